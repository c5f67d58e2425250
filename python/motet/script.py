"""Scripts: policies as Python, as `motet compile --emit python` writes them, carried out on a `Driver`.

    async def steps(robot):
        await robot.call("go", {"to": Entity("counter")}, within=30.0)

    run(Script("fetch", "hsr", steps), MyRobot())

A script makes the calls that the graph of its policy makes: with guards, retries, deadlines and cleanups, and with the beliefs that
decide its branches. It does one thing at a time, and searches for no motions.
"""

from __future__ import annotations

import asyncio
import importlib
import math
import sys
import traceback
from collections.abc import Awaitable, Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import Any

from .belief import EACH, Beliefs, Change, Fact, Field, Look, Measure, Not, both
from .clock import DriverLoop, new_loop
from .driver import Driver, Failed, Goal
from .values import ANY, Case, Entity, Pose, Text, decode, encode

__all__ = ["Contract", "End", "Entry", "Interrupted", "Need", "Planned", "Robot", "Script", "carry_out", "main", "run"]

#: Seconds in which a driver has to end a goal that is cancelled, before it is stopped.
CANCEL_WITHIN = 5.0


class Interrupted(Exception):
    """The end of a run in which the driver interrupted a goal that nobody had cancelled."""


class _Ended(Exception):
    def __init__(self, end: End) -> None:
        super().__init__(end.how)
        self.end = end


class _Left(Exception):
    """The end of a policy inside of another one."""

    def __init__(self, of: object, failure: Failed | None) -> None:
        super().__init__()
        self.of, self.failure = of, failure


@dataclass(frozen=True)
class End:
    """The end of a run: `how` is `done`, `failed`, `cannot`, `replan` or `interrupted`."""

    how: str
    why: str | None = None
    #: The kind of a failure.
    kind: str | None = None
    #: What the policy gives.
    result: Any = None


@dataclass(frozen=True)
class Need:
    """A condition that must hold just before a call starts, and the failure where it does not.

    A proven one is looked at only where a result was another one than the proofs assumed.
    """

    condition: Any
    failure: str
    when: Any = True
    #: The kind of entity for each of which it must hold, as `EACH`.
    each: str | None = None
    proven: bool = False


@dataclass(frozen=True)
class Entry:
    """A fact that a call makes true, makes false (`no(…)`) or leaves unknown, where a condition holds."""

    fact: Any
    when: Any = True
    each: str | None = None


@dataclass(frozen=True)
class Planned:
    """A motion as the driver protocol has it, with a path or without; where a success leaves the robot, if that is known."""

    motion: dict[str, Any]
    args: tuple[Any, ...] = ()
    leaves: dict[str, Any] | None = None


@dataclass(frozen=True)
class Contract:
    """What a call needs and changes, and the motion that carries it out."""

    needs: tuple[Need, ...] = ()
    makes: tuple[Entry, ...] = ()
    unsettles: tuple[Entry, ...] = ()
    #: Resources whose use ends the lifetime of what a perception makes.
    until_used: tuple[str, ...] = ()
    #: Entities: an action that changes something about one of them ends it.
    until_moved: tuple[Any, ...] = ()
    planned: Planned | None = None


@dataclass(frozen=True)
class Script:
    """A policy: its steps, and the declarations that they rest on."""

    policy: str
    robot: str
    steps: Callable[[Robot], Awaitable[Any]]
    kinds: dict[str, str | None] = field(default_factory=dict)
    #: Entities with their kinds.
    entities: dict[str, str] = field(default_factory=dict)
    #: What people call entities.
    names: dict[str, str] = field(default_factory=dict)
    #: Fluents that the robot can observe.
    observable: tuple[str, ...] = ()
    #: Facts from which the policy was proved, later ones over earlier ones.
    known: tuple[Any, ...] = ()
    goal: tuple[Any, ...] = ()
    #: Sentences for kinds of failure.
    sentences: dict[str, str] = field(default_factory=dict)
    #: Primitives as the driver protocol declares them.
    primitives: dict[str, dict[str, Any]] = field(default_factory=dict)
    observe_within: float = 0.5


