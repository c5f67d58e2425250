"""Exceptions of checks, plans and runs. Each is a `ValueError` with the diagnostics that explain it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .report import Diagnostic

__all__ = ["InputError", "PlanError", "PolicyError"]


class PolicyError(ValueError):
    """The refusal of a policy. `diagnostics` is a tuple of `motet.Diagnostic`, in the order of the document."""

    def __init__(self, message: str, diagnostics: Iterable[Diagnostic] = ()) -> None:
        super().__init__(message)
        self.diagnostics: tuple[Diagnostic, ...] = tuple(diagnostics)


class InputError(ValueError):
    """The refusal of a robot, a scene or another input. `help` is advice or None, `diagnostics` are about its file."""

    def __init__(self, message: str, help: str | None = None, json_lines: str = "") -> None:
        super().__init__(message if help is None else f"{message} (help: {help})")
        self.help: str | None = help
        self.diagnostics: tuple[Diagnostic, ...] = _diagnostics(json_lines)


class PlanError(ValueError):
    """The answer of the planner where it finds no policy. `diagnostics` are about the goal or the plan."""

    def __init__(self, message: str, json_lines: str = "") -> None:
        super().__init__(message)
        self.diagnostics: tuple[Diagnostic, ...] = _diagnostics(json_lines)


def _diagnostics(json_lines: str) -> tuple[Diagnostic, ...]:
    from .report import read_diagnostics

    return read_diagnostics(json_lines)
