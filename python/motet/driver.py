"""Drivers in Python: one coroutine for each primitive of a robot.

    class MyRobot(motet.Driver):
        async def go(self, goal, to):
            for waypoint in goal.motion.path:
                await self.base.move(waypoint["base"])
                if goal.cancelled():
                    return await self.base.brake()
                await goal.feedback("on the way")

        def holding(self, object):
            return self.hand.holds(object)

    motet.serve(MyRobot())

The base class keeps the promises of the driver protocol. It needs the standard library of Python alone.
"""

from __future__ import annotations

import asyncio
import inspect
import keyword
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

from .values import Text, decode, encode, example, python_name

if TYPE_CHECKING:
    from .protocol import Session

__all__ = ["Driver", "Failed", "Goal", "Lost", "Motion", "Refused", "observes", "performs"]

#: Characters of a text for people that the host keeps.
LONGEST = 1000

Method = TypeVar("Method", bound=Callable[..., Any])


class Failed(Exception):
    """The end of a goal in a failure that its primitive declares, such as `slipped`, with a clause for people.

    >>> str(Failed("slipped", "the mug is wet"))
    'slipped: the mug is wet'
    """

    def __init__(self, kind: str, text: str = "") -> None:
        super().__init__(f"{kind}: {text}" if text else kind)
        self.kind: str = kind
        self.text: str = text

    def _wire(self) -> Any:
        return {"kind": self.kind, "text": self.text} if self.text else self.kind


class Refused(Failed):
    """The refusal of a goal, raised before the first `await` of its coroutine: nothing has moved."""

    def __init__(self, kind: str = "refused", text: str = "") -> None:
        super().__init__(kind, text)


class Lost(Exception):
    """Raised by a coroutine that no longer knows what its goal does: the host has it stopped safely."""


@dataclass(frozen=True)
class Motion:
    """A motion of a goal. `verdict` is `proven`, `verified` or `open`; `path` is empty if nobody found a motion.

    A waypoint is a mapping with `base` ([x, y, yaw] in m and rad, in the frame `map`), `joints` (m or rad, in the order of
    `joints` here), `at` (s since the start) and perhaps `ramp` (s).
    """

    query: str = ""
    verdict: str = "open"
    why: str = ""
    joints: tuple[str, ...] = ()
    path: tuple[dict[str, Any], ...] = ()
    grasp: dict[str, Any] | None = None
    clearance: float | None = None

    @classmethod
    def _of(cls, command: dict[str, Any]) -> Motion:
        motions = command.get("motions") or [{}]
        motion = motions[0]
        witness = motion.get("witness") or {}
        return cls(
            motion.get("query", ""), motion.get("verdict", "open"), motion.get("why") or "",
            tuple(witness.get("joints", ())), tuple(witness.get("path", ())), witness.get("grasp"), witness.get("clearance"),
        )


