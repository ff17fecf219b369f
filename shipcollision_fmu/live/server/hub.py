"""Hub: the clients of a live session at its WebSocket.

state     twenty times a second the latest snapshot, made into text once for all clients
touches   before it where bodies have touched since the state before
events    from the session's thread into a short queue of each client; the oldest are dropped
a slow client is waited for at most PATIENCE, then dropped. Nothing waits for it but its own task
"""

from __future__ import annotations

import asyncio
import json
from collections import deque
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from starlette.websockets import WebSocket, WebSocketDisconnect

from ...errors import InputError, ShipCollisionError
from ..session.commands import Leave
from ..session.session import Session
from ..session.snapshot import Snapshot
from ..session.touch_log import LoggedTouch
from . import access
from .access import Allowance
from .messages import BadMessageError, parse_message

__all__ = ["MOST_CLIENTS", "Hub"]

MOST_CLIENTS = 32
"""Clients at a time: a class. More are refused."""
INTERVAL = 0.05
"""[s] between two states: 20 Hz."""
INSTRUCTORS = frozenset({"armed"})
"""Events that instructors alone are told of: a failure that is to come is to surprise the bridge."""
PATIENCE = 5.0
"""[s] for which a message may take to be sent. A slower client is dropped."""
MOST_EVENTS = 200
"""Events that wait for a client, and that a new client is told of."""


@dataclass(eq=False)
class _Client:
    name: str
    role: str
    socket: WebSocket
    waiting: deque[dict[str, Any]] = field(default_factory=lambda: deque(maxlen=MOST_EVENTS))
    news: asyncio.Event = field(default_factory=asyncio.Event)
    touches: tuple[LoggedTouch, ...] = ()  # those that it has been told of
    is_over: bool = False  # asked for besides cancelling: wait_for() of CPython 3.11 may swallow that

    def put(self, message: dict[str, Any]) -> None:
        self.waiting.append(message)
        self.news.set()

    def learn(self, touches: tuple[LoggedTouch, ...]) -> list[dict[str, Any]]:
        """Of the touches so far those that are new to it: all that there were between two states."""
        if touches is self.touches:
            return []
        known, self.touches = {id(logged) for logged in self.touches}, touches
        return [one.as_message() for one in touches if id(one) not in known]


