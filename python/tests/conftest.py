"""Shared fixtures: a tokenizer in a file, an environment, the command `motet`, and the examples."""

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from small_tokenizer import tokenizer_json

pytest_plugins = ["pytester"]

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.motet")) + sorted((ROOT / "examples").glob("*.json"))


@pytest.fixture(scope="session")
def tokenizer(tmp_path_factory):
    path = tmp_path_factory.mktemp("tokenizer") / "tokenizer.json"
    path.write_text(json.dumps(tokenizer_json()))
    return path


@pytest.fixture(scope="session")
def environment():
    import motet

    return motet.Environment(robot="hsr", scene="kitchen")


@pytest.fixture(scope="session")
def command():
    """Runs the command: the bytes of its output, which may be diagnostics."""
    program = os.environ.get("MOTET") or shutil.which("motet")
    assert program, "the command `motet` is not on the path, and MOTET does not name it"

    def run(*words):
        done = subprocess.run([program, *map(str, words)], capture_output=True, cwd=ROOT, timeout=300)
        assert done.returncode in (0, 1, 3), done.stderr.decode()
        return done.stdout.decode()

    return run


def setting(example):
    """The robot and the scene of an example, which its text names."""
    text = example.with_suffix(".motet").read_text()
    robot, scene = re.search(r"Robot ([a-z0-9_]+), scene ([a-z0-9_]+)\.", text).groups()
    return {"robot": robot, "scene": scene}
