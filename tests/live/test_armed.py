"""Failures that begin by themselves: when, where, and that a mark keeps them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from math import dist
from pathlib import Path

import pytest
from websockets.sync.client import connect

from shipcollision_fmu import load_scenario
from shipcollision_fmu.errors import InputError
from shipcollision_fmu.live.session.armed import Armed
from shipcollision_fmu.live.session.live_run import LiveRun
from tests.live.live_server import receive, receive_until, serving
from tests.live.test_server import ask


@pytest.fixture
def run(tmp_path: Path) -> Iterator[LiveRun]:
    with closing(LiveRun(load_scenario("kvlcc2_crossing"), tmp_path)) as made:
        yield made


def advance(run: LiveRun, until: float) -> None:
    while run.time < until - 1e-9:
        run.advance()


@pytest.mark.parametrize(("at", "given"), [(5.0, 5.0), (4.98, 5.0), (0.06, 0.1)])
def test_a_failure_at_a_time_is_that_of_a_hand_at_that_time(tmp_path: Path, at: float, given: float) -> None:
    texts = []
    for is_armed in (True, False):
        with closing(LiveRun(load_scenario("kvlcc2_crossing"), tmp_path)) as run:
            run.bridges["own"].order(20.0, None, None, None)
            if is_armed:
                run.arm(Armed("own", "blackout", at=at))
            advance(run, given)
            assert run.bridges["own"].failures == ()
            if not is_armed:
                run.bridges["own"].fail("blackout", True)
            advance(run, 8.0)
            assert run.bridges["own"].failures == ("blackout",)
            assert run.armed.listed == ()
            texts.append(run.write_scenario())
    assert texts[0] == texts[1]


def test_a_failure_begins_once_a_ship_is_near(run: LiveRun) -> None:
    def distance() -> float:
        ships = run.observe_ships()
        return dist(ships["own"].eta[:2], ships["target"].eta[:2])

    within = distance() - 60.0
    run.arm(Armed("target", "rudder", of="own", within=within))
    while distance() >= within:
        assert run.bridges["target"].failures == ()
        run.advance()
    assert run.bridges["target"].failures == ()
    run.advance()  # from the first communication point at which it is nearer
    assert run.bridges["target"].failures == ("rudder",)


def test_a_mark_keeps_what_is_armed(run: LiveRun) -> None:
    run.arm(Armed("own", "rudder", at=2.0))
    run.mark("here")
    advance(run, 3.0)
    run.arm(Armed("own", "blackout", at=9.0))
    run.go_back("here")
    assert run.bridges["own"].failures == ()
    assert run.armed.listed == (Armed("own", "rudder", at=2.0),)
    advance(run, 3.0)
    assert run.bridges["own"].failures == ("rudder",)


def test_one_of_a_kind_is_armed_and_can_be_disarmed(run: LiveRun) -> None:
    run.arm(Armed("own", "rudder", at=2.0))
    run.arm(Armed("own", "rudder", at=3.0))
    assert run.armed.listed == (Armed("own", "rudder", at=3.0),)
    run.armed.disarm("own", "rudder")
    advance(run, 4.0)
    assert run.bridges["own"].failures == ()
    with pytest.raises(InputError, match=r"^own: no rudder is armed: nothing is to be disarmed$"):
        run.armed.disarm("own", "rudder")


@pytest.mark.parametrize(
    ("armed", "message"),
    [
        (Armed("own", "rudder"), "own, rudder: give either at, a run time, or within and of, a distance and a ship"),
        (Armed("own", "rudder", at=5.0, of="target", within=9.0), "own, rudder: give either at"),
        (Armed("own", "rudder", within=9.0), "own, rudder: give either at"),
        (Armed("own", "rudder", at=0.0), "own, rudder: at = 0 s must be later than now, 0.05 s, and at most 1e"),
        (Armed("own", "rudder", at=float("inf")), "own, rudder: at = inf s must be later than now"),
        (Armed("own", "rudder", of="target", within=0.0), "own, rudder: within = 0 m must be above 0 and at most 200"),
        (Armed("own", "rudder", of="own", within=50.0), "own, rudder: of = 'own' is the ship itself: name another one"),
        (
            Armed("own", "rudder", of="target", within=1e5),
            "own, rudder: target is nearer than 100000 m already: give less, or let it fail now",
        ),
    ],
)
def test_what_cannot_be_armed(run: LiveRun, armed: Armed, message: str) -> None:
    with pytest.raises(InputError) as refused:
        run.arm(armed)
    assert str(refused.value).startswith(message)
    assert run.armed.listed == ()


def test_what_fails_already_is_not_armed(run: LiveRun) -> None:
    run.bridges["own"].fail("rudder", True)
    with pytest.raises(InputError, match=r"^own: rudder is on already: end it first$"):
        run.arm(Armed("own", "rudder", at=9.0))


def test_the_bridge_does_not_hear_of_what_is_to_come() -> None:
    with serving(paused=True) as server, server.connect("instructor") as client, server.connect() as bridge:
        refused = ask(bridge, type="arm", ship="own", what="rudder", at=9.0)
        assert refused["message"] == "arm is the instructor's: ask there"
        assert ask(client, type="arm", ship="nobody", what="rudder", at=9.0)["message"].startswith("there is no ship")
        assert ask(client, type="arm", ship="own", what="rudder", at=0.2)["type"] == "ok"
        assert ask(client, type="mark", name="then")["type"] == "ok"
        assert receive_until(bridge, "event")["kind"] == "mark"
        with connect(server.address()) as later:
            hello = receive(later)
            assert "armed" not in hello
            assert [event["kind"] for event in hello["events"]] == ["mark"]
        with connect(server.address("instructor")) as later:
            assert receive(later)["armed"] == [
                {"ship": "own", "what": "rudder", "at": 0.2, "of": None, "within": None}
            ]  # fmt: skip
        assert ask(client, type="pause", paused=False)["type"] == "ok"
        failure = receive_until(bridge, "event", kind="failure")
        assert (failure["ship"], failure["what"], failure["on"]) == ("own", "rudder", True)
        assert receive_until(client, "event", kind="armed")["armed"] == []


def test_going_back_tells_what_is_armed_then() -> None:
    with serving(paused=True) as server, server.connect("instructor") as client:
        assert ask(client, type="arm", ship="own", what="rudder", at=9.0)["type"] == "ok"
        client.send('{"type": "back", "name": "start"}')
        receive_until(client, "event", kind="back")
        assert receive_until(client, "event", kind="armed")["armed"] == []
