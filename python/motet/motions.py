"""Verdicts on motions of a robot in a scene."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any, Literal, overload

from . import _motet
from .inputs import Clearance, RobotLike, SceneLike, StateLike, factor, metres, name_or_json
from .report import Report

__all__ = ["Feasibility", "MotionVerdict", "feasible"]


@dataclass(frozen=True, slots=True)
class MotionVerdict:
    """The verdict on one motion.

    `query` is the motion, `answer` the verdict, `text` the same for people. A feasible motion has a `witness`: a mapping with
    `path` (a list of configurations: `base` is [x, y, yaw] in m and rad in the frame `map`, `joints` m or rad by name), `grasp`
    and `margins` (m, kg). An infeasible one has a `reason`, the clause `says`, perhaps `needs`, `reach` and `limit` (m or kg) in
    `numbers`, and the `change` that would help. `certified` is True if it is proven and not only not found.
    """

    query: str
    answer: Literal["feasible", "infeasible", "unknown"]
    text: str
    witness: Mapping[str, Any] | None
    reason: str | None
    says: str | None
    change: str | None
    certified: bool
    numbers: Mapping[str, float]

    def __str__(self) -> str:
        return self.text

    @classmethod
    def _of(cls, text: str, line: str) -> MotionVerdict:
        record = json.loads(line)
        numbers = {name: record[name] for name in ("needs", "reach", "limit") if name in record}
        return cls(
            record["query"],
            record["answer"],
            text,
            record.get("witness"),
            record.get("reason"),
            record.get("says"),
            record.get("change"),
            bool(record.get("certified", False)),
            numbers,
        )


class Feasibility(Sequence[MotionVerdict]):
    """Verdicts in the order of the motions, with a drawing of the scene from above. `report` has the warnings on the inputs."""

    def __init__(self, lines: Sequence[tuple[str, str]], svg: str, report: Report) -> None:
        self._lines = tuple(line for _, line in lines)
        self.verdicts: tuple[MotionVerdict, ...] = tuple(MotionVerdict._of(text, line) for text, line in lines)
        self.svg = svg
        self.report = report

    @property
    def ok(self) -> bool:
        """True if every motion is feasible."""
        return all(verdict.answer == "feasible" for verdict in self.verdicts)

    def to_json(self) -> str:
        """The verdicts as JSON objects, one a line: the bytes of `motet feasible --format json`."""
        return self.report.to_json() + "".join(line + "\n" for line in self._lines)

    @overload
    def __getitem__(self, index: int) -> MotionVerdict: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[MotionVerdict, ...]: ...
    def __getitem__(self, index: int | slice) -> MotionVerdict | tuple[MotionVerdict, ...]:
        return self.verdicts[index]

    def __len__(self) -> int:
        return len(self.verdicts)

    def __iter__(self) -> Iterator[MotionVerdict]:
        return iter(self.verdicts)

    def __str__(self) -> str:
        return "".join(verdict.text for verdict in self.verdicts)

    def __repr__(self) -> str:
        feasible = sum(verdict.answer == "feasible" for verdict in self.verdicts)
        return f"<motet.Feasibility: {feasible} of {len(self)} motions are feasible>"

    def _repr_svg_(self) -> str:
        return self.svg

    def _repr_html_(self) -> str:
        return f"{self.svg}<pre>{escape(str(self))}</pre>"


def feasible(
    motions: str | Iterable[str] | None = None,
    *,
    robot: RobotLike,
    scene: SceneLike,
    state: StateLike | None = None,
    effort: int = 1,
    clearance: Clearance | None = None,
) -> Feasibility:
    """Decides motions, each from the start of the scene: all motions of the scene, or those given. `state` has facts at the
    start, beside those of the scene.

    A motion is a call such as `go_to(shelf)`, `reach(mug_1, top)` or `put(mug_1, shelf)`. `effort` is the factor of the search
    budget, `clearance` the distances from obstacles in m. Raises `motet.InputError`.

    >>> import motet
    >>> motet.feasible("reach(mug_1)", robot="hsr", scene="kitchen").ok
    True
    """
    given = None if motions is None else [motions] if isinstance(motions, str) else list(motions)
    base_m, arm_m = metres(clearance)
    verdicts, svg, findings = _motet.feasible(
        name_or_json(robot),
        name_or_json(scene),
        given,
        state=None if state is None else name_or_json(state),
        effort=factor(effort),
        base_m=base_m,
        arm_m=arm_m,
    )
    return Feasibility(verdicts, svg, Report(findings))
