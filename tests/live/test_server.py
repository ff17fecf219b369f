"""The server of live runs on a real port, against clients that are honest, hostile, slow or gone."""

from __future__ import annotations

import json
import random
import socket
from base64 import b64encode
from collections.abc import Iterator
from contextlib import ExitStack, suppress
from math import radians
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed, InvalidHandshake, InvalidStatus
from websockets.sync.client import ClientConnection, connect

from shipcollision_fmu.errors import StepError
from shipcollision_fmu.live.server import access, hub
from shipcollision_fmu.live.server import serve as serve_module
from shipcollision_fmu.live.server.access import Allowance, Tokens, is_own_origin
from shipcollision_fmu.live.server.serve import MOST_MESSAGE
from shipcollision_fmu.live.session import run_folder
from shipcollision_fmu.live.session import session as session_module
from shipcollision_fmu.live.session.commands import End, Pause
from shipcollision_fmu.live.session.live_run import LiveRun
from tests.live.live_server import PATIENCE, LiveServer, eventually, receive, receive_until, serving


@pytest.fixture(scope="module")
def server() -> Iterator[LiveServer]:
    """A server whose run goes on while the tests come and go."""
    with serving() as made:
        yield made


def ask(client: ClientConnection, **message: Any) -> dict[str, Any]:
    """The answer to a request."""
    ask.number += 1  # type: ignore[attr-defined]  # a counter of its own
    request = f"request {ask.number}"  # type: ignore[attr-defined]
    client.send(json.dumps({"id": request, **message}))
    for _ in range(2000):
        answer = receive(client)
        if answer.get("id") == request and answer["type"] in ("ok", "error"):
            return answer
    raise AssertionError("no answer came")


ask.number = 0  # type: ignore[attr-defined]


def assert_alive(server: LiveServer) -> None:
    """The simulation goes on, and a new client is served."""
    before = server.session.snapshot.step_count
    eventually(lambda: server.session.snapshot.step_count > before)
    with server.connect() as client:
        assert receive_until(client, "state")["running"] is True


# -- what clients get -----------------------------------------------------------------------------------------------


def test_hello_and_states(server: LiveServer) -> None:
    with connect(server.address()) as client:
        hello = receive(client)
        states = [receive_until(client, "state") for _ in range(5)]
        while states[-1]["time"] == states[0]["time"]:  # states come by the clock, the simulation when it has its turn
            states.append(receive_until(client, "state"))
    assert (hello["type"], hello["role"], hello["own"], hello["scene"]) == ("hello", "bridge", "own", "/scene.glb")
    own = hello["ships"][0]
    assert (own["name"], own["model"], own["L_oa"], own["limits"]["rudder_deg"]) == ("own", "KVLCC2", 320.0, 35.0)
    assert len(own["limits"]["telegraph"]) == 9
    assert "start" in [mark["name"] for mark in hello["marks"]]
    times = [state["time"] for state in states]
    assert times == sorted(times)
    assert times[-1] > times[0]
    assert [len(states[0]["ships"]["own"][key]) for key in ("eta", "nu")] == [6, 6]


def test_an_order_reaches_the_ship(server: LiveServer) -> None:
    with server.connect() as client:
        refused = ask(client, type="order", ship="target", rudder_deg=5.0)
        assert refused["message"] == "nobody is in command of target: take command first"
        assert ask(client, type="command", ship="target", take=True)["type"] == "ok"
        assert ask(client, type="order", ship="target", rudder_deg=5.0, telegraph=2)["type"] == "ok"
        for _ in range(1000):  # states come by the clock, also while the simulation is held up
            state = receive_until(client, "state")
            if state["ships"]["target"]["rudder_order"] == pytest.approx(0.0872664626):
                break
        assert state["ships"]["target"]["rudder_order"] == pytest.approx(0.0872664626)
        assert state["ships"]["target"]["rev_order"] == pytest.approx(0.8)
        assert list(state["command"]) == ["target"]
    eventually(lambda: "target" not in server.session.snapshot.command)  # who leaves gives up command