class Hub:
    """The clients of `session`. `hello` is what every client is told first."""

    def __init__(self, session: Session, hello: dict[str, Any], *, sets_pace: bool = True, patience: float = PATIENCE):
        self._session, self._hello, self._sets_pace, self._patience = session, hello, sets_pace, patience
        self._clients: set[_Client] = set()
        self._count = 0
        self._text: tuple[Snapshot | None, str] = (None, "")
        self._undone: Snapshot | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._history: deque[dict[str, Any]] = deque(maxlen=MOST_EVENTS)
        self._end: dict[str, Any] | None = None
        self.has_ended = asyncio.Event()

    def connect(self) -> None:
        """Begin to pass on events, into the running loop."""
        self._loop = asyncio.get_running_loop()
        self._stop = self._session.listen(self._hear)

    @property
    def clients(self) -> int:
        """How many there are."""
        return len(self._clients)

    async def serve(self, socket: WebSocket, role: str) -> None:
        """Serve a client, from its acceptance to its end."""
        self._count += 1
        client = _Client(f"{role}-{self._count}", role, socket)
        await socket.accept()
        self._greet(client)
        self._clients.add(client)  # at once: what happens from now on is no history
        tasks = [asyncio.create_task(self._send_all(client)), asyncio.create_task(self._receive_all(client))]
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._clients.discard(client)
            client.is_over = True
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)
            self._session.submit(Leave(client.name))

    # -- out ----------------------------------------------------------------------------------------------------------

    def _greet(self, client: _Client) -> None:
        """Tell a new client what it has missed."""
        notes = self._session.notes
        marks = [
            {"name": name, "time": time, "note": notes.get(name, "")} for name, time in self._session.marks.items()
        ]
        touches = client.learn(self._session.touches)
        client.put(
            {
                "type": "hello", **self._hello, "role": client.role, "client": client.name, "marks": marks,
                "events": [event for event in self._history if _is_for(event, client)], "touches": touches,
                **({"armed": self._session.armed} if client.role == "instructor" else {}),
            }
        )  # fmt: skip
        if self._end is not None:
            client.put(self._end)

    async def _send_all(self, client: _Client) -> None:
        """What waits, which begins with hello, then states and events, until the client is gone or too slow."""
        loop = asyncio.get_running_loop()
        try:
            due = loop.time()
            while not client.is_over:
                while client.waiting and not client.is_over:
                    await self._send(client, json.dumps(client.waiting.popleft()))
                now = loop.time()
                if now >= due:
                    if new := client.learn(self._session.touches):
                        await self._send(client, json.dumps({"type": "touches", "touches": new}))
                    if (snapshot := self._session.snapshot) is not self._undone:
                        await self._send(client, self._encode(snapshot))
                    due = max(due + INTERVAL, loop.time())
                client.news.clear()
                if not client.waiting:
                    with suppress(asyncio.TimeoutError):
                        await asyncio.wait_for(client.news.wait(), max(0.0, due - loop.time()))
        except (asyncio.TimeoutError, WebSocketDisconnect, RuntimeError, OSError):
            return  # gone, or too slow

    async def _send(self, client: _Client, text: str) -> None:
        await asyncio.wait_for(client.socket.send_text(text), self._patience)

    def _encode(self, snapshot: Snapshot) -> str:
        if self._text[0] is not snapshot:
            self._text = snapshot, json.dumps(snapshot.as_message(), separators=(",", ":"))
        return self._text[1]

    def _hear(self, event: dict[str, Any]) -> None:
        """Called in the session's thread."""
        assert self._loop is not None
        if event["kind"] == "back":  # the state from here on is published later than the event
            self._undone = self._session.snapshot
        try:
            self._loop.call_soon_threadsafe(self._pass_on, event)
        except RuntimeError:  # the loop is closed: nobody is left
            self._stop()

    def _pass_on(self, event: dict[str, Any]) -> None:
        if event["kind"] == "end":
            what = {key: value for key, value in event.items() if key != "kind"}
            message = {"type": "end", **what, "replay": "/replay.html" if self._session.page else None}
        else:
            message = {"type": "event", **event}
            self._history.append(event)
        for client in self._clients:
            if _is_for(event, client):
                client.put(message)
        if event["kind"] == "end":
            self._end = message
            self.has_ended.set()

    # -- in -----------------------------------------------------------------------------------------------------------

    async def _receive_all(self, client: _Client) -> None:
        """Answer every message of a client, until it is gone or floods."""
        loop = asyncio.get_running_loop()
        allowance = Allowance(loop.time(), access.PER_SECOND, access.AT_ONCE)
        beyond = Allowance(loop.time(), access.REFUSED_PER_SECOND, access.REFUSED_AT_ONCE)
        is_told = False
        try:
            while True:
                received = await client.socket.receive()
                if received["type"] == "websocket.disconnect":
                    return
                if allowance.take(loop.time()):
                    is_told = False
                    client.put(await self._answer(client, received.get("text")))
                    continue
                self._session.count_refused()
                if not beyond.take(loop.time()):
                    return
                if not is_told:
                    is_told = True
                    client.put({"type": "error", "message": f"too many: send {access.PER_SECOND:g} a second at most"})
        except (WebSocketDisconnect, RuntimeError, OSError):
            return

    async def _answer(self, client: _Client, text: str | None) -> dict[str, Any]:
        try:
            if text is None:
                raise BadMessageError("the message is binary: send JSON as text")
            request, command = parse_message(text, client.name, client.role, sets_pace=self._sets_pace)
        except BadMessageError as error:
            self._session.count_refused()
            return _make_answer("error", error.request, message=str(error))
        try:
            await asyncio.wrap_future(self._session.submit(command))
        except (InputError, ShipCollisionError) as error:
            return _make_answer("error", request, message=str(error))
        return _make_answer("ok", request, step_count=self._session.snapshot.step_count)


def _is_for(event: dict[str, Any], client: _Client) -> bool:
    return client.role == "instructor" or event["kind"] not in INSTRUCTORS


def _make_answer(kind: str, request: Any, **what: Any) -> dict[str, Any]:
    return {"type": kind, **({} if request is None else {"id": request}), **what}
