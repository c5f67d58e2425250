"""Environments from names, files and values."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

from . import _motet

__all__ = ["Environment"]


class Environment:
    """A robot, a scene and facts, prepared for any number of policies.

    `robot` is a built-in name or a folder with a robot.toml, `scene` a built-in name, a file or a dictionary, `state` a file
    or a dictionary of facts at the start such as `{"holding(mug_1)": True}`, `domain` a file of further declarations. With
    `modifiers` a policy may have manners, deadlines and retries. `syntax` is "json" or "text". Raises `ValueError` if an argument is wrong.
    """

    def __init__(
        self,
        robot: str | os.PathLike[str] | None = None,
        scene: str | os.PathLike[str] | Mapping[str, Any] | None = None,
        state: str | os.PathLike[str] | Mapping[str, Any] | None = None,
        domain: str | os.PathLike[str] | None = None,
        modifiers: bool = False,
        syntax: Literal["json", "text"] = "json",
    ) -> None:
        if syntax not in ("json", "text"):
            raise ValueError(f"there is no syntax `{syntax}`: json or text")
        declarations = None
        if robot is not None and Path(robot).is_dir():
            folder = Path(robot)
            robot = (folder / "robot.toml").read_text(encoding="utf-8")
            primitives = folder / "primitives.motet"
            declarations = primitives.read_text(encoding="utf-8") if primitives.exists() else None
        declared = None if domain is None else Path(domain).read_text(encoding="utf-8")
        self._environment = _motet.Environment(
            robot=None if robot is None else str(robot),
            declarations=declarations,
            scene=_text(scene),
            state=_text(state),
            domain=declared,
            modifiers=modifiers,
            text=syntax == "text",
        )

    def check(self, policy: str) -> list[dict[str, Any]]:
        """The diagnostics of a policy in either syntax: a list of dictionaries, described by `motet schema diagnostic`."""
        return _objects(self._environment.check(policy))

    def _decoder(self, vocabulary: _motet.Vocabulary, budget: int) -> _motet.Decoder:
        return self._environment.decoder(vocabulary, budget)


def _text(given: str | os.PathLike[str] | Mapping[str, Any] | None) -> str | None:
    """The name itself, or the text of a file or a value."""
    if given is None:
        return None
    if isinstance(given, Mapping):
        return json.dumps(given)
    if isinstance(given, os.PathLike) or Path(given).is_file():
        return Path(given).read_text(encoding="utf-8")
    return given


def _objects(lines: str) -> list[dict[str, Any]]:
    return [json.loads(line) for line in lines.splitlines() if line]