def test_one_is_in_command_and_the_instructor_may_take_over(server: LiveServer) -> None:
    with server.connect() as one, server.connect() as other, server.connect("instructor") as instructor:
        assert ask(one, type="command", ship="own")["type"] == "ok"
        refused = ask(other, type="command", ship="own")
        assert refused["type"] == "error"
        assert refused["message"].endswith("is in command of own: ask for it, or let the instructor take it")
        assert (
            "is in command of own: take command first" in ask(other, type="order", ship="own", telegraph=0)["message"]
        )
        assert ask(instructor, type="command", ship="own")["type"] == "ok"
        assert receive_until(one, "event", kind="command", ship="own")["client"].startswith("instructor")
        assert ask(one, type="order", ship="own", telegraph=0)["type"] == "error"
        assert ask(instructor, type="command", ship="own", take=False)["type"] == "ok"
        assert ask(other, type="command", ship="own")["type"] == "ok"


def test_the_bridge_may_not_do_what_the_instructor_may(server: LiveServer) -> None:
    requests: list[dict[str, Any]] = [
        {"type": "fail", "ship": "own", "what": "rudder", "on": True}, {"type": "mark", "name": "m"},
        {"type": "back", "name": "start"}, {"type": "end"}, {"type": "environment", "current": [1.0, 0.0]},
    ]  # fmt: skip
    with server.connect() as client:
        for request in requests:
            assert ask(client, **request)["message"] == f"{request['type']} is the instructor's: ask there"


def test_the_instructor_changes_wind_fails_a_rudder_and_goes_back(server: LiveServer) -> None:
    with server.connect("instructor") as client:
        assert ask(client, type="mark", name="before")["type"] == "ok"
        assert ask(client, type="environment", wind={"speed": 12.0, "from_deg": 270.0})["type"] == "ok"
        assert ask(client, type="fail", ship="own", what="rudder", on=True)["type"] == "ok"
        assert ask(client, type="fail", ship="own", what="rudder", on=True)["message"] == (
            "own: rudder is on already: give the other"
        )
        assert ask(client, type="command", ship="own")["type"] == "ok"
        stuck = ask(client, type="order", ship="own", rudder_deg=3.0)["message"]
        assert stuck.startswith("own: the rudder is stuck at ")
        assert stuck.endswith("order revolutions alone until the instructor ends the failure")
        assert ask(client, type="back", name="before")["type"] == "ok"
        state = receive_until(client, "state")
        state = receive_until(client, "state")
        assert state["environment"]["wind"]["speed"] == 0.0
        assert state["ships"]["own"]["failures"] == []
        assert ask(client, type="command", ship="own", take=False)["type"] == "ok"


def test_a_mark_has_a_note(server: LiveServer) -> None:
    with server.connect("instructor") as client:
        assert ask(client, type="mark", name="noted", note=" ask for her intentions ")["type"] == "ok"
        refused = ask(client, type="mark", name="noted", note="two\nlines")["message"]
        assert refused == "mark 'noted': give a note of up to 200 printable characters, in one line"
        assert "note" in ask(client, type="mark", name="noted", note="x" * 201)["message"]
        with connect(server.address("instructor")) as later:
            marks = {mark["name"]: mark["note"] for mark in receive(later)["marks"]}
    assert (marks["noted"], marks["start"]) == ("ask for her intentions", "")


@pytest.mark.parametrize("role", ["bridge", "instructor"])
def test_who_comes_later_hears_what_has_happened(monkeypatch: pytest.MonkeyPatch, role: str) -> None:
    """The latest events, once each: what is told from then on is none of them."""
    monkeypatch.setattr(hub, "MOST_EVENTS", 3)
    with serving() as server, server.connect("instructor") as client:
        for name in "abcd":
            assert ask(client, type="mark", name=name)["type"] == "ok"
        with connect(server.address(role)) as later:
            hello = receive(later)
            assert [(event["kind"], event["name"]) for event in hello["events"]] == [
                ("mark", "b"), ("mark", "c"), ("mark", "d"),
            ]  # fmt: skip
            assert ask(client, type="mark", name="e")["type"] == "ok"
            assert receive_until(later, "event")["name"] == "e"


def test_who_comes_after_the_end_is_told_of_it() -> None:
    with serving() as server, server.connect() as first:
        server.session.submit(End("all is done"))
        end = receive_until(first, "end")
        with server.connect() as later:
            assert receive(later) == end


