"""Tests need the command `motet`: in PATH, in $MOTET, or as built in this checkout."""

import os
import pathlib
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from motet_mujoco.model import ModelError, find_motet  # noqa: E402


def pytest_configure():
    for build in ("debug", "release"):
        built = ROOT / "target" / build / "motet"
        if built.exists():
            os.environ.setdefault("MOTET", str(built))


@pytest.fixture(scope="session")
def motet():
    """Path of the command."""
    try:
        return find_motet()
    except ModelError as error:
        pytest.skip(str(error))
