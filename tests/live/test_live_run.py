"""A live run and the scenario that it writes: the same files, to the byte."""

from __future__ import annotations

import csv
import random
from collections.abc import Iterator
from contextlib import closing
from math import sin
from pathlib import Path

import psutil
import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.cosim.row_log import CHUNK
from shipcollision_fmu.errors import InputError
from shipcollision_fmu.live.session import run_folder
from shipcollision_fmu.live.session.live_run import MOST_MARKS, LiveRun
from shipcollision_fmu.live.session.run_folder import write_run

FILES = (
    "states.csv", "contacts.csv", "events.json", "signals.csv", "summary.json", "bodies.json", "machinery.csv",
    "surroundings.csv",
)  # fmt: skip


@pytest.fixture(autouse=True)
def _without_page(monkeypatch: pytest.MonkeyPatch) -> None:
    """The page of a run is that of any run's folder (tests/show), and takes a third of the time of these tests;
    test_live_command.py has one written."""
    monkeypatch.setattr(run_folder, "write_page", lambda folder: folder / "replay.html")


@pytest.fixture
def run(tmp_path: Path) -> Iterator[LiveRun]:
    """The shipped crossing, whose ships meet after half a minute."""
    with closing(LiveRun(load_scenario("kvlcc2_crossing"), tmp_path)) as made:
        yield made


def advance(run: LiveRun, until: float) -> None:
    while run.time < until - 1e-9:
        run.advance()


def assert_same_again(run: LiveRun, folder: Path) -> None:
    """The run's files are those of its scenario.toml, simulated in process."""
    write_run(run, folder / "live")
    simulate(load_scenario(folder / "live" / "scenario.toml"), in_process=True, out=folder / "again")
    for name in FILES:
        assert (folder / "live" / name).read_bytes() == (folder / "again" / name).read_bytes(), name


def do_anything(run: LiveRun, rng: random.Random) -> None:
    """Now and then an order, a failure, another wind or current."""
    for bridge in run.bridges.values():
        draw = rng.random()
        try:
            if draw < 0.01:
                bridge.order(rng.uniform(-35.0, 35.0), None, None, None)
            elif draw < 0.02:
                bridge.order(None, rng.uniform(0.0, 360.0), rng.uniform(0.0, 1.6), None)
            elif draw < 0.03:
                bridge.order(None, None, None, rng.randint(-4, 4))
            elif draw < 0.034:
                bridge.fail(rng.choice(["rudder", "blackout"]), rng.random() < 0.5)
            elif draw < 0.038:
                run.change((rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)), None)
            elif draw < 0.042:
                run.change(None, (rng.uniform(0.0, 20.0), rng.uniform(0.0, 360.0)))
        except InputError:
            pass  # a stuck rudder, for instance


@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_whatever_is_ordered_the_scenario_gives_the_same_run(run: LiveRun, tmp_path: Path, seed: int) -> None:
    rng = random.Random(seed)
    back = {rng.randrange(500, 700), rng.randrange(500, 700)}
    for k in range(900):
        do_anything(run, rng)
        if k == 450:
            run.mark("before")
        if k in back:
            run.go_back("before")
        run.advance()
    assert run.k < 901
    assert_same_again(run, tmp_path)


def test_back_at_a_mark_the_run_is_as_if_nothing_had_been(tmp_path: Path) -> None:
    """Two runs with the same orders; one of them has gone through the collision and come back, twice."""
    texts = []
    for detours in (0, 2):
        with closing(LiveRun(load_scenario("kvlcc2_crossing"), tmp_path)) as run:
            run.bridges["own"].order(None, 170.0, None, None)
            advance(run, 20.0)
            run.bridges["own"].fail("rudder", True)
            advance(run, 25.0)
            run.mark("here")
            for _ in range(detours):
                run.bridges["own"].fail("blackout", True)
                run.bridges["target"].order(20.0, None, None, 4)
                run.change((0.5, 0.5), (12.0, 90.0))
                advance(run, 32.0)
                run.mark("later")
                run.go_back("here")
                assert list(run.marks) == ["here"]
            run.bridges["target"].order(-10.0, None, None, None)
            advance(run, 34.0)
            write_run(run, tmp_path / str(detours))
        texts.append([(tmp_path / str(detours) / name).read_bytes() for name in (*FILES, "scenario.toml")])
    assert texts[0] == texts[1]


