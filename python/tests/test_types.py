"""Types: the stub of the native part says what the module has, and the package is clean for mypy and pyright."""

import ast
import inspect
import json
import re
import subprocess
import sys
from pathlib import Path

import motet
import pytest
from conftest import ROOT
from motet import _motet

PACKAGE = Path(motet.__file__).parent


def of_stub():
    """Members of the stub with the names of their parameters; None for values and properties."""
    members = {}

    def add(prefix, node):
        if isinstance(node, ast.ClassDef):
            members[prefix + node.name] = None
            for inner in node.body:
                add(f"{prefix}{node.name}.", inner)
        elif isinstance(node, ast.FunctionDef):
            args = [*node.args.args, *node.args.kwonlyargs]
            is_property = any(getattr(mark, "id", "") == "property" for mark in node.decorator_list)
            names = [arg.arg for arg in args if arg.arg not in ("self", "cls")]
            members[prefix + node.name] = None if is_property else names
        elif isinstance(node, ast.AnnAssign):
            members[prefix + node.target.id] = None

    for node in ast.parse((PACKAGE / "_motet.pyi").read_text()).body:
        add("", node)
    return members


def of_module():
    members = {}

    def add(prefix, name, value):
        if callable(value) and not inspect.isclass(value):
            signature = getattr(value, "__text_signature__", None) or "()"
            names = re.findall(r"(?:^|, )(?!\$?self)(\w+)", signature.strip("()").replace("$self, /", "self"))
            members[prefix + name] = names
        else:
            members[prefix + name] = None

    for name in dir(_motet):
        value = getattr(_motet, name)
        if name == "__version__" or not name.startswith("_"):
            add("", name, value)
        if inspect.isclass(value):
            add(f"{name}.", "__new__", value) if value.__text_signature__ else None
            for inner, content in vars(value).items():
                if inner == "__len__" or not inner.startswith("_"):
                    add(f"{name}.", inner, content.__func__ if isinstance(content, staticmethod) else content)
    return members


def test_the_stub_has_what_the_module_has():
    stub, module = of_stub(), of_module()
    # The signature of a class is that of its constructor.
    for name in [name for name in stub if name.endswith(".__new__")]:
        cls = getattr(_motet, name.removesuffix(".__new__"))
        module[name] = list(inspect.signature(cls).parameters)
    assert sorted(stub) == sorted(module)
    wrong = {name: (stub[name], module[name]) for name in stub if stub[name] != module[name]}
    assert not wrong


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