@dataclass
class Goal:
    """One call that the robot carries out.

    `args` are the arguments by name, `command` is the call as the protocol has it, `result_type` the type of the result or
    None, `fails` the failures that the primitive declares, `deadline_secs` its deadline in s.
    """

    number: int
    command: dict[str, Any]
    result_type: str | None = None
    fails: tuple[str, ...] = ()
    is_held: bool = False
    _session: Session | None = field(default=None, repr=False)
    _is_cancelled: bool = False
    _polls: bool = False
    _saw_cancel: bool = False
    _holding: asyncio.Event = field(default_factory=asyncio.Event, repr=False)
    _proceeding: asyncio.Event = field(default_factory=asyncio.Event, repr=False)

    def __post_init__(self) -> None:
        self._proceeding.set()

    @property
    def primitive(self) -> str:
        return str(self.command["primitive"])

    @property
    def args(self) -> dict[str, Any]:
        return {python_name(name): decode(value) for name, value in self.command.get("args", ())}

    @property
    def motion(self) -> Motion:
        return Motion._of(self.command)

    @property
    def deadline_secs(self) -> float:
        return float(self.command.get("deadline_secs", 0.0))

    def cancelled(self) -> bool:
        """True once the host asks for an early end: brake, and return.

        Who calls this is left to end by itself. In any other coroutine the next `await` raises `asyncio.CancelledError`.
        """
        self._polls = True
        self._saw_cancel = self._is_cancelled
        return self._is_cancelled

    def example_result(self) -> Any:
        """Some value of the type of its result, for drivers that only pretend to move."""
        return example(self.result_type)

    async def feedback(self, text: str, *, own_motion: bool = False) -> None:
        """Says something to people and the journal; the host keeps at most 1,000 characters. Gives other goals a turn.

        Set `own_motion` where the driver plans a motion itself and does not follow the witness of `motion`.
        """
        if self._session is not None:
            # A longer line would count as a flood, and end the connection.
            said = {"goal": self.number, "text": text[:LONGEST]}
            self._session.report("feedback", {**said, "own_motion": True} if own_motion else said)
        await asyncio.sleep(0)

    def not_held(self) -> None:
        """Says that the goal cannot be held after all, and goes on."""
        if self._session is not None:
            self._session.report("not_held", {"goal": self.number})
        self._proceed()

    async def sleep(self, seconds: float) -> None:
        """Waits for so long, not counting the time in which the goal is held."""
        loop = asyncio.get_running_loop()
        left = seconds
        while left > 0.0:
            await self.proceeding()
            begun = loop.time()
            try:
                await asyncio.wait_for(self._holding.wait(), left)
            except asyncio.TimeoutError:
                return
            left -= loop.time() - begun

    async def proceeding(self) -> None:
        """Waits while the goal is held."""
        await self._proceeding.wait()

    def _hold(self) -> None:
        self.is_held = True
        self._holding.set()
        self._proceeding.clear()

    def _proceed(self) -> None:
        self.is_held = False
        self._holding.clear()
        self._proceeding.set()


def observes(name: str) -> Callable[[Method], Method]:
    """Marks a method that answers the fact or the measure `name`, where its own name must be another one.

    >>> class Robot(Driver):
    ...     @observes("open")
    ...     def is_open(self, container): return True
    >>> Robot()._observer("open") is not None
    True
    """

    def mark(method: Method) -> Method:
        method._motet_observes = name  # type: ignore[attr-defined]
        return method

    return mark


def performs(name: str) -> Callable[[Method], Method]:
    """Marks the coroutine of the primitive `name`, where its own name must be another one: `stop`, `look` and the other names of
    the base class are taken.

    >>> class Robot(Driver):
    ...     @performs("look")
    ...     async def look_at(self, goal, target): ...
    >>> Robot()._primitives()
    {'only': ['look']}
    """

    def mark(method: Method) -> Method:
        method._motet_performs = name  # type: ignore[attr-defined]
        return method

    return mark


#: Parameters of the methods that a driver may have and the base class has not.
_OPTIONAL = {"look": ("camera",), "detections": (), "told": ("thing",), "truth": ("query",)}


def _needed(method: Callable[..., Any]) -> tuple[str, ...]:
    """Names of the parameters of a method that a caller must give."""
    params = list(inspect.signature(method).parameters.values())[1:]
    return tuple(one.name for one in params if one.default is one.empty and one.kind is one.POSITIONAL_OR_KEYWORD)


def _is_own_name(name: str) -> bool:
    """True if a method of this name answers the protocol, and is no primitive, fact or measure."""
    return name in _OPTIONAL or hasattr(Driver, name)


