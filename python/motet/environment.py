"""Environments from names, files and values."""

import json
import os
from pathlib import Path

from . import _motet

__all__ = ["Environment"]


class Environment:
    """A robot, a scene and facts, prepared for any number of policies.

    `robot` is a built-in name or a folder with a robot.toml, `scene` a built-in name, a file or a dictionary, `state` a file
    or a dictionary of facts at the start such as `{"holding(mug_1)": True}`, `domain` a file of further declarations. With
    `modifiers` a policy may have manners, deadlines and retries. `syntax` is "json" or "text". Raises `ValueError` if an argument is wrong.
    """

    def __init__(self, robot=None, scene=None, state=None, domain=None, modifiers=False, syntax="json"):
        if syntax not in ("json", "text"):
            raise ValueError(f"there is no syntax `{syntax}`: json or text")
        declarations = None
        if robot is not None and Path(robot).is_dir():
            folder = Path(robot)
            robot = (folder / "robot.toml").read_text(encoding="utf-8")
            primitives = folder / "primitives.motet"
            declarations = primitives.read_text(encoding="utf-8") if primitives.exists() else None
        domain = None if domain is None else Path(domain).read_text(encoding="utf-8")
        self._environment = _motet.Environment(
            robot=None if robot is None else str(robot),
            declarations=declarations,
            scene=_text(scene),
            state=_text(state),
            domain=domain,
            modifiers=modifiers,
            text=syntax == "text",
        )

    def check(self, policy):
        """The diagnostics of a policy in either syntax: a list of dictionaries, described by `motet schema diagnostic`."""
        return _objects(self._environment.check(policy))

    def _decoder(self, vocabulary, budget):
        return self._environment.decoder(vocabulary, budget)


def _text(given):
    """The name itself, or the text of a file or a value."""
    if given is None:
        return None
    if isinstance(given, dict):
        return json.dumps(given)
    if isinstance(given, os.PathLike) or Path(given).is_file():
        return Path(given).read_text(encoding="utf-8")
    return given


def _objects(lines):
    return [json.loads(line) for line in lines.splitlines() if line]