class Robot:
    """A driver that a script leads, with what the script knows."""

    def __init__(self, script: Script, driver: Driver) -> None:
        self.script: Script = script
        self.driver: Driver = driver
        self.beliefs: Beliefs = Beliefs(script.kinds, script.observable)
        self._goals = 0
        self._result: Any = None
        #: The deadlines of the blocks around the present step.
        self._deadlines: list[_Deadline] = []
        #: True if a result was another one than the proofs assume.
        self._is_unproven = False
        #: True once a wait began whose condition was believed to be false: the world may undo what calls made.
        self._looks_afresh = False
        for id, kind in script.entities.items():
            self.beliefs.hear(Entity(id), kind)
        for known in script.known:
            inner = known.inner if isinstance(known, Not) else known
            self.beliefs.apply(Change(inner, inner is known))

    # Calls.

    async def call(
        self,
        primitive: str,
        args: dict[str, Any],
        *,
        within: float,
        retry: int = 0,
        manner: dict[str, float] | None = None,
        contract: Contract = Contract(),
        among: tuple[str, ...] = (),
    ) -> Any:
        """Carries out a call with its retries. Raises `Failed` as its last attempt failed."""
        attempt = 0
        while True:
            attempt += 1
            try:
                return await self._attempt(primitive, args, within, manner, contract, among, attempt)
            except Failed:
                if attempt > retry:
                    raise

    async def _attempt(
        self,
        primitive: str,
        args: dict[str, Any],
        within: float,
        manner: dict[str, float] | None,
        contract: Contract,
        among: tuple[str, ...],
        attempt: int,
    ) -> Any:
        values = await self._ready(args, contract, attempt > 1)
        self._end_lifetimes(primitive, contract)
        self._apply(self._changes(contract.unsettles, None))
        outcome, value = await self._goal(primitive, values, within, manner, contract)
        declared = self.script.primitives.get(primitive, {}).get("result")
        if outcome == "success" and declared is not None and not self._fits(value, declared):
            outcome, value = "failure", Failed("failed")
        if outcome == "success":
            if declared is not None:
                self._is_unproven |= bool(among) and isinstance(value, Entity) and value not in among
                self.beliefs.hear(value, declared)
            self._make(primitive, contract, value)
            return value
        self._doubt(primitive, contract)
        if outcome == "interrupted":
            raise Interrupted
        raise value

    async def _ready(self, args: dict[str, Any], contract: Contract, is_again: bool) -> dict[str, Any]:
        """The arguments of a call whose guards hold, after the observations that they ask for."""
        since, missing = self._now(), list[Any]()
        seen = self.beliefs.observations if is_again or self._looks_afresh else None
        look = self._look(since, missing)
        refused, values = self._guards(look, seen, args, contract)
        if (refused is not None or None in values.values()) and missing:
            await self._observe(missing)
            refused, values = self._guards(self._look(since, []), seen, args, contract, is_last=True)
        if refused is not None:
            raise Failed(refused)
        if None in values.values():
            # Nothing more will be known: a text says so.
            vague = replace(self._look(since, []), is_vague=True)
            values = {name: vague.value(arg) for name, arg in args.items()}
            if None in values.values():
                raise Failed("timeout")
        return values

    def _guards(
        self, look: Look, seen: int | None, args: dict[str, Any], contract: Contract, is_last: bool = False
    ) -> tuple[str | None, dict[str, Any]]:
        """The failure of the first guard that is not known to hold, and the values of the arguments."""
        unknown = None
        for need in contract.needs:
            if need.proven and not self._is_unproven:
                continue
            truth = self._need(need, look)
            # A retry looks afresh, and so does what comes behind a wait, also at what is believed: it may have changed.
            # Where nobody can tell, what was believed stands.
            is_doubted = truth is False or (truth is True and self._looks_afresh and not is_last)
            if seen is not None and is_doubted:
                truth = self._need(need, replace(look, seen=seen))
            if truth is False:
                raise Failed(need.failure)
            if truth is None and unknown is None:
                unknown = need.failure
        return unknown, {name: look.value(arg) for name, arg in args.items()}

    def _need(self, need: Need, look: Look) -> bool | None:
        if need.each is None:
            return look.truth(need.condition) if look.truth(need.when) is True else True
        truth: bool | None = True
        for entity, _ in self.beliefs.of_kind(need.each):
            # Whether it is asked is judged by what is believed; only what it asks is worth an observation.
            if look.of(entity).truth(need.when) is True:
                truth = both(truth, look.of(entity, look.missing).truth(need.condition))
        return truth

    async def _goal(
        self, primitive: str, values: dict[str, Any], within: float, manner: Any, contract: Contract
    ) -> tuple[str, Any]:
        self._goals += 1
        declared = self.script.primitives.get(primitive, {})
        tagged = [[name, encode(value, None)] for name, value in values.items()]
        command: dict[str, Any] = {"primitive": primitive, "args": tagged, "uses": list(declared.get("uses", ()))}
        command |= {"deadline_secs": within} | ({} if manner is None else {"manner": manner})
        if contract.planned is not None:
            look = self._look(self._now(), None)
            args = [encode(look.value(arg), None) for arg in contract.planned.args]
            command["motions"] = [contract.planned.motion | {"args": args}]
            command |= {} if contract.planned.leaves is None else {"leaves": contract.planned.leaves}
        goal = Goal(self._goals, command, declared.get("result"), tuple(declared.get("fails", ())))
        task = asyncio.ensure_future(self._perform(goal))
        try:
            await asyncio.wait([task], timeout=within)
        except asyncio.CancelledError:
            outcome, value = await self._cancel(goal, task)
            if outcome == "success":
                self._make(primitive, contract, value)
            else:
                self._doubt(primitive, contract)
            raise
        if task.done():
            return task.result()
        outcome, value = await self._cancel(goal, task)
        return ("failure", Failed("timeout")) if outcome == "interrupted" else (outcome, value)

    async def _perform(self, goal: Goal) -> tuple[str, Any]:
        """Runs the coroutine of a goal to its end."""
        try:
            value = await self.driver._performer(goal.primitive)(goal, **goal.args)
            tagged = encode(value, goal.result_type)
            return ("interrupted", None) if goal._saw_cancel else ("success", None if tagged is None else _frozen(tagged))
        except Failed as failed:
            return "failure", self._declared(goal, failed)
        except asyncio.CancelledError:
            return "interrupted", None
        except Exception as error:
            traceback.print_exc(file=sys.stderr)
            return "failure", self._declared(goal, Failed("failed", f"{type(error).__name__}: {error}"))

    async def _cancel(self, goal: Goal, task: asyncio.Future[tuple[str, Any]]) -> tuple[str, Any]:
        """Asks a goal for an early end, stops it where it has none, and answers how it ended."""
        goal._is_cancelled = True
        goal._proceed()
        if not goal._polls:
            task.cancel()
        await asyncio.wait([task], timeout=CANCEL_WITHIN)
        if not task.done():
            task.cancel()
            await self.driver.stop(goal)
            return "interrupted", None
        return ("interrupted", None) if task.cancelled() else task.result()

    @staticmethod
    def _declared(goal: Goal, failed: Failed) -> Failed:
        """A failure that the primitive declares: another one becomes its first, and goes on in the text."""
        if not goal.fails or failed.kind in (*goal.fails, "timeout"):
            return failed
        return Failed(goal.fails[0], str(failed))

    def _fits(self, value: Any, kind: str) -> bool:
        if kind.startswith("List<"):
            return isinstance(value, tuple) and all(self._fits(item, kind[5:-1]) for item in value)
        if isinstance(value, Entity):
            known = self.beliefs.entities.get(value)
            is_foreign = known is not None and not self.beliefs.is_kind(known, kind) and not self.beliefs.is_kind(kind, known)
            is_robot = value == "robot" and self.script.kinds.get(kind) is not None
            return kind in self.script.kinds and bool(value) and not is_foreign and not is_robot
        types = {"Bool": bool, "Int": int, "Text": Text, "Pose": Pose}
        if kind in types:
            return isinstance(value, types[kind]) and (kind == "Bool" or not isinstance(value, bool))
        if isinstance(value, Case):
            return kind not in self.script.kinds
        return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)

    # Contracts.

    def _changes(self, entries: Iterable[Entry], truth: bool | None) -> list[Change]:
        return [change for entry in entries for change in self._entry(entry, truth)]

    def _make(self, primitive: str, contract: Contract, result: Any) -> None:
        """What a successful call makes is believed."""
        self._result = result
        self._end_lifetimes(primitive, contract)
        made = [change for entry in contract.makes for change in self._entry(entry, not isinstance(entry.fact, Not))]
        look = self._look(self._now(), None)
        entities = frozenset(look.value(entity) for entity in contract.until_moved)
        self._result = None
        # What is both made and unmade is made.
        self._apply(sorted(made, key=lambda change: change.truth is True))
        if contract.until_used or contract.until_moved:
            for change in made:
                if change.sure:
                    self.beliefs.lasting[change.fact] = (frozenset(contract.until_used), entities)

    def _end_lifetimes(self, primitive: str, contract: Contract) -> None:
        """What was seen is unknown once a call uses a resource, or an action changes something about an entity."""
        if not self.beliefs.lasting:
            return
        declared = self.script.primitives.get(primitive, {})
        used = frozenset(declared.get("uses", ()))
        is_action = declared.get("kind") != "perception"
        entries = (*contract.makes, *contract.unsettles) if is_action else ()
        facts = [entry.fact.inner if isinstance(entry.fact, Not) else entry.fact for entry in entries]
        look = self._look(self._now(), None)
        moved = frozenset(look.value(fact.args[0]) for fact in facts if fact.args and fact.args[0] is not ANY) - {None}
        over = [fact for fact, (uses, of) in self.beliefs.lasting.items() if used & uses or moved & of]
        self._apply(Change(fact, None) for fact in over)

    def _doubt(self, primitive: str, contract: Contract) -> None:
        """Nothing is known any more of what a call makes or unsettles."""
        self._end_lifetimes(primitive, contract)
        self._apply(self._changes((*contract.makes, *contract.unsettles), None))

    def _apply(self, changes: Iterable[Change]) -> None:
        self.beliefs.now = self._now()
        for change in list(changes):
            self.beliefs.apply(change)

    def _entry(self, entry: Entry, truth: bool | None) -> list[Change]:
        """The changes of one entry, in the state as it is."""
        fact = entry.fact.inner if isinstance(entry.fact, Not) else entry.fact
        look = self._look(self._now(), None)
        changes: list[Change] = []
        entities: list[tuple[Entity | None, bool]]
        if entry.each is None:
            entities = [(None, True)]
        else:
            entities = [*self.beliefs.of_kind(entry.each)]
            # For those nobody has heard of it is the new default, before what is said of single ones.
            nobody = look.of(Entity(""))
            if nobody.truth(entry.when) is not False:
                wide = nobody.fact(Fact(fact.fluent, tuple(ANY if arg is EACH else arg for arg in fact.args)))
                if wide is not None:
                    changes.append(Change(wide, truth, sure=False, rest=True))
        for entity, surely in entities:
            own = look.of(entity)
            holds = own.truth(entry.when)
            made = own.fact(fact)
            if holds is not False and made is not None:
                changes.append(Change(made, truth, sure=holds is True and surely))
        return changes

    # Tests.

    async def test(self, condition: Any, looks: bool = False) -> bool:
        """Answers whether a condition is known to hold, after an observation where it is unknown.

        With `looks` it is observed whatever is believed: the held thing may have dropped.
        """
        if looks:
            missing = list[Any]()
            replace(self._look(self._now(), missing), seen=self.beliefs.observations).truth(condition)
            if missing:
                await self._observe(missing)
        return await self._settled(lambda look: look.truth(condition)) is True

    async def value(self, term: Any, kind: str) -> Any:
        """The value of a term. Raises `Failed`, if it stays unknown or has another type."""
        found = await self._settled(lambda look: look.value(term))
        if found is None:
            found = replace(self._look(self._now(), []), is_vague=True).value(term)
        if found is None:
            raise Failed("timeout")
        if not self._fits(found, kind):
            raise Failed("failed")
        self.beliefs.hear(found, kind)
        return found

    def items(self, term: Any, kind: str, at_most: int) -> tuple[Any, ...]:
        """The elements of a list. Raises `Failed`, if there are more than `at_most`."""
        found = self._look(self._now(), None).value(term)
        if found is None:
            raise Failed("timeout")
        if not isinstance(found, tuple):
            raise Failed("failed")
        if len(found) > at_most:
            raise Failed("exhausted")
        self.beliefs.hear(found, f"List<{kind}>")
        return found

    async def wait_until(self, condition: Any, within: float) -> None:
        """Waits until a condition holds. Raises `Failed` after `within` seconds."""
        begun = self._now()
        self._looks_afresh |= self._look(begun, []).truth(condition) is False
        while True:
            missing: list[Any] = []
            if self._look(begun, missing).truth(condition) is True:
                return
            await self._observe(_queries(condition, self._look(begun, None)))
            if self._look(self._now(), []).truth(condition) is True:
                return
            left = begun + within - self._now()
            if left <= 0.0:
                raise Failed("timeout")
            await asyncio.sleep(min(self.driver.watch_period, left))

    async def sleep(self, seconds: float) -> None:
        """Waits for so long."""
        await asyncio.sleep(seconds)

    async def _settled(self, judge: Callable[[Look], Any]) -> Any:
        since, missing = self._now(), list[Any]()
        found = judge(self._look(since, missing))
        if found is None and missing:
            await self._observe(missing)
            found = judge(self._look(since, []))
        return found

    async def _observe(self, queries: list[Any]) -> None:
        tasks = [asyncio.ensure_future(self.driver._answer(_wire(query))) for query in queries]
        try:
            if tasks:
                await asyncio.wait(tasks, timeout=self.script.observe_within)
        finally:
            for task in tasks:
                task.cancel()
        self.beliefs.now = self._now()
        for query, task in zip(queries, tasks, strict=True):
            if not task.done() or task.cancelled():
                continue
            if (error := task.exception()) is not None:
                traceback.print_exception(type(error), error, error.__traceback__, file=sys.stderr)
                continue
            answer = task.result()
            known = answer if isinstance(answer, dict) else {}
            self.beliefs.observe(query, known.get("truth") if isinstance(query, Fact) else _value(known))

    def _look(self, since: float, missing: list[Any] | None) -> Look:
        return Look(self.beliefs, since, missing=missing, result=self._result, names=tuple(self.script.names.items()))

    @staticmethod
    def _now() -> float:
        return asyncio.get_running_loop().time()

    # Blocks and endings.

    def reason(self, failure: Failed) -> Text:
        """A failure in words: those of the driver, or the sentence of its kind."""
        kind = failure.kind
        return Text(failure.text or self.script.sentences.get(kind, kind.replace("_", " ")))

    def within(self, seconds: float) -> _Deadline:
        """A deadline of a block, after which it fails with `timeout`."""
        return _Deadline(self, seconds)

    def cleanup(self, cleanup: Callable[[], Awaitable[None]]) -> _Cleanup:
        """A block with a cleanup, which runs however the block is left, but for an interruption by the driver."""
        return _Cleanup(self, cleanup)

    def _check_deadlines(self) -> None:
        """Goes on with an interruption that a cleanup has put off."""
        if any(deadline.is_over for deadline in self._deadlines):
            raise asyncio.CancelledError

    def part(self) -> _Part:
        """A block that is a policy of its own: `done()` ends it, `fail()` fails it."""
        return _Part(self)

    def end(self, how: str, why: Any = None) -> None:
        """Ends the policy: `done`, `fail`, `cannot` or `replan`."""
        words = None if why is None else self.words(why)
        raise _Ended(End("failed", words, "failed") if how == "fail" else End(how, words))

    def words(self, term: Any) -> Any:
        """A text with what was last known."""
        return replace(self._look(-math.inf, None), is_vague=True).value(term)

    async def _reached(self, end: End) -> End:
        """The end of a policy that is done: what can be observed of its goal is observed."""
        since, seen, missing = self._now(), self.beliefs.observations, list[Any]()

        def judge(missing: list[Any]) -> bool | None:
            look, truth = replace(self._look(since, missing), seen=seen), True
            for part in self.script.goal:
                truth = both(truth, look.truth(part))  # type: ignore[assignment]
            return truth

        truth = judge(missing)
        if truth is None and missing:
            await self._observe(missing)
            truth = judge([])
        return End("failed", "the goal does not hold", "failed") if truth is False else end