def test_what_is_done_says_after_which_step_the_ship_has_it(server: LiveServer) -> None:
    with server.connect() as client:
        assert ask(client, type="command", ship="own")["type"] == "ok"
        for angle in (4.0, -4.0, 8.0):
            answer = ask(client, type="order", ship="own", rudder_deg=angle)
            while (state := receive_until(client, "state"))["step_count"] <= answer["step_count"]:
                pass
            assert state["ships"]["own"]["rudder_order"] == pytest.approx(radians(angle))


# -- who may come in --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("path", ["/", "/instructor", "/scene.glb", "/replay.html"])
@pytest.mark.parametrize("query", ["", "?token=", "?token=wrong", "?token=%ff%00"])
def test_pages_need_the_token(server: LiveServer, path: str, query: str) -> None:
    status, body, _ = server.get(path + query)
    assert status == 403
    assert body == b"the token is missing or wrong: take the address that `shipcollision live` has printed\n"


@pytest.mark.parametrize(("role", "token"), [("bridge", "wrong"), ("bridge", ""), ("instructor", None), ("root", None)])
def test_the_socket_needs_the_token_of_its_role(server: LiveServer, role: str, token: str | None) -> None:
    token = server.app.tokens.bridge if token is None else token
    with pytest.raises(InvalidStatus) as refused, connect(server.address(role, token)):
        pass
    assert refused.value.response.status_code == 403


@pytest.mark.parametrize(
    "origin",
    ["http://evil.example", "https://evil.example:{port}", "null", "http://127.0.0.1:1", "http://[::1", "file://"],
)
def test_a_page_from_elsewhere_gets_no_socket(server: LiveServer, origin: str) -> None:
    with pytest.raises(InvalidStatus) as refused, connect(server.address(), origin=origin.format(port=server.port)):  # type: ignore[arg-type]
        pass
    assert refused.value.response.status_code == 403


def test_our_own_page_gets_one(server: LiveServer) -> None:
    with server.connect(origin=f"http://127.0.0.1:{server.port}") as client:
        assert receive_until(client, "state")


@pytest.mark.parametrize(
    ("origin", "host", "own"),
    [
        (None, "127.0.0.1:80", True),
        ("http://192.168.1.5:8750", "192.168.1.5:8750", True),
        ("http://LOCALHOST:8750", "localhost:8750", True),
        ("http://bridge.example:8750", "bridge.example:8750", False),  # a name that its owner lets lead here
        ("http://localhost:8751", "localhost:8750", False),
        ("chrome-extension://localhost:8750", "localhost:8750", False),
    ],
)
def test_origins(origin: str | None, host: str, own: bool) -> None:
    assert is_own_origin(origin, host, frozenset({"localhost"})) is own


def test_tokens_differ_and_the_instructors_admits_to_both() -> None:
    tokens, others = Tokens(), Tokens()
    assert len({tokens.bridge, tokens.instructor, others.bridge, others.instructor}) == 4
    assert min(len(tokens.bridge), len(tokens.instructor)) >= 32
    assert [tokens.admits(tokens.instructor, role) for role in ("bridge", "instructor")] == [True, True]
    assert [tokens.admits(tokens.bridge, role) for role in ("bridge", "instructor")] == [True, False]


@pytest.mark.parametrize(
    "path",
    [
        "/../../etc/passwd",
        "/%2e%2e/%2e%2e/etc/passwd",
        "/live.js/../../pages.py",
        "/bundle/page.js",
        "/static/",
        "//etc/passwd",
    ],
)
def test_no_path_leads_to_the_disk(server: LiveServer, path: str) -> None:
    status, body, _ = server.get(f"{path}?token={server.app.tokens.instructor}")
    assert (status, body) == (404, b"Not Found")


def test_pages_have_a_policy_and_leave_no_trace(server: LiveServer) -> None:
    for path, token in (("/", server.app.tokens.bridge), ("/instructor", server.app.tokens.instructor)):
        status, body, headers = server.get(f"{path}?token={token}")
        assert status == 200
        assert b'<script src="/live.js">' in body
        policy = headers["Content-Security-Policy"]
        assert "default-src 'none'; script-src 'self';" in policy
        assert "frame-ancestors 'none'" in policy
        assert (headers["Referrer-Policy"], headers["Cache-Control"]) == ("no-referrer", "no-store")
        assert token.encode() not in body