class Driver:
    """A robot. A subclass has one `async def` for each primitive, and a method for each fact or measure that it observes.

    The coroutines whose names do not begin with `_` are the primitives that it has; a subclass with a `perform` of its own has
    all. A policy that calls another primitive is refused before anything moves. For a primitive, a fact or a measure with the
    name of a method here, such as `stop`, mark another method with `performs` or `observes`.

    A coroutine gets the goal and the arguments of the primitive by name; a name that is a keyword of Python has an underscore at
    its end, such as `from_`. What it returns is the result. It raises `Failed` to end in a failure, and `Refused`, before its
    first `await`, to refuse. An observation returns a bool for a fact, a number in SI units for a measure, None for unknown.

    A driver may also have `look(camera)`, `detections()` and `told(thing)`, with parameters and results as in the protocol, and a
    simulator `truth(query)`, which answers a judge by what is so, whatever the robot knows.

    `can_hold` and `can_update` are "all" or the primitives whose goals can be held, or take new arguments while they run.
    Hold with `goal.sleep` or `goal.proceeding`. `owns_clock` is for simulators: time passes only in `goal.sleep` and
    `asyncio.sleep`. `takes_state` says that `begin_run` makes the facts in `run["state"]` so.
    """

    name: str = ""
    can_hold: str | tuple[str, ...] = ()
    can_update: str | tuple[str, ...] = ()
    owns_clock: bool = False
    takes_state: bool = False
    #: Seconds between two looks at what the host watches.
    watch_period: float = 0.1

    _session: Session | None = None

    def __init_subclass__(cls, **kwargs: Any) -> None:
        """Raises `TypeError` for a primitive or an observation that hides a method of the protocol."""
        super().__init_subclass__(**kwargs)
        for name, method in vars(cls).items():
            if not inspect.isfunction(method) or not _is_own_name(name) or name.startswith("_"):
                continue
            params = _OPTIONAL[name] if name in _OPTIONAL else _needed(getattr(Driver, name))
            try:
                inspect.signature(method).bind(None, *params)
            except TypeError:
                raise TypeError(
                    f"`{cls.__name__}.{name}` does not take ({', '.join(params)}) as the method of the protocol with this name "
                    f"does; for a primitive or an observation `{name}`, give the method another name and mark it with "
                    f'`@motet.performs("{name}")` or `@motet.observes("{name}")`'
                ) from None

    async def perform(self, goal: Goal, **args: Any) -> Any:
        """Carries out a primitive that has no coroutine of its own. Refuses it, if no subclass says otherwise."""
        raise Refused(text=f"the driver has no `{goal.primitive}`")

    def observe(self, query: dict[str, Any]) -> Any:
        """Answers a query that has no method of its own: unknown, if no subclass says otherwise."""
        return None

    async def stop(self, goal: Goal) -> None:
        """Brings everything that the goal uses to a stand. Returns only when it stands still."""

    def begin_run(self, run: dict[str, Any]) -> None:
        """Learns of a run that begins: `run` has `robot`, `policy`, `primitives` and perhaps `state`."""

    def shutdown(self) -> None:
        """Called once at the end, when no host comes back. `close` is a primitive."""

    def report_moved(self, base: Any = None, joints: dict[str, float] | None = None, things: Any = ()) -> None:
        """Says where the robot is, for people: `base` is [x, y, yaw] in m and rad, `joints` m or rad by name."""
        if self._session is not None:
            parts = {"base": base, "joints": joints, "things": list(things)}
            self._session.report("moved", {name: part for name, part in parts.items() if part})

    def report_heard(self, text: str, by: str | None = None) -> None:
        """Says that a person said something that nobody had asked for."""
        if self._session is not None:
            self._session.report("heard", {"text": text[:LONGEST]} | ({} if by is None else {"from": by}))

    def report_detected(self, detections: Iterable[dict[str, Any]]) -> None:
        """Says what the robot has just seen, as the answer to `detections` has it."""
        if self._session is not None:
            self._session.report("detected", {"detections": list(detections)})

    def report_observed(self, query: dict[str, Any], answer: Any) -> None:
        """Says what the robot noticed by itself. `query` and `answer` are those of the protocol; None is unknown."""
        if self._session is not None:
            self._session.report("observed", {"query": query, "answer": answer_of(query, answer)})

    def check_watched(self) -> None:
        """Looks at what the host watches now, instead of within `watch_period`."""
        if self._session is not None:
            self._session.look_at_watched()

    def _capabilities(self) -> dict[str, Any]:
        def which(names: str | tuple[str, ...]) -> Any:
            return names if names == "all" else {"only": list(names)}

        capabilities = {"primitives": self._primitives(), "hold": which(self.can_hold), "update": which(self.can_update),
                        "moved": True}
        for name in ("look", "detections", "told"):
            capabilities[name] = callable(getattr(self, name, None))
        capabilities["state"] = self.takes_state
        return capabilities | ({"clock": "driver"} if self.owns_clock else {})

    def _primitives(self) -> Any:
        """The primitives that the driver has: those with a coroutine, or all with a `perform` of its own."""
        if type(self).perform is not Driver.perform:
            return "all"
        methods = {name: getattr(type(self), name, None) for name in dir(type(self))} | vars(self)
        own = [_primitive(name, method) for name, method in methods.items() if inspect.iscoroutinefunction(method)]
        return {"only": sorted(name for name in own if name is not None)}

    def _marked(self, mark: str, name: str) -> Callable[..., Any] | None:
        """The method that a decorator has marked with a name."""
        keys = (key for key in dir(type(self)) if getattr(getattr(type(self), key), mark, None) == name)
        return next((getattr(self, key) for key in keys), None)

    def _performer(self, primitive: str) -> Callable[..., Any]:
        marked = self._marked("_motet_performs", primitive)
        if marked is not None:
            return marked
        name = python_name(primitive)
        method = getattr(self, name, None)
        return method if inspect.iscoroutinefunction(method) and _primitive(name, method) == primitive else self.perform

    def _unfit(self, calls: Mapping[str, tuple[str, ...]]) -> list[str]:
        """What keeps its coroutines from taking these parameters of their primitives, each in a clause."""
        unfit = []
        for primitive, params in calls.items():
            names = [python_name(name) for name in params]
            performer = self._performer(primitive)
            if _is_own_name(primitive) and performer == self.perform and type(self).perform is Driver.perform:
                unfit.append(f'`{primitive}` is a method of the protocol: mark a coroutine with `@motet.performs("{primitive}")`')
                continue
            if performer == self.perform and type(self).perform is Driver.perform:
                is_plain = callable(getattr(self, python_name(primitive), None))
                hint = f": its `{python_name(primitive)}` is not an `async def`" if is_plain else ""
                unfit.append(f"the driver does not have `{primitive}`{hint}")
                continue
            try:
                inspect.signature(performer).bind(None, **dict.fromkeys(names))
            except TypeError as wrong:
                unfit.append(f"its `{python_name(primitive)}` does not take `goal, {', '.join(names)}`: {wrong}")
        return unfit

    def _unobserved(self, names: Iterable[str]) -> list[str]:
        """Facts and measures of which the driver knows nothing."""
        if type(self).observe is not Driver.observe:
            return []
        return [name for name in names if self._observer(name) is None]

    def _observer(self, name: str) -> Callable[..., Any] | None:
        marked = self._marked("_motet_observes", name)
        if marked is not None:
            return marked
        method = getattr(self, python_name(name), None)
        is_own = callable(method) and not inspect.iscoroutinefunction(method) and not _is_own_name(python_name(name))
        return method if is_own else None

    async def _answer(self, query: dict[str, Any]) -> Any:
        """The answer to a query in the words of the protocol."""
        if "field" in query:
            asked, method = query["field"], self._observer("field")
            args = [asked["entity"], asked["field"]]
        else:
            asked = query["fact" if "fact" in query else "measure"]
            method = self._observer(asked.get("fluent") or asked.get("measure"))
            args = [decode(arg) for arg in asked.get("args", ())]
        said = self.observe(query) if method is None else method(*args)
        if inspect.isawaitable(said):
            said = await said
        return answer_of(query, said)


def _primitive(name: str, coroutine: Any) -> str | None:
    """The primitive that a coroutine of a driver carries out, or None."""
    marked = getattr(coroutine, "_motet_performs", None)
    if marked is not None:
        return str(marked)
    if name.startswith("_") or _is_own_name(name) or hasattr(coroutine, "_motet_observes"):
        return None
    return name[:-1] if name.endswith("_") and keyword.iskeyword(name[:-1]) else name


def answer_of(query: dict[str, Any], said: Any) -> Any:
    """What an observation returned, in the words of the protocol."""
    if said is None or isinstance(said, dict):
        return "unknown" if said is None else said
    if "fact" in query:
        return {"truth": bool(said)}
    if isinstance(said, bool) or not isinstance(said, (int, float)):
        return {"value": encode(said, "Text" if isinstance(said, Text) else None)}
    return {"value": {"number": float(said)}}
