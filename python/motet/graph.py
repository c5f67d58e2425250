"""Compiled policies."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Literal

from .pictures import outline

if TYPE_CHECKING:
    from . import _motet
    from .report import Report

__all__ = ["Graph"]


class Graph:
    """A policy that has passed the check, with its execution graph. `report` has the warnings of the check.

    >>> import motet
    >>> graph = motet.compile('policy greet for hsr { say("Hello!") done }')
    >>> graph.policy, graph.to_dict()["policy"]
    ('greet', 'greet')
    """

    def __init__(self, native: _motet.Graph, report: Report) -> None:
        self._native = native
        self.report = report

    @property
    def policy(self) -> str:
        """The name of the policy."""
        return self._native.policy

    def to_json(self) -> str:
        """The graph in its versioned JSON encoding, which a robot's own computer runs."""
        return self._native.json()

    def to_dict(self) -> dict[str, Any]:
        """The graph as values of Python."""
        return dict(json.loads(self.to_json()))

    def to_policy(self, syntax: Literal["json", "text"] = "text") -> str:
        """The policy in a syntax. Raises `ValueError` if JSON cannot hold the declarations of the document."""
        return self._native.policy_as(syntax)

    def tree(self) -> str:
        """The graph as an indented tree with guards, effects and durations in s."""
        return self._native.tree()

    def mermaid(self) -> str:
        """The graph as a Mermaid flowchart."""
        return self._native.mermaid()

    def dot(self) -> str:
        """The graph for Graphviz."""
        return self._native.dot()

    def __str__(self) -> str:
        return self.tree()

    def __repr__(self) -> str:
        return f"<motet.Graph of {self.policy!r}>"

    def _repr_svg_(self) -> str:
        return outline(self.tree())