def test_back_at_a_mark_what_is_seen_and_what_waits_are_as_they_were(timed: LiveRun, tmp_path: Path) -> None:
    """In a pause everything is ordered, marked, and gone back to, from a pause and from later."""
    texts = []

    def look() -> list[object]:
        return [timed.observe_ships(), timed.observe_environment(), timed.observe_contact(), timed.list_touches(),
                timed.k, timed.recorded, timed.bridges["own"].failures, timed.write_scenario()]  # fmt: skip

    advance(timed, 4.0)
    timed.bridges["target"].order(None, 120.0, 0.3, None)
    timed.bridges["own"].order(12.0, None, None, None)
    timed.bridges["own"].fail("blackout", True)
    timed.change(None, (17.0, 200.0))
    timed.change((0.25, -0.5), None)
    timed.mark("here")
    seen = look()
    assert timed.observe_environment().wind.speed == 17.0
    for later in (4.0, 5.0, 9.0):
        timed.change((1.0, 1.0), (2.0, 2.0))
        advance(timed, later)
        timed.go_back("here")
        assert look() == seen
        advance(timed, 6.0)
        assert timed.observe_environment().wind.speed == 17.0
        write_run(timed, tmp_path / str(later))
        texts.append([(tmp_path / str(later) / name).read_bytes() for name in (*FILES, "scenario.toml")])
        timed.go_back("here")
    assert texts[0] == texts[1] == texts[2]
    advance(timed, 6.0)
    assert_same_again(timed, tmp_path)


def test_a_stuck_rudder_stays_where_it_is_on_its_way(run: LiveRun) -> None:
    bridge = run.bridges["own"]
    bridge.order(35.0, None, None, None)
    advance(run, 5.0)
    angle = bridge.read_machines()[0]
    assert 0.1 < angle < 0.3
    bridge.fail("rudder", True)
    advance(run, 8.0)
    assert bridge.read_machines()[0] == pytest.approx(angle, abs=1e-12)
    with pytest.raises(InputError, match=r"own: the rudder is stuck at \d+.\d deg: order revolutions alone until the"):
        bridge.order(None, 90.0, None, None)
    bridge.order(None, None, None, -4)  # the engine is not stuck
    bridge.fail("rudder", False)
    advance(run, 9.0)
    assert bridge.read_machines()[0] == pytest.approx(angle, abs=1e-12)  # until the next order
    bridge.order(0.0, None, None, None)
    advance(run, 20.0)
    assert bridge.read_machines()[0] == 0.0


TIMED = """
[scenario]
name = "timed"
duration = 30.0
step = 0.05
[ships.own]
ship = "kvlcc2"
position = [0.0, 0.0]
heading_deg = 0.0
speed = 5.0
orders = [
  { time = 0.0, rev_per_s = 0.7 },
  { time = 2.0, rudder_deg = 10.0 },
  { time = 6.0, rudder_deg = -10.0 },
  { time = 9.0, heading_deg = 30.0, rev_per_s = 0.5 },
]
[ships.target]
ship = "kvlcc2"
position = [800.0, 300.0]
heading_deg = 200.0
speed = 5.0
evasion = { of = "own", distance = 900.0, rudder_deg = 35.0 }
[environment]
wind = { speed = 5.0, from_deg = 0.0 }
changes = [{ time = 3.0, current = [0.5, 0.0] }, { time = 8.0, wind = { speed = 9.0, from_deg = 90.0 } }]
"""


@pytest.fixture
def timed(tmp_path: Path) -> Iterator[LiveRun]:
    (tmp_path / "timed.toml").write_text(TIMED, encoding="utf-8")
    with closing(LiveRun(load_scenario(tmp_path / "timed.toml"), tmp_path)) as made:
        yield made


def test_a_blackout_stops_propeller_and_rudder_until_it_ends(timed: LiveRun) -> None:
    bridge = timed.bridges["own"]
    bridge.order(20.0, None, 0.8, None)
    advance(timed, 4.0)
    bridge.fail("blackout", True)
    advance(timed, 60.0)
    rudder, revolutions = bridge.read_machines()
    assert (revolutions, rudder) == (0.0, pytest.approx(0.16, abs=0.1))
    with pytest.raises(InputError, match="own has a blackout and takes no orders until the instructor ends it"):
        bridge.order(None, None, None, 4)
    bridge.fail("blackout", False)
    bridge.order(None, None, None, 1)
    advance(timed, 66.0)
    assert bridge.read_machines()[1] > 0.1