class _Deadline:
    def __init__(self, robot: Robot, seconds: float) -> None:
        self.robot: Robot = robot
        self.seconds: float = seconds
        self.is_over: bool = False
        self.task: asyncio.Task[Any] | None = None
        self.timer: asyncio.TimerHandle | None = None

    async def __aenter__(self) -> None:
        self.robot._deadlines.append(self)
        self.task = asyncio.current_task()
        self.timer = asyncio.get_running_loop().call_later(self.seconds, self.expire)

    def expire(self) -> None:
        if self.task is not None:
            self.is_over = True
            self.task.cancel()

    async def __aexit__(self, kind: Any, error: Any, trace: Any) -> None:
        if self.timer is not None:
            self.timer.cancel()
        self.robot._deadlines.remove(self)
        if not self.is_over:
            return
        if self.task is not None and hasattr(self.task, "uncancel"):
            self.task.uncancel()
        # An ending that is under way is no longer watched.
        if kind is asyncio.CancelledError:
            self.robot._check_deadlines()
            raise Failed("timeout")


class _Cleanup:
    def __init__(self, robot: Robot, cleanup: Callable[[], Awaitable[None]]) -> None:
        self.robot: Robot = robot
        self.cleanup: Callable[[], Awaitable[None]] = cleanup

    async def __aenter__(self) -> None:
        pass

    async def __aexit__(self, kind: Any, error: Any, trace: Any) -> None:
        if kind is Interrupted:
            return
        task = asyncio.ensure_future(self.cleanup())
        while not task.done():
            try:
                await asyncio.wait([task])
            except asyncio.CancelledError:
                # A cleanup that has begun is not stopped: a deadline around it counts when it has ended.
                pass
        failure = task.exception()
        if isinstance(failure, Interrupted):
            if error is None or isinstance(error, Failed):
                raise failure
        elif isinstance(failure, (Failed, _Left)):
            print(f"the cleanup failed: {failure}", file=sys.stderr)
        elif failure is not None:
            raise failure
        if not isinstance(error, (_Ended, _Left)):
            self.robot._check_deadlines()


