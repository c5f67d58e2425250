"""The event loop of a driver: on the clock of the wall, or on a clock of its own that stands still between calls."""

from __future__ import annotations

import asyncio
import selectors
from collections.abc import Callable
from typing import Any

__all__ = ["DriverLoop", "new_loop"]


class _Idle(selectors.DefaultSelector):
    """A selector that says when nothing is left to do at the present time."""

    idle: Callable[[float | None], bool] = staticmethod(lambda timeout: False)

    def select(self, timeout: float | None = None) -> Any:
        if timeout is not None and timeout <= 0.0:
            return super().select(0.0)
        # What came in meanwhile is heard first.
        return super().select(0.0) or super().select(0.0 if self.idle(timeout) else None)


class DriverLoop(asyncio.SelectorEventLoop):
    """An event loop whose time passes only while the host lets it: `asyncio.sleep` waits for that time."""

    def __init__(self) -> None:
        self._virtual = 0.0
        self._until: float | None = None
        self._reached: asyncio.Future[None] | None = None
        self._settled: asyncio.Future[None] | None = None
        selector = _Idle()
        super().__init__(selector)
        selector.idle = self._idle

    def time(self) -> float:
        return self._virtual

    async def pass_until(self, until: float) -> None:
        """Lets time pass until there is a report, but not beyond `until`, in s of this loop."""
        self._until, self._reached = max(until, self._virtual), self.create_future()
        try:
            await self._reached
        finally:
            self._until = self._reached = None

    def stop_passing(self) -> None:
        """Lets time stand still again, as soon as nothing is left to do now."""
        if self._until is not None:
            self._until = self._virtual

    async def settle(self) -> None:
        """Waits until nothing is left to do at the present time."""
        self._settled = self.create_future()
        await self._settled

    def _idle(self, timeout: float | None) -> bool:
        """Lets time pass to the next thing to do. False if only the host can go on."""
        if self._settled is not None and not self._settled.done():
            self._settled.set_result(None)
            return True
        if self._until is None or self._reached is None:
            return False
        due = self._until if timeout is None else min(self._until, self._virtual + timeout)
        self._virtual = max(self._virtual, due)
        if due >= self._until and not self._reached.done():
            self._reached.set_result(None)
        return True


def new_loop(owns_clock: bool) -> asyncio.AbstractEventLoop:
    """The loop of a driver that owns the clock, or of any other."""
    return DriverLoop() if owns_clock else asyncio.SelectorEventLoop()
