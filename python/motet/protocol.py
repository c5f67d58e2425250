"""The driver protocol, version 2: the goals of one driver, the answers to the calls of its host, and its reports."""

from __future__ import annotations

import asyncio
import json
import os
import sys
import time
import traceback
from collections.abc import Callable
from typing import Any

from .clock import DriverLoop
from .driver import LONGEST, Driver, Failed, Goal, Lost, Refused, answer_of
from .values import encode

__all__ = ["Session"]

PROTOCOL = 2
REFUSED, METHOD_NOT_FOUND, INVALID_PARAMS, INTERNAL = 1, -32601, -32602, -32603


class CallError(Exception):
    """An answer that is an error."""

    def __init__(self, code: int, message: str, data: Any = None) -> None:
        super().__init__(message)
        self.code: int = code
        self.data: Any = data


class Session:
    """Keeps the goals of a driver over all its connections. Everything runs on one event loop."""

    def __init__(self, driver: Driver, loop: asyncio.AbstractEventLoop) -> None:
        self.driver: Driver = driver
        self.loop: asyncio.AbstractEventLoop = loop
        self.run: str | None = None
        self.primitives: dict[str, dict[str, Any]] = {}
        self.instance: str = f"{os.getpid()}-{time.time_ns()}"
        self.forgets: int = 0
        self.goals: dict[int, Goal] = {}
        self.states: dict[int, Any] = {}
        self.tasks: dict[int, asyncio.Task[Any]] = {}
        self.stops: dict[int, asyncio.Task[None]] = {}
        self.watched: list[tuple[dict[str, Any], Any]] = []
        self.watcher: asyncio.Task[None] | None = None
        self.write: Callable[[bytes], None] | None = None
        self._later: list[dict[str, Any]] | None = None
        self._origin = loop.time()
        driver._session = self

    # Calls, by the name of their method.

    async def hello(self, params: dict[str, Any]) -> Any:
        if params["protocol"] != PROTOCOL:
            raise CallError(INVALID_PARAMS, f"this driver speaks version {PROTOCOL} of the protocol")
        if params["run"] != self.run:
            await self.stop_all()
            self.forget()
            # Who knew the driver before is not to take a forgotten goal for one that never began.
            self.forgets += self.run is not None
            self.run = params["run"]
            self._origin = self.loop.time() - params.get("at", 0.0)
        self.primitives = {primitive["name"]: primitive for primitive in params["primitives"]}
        self.driver.begin_run(params)
        name = self.driver.name or type(self.driver).__name__
        answer = {"protocol": PROTOCOL, "driver": name, "instance": f"{self.instance}-{self.forgets}"}
        return answer | {"capabilities": self.driver._capabilities()}

    async def start(self, params: dict[str, Any]) -> Any:
        number = params["goal"]
        if number not in self.states:
            command = params["command"]
            primitive = self.primitives.get(command["primitive"], {})
            result, fails = primitive.get("result"), tuple(primitive.get("fails", ()))
            goal = Goal(number, command, result, fails, _session=self)
            self.goals[number], self.states[number] = goal, "running"
            task = self.loop.create_task(self.carry_out(goal))
            self.tasks[number] = task
            # Its first step decides whether it is refused.
            await asyncio.sleep(0)
            await asyncio.sleep(0)
        state = self.states[number]
        if isinstance(state, dict) and "refused" in state:
            failure = state["refused"]
            text = failure["text"] if isinstance(failure, dict) else "the goal is refused"
            raise CallError(REFUSED, text, {"failure": failure})
        return {}

    async def update(self, params: dict[str, Any]) -> Any:
        if goal := self.running(params["goal"]):
            goal.command = params["command"]
        return {}

    async def cancel(self, params: dict[str, Any]) -> Any:
        number = params["goal"]
        if goal := self.running(number):
            goal._is_cancelled = True
            # A held goal is let go, so that it can end.
            goal._proceed()
            if not goal._polls and number in self.tasks:
                self.tasks[number].cancel()
        return {}

    async def hold(self, params: dict[str, Any]) -> Any:
        if goal := self.running(params["goal"]):
            if self.driver.can_hold != "all" and goal.primitive not in self.driver.can_hold:
                raise CallError(INVALID_PARAMS, f"`{goal.primitive}` cannot be held")
            goal._hold()
        return {}

    async def proceed(self, params: dict[str, Any]) -> Any:
        if goal := self.running(params["goal"]):
            goal._proceed()
        return {}

    async def safe_stop(self, params: dict[str, Any]) -> Any:
        number = params["goal"]
        if number not in self.stops or self.stops[number].done():
            self.stops[number] = self.loop.create_task(self.stop(number))
        return {}

    async def observe(self, params: dict[str, Any]) -> Any:
        return {"answer": await self.driver._answer(params["query"])}

    async def watch(self, params: dict[str, Any]) -> Any:
        query = params["query"]
        answer = await self.driver._answer(query)
        self.watched = [pair for pair in self.watched if pair[0] != query] + [(query, answer)]
        if self.watcher is None:
            self.watcher = self.loop.create_task(self.look_now_and_then())
        return {"answer": answer}

    async def unwatch(self, params: dict[str, Any]) -> Any:
        self.watched = [pair for pair in self.watched if pair[0] != params["query"]]
        return {}

    async def status(self, params: dict[str, Any]) -> Any:
        goals = params["goals"]
        return {"goals": [{"goal": number, "state": self.states.get(number, "unknown")} for number in goals]}

    async def ping(self, params: dict[str, Any]) -> Any:
        return {}

    async def advance(self, params: dict[str, Any]) -> Any:
        if not isinstance(self.loop, DriverLoop):
            raise CallError(METHOD_NOT_FOUND, "this driver goes by the clock on the wall")
        await self.loop.pass_until(params["until"] + self._origin)
        return {"now": min(params["until"], max(params.get("at", 0.0), self.now()))}

    async def perceive(self, method: str, params: dict[str, Any]) -> Any:
        """Calls a method that the protocol has and a driver may have: `look`, `detections`, `told`, `truth`."""
        args = {key: value for key, value in params.items() if key != "at"}
        said = getattr(self.driver, method)(**args)
        if asyncio.iscoroutine(said):
            said = await said
        if method == "truth":
            return {"answer": answer_of(params["query"], said)}
        return {"detections": said} if method == "detections" else said if said is not None else {}

    METHODS = frozenset(
        "hello start update cancel hold proceed safe_stop observe watch unwatch status ping advance".split()
    )
    PERCEPTION = frozenset(("look", "detections", "told", "truth"))

    # Goals.

    def now(self) -> float:
        """Seconds of the run."""
        return self.loop.time() - self._origin

    def running(self, number: int) -> Goal | None:
        return self.goals[number] if self.states.get(number) == "running" else None

    async def carry_out(self, goal: Goal) -> None:
        """Runs the coroutine of a goal to its end, and says how it ended."""
        try:
            method = self.driver._performer(goal.primitive)
            try:
                value = encode(await method(goal, **goal.args), goal.result_type)
            except Failed as failed:
                if isinstance(failed, Refused) and self._later is not None and goal.number == self._starting:
                    self.states[goal.number] = {"refused": failed._wire()}
                    return
                outcome: Any = {"failure": self.declared(goal, failed)}
            else:
                outcome = "interrupted" if goal._saw_cancel else {"success": value}
        except Lost:
            # It counts as running until the host has it stopped.
            self.report("lost", {"goal": goal.number})
            return
        except asyncio.CancelledError:
            outcome = "interrupted"
        except Exception as error:
            traceback.print_exc(file=sys.stderr)
            outcome = {"failure": self.declared(goal, Failed("failed", f"{type(error).__name__}: {error}"))}
        if self.states.get(goal.number) == "running":
            self.states[goal.number] = {"ended": outcome}
            self.report("ended", {"goal": goal.number, "outcome": outcome})
            self.look_at_watched()

    def declared(self, goal: Goal, failed: Failed) -> Any:
        """A failure that the primitive declares: another one becomes its first, and goes on in the text."""
        if not goal.fails or failed.kind in (*goal.fails, "timeout"):
            return failed._wire()
        kinds = ", ".join(f"`{kind}`" for kind in goal.fails)
        told = f"`{goal.primitive}` does not declare `{failed.kind}`, but {kinds}: it counts as `{goal.fails[0]}`"
        print(f"motet: {told}", file=sys.stderr)
        self.report("feedback", {"goal": goal.number, "text": told[:LONGEST]})
        return {"kind": goal.fails[0], "text": str(failed)[:LONGEST]}

    async def stop(self, number: int) -> None:
        """Brings a goal to a safe stop, known or not, and says so when everything stands still."""
        await self.bring_to_a_stand(number)
        self.report("stopped", {"goal": number})

    async def bring_to_a_stand(self, number: int) -> None:
        goal = self.running(number)
        if goal is not None or number not in self.states:
            self.states[number] = "stopped"
        task = self.tasks.get(number)
        if task is not None and not task.done():
            task.cancel()
            await asyncio.wait([task])
        known = self.goals.get(number) or Goal(number, {"primitive": ""}, _session=self)
        await self.driver.stop(known)

    async def stop_all(self) -> None:
        """Stops what runs; a later host hears that it has."""
        for number in [number for number, state in self.states.items() if state == "running"]:
            await self.bring_to_a_stand(number)

    def forget(self) -> None:
        """Another run begins: its goals have numbers of their own."""
        for kept in (self.goals, self.states, self.tasks, self.stops, self.watched):
            kept.clear()

    # Watched queries.

    async def look_now_and_then(self) -> None:
        while True:
            await asyncio.sleep(self.driver.watch_period)
            await self.look()

    def look_at_watched(self) -> None:
        if self.watched:
            self.loop.create_task(self.look())

    async def look(self) -> None:
        """Says which answers have changed."""
        for query, _ in list(self.watched):
            answer = await self.driver._answer(query)
            for at, (watched, before) in enumerate(self.watched):
                if watched == query and answer != before:
                    self.watched[at] = (query, answer)
                    self.report("observed", {"query": query, "answer": answer})

    # Messages.

    def report(self, method: str, params: dict[str, Any]) -> None:
        """Says something to the host; while a call is answered, after its answer."""
        if method == "moved" and isinstance(self.loop, DriverLoop):
            params = {"at": self.now()} | params
        message = {"jsonrpc": "2.0", "method": method, "params": params}
        if self._later is not None:
            self._later.append(message)
            return
        self.say(message)
        if method != "moved" and isinstance(self.loop, DriverLoop):
            self.loop.stop_passing()

    def say(self, message: dict[str, Any]) -> None:
        if self.write is not None:
            self.write((json.dumps(message, allow_nan=False) + "\n").encode())

    _starting: int | None = None

    async def take(self, line: bytes) -> bool:
        """Takes a line of the host in. False where it goes."""
        message = json.loads(line)
        method, params = message.get("method"), message.get("params") or {}
        if method == "bye":
            await self.stop_all()
            return False
        answer: dict[str, Any] = {"jsonrpc": "2.0", "id": message["id"]}
        if method != "advance":
            self._later = []  # what this call makes the driver report comes after its answer
        self._starting = params.get("goal") if method == "start" else None
        try:
            if method in self.METHODS:
                answer["result"] = await getattr(self, method)(params)
            elif method in self.PERCEPTION and callable(getattr(self.driver, method, None)):
                answer["result"] = await self.perceive(method, params)
            else:
                raise CallError(METHOD_NOT_FOUND, f"there is no method `{method}`")
        except CallError as error:
            answer["error"] = {"code": error.code, "message": str(error), "data": error.data}
        except (KeyError, TypeError, ValueError) as error:
            answer["error"] = {"code": INVALID_PARAMS, "message": f"bad parameters: {error!r}", "data": None}
        except Exception as error:
            traceback.print_exc(file=sys.stderr)
            answer["error"] = {"code": INTERNAL, "message": f"{type(error).__name__}: {error}", "data": None}
        if isinstance(self.loop, DriverLoop):
            # Otherwise it would depend on the host's haste which reports come before the next call.
            await self.loop.settle()
        later, self._later, self._starting = self._later or [], None, None
        self.say(answer)
        for report in later:
            self.say(report)
        return True
