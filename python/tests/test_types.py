"""Types: the package is clean for mypy and pyright. `wheel.sh` compares the stub of the native part with the module."""

import json
import subprocess
import sys

import motet
import pytest
from conftest import ROOT


def test_mypy_is_content():
    pytest.importorskip("mypy")
    words = [sys.executable, "-m", "mypy", "--strict", "motet"]
    done = subprocess.run(words, capture_output=True, text=True, cwd=ROOT / "python")
    assert done.returncode == 0, done.stdout + done.stderr


def test_pyright_knows_the_type_of_every_public_name():
    pytest.importorskip("pyright")
    words = [sys.executable, "-m", "pyright", "--verifytypes", "motet", "--ignoreexternal", "--outputjson"]
    words += ["--pythonpath", sys.executable]
    done = subprocess.run(words, capture_output=True, text=True)
    if not done.stdout.startswith("{"):
        pytest.skip(f"pyright does not run: {(done.stdout + done.stderr)[:200]}")
    found = json.loads(done.stdout)["typeCompleteness"]
    exported = {symbol["name"]: symbol["isTypeKnown"] for symbol in found["symbols"] if symbol["isExported"]}
    unseen = [name for name in motet.__all__ if f"motet.{name}" not in exported]
    assert unseen in ([], ["__version__"])
    unknown = [name for name, is_known in exported.items() if not is_known]
    assert not unknown and done.returncode == 0, (unknown[:5], done.stdout[-2000:] + done.stderr)