def test_a_heading_is_steered_by_the_autopilot(timed: LiveRun) -> None:
    advance(timed, 1.0)
    timed.bridges["own"].order(None, 340.0, None, None)
    advance(timed, 40.0)
    own = timed.observe_ships()["own"]
    assert own.nu[5] < -0.001  # to port, from north
    assert own.heading_order == pytest.approx(5.9341195)


def test_without_people_a_live_run_is_the_scenarios(timed: LiveRun, tmp_path: Path) -> None:
    advance(timed, 30.0)
    write_run(timed, tmp_path / "live")
    simulate(load_scenario(tmp_path / "timed.toml"), in_process=True, out=tmp_path / "again")
    for name in FILES:
        assert (tmp_path / "live" / name).read_bytes() == (tmp_path / "again" / name).read_bytes(), name


def test_a_persons_first_order_ends_the_timed_ones_and_an_evasion(timed: LiveRun, tmp_path: Path) -> None:
    advance(timed, 4.0)
    assert timed.observe_ships()["own"].rudder_order == pytest.approx(0.1745329)  # of the scenario
    assert timed.observe_ships()["target"].rudder_order == pytest.approx(0.6108652)  # it evades
    timed.bridges["own"].order(None, None, None, 3)
    timed.bridges["target"].order(-5.0, None, None, None)
    advance(timed, 12.0)
    assert timed.observe_ships()["own"].rudder_order == pytest.approx(0.1745329)
    assert timed.observe_ships()["target"].rudder_order == pytest.approx(-0.0872665)
    assert_same_again(timed, tmp_path)
    text = (tmp_path / "live" / "scenario.toml").read_text(encoding="utf-8")
    assert "until = 4.0" in text
    assert "heading_deg = 30.0" not in text


@pytest.mark.parametrize("at", [1.0, 5.0, 10.0])
def test_a_persons_wind_ends_the_changes_to_come(timed: LiveRun, tmp_path: Path, at: float) -> None:
    advance(timed, at)
    timed.change(None, (20.0, 180.0))
    advance(timed, 15.0)
    assert timed.observe_environment().wind.speed == pytest.approx(20.0)
    assert timed.observe_environment().current == ((0.5, 0.0) if at > 3.0 else (0.0, 0.0))
    assert_same_again(timed, tmp_path)


def test_a_failure_spares_the_timed_revolutions(timed: LiveRun, tmp_path: Path) -> None:
    advance(timed, 4.0)
    timed.bridges["own"].fail("rudder", True)
    advance(timed, 12.0)
    own = timed.observe_ships()["own"]
    assert (own.rev_order, own.heading_order) == (0.5, None)
    assert own.rudder == pytest.approx(timed.bridges["own"].read_machines()[0])
    assert_same_again(timed, tmp_path)


def test_contact_points_are_those_that_are_recorded(run: LiveRun, tmp_path: Path) -> None:
    """At the first point with contact, and at one without."""
    assert run.observe_contact().touching == ()
    while not run.observe_contact().points:
        run.advance()
    (touch,) = run.observe_contact().touching
    write_run(run, tmp_path / "live")
    (row,) = csv.DictReader((tmp_path / "live" / "contacts.csv").read_text(encoding="utf-8").splitlines())
    assert (touch.ship_a, touch.ship_b) == (row["ship_a"], row["ship_b"]) == ("own", "target")
    for place, columns in ((touch.a, "a."), (touch.b, "b.")):
        assert place == tuple(float(row[f"{columns}{axis}"]) for axis in "xyz")
    assert touch.normal == tuple(float(row[f"normal.{axis}"]) for axis in ("north", "east", "down"))
    for _ in range(20):
        run.advance()
    (collision,) = run.observe_contact().collisions  # has them as the ships move on
    assert (collision.a, collision.b) == (touch.a, touch.b)


def test_a_run_longer_than_its_scenario(timed: LiveRun, tmp_path: Path) -> None:
    """The duration of the scenario, 30 s, does not end a live run; its record grows beyond the chunk in memory."""
    advance(timed, 60.0)
    timed.mark("here")
    timed.change(None, (20.0, 180.0))
    advance(timed, 62.0)
    timed.go_back("here")
    advance(timed, 70.0)
    assert timed.k == 1400
    assert_same_again(timed, tmp_path)


