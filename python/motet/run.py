"""Runs that are over, and replays of them."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any, overload

from . import _motet
from .pictures import Bar, lanes

if TYPE_CHECKING:
    import pandas

    from .graph import Graph
    from .report import Report

__all__ = ["Event", "Replay", "Run", "replay"]


@dataclass(frozen=True, slots=True)
class Event:
    """An event of a run.

    `at` is the time in s since the start, `event` its name, such as `command`, `node` the number of its step in the graph,
    `path` the place of the step in the policy, `step` the step in one line; these three are None for events without a step.
    `more` has what depends on the name: the `docs/running.md` lists it.
    """

    at: float
    event: str
    node: int | None
    path: str | None
    step: str | None
    more: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Replay:
    """A journal after the engine went through it again.

    `entries` and `effects` are the numbers of those compared, `at` is the time of the last in s, `difference` the first one that
    differs or None, `verdict` the result for people.

    `state` is the engine's state after the last entry, as `motet replay --json` has it (its times are in ns), and `text` the same
    for people: facts, readings, bindings, and the goals that run. They are None and empty if `motet.replay` goes to the end.
    `print` shows the text and the verdict.
    """

    entries: int
    effects: int
    at: float
    difference: Mapping[str, Any] | None
    state: Mapping[str, Any] | None
    verdict: str
    text: str = ""

    @property
    def is_identical(self) -> bool:
        """True if the engine did again all that it had done."""
        return self.difference is None

    def __str__(self) -> str:
        return self.text + self.verdict

    @classmethod
    def _of(cls, native: tuple[str, str, str]) -> Replay:
        verdict, text, record = native[0], native[1], json.loads(native[2])
        at = record["at"] / 1e9
        return cls(record["entries"], record["effects"], at, record["difference"], record["state"], verdict, text)


def replay(
    folder: str | os.PathLike[str], *, at: float | None = None, entry: int | None = None
) -> Replay:
    """Replays the journal in a folder to a time in s, to the entry with a number, or to the end.

    With `at` or `entry` the replay has the state there. Raises `motet.InputError` if the journal cannot be read.
    """
    return Replay._of(_motet.replay(os.fspath(folder), at, entry))


class Run(Sequence[Event]):
    """A run that is over: a sequence of its events. `graph` is the policy that ran, `report` has the warnings of its check.

    >>> import motet
    >>> run = motet.simulate('policy greet for hsr { say("Hello!") done }')
    >>> run.outcome, run.ok, [event.event for event in run][-1]
    ('done', True, 'finished')
    >>> run.replay().is_identical
    True
    """

    def __init__(self, native: _motet.Run, graph: Graph, report: Report) -> None:
        self._native = native
        self.graph = graph
        self.report = report
        self.events: tuple[Event, ...] = tuple(_event(json.loads(line)) for line in native.events().splitlines())

    @property
    def outcome(self) -> str:
        """The end of the run: `done`, `failed`, `declined`, `replan`, `interrupted` or `fault`."""
        return str(self.events[-1].more["outcome"])

    @property
    def ok(self) -> bool:
        """True if the policy came to its `done`."""
        return self.outcome == "done"

    @property
    def failure(self) -> str | None:
        """The failure that ended the run, such as `slipped`, or None."""
        found = self.events[-1].more.get("failure")
        return None if found is None else str(found)

    @property
    def why(self) -> str | None:
        """The reason for the end, in words, or None: that of the driver, or the need that a step lacked."""
        found = self.events[-1].more.get("why")
        return None if found is None else str(found)

    @property
    def result(self) -> Any:
        """The value that the policy gave, or None."""
        return self.events[-1].more.get("result")

    @property
    def duration(self) -> float:
        """The time of the last event, in s."""
        return self.events[-1].at

    def to_json(self) -> str:
        """The events as JSON objects, one a line: the bytes of `motet run --format json --speed max`."""
        return self._native.events()

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each event. Raises `ImportError` without pandas."""
        import pandas

        return pandas.DataFrame([json.loads(line) for line in self.to_json().splitlines()])

    def replay(self, *, at: float | None = None, entry: int | None = None) -> Replay:
        """Replays the run to a time in s, to the entry of its journal with a number, or to the end, with the state there."""
        return Replay._of(self._native.replay(at, entry))

    @overload
    def __getitem__(self, index: int) -> Event: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Event, ...]: ...
    def __getitem__(self, index: int | slice) -> Event | tuple[Event, ...]:
        return self.events[index]

    def __len__(self) -> int:
        return len(self.events)

    def __iter__(self) -> Iterator[Event]:
        return iter(self.events)

    def __repr__(self) -> str:
        return f"<motet.Run of {self.graph.policy!r}: {self.outcome}, {self.duration:.1f} s, {len(self)} events>"

    def _bars(self) -> list[Bar]:
        begun: dict[str, Event] = {}
        bars = []
        for event in self.events:
            if event.event == "command":
                begun[event.more["goal"]] = event
            elif event.event == "goal_ended" and (start := begun.pop(event.more["goal"], None)) is not None:
                bars.append(_bar(start, event.at, event.more["ending"]))
        return bars + [_bar(start, self.duration, "running") for start in begun.values()]

    def _repr_svg_(self) -> str:
        return lanes(self._bars(), self.duration)

    def _repr_html_(self) -> str:
        end = "" if self.failure is None else f": {self.failure}" + ("" if self.why is None else f", {self.why}")
        caption = f"{self.graph.policy}: {self.outcome} after {self.duration:.1f} s{end}"
        return f"{self._repr_svg_()}<p>{escape(caption)}</p>"


def _event(record: dict[str, Any]) -> Event:
    known = {name: record.pop(name, None) for name in ("at", "event", "node", "path", "step")}
    return Event(**known, more=record)


def _bar(start: Event, until: float, ending: str) -> Bar:
    word = {"success": "done", "failure": "failed", "interrupted": "interrupted"}.get(ending, "running")
    return Bar(str(start.more["primitive"]), start.at, until, str(start.step), word)