class _Part:
    def __init__(self, robot: Robot) -> None:
        self.robot = robot

    async def __aenter__(self) -> _Part:
        return self

    def done(self) -> None:
        """Ends the policy in success."""
        raise _Left(self, None)

    def fail(self, why: str = "") -> None:
        """Fails the policy."""
        raise _Left(self, Failed("failed", why))

    async def __aexit__(self, kind: Any, error: Any, trace: Any) -> bool:
        if not isinstance(error, _Left) or error.of is not self:
            return False
        self.robot._check_deadlines()
        if error.failure is not None:
            raise error.failure from None
        return True


def _frozen(tagged: Any) -> Any:
    """The value of a tagged value, a list as a tuple."""
    value = decode(tagged)
    return tuple(value) if isinstance(value, list) else value


def _value(known: dict[str, Any]) -> Any:
    return _frozen(known["value"]) if "value" in known else None


def _wire(query: Any) -> dict[str, Any]:
    """A query in the words of the protocol."""
    if isinstance(query, Field):
        return {"field": {"entity": query.of, "field": query.field}}
    args = ["any" if arg is ANY else encode(arg, None) for arg in query.args]
    if isinstance(query, Fact):
        return {"fact": {"fluent": query.fluent, "args": args}}
    return {"measure": {"measure": query.measure, "args": args}}