def test_an_order_at_every_step(timed: LiveRun, tmp_path: Path) -> None:
    """More orders than the chunk of the log in memory; a mark is in what is written, and one in what is held."""
    while timed.k < 1200:
        timed.bridges["own"].order(20.0 * sin(timed.k), None, None, None)
        timed.bridges["target"].order(None, None if timed.k % 2 else 300.0, 0.5, None)
        if timed.k in (300, 1150):
            timed.mark(str(timed.k))
        timed.advance()
    assert len(timed.bridges["own"].log) > CHUNK
    for name in ("1150", "300"):
        timed.go_back(name)
        timed.bridges["own"].order(-7.5, None, None, None)
        advance(timed, timed.time + 3.0)
    assert len(timed.bridges["own"].log) < 320
    assert_same_again(timed, tmp_path)


@pytest.mark.parametrize(
    ("order", "message"),
    [
        ((36.0, None, None, None), "own: rudder_deg = 36 deg is beyond what it can: give -35 to 35 deg"),
        ((None, 361.0, None, None), "own: heading_deg = 361 deg is beyond what it can: give 0 to 360 deg"),
        ((None, None, 2.0, None), "own: rev_per_s = 2 1/s is beyond what it can: give -1 to 1.6 1/s"),
        ((None, None, float("nan"), None), "own: rev_per_s = nan is not a finite number: give one from -1 to 1.6 1/s"),
        (
            (None, None, None, 5),
            "own: telegraph = 5 must be a whole number from -4 (full astern) to 4 (full ahead): 0 is stop",
        ),
        ((1.0, 1.0, None, None), "own: rudder_deg and heading_deg are both given: keep one of them"),
        ((None, None, 1.0, 1), "own: rev_per_s and telegraph are both given: keep one of them"),
        ((None,) * 4, "own: the order is empty: give rudder_deg, heading_deg, rev_per_s or telegraph"),
    ],
)
def test_orders_that_are_refused(run: LiveRun, order: tuple[float | None, ...], message: str) -> None:
    with pytest.raises(InputError) as refused:
        run.bridges["own"].order(*order)  # type: ignore[arg-type]  # a telegraph that is none
    assert str(refused.value) == message


@pytest.mark.parametrize(
    ("current", "wind", "message"),
    [
        ((11.0, 0.0), None, "runs faster than the limit of 10 m/s"),
        (None, (61.0, 0.0), "speed = 61.0 must be less than or equal to 60"),
        (None, (5.0, 900.0), "from_deg = 900.0 must be"),
    ],
)
def test_current_and_wind_that_are_refused(
    run: LiveRun, current: tuple[float, float] | None, wind: tuple[float, float] | None, message: str
) -> None:
    with pytest.raises(InputError, match=message):
        run.change(current, wind)


def test_ships_that_coast_take_no_orders_and_no_wind() -> None:
    with closing(LiveRun(load_scenario("guan2014_added_mass"))) as run:
        with pytest.raises(InputError, match="own takes no orders, it coasts, follows a track or has no rudder and"):
            run.bridges["own"].order(1.0, None, None, None)
        with pytest.raises(
            InputError, match="current and wind act on no ship here: take a scenario with hydrodynamics"
        ):
            run.change((1.0, 0.0), None)


def test_marks_are_bounded(run: LiveRun) -> None:
    for number in range(MOST_MARKS):
        run.mark(f"{number}")
    run.mark("3")
    with pytest.raises(InputError, match="mark 'more': there are 30 marks, which is the limit: take the name of one"):
        run.mark("more")


def test_beyond_its_full_length_the_record_ends_and_the_run_goes_on(timed: LiveRun, tmp_path: Path) -> None:
    timed._stepper.most_recorded = 100
    advance(timed, 4.0)
    timed.mark("within")
    advance(timed, 7.0)
    timed.bridges["own"].order(3.0, None, None, None)
    timed.change(None, (20.0, 180.0))
    advance(timed, 10.0)
    assert (timed.k, timed.recorded) == (200, 100)
    assert timed.observe_ships()["own"].rudder_order == pytest.approx(0.0523599)
    assert_same_again(timed, tmp_path)
    assert (tmp_path / "live" / "states.csv").read_text(encoding="utf-8").count("\n") == 102
    timed.go_back("within")
    advance(timed, 4.5)
    assert_same_again(timed, tmp_path)


@pytest.mark.slow
def test_the_memory_of_a_long_run_stays(run: LiveRun) -> None:
    """Ten minutes of simulated time, ships in contact for most of it, with an order at every step."""
    process = psutil.Process()
    advance(run, 120.0)
    before = process.memory_info().rss
    while run.time < 720.0:
        run.bridges["own"].order(10.0 * sin(run.time), None, None, None)
        run.bridges["target"].order(None, 250.0 + run.time % 60.0, None, None)
        run.advance()
    assert process.memory_info().rss - before < 8e6
