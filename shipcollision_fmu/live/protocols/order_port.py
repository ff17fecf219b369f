"""Orders in by TCP: one JSON object a line, and one line of answer to each.

    -> {"ship": "own", "rudder_deg": 5, "rev_per_s": 1.2}           <- {"ok": true}
    -> {"ship": "own", "heading_deg": 90, "telegraph": 3, "id": 7}  <- {"ok": true, "id": 7}
    -> {"ship": "own", "command": false}                            <- {"ok": true}             gives up the command
    -> {"state": true}                                              <- {"ok": true, "state": {...}}
    -> {"ship": "own", "rudder": 5}      <- {"ok": false, "error": "rudder is no key: ..."}

The first order to a ship that nobody commands takes its command; a client that goes gives up all. Lines are UTF-8, end
with a line feed and have at most LONGEST_LINE bytes. One thread serves all clients and waits for none: a client that
does not read its answers, or sends too much at a time, is dropped. Lines that are refused are counted.

A port with a token asks for it in the first line of a client, alone or with an order: {"token": "...", "ship": ...}.
Without it a client is dropped, and after ADMISSION seconds at the latest, so that silent ones do not lock others out.

A client whose first line is not JSON is dropped, with all that follows. Any page in a browser of this machine may post
to the port: that begins with a line of HTTP, and its body could hold orders.
"""

from __future__ import annotations

import json
import secrets
import selectors
import socket
import threading
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from concurrent.futures import TimeoutError as TooLate
from contextlib import suppress
from dataclasses import dataclass
from time import monotonic
from typing import Any

from ...errors import InputError
from .addresses import listen
from .order_line import Line, NotJsonError, parse_line

__all__ = ["LONGEST_LINE", "MOST_CLIENTS", "MOST_LINES", "OrderPort", "Orders"]

LONGEST_LINE = 4096
"""Bytes in a line. An order has some sixty."""
MOST_CLIENTS = 8
MOST_LINES = 50
"""Lines of a client that are answered in a second; the others are refused."""
MOST_PENDING = 65_536
"""Bytes of answers that wait for a client; with more it is dropped."""
LONGEST_ANSWER = 2.0
"""[s] for the session to answer an order."""
ADMISSION = 8.0
"""[s] for a client to give the token, where there is one."""
POLL = 0.2
"""[s] after which the thread looks whether it is to end."""


@dataclass(frozen=True)
class Orders:
    """What a session does for the port. Each function but `leave` and `state` returns a Future of a result or refusal.

    take(client, ship, take), order(client, ship, values), leave(client), state(), refused()
    """

    take: Callable[[str, str, bool], Future[Any]]
    order: Callable[[str, str, Mapping[str, float | int]], Future[Any]]
    in_command: Callable[[str], str | None]
    leave: Callable[[str], Any]
    state: Callable[[], Mapping[str, Any]]
    refused: Callable[[], Any]


class _Client:
    def __init__(self, connection: socket.socket, name: str, is_admitted: bool) -> None:
        self.connection, self.name = connection, name
        self.is_admitted, self.came = is_admitted, monotonic()
        self.received, self.answers = bytearray(), bytearray()
        self.skipping = False  # the rest of a line that is too long
        self.is_known = False  # a line of it was JSON: it speaks this protocol
        self.is_unwanted = False  # it speaks another one, or does not know the token
        self.second, self.lines = 0, 0