def test_the_scene_is_a_glb(server: LiveServer) -> None:
    status, body, _ = server.get(f"/scene.glb?token={server.app.tokens.bridge}")
    assert (status, body[:4]) == (200, b"glTF")


def test_there_is_no_replay_before_the_end(server: LiveServer) -> None:
    status, body, _ = server.get(f"/replay.html?token={server.app.tokens.bridge}")
    assert (status, body) == (404, b"there is no replay: the run has not ended\n")


# -- what is malformed, too much, too slow or gone --------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "the message is not JSON ("),
        ("[" * 10_000, "the message is not JSON ("),
        ("7", "the message is a int: send one object with a type"),
        ('{"type": 7}', "type = '7' is unknown: give one of order, command, "),
        ('{"type": "order"}', "order: [ship] is missing: give its value"),
        ('{"type": "order", "ship": "own", "rudder_deg": "5"}', "order: "),
        ('{"type": "order", "ship": "own", "rudder_deg": NaN}', "NaN is not JSON: give a finite number"),
        ('{"type": "step", "type": "end"}', "'type' is there twice: give it once"),
        (
            '{"type": "order", "ship": "own", "rudder": 5}',
            "order: [rudder] is not a known key: did you mean rudder_deg?",
        ),
        ('{"type": "order", "id": [1], "ship": "own"}', "id must be a whole number or a text of at most 64 characters"),
        (b"\x00\x01", "the message is binary: send JSON as text"),
    ],
)
def test_what_is_malformed_is_answered_and_counted(server: LiveServer, text: str | bytes, message: str) -> None:
    before = server.session.snapshot.refused
    with server.connect() as client:
        client.send(text)
        assert receive_until(client, "error")["message"].startswith(message)
    eventually(lambda: server.session.snapshot.refused == before + 1)


def test_a_message_that_is_too_large_ends_its_connection(server: LiveServer) -> None:
    with server.connect() as client:
        client.send("x" * (MOST_MESSAGE + 1))
        with pytest.raises(ConnectionClosed) as closed:
            receive_until(client, "never")
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1009
    assert_alive(server)


def test_a_flood_is_refused_counted_and_dropped(server: LiveServer) -> None:
    before = server.session.snapshot.refused

    def flood(client: ClientConnection) -> None:
        for _ in range(20_000):
            client.send('{"type": "order", "ship": "own", "telegraph": 0}')
        receive_until(client, "never")

    with server.connect() as client, pytest.raises(ConnectionClosed):
        flood(client)
    eventually(lambda: server.session.snapshot.refused - before >= access.REFUSED_AT_ONCE)
    assert_alive(server)


def test_the_allowance_fills_with_time() -> None:
    allowance = Allowance(0.0, per_second=60.0, at_once=120.0)
    assert sum(allowance.take(0.0) for _ in range(1000)) == 120
    assert sum(allowance.take(1.0) for _ in range(1000)) == 60
    assert sum(allowance.take(1000.0) for _ in range(1000)) == 120


def shake_hands(server: LiveServer) -> socket.socket:
    """A bare connection with an open WebSocket, which need not follow its rules."""
    bare = socket.socket()
    bare.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    bare.connect(("127.0.0.1", server.port))
    path = server.address().partition(str(server.port))[2]
    key = b64encode(b"0123456789abcdef").decode()
    bare.sendall(
        f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode()
    )
    assert bare.recv(12) == b"HTTP/1.1 101"
    return bare


def test_a_client_that_never_reads_is_dropped_and_stalls_nobody(monkeypatch: pytest.MonkeyPatch) -> None:
    """While the server waits for it, the simulation makes steps, and the other client has them."""
    monkeypatch.setattr(hub, "INTERVAL", 0.001)  # fills the buffers at once
    send, sent = hub.Hub._send, [0]

    async def count(self: hub.Hub, client: Any, text: str) -> None:
        sent[0] += client.name == "bridge-1"
        await send(self, client, text)

    monkeypatch.setattr(hub.Hub, "_send", count)
    with serving(patience=2.0) as server:  # a reader that the machine holds up for less than that is not dropped
        with shake_hands(server), server.connect() as reader:
            eventually(lambda: server.app.hub.clients == 2)
            before, meanwhile = 0, set[float]()
            while server.app.hub.clients == 2:
                time_of_state = receive_until(reader, "state")["time"]
                if sent[0] != before:
                    before, meanwhile = sent[0], set()
                meanwhile.add(time_of_state)
            assert {client.name for client in server.app.hub._clients} == {"bridge-2"}
            assert len(meanwhile) > 5  # of 40 steps; were it waited for, one
        assert_alive(server)