def _queries(condition: Any, look: Look) -> list[Any]:
    """What a condition depends on that the robot can observe."""
    found: list[Any] = []
    pending = [condition]
    while pending:
        part = pending.pop(0)
        if isinstance(part, Fact):
            asked = look.fact(part)
            found += [asked] if asked is not None and part.fluent in look.beliefs.observable else []
        elif isinstance(part, Measure):
            args = look.value(part.args)
            found += [] if args is None else [Measure(part.measure, args)]
        elif isinstance(part, Field):
            of = look.value(part.of)
            found += [Field(of, part.field)] if isinstance(of, Entity) else []
        else:
            pending += [value for value in getattr(part, "__dict__", {}).values() if not isinstance(value, (str, bool))]
            pending += list(part) if isinstance(part, (list, tuple)) else []
    return found


async def carry_out(script: Script, driver: Driver) -> End:
    """Carries a script out on a driver, on the running loop."""
    run = {"robot": script.robot, "policy": script.policy}
    driver.begin_run(run | {"primitives": [{"name": name} | one for name, one in script.primitives.items()]})
    robot = Robot(script, driver)
    try:
        return await robot._reached(End("done", result=await script.steps(robot)))
    except _Ended as ended:
        return await robot._reached(ended.end) if ended.end.how == "done" else ended.end
    except Failed as failed:
        return End("failed", failed.text or None, failed.kind)
    except Interrupted:
        return End("interrupted")