class OrderPort:
    """The server of the protocol; start() it, and close() it. `token`: what its clients have to know, if anything."""

    def __init__(
        self, host: str, port: int, orders: Orders, option: str = "--orders", token: str | None = None
    ) -> None:  # fmt: skip
        self._listening = listen(host, port, option)
        self._orders, self._token = orders, token
        self._clients: dict[socket.socket, _Client] = {}
        self._selector = selectors.DefaultSelector()
        self._selector.register(self._listening, selectors.EVENT_READ)
        self._ending, self._number = threading.Event(), 0
        self._thread = threading.Thread(target=self._serve, name="order port", daemon=True)
        self.refused, self.accepted, self.dropped = 0, 0, 0

    @property
    def port(self) -> int:
        """The port, also where 0 was given."""
        return int(self._listening.getsockname()[1])

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def close(self) -> None:
        """End, and give the sockets back."""
        self._ending.set()
        if self._thread.is_alive():
            self._thread.join(2.0 + LONGEST_ANSWER)
        for client in list(self._clients.values()):
            self._drop(client)
        self._selector.close()
        self._listening.close()

    # -- the thread ---------------------------------------------------------------------------------------------------

    def _serve(self) -> None:
        while not self._ending.is_set():
            for key, events in self._selector.select(POLL):
                if key.fileobj is self._listening:
                    self._accept()
                    continue
                client = self._clients.get(key.fileobj)  # type: ignore[call-overload]
                if client is not None:
                    self._guard(client, events)
            self._drop_silent()

    def _drop_silent(self) -> None:
        """Drop those who have had their time to give the token."""
        deadline = monotonic() - ADMISSION
        for client in list(self._clients.values()):
            if not client.is_admitted and client.came < deadline:
                self._drop(client)

    def _guard(self, client: _Client, events: int) -> None:
        """A fault of ours costs one client its connection, and the others nothing."""
        try:
            self._attend(client, events)
        except Exception as fault:
            message = f"the order port failed: {type(fault).__name__}: {fault}; the connection ends"
            client.answers += json.dumps({"ok": False, "error": message}).encode() + b"\n"
            self._send(client)
            self._drop(client)

    def _accept(self) -> None:
        try:
            connection, _ = self._listening.accept()
        except OSError:
            return
        connection.setblocking(False)
        if len(self._clients) >= MOST_CLIENTS:
            self.dropped += 1
            said = {"ok": False, "error": f"{MOST_CLIENTS} clients are here already: close one of them"}
            with suppress(OSError):
                connection.send(json.dumps(said).encode() + b"\n")
            connection.close()
            return
        self._number += 1
        self._clients[connection] = _Client(connection, f"order port {self._number}", self._token is None)
        self._selector.register(connection, selectors.EVENT_READ)

    def _attend(self, client: _Client, events: int) -> None:
        if events & selectors.EVENT_READ and not self._receive(client):
            self._drop(client)
            return
        if not self._send(client) or client.is_unwanted or len(client.answers) > MOST_PENDING:
            self._drop(client)
            return
        mask = selectors.EVENT_READ | (selectors.EVENT_WRITE if client.answers else 0)
        self._selector.modify(client.connection, mask)

    def _receive(self, client: _Client) -> bool:
        """Read what has come and answer whole lines; False for a client that has gone."""
        try:
            data = client.connection.recv(16_384)
        except BlockingIOError:
            return True
        except OSError:
            return False
        if not data:
            return False
        client.received += data
        while (end := client.received.find(b"\n")) >= 0:
            raw = bytes(client.received[:end])
            del client.received[: end + 1]
            if client.skipping:
                client.skipping = False
            else:
                self._take(client, raw)
            if client.is_unwanted:
                return True
        if len(client.received) > LONGEST_LINE:
            if not client.skipping:
                self._refuse_line(client, f"the line has more than {LONGEST_LINE} bytes: send shorter ones")
            client.skipping = True
            client.received.clear()
        return True

    def _take(self, client: _Client, raw: bytes) -> None:
        if not raw.strip():
            return
        if len(raw) > LONGEST_LINE:
            self._refuse_line(client, f"the line has more than {LONGEST_LINE} bytes: send shorter ones")
            return
        now = int(monotonic())
        client.second, client.lines = (now, 1) if now != client.second else (now, client.lines + 1)
        if client.lines > MOST_LINES:
            self._refuse(client, f"more than {MOST_LINES} lines in a second: send fewer")
            return
        identifier: str | int | None = None
        try:
            line = parse_line(raw)
            client.is_known, identifier = True, line.id
            self._admit(client, line.token)
            result = self._obey(client, line)
        except NotJsonError as error:
            self._refuse_line(client, str(error))
        except InputError as error:
            client.is_known = True
            client.is_unwanted = not client.is_admitted
            end = "; the connection ends" if client.is_unwanted else ""
            self._refuse(client, f"{error}{end}", identifier)
        else:
            self.accepted += 1
            self._answer(client, {"ok": True, **result}, identifier)

    def _admit(self, client: _Client, token: str | None) -> None:
        """Let a client in, once and for all, that knows the token. Raises InputError; its connection then ends."""
        if client.is_admitted:
            return
        asked, given = (self._token or "").encode(), (token or "").encode("utf-8", "replace")
        if not secrets.compare_digest(given, asked):
            what = "is wrong" if token is not None else "is missing in the first line"
            raise InputError(f'the token {what}: send {{"token": "..."}} as `shipcollision live` has it')
        client.is_admitted = True

    def _obey(self, client: _Client, line: Line) -> dict[str, Any]:
        if line.state:
            return {"state": self._orders.state()}
        if line.ship is None:
            return {}
        ship = line.ship
        before = self._orders.in_command(ship)
        has_taken = before != client.name and (line.command or (line.command is None and before is None))
        if line.command is not None or has_taken:
            _wait(self._orders.take(client.name, ship, line.command is not False))
        if line.order and line.command is not False:
            try:
                _wait(self._orders.order(client.name, ship, line.order))
            except InputError:
                if has_taken:  # what is refused changes nothing
                    _wait(self._orders.take(client.name, ship, False))
                raise
        return {}

    def _refuse_line(self, client: _Client, message: str) -> None:
        """Refuse what is not JSON; as the first line of a client it is the last."""
        client.is_unwanted = not client.is_known
        end = "; the connection ends, as its first line must be JSON" if client.is_unwanted else ""
        self._refuse(client, message + end)

    def _refuse(self, client: _Client, message: str, identifier: str | int | None = None) -> None:
        self.refused += 1
        self._orders.refused()
        self._answer(client, {"ok": False, "error": message}, identifier)

    def _answer(self, client: _Client, answer: dict[str, Any], identifier: str | int | None) -> None:
        if identifier is not None:
            answer["id"] = identifier
        client.answers += json.dumps(answer, allow_nan=False, default=str).encode() + b"\n"

    def _send(self, client: _Client) -> bool:
        try:
            while client.answers:
                del client.answers[: client.connection.send(client.answers)]
        except BlockingIOError:
            return True
        except OSError:
            return False
        return True

    def _drop(self, client: _Client) -> None:
        self._selector.unregister(client.connection)
        del self._clients[client.connection]
        client.connection.close()
        self.dropped += 1
        self._orders.leave(client.name)


def _wait(answer: Future[Any]) -> None:
    """Wait for the session. Raises InputError for its refusal."""
    try:
        answer.result(LONGEST_ANSWER)
    except TooLate:
        end = "it is withdrawn: try again" if answer.cancel() else "it may still be done: ask for the state"
        raise InputError(f"the simulation did not answer within {LONGEST_ANSWER:g} s; {end}") from None
    except InputError:
        raise
    except Exception as error:
        raise InputError(str(error)) from None
