"""The order port: what it takes and refuses, its bounds, and that no input stops the simulation."""

from __future__ import annotations

import json
import random
import socket
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future
from contextlib import suppress
from math import radians
from typing import Any

import pytest

from shipcollision_fmu import load_scenario
from shipcollision_fmu.errors import HostError, InputError
from shipcollision_fmu.live.protocols import order_port
from shipcollision_fmu.live.protocols.order_line import parse_line
from shipcollision_fmu.live.protocols.order_port import LONGEST_LINE, MOST_CLIENTS, MOST_LINES, OrderPort, Orders
from shipcollision_fmu.live.protocols.outlets import OutletAddresses, Outlets
from shipcollision_fmu.live.session.commands import End
from shipcollision_fmu.live.session.session import Session
from tests.free_port import hold_free_port
from tests.live.live_server import PATIENCE, eventually

SEED, MESSAGES = 18, 10_000
Connect = Callable[[], "Bridge"]


class Bridge:
    """A client of the port."""

    def __init__(self, port: int) -> None:
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE)
        self.answers = self.socket.makefile("rb")

    def ask(self, line: object) -> dict[str, Any]:
        self.socket.sendall((line if isinstance(line, bytes) else json.dumps(line).encode()) + b"\n")
        return self.read()

    def read(self) -> dict[str, Any]:
        answer: dict[str, Any] = json.loads(self.answers.readline())
        return answer

    def close(self) -> None:
        self.answers.close()
        self.socket.close()


class Recorded:
    """Stands for a session: notes orders, and who is in command."""

    def __init__(self) -> None:
        self.orders: list[tuple[str, Mapping[str, float | int]]] = []
        self.command: dict[str, str] = {}
        self.refused = 0
        self.slow: list[Future[None]] = []
        self.state: dict[str, float] = {"time": 1.5}

    def done(self, error: Exception | None = None) -> Future[None]:
        answer: Future[None] = Future()
        answer.set_exception(error) if error else answer.set_result(None)
        return answer

    def take(self, client: str, ship: str, take: bool) -> Future[None]:
        if self.command.get(ship, client) != client:
            return self.done(InputError(f"{self.command[ship]} is in command of {ship}"))
        if take:
            self.command[ship] = client
        else:
            self.command.pop(ship, None)
        return self.done()

    def order(self, client: str, ship: str, values: Mapping[str, float | int]) -> Future[None]:
        if self.command.get(ship) != client:
            return self.done(InputError(f"nobody is in command of {ship}"))
        if self.slow:
            return self.slow.pop(0)
        if values.get("rudder_deg", 0.0) > 90.0:
            return self.done(InputError("99 is beyond"))
        self.orders.append((ship, values))
        return self.done()

    def leave(self, client: str) -> None:
        self.command = {ship: who for ship, who in self.command.items() if who != client}

    def count(self) -> None:
        self.refused += 1

    def connect(self) -> Orders:
        return Orders(self.take, self.order, self.command_of, self.leave, lambda: self.state, self.count)

    def command_of(self, ship: str) -> str | None:
        return self.command.get(ship)


@pytest.fixture
def session() -> Recorded:
    return Recorded()


@pytest.fixture
def port(session: Recorded) -> Iterator[OrderPort]:
    served = OrderPort("127.0.0.1", 0, session.connect())
    served.start()
    yield served
    served.close()


@pytest.fixture
def connect(port: OrderPort) -> Iterator[Connect]:
    bridges: list[Bridge] = []

    def make() -> Bridge:
        bridges.append(Bridge(port.port))
        return bridges[-1]

    yield make
    for bridge in bridges:
        bridge.close()


def test_an_order_takes_command_and_is_answered(session: Recorded, connect: Connect) -> None:
    bridge = connect()
    assert bridge.ask({"ship": "own", "rudder_deg": 5, "rev_per_s": 1.2}) == {"ok": True}
    assert bridge.ask({"ship": "own", "heading_deg": 90.0, "telegraph": 3, "id": 7}) == {"ok": True, "id": 7}
    assert session.orders == [
        ("own", {"rudder_deg": 5.0, "rev_per_s": 1.2}), ("own", {"heading_deg": 90.0, "telegraph": 3}),
    ]  # fmt: skip
    assert bridge.ask({"state": True, "id": "a"}) == {"ok": True, "state": {"time": 1.5}, "id": "a"}


