"""Motet: policies for robots, checked before anything moves.

    class MyRobot(motet.Driver):
        async def go(self, goal, to):
            await self.base.drive(to)

    motet.serve(MyRobot())

`Driver`, `serve` and their like need the standard library of Python alone. The other names need the compiled part of the package,
which is loaded when the first of them is used.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .driver import Driver, Failed, Goal, Motion, Refused, observes
from .serving import serve
from .values import ANY, Case, Entity, Pose, Text

if TYPE_CHECKING:
    from ._motet import __version__
    from .decoder import Decoder
    from .environment import Environment
    from .vocabularies import Vocabulary, vocabulary

_COMPILED = {
    "__version__": "_motet",
    "Decoder": "decoder",
    "Environment": "environment",
    "Vocabulary": "vocabularies",
    "vocabulary": "vocabularies",
}

__all__ = [
    "ANY", "Case", "Driver", "Entity", "Failed", "Goal", "Motion", "Pose", "Refused", "Text", "observes", "serve",
    "Decoder", "Environment", "Vocabulary", "__version__", "vocabulary",
]


def __getattr__(name: str) -> object:
    if name not in _COMPILED:
        raise AttributeError(f"module 'motet' has no attribute {name!r}")
    from importlib import import_module

    found = getattr(import_module(f".{_COMPILED[name]}", __name__), name)
    globals()[name] = found
    return found
