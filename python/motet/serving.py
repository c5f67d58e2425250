"""Serving a driver: on standard input and output, or on a port of this machine."""

from __future__ import annotations

import asyncio
import os
import socket
import sys
import threading
import warnings
from collections.abc import Callable

from .clock import new_loop
from .driver import Driver
from .protocol import Session

__all__ = ["ServedStream", "serve"]

#: A host says something every second; after so many seconds without a word it has vanished.
SILENCE = 5.0
LONGEST_LINE = 16 << 20


def serve(driver: Driver, port: int | None = None, grace: float = 10.0) -> None:
    """Serves a driver on standard input and output until its host goes, or on a TCP port of this machine for ever.

    Port 0 takes a free one; the first line of the output names it. On a port the goals go on for `grace` seconds without a host.
    The protocol has standard input and output; what the driver prints goes to standard error.
    """
    try:
        if port is None:
            output = os.dup(sys.stdout.fileno())
            os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
            _run(driver, lambda session: _serve_stdio(session, output))
        else:
            with socket.create_server(("127.0.0.1", port)) as server:
                print(f"listening on tcp://127.0.0.1:{server.getsockname()[1]}", flush=True)
                _run(driver, lambda session: _listen(session, server, grace))
    except (KeyboardInterrupt, BrokenPipeError):
        pass


def _run(driver: Driver, serving: Callable[[Session], object]) -> None:
    loop = new_loop(driver.owns_clock)
    asyncio.set_event_loop(loop)
    try:
        loop.run_until_complete(serving(Session(driver, loop)))  # type: ignore[arg-type]
    finally:
        driver.shutdown()
        left = asyncio.all_tasks(loop)
        for task in left:
            task.cancel()
        if left and not loop.is_closed():
            loop.run_until_complete(asyncio.gather(*left, return_exceptions=True))
        asyncio.set_event_loop(None)
        loop.close()


async def _serve_stdio(session: Session, output: int) -> None:
    def write(data: bytes) -> None:
        while data:
            data = data[os.write(output, data) :]

    await _converse(session, sys.stdin.fileno(), lambda: os.read(sys.stdin.fileno(), 65536), write)
    # No host can come back.
    session.write = None
    await session.stop_all()


class ServedStream:
    """A driver in this process, on a thread of its own, at the other end of a socket."""

    #: Seconds that a driver has to end after its host has gone.
    GRACE = 10.0

    def __init__(self, driver: Driver) -> None:
        self._driver = driver
        self._thread: threading.Thread | None = None

    def serve(self, file: int) -> None:
        """Begins to serve the socket with this number, which is closed at the end."""
        connection = socket.socket(fileno=file)

        async def serving(session: Session) -> None:
            if not await serve_connection(session, connection):
                await session.stop_all()

        self._thread = threading.Thread(target=_run, args=(self._driver, serving), name="motet driver", daemon=True)
        self._thread.start()

    def join(self) -> None:
        """Waits until the driver has ended, but not for ever."""
        if self._thread is None:
            return
        self._thread.join(self.GRACE)
        if self._thread.is_alive():
            text = f"the driver has not ended within {self.GRACE} s: a coroutine of it does not await"
            warnings.warn(text, RuntimeWarning, stacklevel=4)


async def _listen(session: Session, server: socket.socket, grace: float) -> None:
    """Serves one connection after the other. What runs has `grace` seconds without one."""
    server.setblocking(False)
    alone = False
    while True:
        accepted = asyncio.ensure_future(session.loop.sock_accept(server))
        waits = alone and not session.driver.owns_clock
        done, _ = await asyncio.wait([accepted], timeout=grace if waits else None)
        if not done:
            await session.stop_all()
        connection, _ = await accepted
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        alone = not await serve_connection(session, connection)
        if alone and session.driver.owns_clock:
            await session.stop_all()


async def serve_connection(session: Session, connection: socket.socket) -> bool:
    """Serves one connection. Answers whether its host said goodbye."""
    with connection:
        connection.setblocking(True)
        # A host that reads nothing any more is as good as gone.
        connection.settimeout(SILENCE)
        read = lambda: connection.recv(65536)  # noqa: E731
        try:
            return await _converse(session, connection.fileno(), read, connection.sendall)
        except OSError:
            return False
        finally:
            session.write = None


def _set(ready: asyncio.Future[None]) -> None:
    if not ready.done():
        ready.set_result(None)


async def _converse(
    session: Session, file: int, read: Callable[[], bytes], write: Callable[[bytes], None]
) -> bool:
    """Takes lines in until the host goes, or falls silent. Answers whether it said goodbye."""
    loop, rest = session.loop, b""
    session.write = write
    while True:
        ready = loop.create_future()
        loop.add_reader(file, _set, ready)
        try:
            # Nothing moves while our own time stands still, however long the host is silent.
            await asyncio.wait([ready], timeout=None if session.driver.owns_clock else SILENCE)
        finally:
            loop.remove_reader(file)
        data = read() if ready.done() else b""
        if not data:
            return False
        *lines, rest = (rest + data).split(b"\n")
        if len(rest) > LONGEST_LINE:
            return False
        for line in lines:
            if line.strip() and not await session.take(line):
                return True