def test_one_is_in_command_until_it_goes(session: Recorded, connect: Connect) -> None:
    first, second = connect(), connect()
    assert first.ask({"ship": "own", "rudder_deg": 5})["ok"]
    assert second.ask({"ship": "own", "rudder_deg": 6}) == {"ok": False, "error": "nobody is in command of own"}
    assert "is in command of own" in second.ask({"ship": "own", "command": True})["error"]
    assert first.ask({"ship": "own", "command": False})["ok"]
    assert second.ask({"ship": "own", "rudder_deg": 6})["ok"]
    second.close()
    eventually(lambda: not session.command)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (b"full ahead", 'the line is not JSON: send an object such as {"ship": "own", "rudder_deg": 5}'),
        (b"\xff\xfe", "the line is not JSON"),
        (b"[" * 3000, "the line is not JSON"),
        (b"[1]", "the line is list, not an object: put it into braces"),
        (b'{"ship": "own", "rudder": 5}', "'rudder' is no key: known are ship, rudder_deg, heading_deg, rev_per_s"),
        (b'{"rudder_deg": 5}', "ship is missing: give the name of a ship of the scenario"),
        (b'{"ship": "own"}', "the order is empty: give rudder_deg, heading_deg, rev_per_s or telegraph"),
        (b'{"ship": "own", "rudder_deg": "5"}', "rudder_deg = '5' must be a number"),
        (b'{"ship": "own", "rudder_deg": true}', "rudder_deg = True must be a number"),
        (b'{"ship": "own", "rudder_deg": 5, "rudder_deg": 6}', "'rudder_deg' is there twice: give it once"),
        (b'{"ship": "own", "token": 7}', "token must be a text of up to 256 characters"),
        (b'{"ship": "own", "rudder_deg": NaN}', "NaN is not JSON: give a finite number"),
        (b'{"ship": "own", "rudder_deg": 1e400}', "rudder_deg = inf must be between -1e+06 and 1e+06"),
        (b'{"ship": "own", "telegraph": 5}', "telegraph = 5 must be a whole number, -4 (full astern) to 4 (ahead)"),
        (b'{"ship": "own", "command": 1}', "command = 1 must be true or false"),
        (b'{"state": true, "ship": "own"}', 'state goes alone, as {"state": true}'),
        (b'{"ship": "own", "rudder_deg": 5, "id": [1]}', "id must be a text or a whole number"),
    ],
)
def test_what_is_no_order_is_refused_and_counted(
    session: Recorded, port: OrderPort, connect: Connect, line: bytes, said: str
) -> None:  # fmt: skip
    bridge = connect()
    assert bridge.ask({"state": True})["ok"]
    answer = bridge.ask(line)
    assert answer["ok"] is False
    assert answer["error"].startswith(said)
    assert (session.orders, session.refused, port.refused) == ([], 1, 1)
    assert bridge.ask({"ship": "own", "rudder_deg": 5})["ok"]


def test_a_line_that_is_too_long_is_refused_once(port: OrderPort, connect: Connect) -> None:
    bridge = connect()
    assert bridge.ask({"state": True})["ok"]
    bridge.socket.sendall(b"x" * 50_000 + b"\n")
    assert bridge.read()["error"] == f"the line has more than {LONGEST_LINE} bytes: send shorter ones"
    assert bridge.ask({"ship": "own", "rudder_deg": 5})["ok"]
    assert port.refused == 1


ORDER = b'{"ship": "own", "rudder_deg": 5}\n'


