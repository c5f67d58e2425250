"""Worlds from names, files and values."""

import json
import os
from pathlib import Path

from . import _motet

__all__ = ["World"]


class World:
    """A robot, a scene and what else is known, prepared for any number of policies.

    `robot` is a name that is built in or a folder with a robot.toml, `scene` a name, a file or a dictionary, `state` a file
    or a dictionary of facts at the start such as `{"holding(mug_1)": True}`, `domain` a file of further declarations.
    `modifiers` gives deadlines and retries a place, `surface` is "json" or "text". Raises `ValueError` where something of it is wrong.
    """

    def __init__(self, robot=None, scene=None, state=None, domain=None, modifiers=False, surface="json"):
        if surface not in ("json", "text"):
            raise ValueError(f"there is no surface `{surface}`: json or text")
        declarations = None
        if robot is not None and Path(robot).is_dir():
            folder = Path(robot)
            robot = (folder / "robot.toml").read_text(encoding="utf-8")
            primitives = folder / "primitives.motet"
            declarations = primitives.read_text(encoding="utf-8") if primitives.exists() else None
        domain = None if domain is None else Path(domain).read_text(encoding="utf-8")
        self._world = _motet.World(
            robot=None if robot is None else str(robot),
            declarations=declarations,
            scene=_text(scene),
            state=_text(state),
            domain=domain,
            modifiers=modifiers,
            text=surface == "text",
        )

    def check(self, policy):
        """What the checker says of a policy in either form: a list of dictionaries as `motet schema diagnostic` has them."""
        return _objects(self._world.check(policy))

    def _decoder(self, vocabulary, budget):
        return self._world.decoder(vocabulary, budget)


def _text(given):
    """The name or the text that a name, a file or a value stands for."""
    if given is None:
        return None
    if isinstance(given, dict):
        return json.dumps(given)
    if isinstance(given, os.PathLike) or Path(given).is_file():
        return Path(given).read_text(encoding="utf-8")
    return given


def _objects(lines):
    return [json.loads(line) for line in lines.splitlines() if line]