def run(script: Script, driver: Driver) -> End:
    """Carries a script out on a driver, to its end. The time of a driver with its own clock passes at once."""
    loop = new_loop(driver.owns_clock)
    asyncio.set_event_loop(loop)
    try:
        task = loop.create_task(carry_out(script, driver))
        passing = [loop.create_task(loop.pass_until(math.inf))] if isinstance(loop, DriverLoop) else []
        end = loop.run_until_complete(task)
        for one in passing:
            one.cancel()
        loop.run_until_complete(asyncio.gather(*passing, return_exceptions=True))
        return end
    finally:
        driver.shutdown()
        asyncio.set_event_loop(None)
        loop.close()


def main(script: Script) -> None:
    """Runs a script on the driver that the command line names as `MODULE:CLASS`; exits with 0 if it is done."""
    if len(sys.argv) != 2 or ":" not in sys.argv[1]:
        sys.exit(f"usage: {sys.argv[0]} MODULE:CLASS, with a subclass of motet.Driver that needs no arguments")
    module, name = sys.argv[1].split(":", 1)
    sys.path.insert(0, "")
    try:
        driver = getattr(importlib.import_module(module), name)()
    except (ImportError, AttributeError) as why:
        sys.exit(f"there is no driver `{sys.argv[1]}`: {why}")
    end = run(script, driver)
    told = ": ".join(part for part in (end.kind, end.why) if part)
    print(f"{end.how}{' (' + told + ')' if told else ''}")
    sys.exit(0 if end.how == "done" else 3)
