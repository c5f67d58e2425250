"""Motet: policies for robots, checked before anything moves.

    report = motet.check(policy, robot="hsr", scene="kitchen")     # what `motet check` says
    run = motet.simulate(policy, robot="hsr", scene="kitchen")     # what `motet run` does

    class MyRobot(motet.Driver):
        async def go(self, goal, to):
            await self.base.drive(to)

    motet.drive(policy, MyRobot(), scene="kitchen")                # in this process
    motet.serve(MyRobot())                                         # for `motet run --driver`

`Driver`, `serve` and their like need the standard library of Python alone. The other names need the compiled part of the package,
which is loaded when the first of them is used.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .driver import Driver, Failed, Goal, Lost, Motion, Refused, observes, performs
from .errors import InputError, PlanError, PolicyError
from .serving import serve
from .values import ANY, Case, Entity, Pose, Text

if TYPE_CHECKING:
    from ._motet import Vocabulary, __version__, explain
    from .conformance import Conformance, check_driver
    from .decoder import Decoder
    from .environment import Environment
    from .graph import Graph
    from .inputs import Inputs
    from .motions import Feasibility, MotionVerdict, feasible
    from .project import Plan, Project, check, compile, drive, fix, fmt, plan, simulate
    from .report import Diagnostic, Report
    from .run import Event, Replay, Run, replay
    from .vocabularies import vocabulary

#: Names that need the compiled part, by the module that has them.
_COMPILED = {
    name: module
    for module, names in {
        "_motet": ("Vocabulary", "__version__", "explain"),
        "conformance": ("Conformance", "check_driver"),
        "decoder": ("Decoder",),
        "environment": ("Environment",),
        "graph": ("Graph",),
        "inputs": ("Inputs",),
        "motions": ("Feasibility", "MotionVerdict", "feasible"),
        "project": ("Plan", "Project", "check", "compile", "drive", "fix", "fmt", "plan", "simulate"),
        "report": ("Diagnostic", "Report"),
        "run": ("Event", "Replay", "Run", "replay"),
        "vocabularies": ("vocabulary",),
    }.items()
    for name in names
}

__all__ = [
    "ANY", "Case", "Conformance", "Decoder", "Diagnostic", "Driver", "Entity", "Environment", "Event", "Failed", "Feasibility",
    "Goal", "Graph", "InputError", "Inputs", "Lost", "Motion", "MotionVerdict", "Plan", "PlanError", "PolicyError", "Pose", "Project",
    "Refused", "Replay", "Report", "Run", "Text", "Vocabulary", "__version__", "check", "check_driver", "compile", "drive",
    "explain", "feasible", "fix", "fmt", "observes", "performs", "plan", "replay", "serve", "simulate", "vocabulary",
]


def __dir__() -> list[str]:
    return sorted({*globals(), *_COMPILED})


def __getattr__(name: str) -> object:
    if name not in _COMPILED:
        raise AttributeError(f"module 'motet' has no attribute {name!r}")
    from importlib import import_module

    found = getattr(import_module(f".{_COMPILED[name]}", __name__), name)
    globals()[name] = found
    return found
