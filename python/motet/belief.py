"""What a script knows: facts that are true, false or unknown, readings, and the conditions that it asks of them.

A script keeps the books that the engine keeps: effects of calls and observations, by single facts and by patterns with `ANY`.
Truth values are True, False and None for unknown (Kleene's strong logic).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from decimal import Decimal
from typing import Any

from .values import ANY, Entity, Text

__all__ = [
    "EACH", "Arith", "Beliefs", "Change", "Compare", "Count", "Fact", "Field", "First", "Look", "Measure", "Not", "RESULT", "Said",
    "all_of", "any_of", "compare", "count", "fact", "field", "first", "measure", "no", "said", "arith",
]

#: The fluent that follows from a motion. What was seen of it does not last.
DERIVED = "reachable"


class _Each:
    """Stands for each entity of a kind, in an entry of a contract."""

    def __repr__(self) -> str:
        return "EACH"


EACH = _Each()


class _Result:
    """The result of the call whose contract speaks of it."""

    def __repr__(self) -> str:
        return "RESULT"


RESULT = _Result()


@dataclass(frozen=True)
class Fact:
    """A fluent with its arguments; `ANY` stands for some entity in a condition, and for every one in an effect."""

    fluent: str
    args: tuple[Any, ...]


@dataclass(frozen=True)
class Measure:
    """A number that the robot observes."""

    measure: str
    args: tuple[Any, ...]


@dataclass(frozen=True)
class Field:
    """A property of an entity, such as its mass."""

    of: Any
    field: str


@dataclass(frozen=True)
class Compare:
    """A comparison of two values; all but `==` and `!=` are of numbers."""

    left: Any
    sign: str
    right: Any


@dataclass(frozen=True)
class Not:
    """The opposite of a condition."""

    inner: Any


@dataclass(frozen=True)
class _Joined:
    parts: tuple[Any, ...]
    #: The value that decides: False of a conjunction, True of a disjunction.
    decides: bool


@dataclass(frozen=True)
class Arith:
    """Arithmetic on two numbers."""

    left: Any
    sign: str
    right: Any


@dataclass(frozen=True)
class Count:
    """The number of elements of a list."""

    of: Any


@dataclass(frozen=True)
class First:
    """The first element of a list; an empty list has none."""

    of: Any


@dataclass(frozen=True)
class Said:
    """A text with values; a value is a pair of itself and its type."""

    parts: tuple[Any, ...]


def fact(fluent: str, *args: Any) -> Fact:
    """A fluent with its arguments."""
    return Fact(fluent, args)


def measure(name: str, *args: Any) -> Measure:
    """A measure with its arguments."""
    return Measure(name, args)


def field(of: Any, name: str) -> Field:
    """A property of an entity."""
    return Field(of, name)


def compare(left: Any, sign: str, right: Any) -> Compare:
    """A comparison, with the sign that Python has for it."""
    return Compare(left, sign, right)


def no(inner: Any) -> Not:
    """The opposite of a condition, or an effect that makes a fact false."""
    return Not(inner)


def all_of(*parts: Any) -> _Joined:
    """A conjunction; true if it is empty."""
    return _Joined(parts, False)


def any_of(*parts: Any) -> _Joined:
    """A disjunction; false if it is empty."""
    return _Joined(parts, True)


def arith(left: Any, sign: str, right: Any) -> Arith:
    """Arithmetic on two numbers."""
    return Arith(left, sign, right)


def count(of: Any) -> Count:
    """The number of elements of a list."""
    return Count(of)


def first(of: Any) -> First:
    """The first element of a list."""
    return First(of)


def said(*parts: Any) -> Said:
    """A text with values."""
    return Said(parts)


def both(left: bool | None, right: bool | None) -> bool | None:
    """A conjunction of two truth values."""
    if left is False or right is False:
        return False
    return True if left and right else None


def covers(wide: tuple[Any, ...], other: tuple[Any, ...]) -> bool:
    """Answers whether every fact of `other` is one of `wide`."""
    return all(mine is ANY or mine == its for mine, its in zip(wide, other, strict=True))


def overlaps(one: tuple[Any, ...], other: tuple[Any, ...]) -> bool:
    """Answers whether some fact is one of both."""
    return all(mine is ANY or its is ANY or mine == its for mine, its in zip(one, other, strict=True))


@dataclass
class _Cell:
    truth: bool | None
    #: The number of the observation behind it, 0 for an effect.
    seen: int
    at: float = 0.0


@dataclass(frozen=True)
class Change:
    """A change of what is believed, worked out before any change is made."""

    fact: Fact
    truth: bool | None
    #: False where it may have happened.
    sure: bool = True
    #: True if a pattern is meant only of facts that nobody has asked for yet.
    rest: bool = False


class Beliefs:
    """What is believed. `kinds` are the kinds of entities with their parents, parents first."""

    def __init__(self, kinds: dict[str, str | None], observable: tuple[str, ...]) -> None:
        self.kinds: dict[str, str | None] = kinds
        self.observable: tuple[str, ...] = observable
        self.entities: dict[str, str] = {}
        self.observations: int = 0
        self.now: float = 0.0
        self._observing = 0
        self._cells: dict[Fact, _Cell] = {}
        self._wides: dict[str, list[tuple[Fact, bool | None, int]]] = {}
        self._readings: dict[Measure | Field, tuple[Any, float]] = {}
        #: Facts that last only so long, with the resources and the entities that end them.
        self.lasting: dict[Fact, tuple[frozenset[str], frozenset[Any]]] = {}

    # Entities.

    def is_kind(self, kind: str | None, above: str) -> bool:
        """Answers whether a kind is another or below it."""
        while kind is not None and kind != above:
            kind = self.kinds.get(kind)
        return kind is not None

    def hear(self, value: Any, kind: str | None) -> None:
        """Learns of the entities in a value of a type. The narrowest kind of each is kept."""
        if isinstance(value, (list, tuple)):
            inner = kind[5:-1] if kind is not None and kind.startswith("List<") else None
            for item in value:
                self.hear(item, inner)
        elif isinstance(value, Entity) and kind in self.kinds:
            known = self.entities.get(value)
            if known is None or self.is_kind(kind, known):
                self.entities[value] = kind

    def of_kind(self, kind: str) -> list[tuple[Entity, bool]]:
        """The known entities that are of a kind, or may be; with whether they surely are."""
        sorts = ((Entity(id), self.is_kind(own, kind), self.is_kind(kind, own)) for id, own in self.entities.items())
        return [(id, surely) for id, surely, perhaps in sorts if surely or perhaps]

    # Facts.

    def fact(self, asked: Fact) -> tuple[bool | None, int]:
        """The truth of a fact, and the number of the observation behind it."""
        cell = self._cells.get(asked)
        truth, seen = self._wide(asked) if cell is None else (cell.truth, cell.seen)
        if ANY in asked.args and truth is not True:
            for own in self._covered(asked):
                if self._cells[own].truth is True:
                    return True, self._cells[own].seen
        return truth, seen

    def is_current(self, asked: Fact, since: float) -> bool:
        """Answers whether something was said of a fact since a time."""
        cell = self._cells.get(asked)
        return cell is not None and cell.at >= since

    def intern(self, asked: Fact) -> _Cell:
        """The cell of a fact; a new one says what the patterns say."""
        if asked not in self._cells:
            self._cells[asked] = _Cell(*self._wide(asked))
        return self._cells[asked]

    def apply(self, change: Change) -> None:
        """Makes a change."""
        if change.sure and not change.rest:
            for known in [fact for fact in self.lasting if fact.fluent == change.fact.fluent]:
                if covers(change.fact.args, known.args):
                    del self.lasting[known]
        if ANY in change.fact.args:
            self._write_wide(change)
        else:
            cell = self.intern(change.fact)
            new = change.truth if change.sure or cell.truth is change.truth else None
            self._set(cell, new)
            self._unsettle_patterns(change.fact, new)

    def observe(self, query: Fact | Measure | Field, answer: Any) -> None:
        """Takes an observation: a truth of a fact, a value of a reading, None if it is unknown."""
        if not isinstance(query, Fact):
            self._readings[query] = (answer, self.now)
            return
        cell = self.intern(query)
        if answer is None:
            # Nobody can tell now: what was believed stands.
            return
        self.observations += 1
        self._observing = self.observations
        # That none fits says something of each; that some does, or that it is not known, says nothing of any.
        if ANY in query.args and answer is not False:
            self._set(cell, answer)
        else:
            self.apply(Change(query, answer))
        self._observing = 0

    def reading(self, query: Measure | Field, since: float) -> Any:
        """The last reading of a measure since a time, or of a field; None where there is none."""
        value, at = self._readings.get(query, (None, -math.inf))
        is_number = isinstance(value, (int, float))
        if (at < since and isinstance(query, Measure)) or (is_number and not math.isfinite(value)):
            return None
        return value

    def _set(self, cell: _Cell, truth: bool | None) -> None:
        cell.truth, cell.seen, cell.at = truth, self._observing, self.now

    def _covered(self, wide: Fact) -> Iterator[Fact]:
        for own in self._cells:
            if own.fluent == wide.fluent and ANY not in own.args and covers(wide.args, own.args):
                yield own

    def _wide(self, asked: Fact) -> tuple[bool | None, int]:
        for wide, truth, seen in reversed(self._wides.get(asked.fluent, [])):
            if covers(wide.args, asked.args):
                none = truth is False and all(self._cells[own].truth is False for own in self._covered(asked))
                return (None, 0) if ANY in asked.args and not none else (truth, seen)
            # A later write to some of them: only where it says the same does an earlier one stand.
            if overlaps(wide.args, asked.args) and truth is not False:
                return None, 0
        return None, 0

    def _write_wide(self, change: Change) -> None:
        wide, written = change.fact, change.truth if change.sure else None
        for own in [] if change.rest else list(self._covered(wide)):
            cell = self._cells[own]
            self._set(cell, change.truth if change.sure or cell.truth is change.truth else None)
        wides = self._wides.setdefault(wide.fluent, [])
        wides[:] = [entry for entry in wides if not covers(wide.args, entry[0].args)]
        wides.append((wide, written, self._observing))
        self._unsettle_patterns(wide, written)

    def _unsettle_patterns(self, changed: Fact, written: bool | None) -> None:
        """Looks again at the facts with `ANY` that a write touches."""
        for own, cell in self._cells.items():
            if own.fluent != changed.fluent or ANY not in own.args or not overlaps(changed.args, own.args):
                continue
            if covers(changed.args, own.args):
                self._set(cell, written)
            elif written is True:
                self._set(cell, True)
            else:
                # It may have been the one that held, or it may be the one that holds.
                self._set(cell, False if cell.truth is False and written is False else None)


@dataclass(frozen=True)
class Look:
    """A look at what is believed. Notes in `missing` what would have to be observed."""

    beliefs: Beliefs
    #: Readings count from this time on.
    since: float
    #: Facts that can be observed count only if they were seen after the observation of this number.
    seen: int | None = None
    missing: list[Any] | None = None
    #: A text says of an unknown value that it is unknown; otherwise the whole text is.
    is_vague: bool = False
    each: Any = None
    #: Value of `RESULT`, once there is one.
    result: Any = None
    names: tuple[tuple[str, str], ...] = ()

    def of(self, each: Any, missing: list[Any] | None = None) -> Look:
        """The same look with a value for `EACH`."""
        return replace(self, each=each, missing=missing)

    def truth(self, condition: Any) -> bool | None:
        """The truth of a condition."""
        if isinstance(condition, bool):
            return condition
        if isinstance(condition, Not):
            inner = self.truth(condition.inner)
            return None if inner is None else not inner
        if isinstance(condition, _Joined):
            truth: bool | None = not condition.decides
            for part in condition.parts:
                own = self.truth(part)
                if own is condition.decides:
                    return own
                truth = None if own is None else truth
            return truth
        if isinstance(condition, Compare):
            return self._compare(condition)
        return self._fact(condition)

    def fact(self, condition: Fact) -> Fact | None:
        """A fact with values as arguments; None where one is unknown."""
        args = tuple(arg if arg is ANY else self.value(arg) for arg in condition.args)
        return None if None in args else Fact(condition.fluent, args)

    def value(self, term: Any) -> Any:
        """The value of a term; None where it is unknown."""
        if term is EACH:
            return self.each
        if term is RESULT:
            return self.result
        if isinstance(term, (list, tuple)):
            items = tuple(self.value(item) for item in term)
            return None if None in items else items
        if isinstance(term, (Measure, Field)):
            return self._reading(term)
        if isinstance(term, Arith):
            return _arithmetic(self.value(term.left), term.sign, self.value(term.right))
        if isinstance(term, (Count, First)):
            items = self.value(term.of)
            if not isinstance(items, tuple):
                return None
            return len(items) if isinstance(term, Count) else next(iter(items), None)
        if isinstance(term, Said):
            return self._said(term)
        return term

    def _fact(self, condition: Fact) -> bool | None:
        asked = self.fact(condition)
        if asked is None:
            return None
        truth, seen = self.beliefs.fact(asked)
        is_observable = asked.fluent in self.beliefs.observable
        if asked.fluent == DERIVED and not self.beliefs.is_current(asked, self.since):
            truth = None
        if self.seen is not None and is_observable and seen <= self.seen:
            truth = None
        if truth is None and is_observable:
            self._miss(asked)
            if self.missing is not None:
                self.beliefs.intern(asked)
        # Nobody searches for motions beside a script: the driver decides.
        return True if truth is None and not is_observable and asked.fluent == DERIVED else truth

    def _reading(self, term: Measure | Field) -> Any:
        if isinstance(term, Field):
            of = self.value(term.of)
            query: Measure | Field | None = Field(of, term.field) if isinstance(of, Entity) else None
        else:
            args = self.value(term.args)
            query = None if args is None else Measure(term.measure, args)
        value = None if query is None else self.beliefs.reading(query, self.since)
        if value is None and query is not None:
            self._miss(query)
        return value

    def _miss(self, query: Any) -> None:
        if self.missing is not None and query not in self.missing:
            self.missing.append(query)

    def _said(self, term: Said) -> str | None:
        text: str | None = ""
        for part in term.parts:
            # All are looked at, so that everything that is missing is asked for together.
            value = part if isinstance(part, str) else self.value(part[0])
            if isinstance(part, str):
                own: str | None = part
            elif value is None:
                own = "unknown" if self.is_vague else None
            else:
                own = spoken(value, part[1], dict(self.names))
            text = None if text is None or own is None else text + own
        return None if text is None else Text(text)

    def _compare(self, condition: Compare) -> bool | None:
        left, right = self.value(condition.left), self.value(condition.right)
        if left is None or right is None:
            return None
        if condition.sign in ("==", "!="):
            return (left == right) is (condition.sign == "==")
        if not _is_number(left) or not _is_number(right):
            return None
        signs: dict[str, bool] = {"<": left < right, "<=": left <= right, ">": left > right, ">=": left >= right}
        return signs[condition.sign]


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _arithmetic(left: Any, sign: str, right: Any) -> Any:
    if not _is_number(left) or not _is_number(right) or (sign == "/" and right == 0):
        return None
    if sign == "/":
        result: Any = left / right
    else:
        result = {"+": left + right, "-": left - right, "*": left * right}[sign]
    if isinstance(result, int):
        return result if -(2**63) <= result < 2**63 else None
    return result if math.isfinite(result) else None


UNITS = {"Length": "m", "Angle": "deg", "Duration": "s", "Mass": "kg", "Force": "N", "Speed": "m/s", "Ratio": "%"}


def _plain(value: float) -> str:
    """A number without an exponent, and without a fraction where it is whole."""
    text = format(Decimal(repr(value)), "f")
    return text.removesuffix(".0") if "." in text else text


def spoken(value: Any, kind: str, names: dict[str, str]) -> str:
    """A value as a person says it: an entity by its name, a quantity with its unit, a list as `a, b and c`."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (int, float)) and (isinstance(value, float) or kind in UNITS):
        value = {"Angle": round(math.degrees(value), 9), "Ratio": round(value * 100.0, 9)}.get(kind, float(value))
        value = float(round(value)) if abs(value) >= 100.0 else float(f"{value:.2e}")
        return f"{_plain(value)} {UNITS[kind]}" if kind in UNITS else _plain(value)
    if isinstance(value, Entity):
        return names.get(value, str(value))
    if isinstance(value, (list, tuple)):
        inner = kind[5:-1] if kind.startswith("List<") else kind
        items = [spoken(item, inner, names) for item in value]
        return f"{', '.join(items[:-1])} and {items[-1]}" if len(items) > 1 else (items or ["nothing"])[0]
    if hasattr(value, "quaternion"):
        numbers = [_plain(float(number)) for number in (*value.xyz, *value.quaternion)]
        return f"pose({', '.join(numbers[:3])}; {', '.join(numbers[3:])})"
    return str(value)
