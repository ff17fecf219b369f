"""A live server of the tests, on a port of loopback that is free, in a thread of its own."""

from __future__ import annotations

import json
import threading
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.client import HTTPMessage
from typing import Any

import pytest
from websockets.sync.client import ClientConnection, connect

from shipcollision_fmu.live.server import serve as serve_module
from shipcollision_fmu.live.server.app import LiveApp
from shipcollision_fmu.live.server.serve import bind, serve
from shipcollision_fmu.live.session.commands import End
from shipcollision_fmu.live.session.session import Session
from shipcollision_fmu.scenario.scenario import load_scenario

__all__ = ["PATIENCE", "LiveServer", "eventually", "receive", "receive_until", "serving"]

PATIENCE = 120.0
"""[s] for what comes in a moment on a quiet machine: a busy one may be long about it, and no test is about that."""


class LiveServer:
    """The address of a server, its application and its session."""

    def __init__(self, app: LiveApp, port: int, ended: threading.Event) -> None:
        self.app, self.session, self.port, self.ended = app, app.session, port, ended

    def address(self, role: str = "bridge", token: str | None = None) -> str:
        """Of the WebSocket."""
        token = getattr(self.app.tokens, role) if token is None else token
        return f"ws://127.0.0.1:{self.port}/ws?token={token}&role={role}"

    @contextmanager
    def connect(self, role: str = "bridge", **options: Any) -> Iterator[ClientConnection]:
        """A client that has read its hello."""
        usual = {"open_timeout": PATIENCE, "close_timeout": 1, "ping_interval": None}
        with connect(self.address(role), **(usual | options)) as client:
            assert receive(client)["type"] == "hello"
            yield client

    def get(self, path: str, **headers: str) -> tuple[int, bytes, HTTPMessage]:
        """Status, body and headers of an answer."""
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}{path}", headers=headers)
        try:
            with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
                return answer.status, answer.read(), answer.headers
        except urllib.error.HTTPError as error:
            return error.code, error.read(), error.headers


@contextmanager
def serving(*, out: Any = None, patience: float = 5.0, **options: Any) -> Iterator[LiveServer]:
    """A server of the shipped crossing; it ends with the context. `options` are the session's."""
    scenario = options.pop("scenario", None) or load_scenario("kvlcc2_crossing")
    with bind("127.0.0.1", 0) as listening:
        session = Session(scenario, out=out, **options)
        app = LiveApp(session, next(iter(scenario.ships)), patience=patience)
        ready, ended = threading.Event(), threading.Event()
        thread = threading.Thread(target=serve, args=(app, listening, ready.set, ended.set), daemon=True)
        thread.start()
        assert ready.wait(PATIENCE)
        try:
            yield LiveServer(app, listening.getsockname()[1], ended)
        finally:
            with pytest.MonkeyPatch.context() as patch:  # the next server waits for its pages again
                patch.setattr(serve_module, "GOODBYE", 0.02)
                patch.setattr(serve_module, "LINGER", 0.0)
                session.submit(End())
                thread.join(PATIENCE)
            assert not thread.is_alive()


def eventually(holds: Callable[[], bool]) -> None:
    """Returns once something holds; fails when it does not come true."""
    end = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < end, "it did not come true"
        time.sleep(0.01)


def receive(client: ClientConnection, timeout: float = PATIENCE) -> dict[str, Any]:
    """The next message."""
    message: dict[str, Any] = json.loads(client.recv(timeout))
    return message


def receive_until(client: ClientConnection, type_: str, /, **what: Any) -> dict[str, Any]:
    """The next message of a type that has these values; others are read on the way."""
    for _ in range(2000):
        message = receive(client)
        if message["type"] == type_ and all(message.get(key) == value for key, value in what.items()):
            return message
    raise AssertionError(f"no {type_} with {what} came")
