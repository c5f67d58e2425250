"""Shared fixtures: a tokenizer in a file, and an environment."""

import json

import pytest
from small_tokenizer import tokenizer_json


@pytest.fixture(scope="session")
def tokenizer(tmp_path_factory):
    path = tmp_path_factory.mktemp("tokenizer") / "tokenizer.json"
    path.write_text(json.dumps(tokenizer_json()))
    return path


@pytest.fixture(scope="session")
def environment():
    import motet

    return motet.Environment(robot="hsr", scene="kitchen")
