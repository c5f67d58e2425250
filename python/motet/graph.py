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

    @property
    def calls(self) -> dict[str, tuple[str, ...]]:
        """The primitives that the policy calls, each with the names of its parameters.

        >>> import motet
        >>> motet.compile('policy greet for hsr { say("Hello!") done }').calls
        {'say': ('text',)}
        """
        graph = self.to_dict()
        return {one["name"]: tuple(param["name"] for param in one["params"]) for one in graph["primitives"]}

    @property
    def asks(self) -> frozenset[str]:
        """The facts and measures of which the run asks the robot: those of conditions, monitors and the goal, and of the needs
        that the check has left to the run. After a failure the run may ask for more: it no longer takes for true what the step
        that failed changes.

        >>> import motet
        >>> graph = motet.compile("policy get for hsr { go(mug_1) pick(mug_1) done }", scene="kitchen")
        >>> "visible" in graph.asks, "near" in graph.asks
        (True, False)
        """
        graph = self.to_dict()
        found: set[str] = set()
        _asked([graph["nodes"], graph.get("goal")], graph, found)
        return frozenset(found)

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

    def _repr_html_(self) -> str:
        return self._repr_svg_() + self.report._repr_html_()


#: Parts of a node that say what it does, not what it asks.
_EFFECT_KEYS = frozenset(("effects", "unsettles", "lasts", "motion", "leaves"))


def _asked(part: Any, graph: dict[str, Any], found: set[str]) -> None:
    """Collects the facts and measures that a part of a graph asks for."""
    if isinstance(part, list):
        for item in part:
            _asked(item, graph, found)
    if not isinstance(part, dict) or ("condition" in part and part.get("verdict", "deferred") != "deferred"):
        return
    for key, value in part.items():
        if key == "fact" and isinstance(value, dict) and graph["fluents"][value["fluent"]]["observable"]:
            found.add(graph["fluents"][value["fluent"]]["name"])
        if key == "measure":
            found.add(graph["measures"][value[0]]["name"])
        if key not in _EFFECT_KEYS:
            _asked(value, graph, found)