@pytest.mark.parametrize(
    ("begins", "said"),
    [
        (b"POST / HTTP/1.1\r\nHost: 127.0.0.1:4711\r\nContent-Type: text/plain\r\n\r\n", "the line is not JSON"),
        (b"\r\nGET /" + b"x" * 5000 + b" HTTP/1.1\r\n", "the line has more than 4096 bytes"),
        (b"GET /" + b"x" * 50_000 + b" HTTP/1.1\r\n", "the line has more than 4096 bytes"),
        (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\n", "the line is not JSON"),
    ],
)
def test_a_page_in_a_browser_cannot_order(
    session: Recorded, port: OrderPort, connect: Connect, begins: bytes, said: str
) -> None:  # fmt: skip
    """A browser posts what a page from anywhere gives it, and its body comes after lines of HTTP or TLS."""
    browser = connect()
    browser.socket.sendall(begins + ORDER)
    with suppress(ConnectionError):  # it is reset where it had sent more than was read
        answer = browser.read()
        assert answer["error"].startswith(said)
        assert answer["error"].endswith("; the connection ends, as its first line must be JSON")
        assert browser.answers.readline() == b""
    eventually(lambda: port.dropped == 1)
    assert (session.orders, session.command, port.refused) == ([], {}, 1)
    bridge = connect()
    assert bridge.ask(b"[1]")["ok"] is False
    assert bridge.ask(b"full ahead")["ok"] is False
    assert bridge.ask(ORDER.strip())["ok"]


@pytest.mark.parametrize("more", [{}, {"command": True}])
def test_a_first_order_that_is_refused_leaves_nobody_in_command(
    session: Recorded, connect: Connect, more: dict[str, Any]
) -> None:  # fmt: skip
    bridge, line = connect(), {"ship": "own", "rudder_deg": 99, **more}
    assert bridge.ask(line) == {"ok": False, "error": "99 is beyond"}
    assert session.command == {}
    assert bridge.ask({"ship": "own", "rudder_deg": 5})["ok"]
    assert bridge.ask(line)["ok"] is False
    assert list(session.command) == ["own"]  # it had command before


def test_an_order_that_is_not_answered_in_time_is_withdrawn(
    session: Recorded, connect: Connect, monkeypatch: pytest.MonkeyPatch
) -> None:  # fmt: skip
    """A session that is at a long step: when it comes to the order, it does what was not cancelled."""
    monkeypatch.setattr(order_port, "LONGEST_ANSWER", 0.05)
    bridge, waits, begun = connect(), Future[None](), Future[None]()
    begun.set_running_or_notify_cancel()
    session.slow = [waits, begun]
    first = bridge.ask({"ship": "own", "rudder_deg": 5})
    assert first["error"] == "the simulation did not answer within 0.05 s; it is withdrawn: try again"
    assert waits.cancelled()
    second = bridge.ask({"ship": "own", "rudder_deg": 5})
    assert second["error"] == "the simulation did not answer within 0.05 s; it may still be done: ask for the state"


def test_a_fault_costs_one_client_its_connection(session: Recorded, connect: Connect) -> None:
    """A state that is no JSON, of a motion that diverges, say."""
    other, bridge = connect(), connect()
    assert other.ask({"ship": "own", "rudder_deg": 5})["ok"]
    session.state = {"time": float("nan")}
    error = bridge.ask({"state": True})["error"]
    assert error.startswith("the order port failed: ValueError: Out of range float values are not JSON compliant")
    assert error.endswith("; the connection ends")
    assert bridge.answers.readline() == b""
    assert other.ask({"ship": "own", "rudder_deg": 6})["ok"]


def test_too_many_lines_in_a_second_are_refused(connect: Connect, monkeypatch: pytest.MonkeyPatch) -> None:
    """On a clock of the test."""
    now = [100.0]
    monkeypatch.setattr(order_port, "monotonic", lambda: now[0])
    bridge = connect()
    for at in (100.0, 100.99, 101.0):
        now[0] = at
        bridge.socket.sendall(b'{"state": true}\n' * (3 * MOST_LINES))
        answers = [bridge.read() for _ in range(3 * MOST_LINES)]
        taken = 0 if at == 100.99 else MOST_LINES
        assert [answer["ok"] for answer in answers] == [True] * taken + [False] * (3 * MOST_LINES - taken)
        assert answers[-1]["error"] == f"more than {MOST_LINES} lines in a second: send fewer"


def test_more_clients_are_turned_away(connect: Connect) -> None:
    first = [connect() for _ in range(MOST_CLIENTS)]
    assert all(bridge.ask({"state": True})["ok"] for bridge in first)
    late = connect()
    assert late.read()["error"] == f"{MOST_CLIENTS} clients are here already: close one of them"
    assert late.answers.readline() == b""


def test_a_client_that_reads_nothing_is_dropped(port: OrderPort, connect: Connect) -> None:
    """Its answers fill the buffers of both sockets and then the port's own."""
    deaf, other = connect(), connect()
    deaf.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    flood = b'{"ship": "own", "rudder_deg": "x"}\n' * 1_000_000
    with pytest.raises(ConnectionError):
        deaf.socket.sendall(flood)
    eventually(lambda: port.dropped > 0)
    assert other.ask({"state": True})["ok"]


@pytest.fixture
def guarded(session: Recorded, monkeypatch: pytest.MonkeyPatch) -> Iterator[OrderPort]:
    """A port with a token, which waits for it for long."""
    monkeypatch.setattr(order_port, "ADMISSION", PATIENCE)
    served = OrderPort("127.0.0.1", 0, session.connect(), token="open sesame")
    served.start()
    yield served
    served.close()


def test_a_token_admits_alone_or_with_an_order(session: Recorded, guarded: OrderPort) -> None:
    alone, together = Bridge(guarded.port), Bridge(guarded.port)
    assert alone.ask({"token": "open sesame", "id": 1}) == {"ok": True, "id": 1}
    assert alone.ask({"ship": "own", "rudder_deg": 5}) == {"ok": True}
    alone.close()
    eventually(lambda: not session.command)
    assert together.ask({"token": "open sesame", "ship": "own", "rudder_deg": 6}) == {"ok": True}
    assert together.ask({"ship": "own", "rudder_deg": 7}) == {"ok": True}
    assert together.ask({"ship": "own", "rudder": 7})["ok"] is False  # a mistake later costs nothing more
    assert together.ask({"state": True})["ok"]
    together.close()
    assert [values["rudder_deg"] for _, values in session.orders] == [5.0, 6.0, 7.0]


@pytest.mark.parametrize(
    ("line", "what"),
    [
        ({"ship": "own", "rudder_deg": 5}, "the token is missing in the first line"),
        ({"state": True}, "the token is missing in the first line"),
        ({"token": "open", "ship": "own", "rudder_deg": 5}, "the token is wrong"),
        ({"token": ""}, "the token is wrong"),
        ({"token": 7}, "token must be a text"),
        ({"rudder": 7}, "'rudder' is no key"),
    ],
)
def test_without_the_token_a_client_is_dropped(
    session: Recorded, guarded: OrderPort, line: dict[str, Any], what: str
) -> None:
    bridge = Bridge(guarded.port)
    bridge.socket.sendall(json.dumps(line).encode() + b'\n{"token": "open sesame", "ship": "own", "rudder_deg": 5}\n')
    answer = bridge.read()
    assert answer["ok"] is False
    assert answer["error"].startswith(what)
    assert answer["error"].endswith("; the connection ends")
    with suppress(ConnectionResetError):
        assert bridge.answers.readline() == b""
    bridge.close()
    assert (session.orders, session.refused) == ([], 1)


def test_who_gives_no_token_does_not_lock_others_out(guarded: OrderPort, monkeypatch: pytest.MonkeyPatch) -> None:
    admitted = Bridge(guarded.port)
    assert admitted.ask({"token": "open sesame"})["ok"]
    silent = [Bridge(guarded.port) for _ in range(MOST_CLIENTS - 1)]
    late = Bridge(guarded.port)
    assert late.read()["error"] == f"{MOST_CLIENTS} clients are here already: close one of them"
    late.close()
    monkeypatch.setattr(order_port, "ADMISSION", 0.3)
    for bridge in silent:
        assert bridge.answers.readline() == b""
        bridge.close()
    monkeypatch.setattr(order_port, "ADMISSION", PATIENCE)  # a busy machine is long about the token that is given
    later = Bridge(guarded.port)
    assert later.ask({"token": "open sesame"})["ok"]
    assert admitted.ask({"state": True})["ok"]
    for bridge in (later, admitted):
        bridge.close()


def test_a_port_in_use_is_refused(port: OrderPort, session: Recorded) -> None:
    with pytest.raises(HostError, match=rf"--orders 127.0.0.1:{port.port}: .*in use.*; give another port"):
        OrderPort("127.0.0.1", port.port, session.connect())


# -- fuzz -------------------------------------------------------------------------------------------------------------


def make_message(rng: random.Random) -> bytes:
    """Noise, a broken order, or an order with absurd values; without a line feed."""
    good = json.dumps({"ship": rng.choice(["own", "target", "x"]), "rudder_deg": rng.uniform(-40, 40)}).encode()
    kind = rng.randrange(5)
    if kind == 0:
        raw = rng.randbytes(rng.randrange(1, 200))
    elif kind == 1:
        raw = bytearray(good)
        for _ in range(rng.randrange(1, 6)):
            raw[rng.randrange(len(raw))] = rng.randrange(256)
    elif kind == 2:
        raw = good[: rng.randrange(1, len(good))]
    elif kind == 3:
        values = [None, True, -1, 1e308, "5", [], {}, -5, 0.1, "\0", float("nan")]
        keys = ["ship", "rudder_deg", "heading_deg", "rev_per_s", "telegraph", "command", "id", "state", "time"]
        raw = json.dumps(
            {rng.choice(keys): rng.choice(values) for _ in range(rng.randrange(5))} | {"ship": "own"}
        ).encode()
    else:
        raw = b"[" * rng.randrange(1, 2000) if rng.random() < 0.1 else good
    return bytes(raw).replace(b"\n", b" ").replace(b"\r", b" ")


def test_lines_are_read_or_refused_and_nothing_else() -> None:
    rng = random.Random(SEED)
    read = 0
    for _ in range(MESSAGES):
        with suppress(InputError):
            parse_line(make_message(rng))
            read += 1
    assert 1000 < read < 9000


@pytest.mark.parametrize("most_lines", [MOST_LINES, MESSAGES])
def test_ten_thousand_messages_never_stop_the_simulation(monkeypatch: pytest.MonkeyPatch, most_lines: int) -> None:
    """Each line that is not empty has one answer; meanwhile and afterwards time goes on, and orders are obeyed. Without
    the bound on lines in a second, those that are orders reach the ships. All come within one second of the port's
    clock, which the test has stopped: how many are refused does not depend on how busy the machine is."""
    monkeypatch.setattr(order_port, "MOST_LINES", most_lines)
    monkeypatch.setattr(order_port, "LONGEST_ANSWER", PATIENCE)
    monkeypatch.setattr(order_port, "monotonic", lambda: 100.0)
    session = Session(load_scenario("kvlcc2_crossing"), rate=4.0)
    with hold_free_port() as free:
        outlets = Outlets(session, "own", OutletAddresses(orders=str(free)))
    assert outlets.orders is not None
    session.start()
    outlets.start()
    try:
        rng, begun = random.Random(SEED), session.snapshot.time
        bridges = [Bridge(outlets.orders.port) for _ in range(4)]
        assert all(bridge.ask({"state": True})["ok"] for bridge in bridges)
        sent = [0] * 4
        for k in range(0, MESSAGES, 50):
            lines = [make_message(rng) for _ in range(50)]
            bridge = bridges[k // 50 % 4]
            bridge.socket.sendall(b"\n".join(lines) + b"\n")
            for _ in range(sum(bool(line.strip()) for line in lines)):
                assert isinstance(bridge.read()["ok"], bool)
            sent[k // 50 % 4] += 50
        assert sum(sent) == MESSAGES
        assert session.snapshot.running
        eventually(lambda: session.snapshot.time > begun)
        eventually(lambda: session.snapshot.refused == outlets.orders.refused)
        assert outlets.orders.refused > (9000 if most_lines == MOST_LINES else 5000)
        assert outlets.orders.refused + outlets.orders.accepted <= MESSAGES + len(bridges)
        assert outlets.orders.accepted > (0 if most_lines == MOST_LINES else 200)
        for bridge in bridges:
            bridge.close()
        eventually(lambda: not session.snapshot.command)
        late = Bridge(outlets.orders.port)
        assert late.ask({"ship": "own", "rudder_deg": 12.5})["ok"]
        eventually(lambda: session.snapshot.ships["own"].rudder_order == pytest.approx(radians(12.5)))
        late.close()
    finally:
        outlets.close()
        session.submit(End())
        session.join(PATIENCE)
    assert session.error is None