def test_clients_that_vanish_in_the_middle(server: LiveServer) -> None:
    frame = bytes([0x81, 0xFE, 0x10, 0x00, 1, 2, 3, 4]) + b"x" * 100  # 100 of 4096 bytes
    for data in (b"", frame[:1], frame[:5], frame, b"\xff" * 50, bytes([0x81, 0x05]) + b"naked"):  # the last unmasked
        with shake_hands(server) as bare:
            bare.sendall(data)
    with socket.create_connection(("127.0.0.1", server.port)) as bare:
        bare.sendall(b"GET / HT")
    eventually(lambda: server.app.hub.clients == 0)
    assert_alive(server)


@pytest.mark.parametrize("sent", [b"", b"GET / HT", b"GET / HTTP/1.1\r\nHost: a\r\n\r\nGET"])
def test_connections_that_say_nothing_lock_nobody_out(monkeypatch: pytest.MonkeyPatch, sent: bytes) -> None:
    """Nor those that begin a request and do not end it, the first or a later one."""
    monkeypatch.setattr(serve_module, "IDLE", 0.3)
    monkeypatch.setattr(serve_module, "MOST_CONNECTIONS", 5)
    with serving() as server, ExitStack() as stack:
        path = f"/?token={server.app.tokens.bridge}"

        def ask_status() -> int | None:
            """None where a busy machine has held up the question itself until its connection had gone."""
            with suppress(OSError):
                return server.get(path)[0]
            return None

        def is_crowded() -> bool:
            """With more of them each time: a busy machine may look when those before have gone already."""
            for _ in range(8):
                with suppress(ConnectionError):
                    stack.enter_context(socket.create_connection(("127.0.0.1", server.port))).sendall(sent)
            return ask_status() == 503

        eventually(is_crowded)
        eventually(lambda: ask_status() == 200)


def test_a_websocket_may_be_silent(monkeypatch: pytest.MonkeyPatch) -> None:
    """For longer than a connection that is none. The server's look at an idle connection is made to come in between."""
    looks: list[bool] = []
    look = serve_module._Http._end_if_idle

    def count(self: Any) -> None:
        looks.append(self in self.connections)
        look(self)

    monkeypatch.setattr(serve_module._Http, "_end_if_idle", count)
    with serving() as server:
        monkeypatch.setattr(serve_module, "IDLE", 0.3)

        def stays() -> bool:
            """A busy machine may be longer about shaking hands than an idle connection is borne."""
            looks.clear()
            with suppress(OSError, InvalidHandshake), server.connect() as client:
                while False not in looks:
                    receive_until(client, "state")
                for _ in range(5):
                    receive_until(client, "state")
                return True
            return False

        eventually(stays)


def draw_message(rng: random.Random) -> str | bytes:
    """Random bytes, random text, or JSON that is nearly right."""
    kind = rng.random()
    if kind < 0.2:
        return rng.randbytes(rng.randrange(200))
    if kind < 0.4:
        return "".join(chr(rng.randrange(1, 0xD800)) for _ in range(rng.randrange(100)))
    names = ("order", "command", "horn", "rate", "pause", "step", "environment", "fail", "mark", "back", "arm",
             "disarm", "ok", "")  # fmt: skip
    values = (
        None,
        True,
        -1,
        0,
        1e308,
        2**70,
        -0.0,
        "own",
        "target",
        "x" * 500,
        [],
        [1.0, 2.0],
        {},
        {"speed": 1, "from_deg": 9},
    )
    keys = ("ship", "rudder_deg", "heading_deg", "rev_per_s", "telegraph", "take", "on", "rate", "paused", "what",
            "current", "wind", "name", "note", "at", "of", "within", "id", "type")  # fmt: skip
    message = {"type": rng.choice(names), **{rng.choice(keys): rng.choice(values) for _ in range(rng.randrange(5))}}
    text = json.dumps(message)
    if kind < 0.6:
        place = rng.randrange(len(text))
        text = text[:place] + rng.choice('{}[]",:\\0\x00é') + text[place + rng.randrange(3) :]
    return text


