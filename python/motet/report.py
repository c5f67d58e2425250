"""Reports of checks: diagnostics as frozen dataclasses."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any, Literal, overload

from .errors import PolicyError
from .pictures import outline

if TYPE_CHECKING:
    from ._motet import Findings

__all__ = ["About", "AppliedFix", "Diagnostic", "Edit", "Fix", "Related", "Report", "Span", "read_diagnostics"]

Severity = Literal["error", "warning", "note"]


@dataclass(frozen=True, slots=True)
class Span:
    """A range of bytes from `start` to before `end`; `line` and `column`, in characters, are those of its start, from 1."""

    start: int
    end: int
    line: int
    column: int


@dataclass(frozen=True, slots=True)
class Related:
    """Another range that explains a diagnostic. `span` is None for a fact outside of any file."""

    message: str
    path: str
    span: Span | None
    file: str | None = None


@dataclass(frozen=True, slots=True)
class Edit:
    """The replacement of the bytes from `start` to before `end` by a text."""

    start: int
    end: int
    text: str


@dataclass(frozen=True, slots=True)
class Fix:
    """Edits that repair a mistake, all to be made together."""

    title: str
    edits: tuple[Edit, ...]


@dataclass(frozen=True, slots=True)
class About:
    """Names that a diagnostic is about, for programs that act on it."""

    primitive: str | None = None
    parameter: str | None = None
    subject: str | None = None
    wanted: bool | None = None


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """A message for the author of a policy.

    `code` is one such as `M0501`, `message` the mistake in one clause, `help` the text to write instead or None, `file` the name
    of the document, `path` a JSON Pointer into the JSON form of the policy.
    """

    code: str
    severity: Severity
    message: str
    help: str | None
    file: str
    path: str
    span: Span
    related: tuple[Related, ...] = ()
    fix: Fix | None = None
    about: About | None = None

    def __str__(self) -> str:
        return f"{self.file}:{self.span.line}:{self.span.column}: {self.severity}: {self.message} ({self.code})"


@dataclass(frozen=True, slots=True)
class AppliedFix:
    """A fix that was made: the code of its diagnostic, a description of the change, and its applicability."""

    code: str
    title: str
    is_safe: bool


class Report(Sequence[Diagnostic]):
    """The diagnostics of a policy and of its robot, scene and state, errors and warnings alike, in order.

    A report is a sequence. `ok` is True without errors. `fixed` is the document after `motet.fix`, `applied` the fixes that
    were made; `fixed` is None in the report of a check.

    >>> import motet
    >>> report = motet.check("policy drop for hsr { place(mug_1, shelf) done }", scene="kitchen")
    >>> report.ok, report[0].code
    (False, 'M0501')
    """

    def __init__(self, findings: Findings, fixed: str | None = None, applied: Sequence[AppliedFix] = ()) -> None:
        self._findings = findings
        self.diagnostics: tuple[Diagnostic, ...] = read_diagnostics(findings.json())
        self.fixed = fixed
        self.applied: tuple[AppliedFix, ...] = tuple(applied)

    @property
    def errors(self) -> tuple[Diagnostic, ...]:
        """The errors alone."""
        return tuple(found for found in self.diagnostics if found.severity == "error")

    @property
    def ok(self) -> bool:
        """True without errors: the policy may run."""
        return not self.errors

    def raise_if_errors(self) -> Report:
        """Returns the report itself. Raises `motet.PolicyError` with all diagnostics if there are errors."""
        if errors := self.errors:
            first, more = errors[0], f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
            advice = f"; {first.help}" if first.help else ""
            place = f"{first.file}:{first.span.line}:{first.span.column}"
            raise PolicyError(f"the policy is refused: {first.message}{advice}, at {place}{more}", self.diagnostics)
        return self

    def to_json(self) -> str:
        """The diagnostics as JSON objects, one a line: the bytes of `motet check --format json`."""
        return self._findings.json()

    def to_prompt(self) -> str:
        """Short sentences for the next prompt of a language model, the most useful first."""
        return self._findings.llm()

    def render(self, width: int = 100, color: bool = False) -> str:
        """The text for people with the source around each span, in up to `width` columns."""
        return self._findings.human(width, color)

    @overload
    def __getitem__(self, index: int) -> Diagnostic: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Diagnostic, ...]: ...
    def __getitem__(self, index: int | slice) -> Diagnostic | tuple[Diagnostic, ...]:
        return self.diagnostics[index]

    def __len__(self) -> int:
        return len(self.diagnostics)

    def __iter__(self) -> Iterator[Diagnostic]:
        return iter(self.diagnostics)

    def __str__(self) -> str:
        return self.render() if self.diagnostics else "no errors\n"

    def __repr__(self) -> str:
        return f"<motet.Report: {len(self.errors)} errors, {len(self)} diagnostics>"

    def _repr_svg_(self) -> str:
        rows = [f"{_SIGNS[found.severity]} {found}" for found in self.diagnostics]
        return outline("\n".join(rows or ["✓ no errors"]))

    def _repr_html_(self) -> str:
        if not self.diagnostics:
            return "<p>✓ no errors</p>"
        rows = "".join(map(_row, self.diagnostics))
        source = f"<details><summary>in the source</summary><pre>{escape(self.render())}</pre></details>"
        return f"<table>{rows}</table>{source}"


_SIGNS = {"error": "✗", "warning": "⚠", "note": "·"}


def _row(found: Diagnostic) -> str:
    sign = _SIGNS[found.severity]
    place = f"{found.file}:{found.span.line}:{found.span.column}"
    advice = "" if found.help is None else f"<br><i>help: {escape(found.help)}</i>"
    cells = (f"{sign} {found.severity}", found.code, place)
    return "".join(
        ["<tr>", *(f"<td>{escape(cell)}</td>" for cell in cells), f"<td>{escape(found.message)}{advice}</td></tr>"]
    )


def read_diagnostics(json_lines: str) -> tuple[Diagnostic, ...]:
    """The diagnostics of JSON objects, one a line, as `motet check --format json` prints them."""
    return tuple(_diagnostic(json.loads(line)) for line in json_lines.splitlines() if line)


def _diagnostic(record: dict[str, Any]) -> Diagnostic:
    related = tuple(
        Related(one["message"], one["path"], None if one["span"] is None else Span(**one["span"]), one.get("file"))
        for one in record["related"]
    )
    fix, about = record["fix"], record.get("about")
    return Diagnostic(
        code=record["code"],
        severity=record["severity"],
        message=record["message"],
        help=record["help"],
        file=record["file"],
        path=record["path"],
        span=Span(**record["span"]),
        related=related,
        fix=None if fix is None else Fix(fix["title"], tuple(Edit(**edit) for edit in fix["edits"])),
        about=None if about is None else About(**about),
    )
