"""Serves a live run until it has ended and its pages have had the replay.

Ctrl-C ends the run; a second Ctrl-C does not wait for the pages.
"""

from __future__ import annotations

import asyncio
import os
import signal
import socket
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext

import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol

from ...errors import HostError, InputError
from ..session.commands import End
from .app import LiveApp

__all__ = ["MOST_MESSAGE", "bind", "make_server", "serve"]

MOST_MESSAGE = 16_384
"""Bytes in a message of a client. An order has some hundred."""
MOST_CONNECTIONS = 200
"""Connections at a time, of browsers that fetch and of clients."""
IDLE = 8.0
"""[s] without any progress after which a connection ends that is no WebSocket: a request that does not come, an answer
that is not read. Without it, whoever opens connections and is silent locks all others out, token or not."""
SEND_BUFFER = 65_536
"""Bytes that the system keeps for a client: some three seconds of states. More would show a slow client the past."""
LINGER = 60.0
"""[s] for which pages may still fetch the replay after the end of the run."""
GOODBYE = 1.0
"""[s] for the last messages."""


def bind(host: str, port: int) -> socket.socket:
    """A socket that listens at that address. Raises InputError for a port that is none, HostError when the address is
    in use or not this machine's."""
    if not 0 <= port <= 65535:
        raise InputError(f"--port {port} must be from 0 to 65535: give one such as 8750, or 0 for any that is free")
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        listening = socket.socket(family, socket.SOCK_STREAM)
    except OSError as error:
        raise HostError(f"--host {host}: {error.strerror or error}; give an address of this machine") from None
    if os.name == "posix":  # elsewhere the option lets two servers share a port
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER)
    try:
        listening.bind((host, port))
        listening.listen(128)
    except OSError as error:
        listening.close()
        remedy = "give another with --port, or --port 0 for any that is free"
        raise HostError(f"--port {port} at {host}: {error.strerror or error}; {remedy}") from None
    return listening


class _Server(uvicorn.Server):
    """uvicorn's server, which leaves signals to us."""

    def capture_signals(self) -> AbstractContextManager[None]:  # type: ignore[override]  # a generator there
        return nullcontext()


class _Http(H11Protocol):
    """uvicorn's protocol, which has no limit for a request that never comes."""

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        self._seen: object = self._look()
        self.loop.call_later(IDLE, self._end_if_idle)

    def _look(self) -> tuple[object, bool, int]:
        """What changes while there is progress."""
        is_answered = self.cycle is not None and self.cycle.response_complete
        return self.cycle, is_answered, self.transport.get_write_buffer_size()

    def _end_if_idle(self) -> None:
        if self not in self.connections:  # it has gone, or is a WebSocket now
            return
        seen = self._look()
        if seen == self._seen:
            self.transport.abort()
            return
        self._seen = seen
        self.loop.call_later(IDLE, self._end_if_idle)


def make_server(app: LiveApp) -> uvicorn.Server:
    """The server of the application, with its limits; it writes no log."""
    return _Server(
        uvicorn.Config(
            app.asgi, http=_Http, log_config=None, log_level="critical", access_log=False, lifespan="off",
            server_header=False,
            ws="websockets-sansio", ws_max_size=MOST_MESSAGE, ws_per_message_deflate=False, ws_ping_interval=10.0,
            ws_ping_timeout=10.0, limit_concurrency=MOST_CONNECTIONS, timeout_keep_alive=5,
            timeout_graceful_shutdown=2,
        )
    )  # fmt: skip


def serve(
    app: LiveApp,
    listening: socket.socket,
    ready: Callable[[], None] = lambda: None,
    ended: Callable[[], None] = lambda: None,
) -> None:
    """Run session and server to the end. `ready` is called when pages can be asked for, `ended` once the run is stored;
    open pages may then still go to the replay."""
    asyncio.run(_serve(app, listening, ready, ended))


async def _serve(app: LiveApp, listening: socket.socket, ready: Callable[[], None], ended: Callable[[], None]) -> None:
    server, interrupted = make_server(app), asyncio.Event()
    loop = asyncio.get_running_loop()

    def interrupt() -> None:
        interrupted.set()
        app.session.submit(End("interrupted"))

    restore = _answer_signals(loop, interrupt)
    app.hub.connect()
    app.session.start()
    serving = asyncio.create_task(server.serve(sockets=[listening]))
    try:
        ready()
        await app.hub.has_ended.wait()
        ended()
        await _linger(app, interrupted)
    finally:
        server.should_exit = True
        await serving
        restore()


async def _linger(app: LiveApp, interrupted: asyncio.Event) -> None:
    """Wait until the pages have gone to the replay, or until Ctrl-C."""
    if not app.hub.clients:
        return
    loop = asyncio.get_running_loop()
    end = loop.time() + LINGER
    await asyncio.sleep(GOODBYE)
    while app.hub.clients and loop.time() < end and not interrupted.is_set():
        await asyncio.sleep(0.1)
    if not interrupted.is_set():
        await asyncio.sleep(GOODBYE)


def _answer_signals(loop: asyncio.AbstractEventLoop, interrupt: Callable[[], None]) -> Callable[[], None]:
    """Let SIGINT and SIGTERM end the run; the function that puts back what was."""
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    taken = [number for number, handler in before.items() if handler not in (signal.SIG_IGN, None)]
    for number in taken:
        try:
            loop.add_signal_handler(number, interrupt)
        except (NotImplementedError, RuntimeError, ValueError):  # Windows; a thread that is not the main one
            try:
                signal.signal(number, lambda *_: loop.call_soon_threadsafe(interrupt))
            except ValueError:
                return lambda: None

    def restore() -> None:
        for number in taken:
            signal.signal(number, before[number])

    return restore
