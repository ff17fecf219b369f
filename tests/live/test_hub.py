"""What the hub sends when a run goes back, of a session that does as it is told."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import Any, cast

import pytest
from starlette.websockets import WebSocket

from shipcollision_fmu.live.server import hub as hub_module
from shipcollision_fmu.live.server.hub import Hub
from shipcollision_fmu.live.session.session import Session
from tests.live.live_server import PATIENCE


@dataclass(eq=False)
class Published:
    time: float

    def as_message(self) -> dict[str, Any]:
        return {"type": "state", "time": self.time}


@dataclass(eq=False)
class Told:
    """A session: what the hub asks of it."""

    snapshot: Published
    touches: tuple[()] = ()
    marks: dict[str, float] = field(default_factory=dict)
    notes: dict[str, str] = field(default_factory=dict)
    page: None = None

    def listen(self, listener: Callable[[dict[str, Any]], None]) -> Callable[[], None]:
        self.tell = listener
        return lambda: None

    def submit(self, command: object) -> None:
        """Nothing is done."""


class Heard:
    """A socket: what a client hears, ("state" or kind of event, time)."""

    def __init__(self) -> None:
        self.messages: list[tuple[str, float]] = []

    async def accept(self) -> None:
        """At once."""

    async def send_text(self, text: str) -> None:
        message = json.loads(text)
        if message["type"] != "hello":
            self.messages.append((message.get("kind", message["type"]), message["time"]))

    async def receive(self) -> dict[str, Any]:
        return cast("dict[str, Any]", await asyncio.Event().wait())


@asynccontextmanager
async def serve_a_page() -> AsyncIterator[tuple[Told, Heard]]:
    """A session at 10.5 s, and a page that has heard of it."""
    session, socket = Told(Published(10.5)), Heard()
    hub = Hub(cast(Session, session), {})
    hub.connect()
    serving = asyncio.create_task(hub.serve(cast(WebSocket, socket), "bridge"))
    while not socket.messages:
        await asyncio.sleep(0.01)
    yield session, socket
    serving.cancel()


async def hear_of_a_step_back() -> list[tuple[str, float]]:
    async with serve_a_page() as (session, socket):
        session.tell({"kind": "back", "time": 10.0})
        await asyncio.sleep(4 * hub_module.INTERVAL)  # the session's thread is long about it
        session.snapshot = Published(11.0)
        while ("state", 11.0) not in socket.messages:
            await asyncio.sleep(0.01)
    return socket.messages


def test_no_state_that_is_undone_follows_the_event_of_going_back() -> None:
    """A page would take what it shows for what has happened since."""
    messages = asyncio.run(asyncio.wait_for(hear_of_a_step_back(), PATIENCE))
    after = messages[messages.index(("back", 10.0)) + 1 :]
    assert set(after) == {("state", 11.0)}


async def hear_of_a_collision() -> list[tuple[str, float]]:
    async with serve_a_page() as (session, socket):
        session.tell({"kind": "collision begins", "time": 10.55})
        while ("collision begins", 10.55) not in socket.messages:
            await asyncio.sleep(0.01)
    return socket.messages


def test_an_event_does_not_wait_for_the_next_state(monkeypatch: pytest.MonkeyPatch) -> None:
    """Which is due in an hour here: a collision is told of at once."""
    monkeypatch.setattr(hub_module, "INTERVAL", 3600.0)
    messages = asyncio.run(asyncio.wait_for(hear_of_a_collision(), PATIENCE))
    assert messages == [("state", 10.5), ("collision begins", 10.55)]