@pytest.mark.slow
def test_ten_thousand_random_messages_never_stop_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(access, "PER_SECOND", 1e9)
    monkeypatch.setattr(access, "AT_ONCE", 1e9)
    rng = random.Random(18)
    with serving(rate=1.0) as server:
        answered = 0
        with server.connect("instructor") as client:
            for batch in range(100):
                for _ in range(100):
                    client.send(draw_message(rng))
                client.send(json.dumps({"type": "mark", "name": "here", "id": f"batch {batch}"}))
                while True:
                    answer = receive(client)
                    answered += answer["type"] in ("ok", "error")
                    if answer.get("id") == f"batch {batch}":
                        break
            client.send(json.dumps({"type": "pause", "paused": False, "id": "last"}))
            receive_until(client, "ok", id="last")
        assert answered >= 10_000
        assert server.session.error is None
        assert server.session.snapshot.refused > 5_000
        assert_alive(server)


# -- the end ----------------------------------------------------------------------------------------------------------


def test_the_end_is_said_while_pages_are_open() -> None:
    """Whoever started the command sees at once where the run is, and not a minute later."""
    with serving() as server, server.connect():
        server.session.submit(End())
        assert server.ended.wait(PATIENCE)
        assert server.app.hub.clients == 1


def test_the_end_is_told_and_the_replay_served(tmp_path: Path) -> None:
    with (
        serving(out=tmp_path / "run") as server,
        server.connect() as bridge,
        server.connect("instructor") as instructor,
    ):
        assert ask(instructor, type="end")["type"] == "ok"
        for client in (bridge, instructor):
            end = receive_until(client, "end")
            assert (end["folder"], end["replay"], end["error"]) == (str(tmp_path / "run"), "/replay.html", None)
        status, body, _ = server.get(f"/replay.html?token={server.app.tokens.bridge}")
        assert (status, body) == (200, (tmp_path / "run" / "replay.html").read_bytes())
        assert body.startswith(b"<!doctype html>")


def test_where_no_page_was_written_none_is_offered_nor_that_of_an_older_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:  # fmt: skip
    monkeypatch.setattr(run_folder, "LARGEST_PAGE", 1)
    (tmp_path / "replay.html").write_text("of another run", encoding="utf-8")
    with serving(out=tmp_path) as server, server.connect("instructor") as instructor:
        instructor.send('{"type": "end"}')
        end = receive_until(instructor, "end")
        assert (end["folder"], end["replay"], end["error"]) == (str(tmp_path), None, None)
        status, body, _ = server.get(f"/replay.html?token={server.app.tokens.bridge}")
        assert (status, body) == (404, b"there is no replay: none was written\n")


def test_where_the_run_could_not_be_written_no_page_of_an_older_one_is_served(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:  # fmt: skip
    def fail(run: LiveRun, out: Path) -> list[str]:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(session_module, "write_run", fail)
    (tmp_path / "replay.html").write_text("of another run", encoding="utf-8")
    with serving(out=tmp_path) as server, server.connect("instructor") as instructor:
        instructor.send('{"type": "end"}')
        end = receive_until(instructor, "end")
        assert (end["folder"], end["replay"]) == (None, None)
        assert server.get(f"/replay.html?token={server.app.tokens.bridge}")[0] == 404


def test_a_model_that_fails_ends_the_run_with_a_line_for_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    advance = LiveRun.advance

    def fail(self: LiveRun) -> None:
        if self.k >= 20:
            raise StepError("own: the motion diverges in the step at t = 1 s")
        advance(self)

    monkeypatch.setattr(LiveRun, "advance", fail)
    with serving(out=tmp_path / "run", paused=True) as server, server.connect() as one, server.connect() as other:
        server.session.submit(Pause(False))  # both are there: without a client the server would end with the run
        for client in (one, other):
            assert receive_until(client, "end")["error"] == "own: the motion diverges in the step at t = 1 s"
        assert (tmp_path / "run" / "states.csv").read_text(encoding="utf-8").count("\n") == 22
