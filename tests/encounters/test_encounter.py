"""Every generated encounter collides at the time, place and angle of its request; what cannot meet is refused.

The place is where the first contact is recorded, on the struck ship: of hulls that meet along a line, its middle. Half
a metre is the tolerance, everywhere.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from math import cos, degrees, hypot, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.cosim.run import Run
from shipcollision_fmu.encounters.encounter import Encounter, encounter
from shipcollision_fmu.encounters.request import KINDS, Request
from shipcollision_fmu.errors import ScenarioError, ShipError

TOLERANCE = 0.5
STEP = 0.05


def check(made: Encounter, run: Run | None = None, angle_deg: float = 1e-4) -> None:
    """Run it and compare time, angle and place of the first contact with the request."""
    run = run or simulate(made.scenario, in_process=True)
    (first, *_) = run.events["collisions"]
    assert first["start"] == pytest.approx(made.time, abs=1.5 * STEP)
    assert abs(degrees(first["angle"] - made.angle)) < angle_deg
    role = "b_b" if first["ship_b"] == "target" else "b_a"
    x, y, _ = first["first_point"][role]
    assert hypot(x - made.point[0], y - made.point[1]) < TOLERANCE


@pytest.mark.parametrize("hydrodynamics", [pytest.param(None, marks=pytest.mark.slow), True])
@pytest.mark.parametrize("kind", list(KINDS))
def test_every_kind_collides_as_requested(kind: str, hydrodynamics: bool | None) -> None:
    check(
        encounter(
            Request(kind, time=20.0, after=0.5, hydrodynamics=hydrodynamics, before=15.0 if KINDS[kind].helm else None)
        )
    )


@pytest.mark.parametrize("seed", [0, 1, *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(2, 24))])
def test_ships_collide_as_requested_in_current_and_wind(seed: int) -> None:
    """All drawn at random. The heading of a ship that turns differs by its yaw rate times the error in time."""
    rng = np.random.default_rng(seed)
    kind = str(rng.choice(["crossing", "head-on", "t-bone", "late-evasive", "loss-of-steering", "drifting-target"]))
    options: dict[str, Any] = {
        "own": str(rng.choice(["kcs", "kvlcc2"])), "target": str(rng.choice(["kcs", "kvlcc2"])),
        "heading_deg": rng.uniform(0.0, 360.0), "degrees_of_freedom": int(rng.choice([3, 4])),
        "wind_speed": rng.uniform(5.0, 40.0), "wind_from_deg": rng.uniform(0.0, 360.0),
    }  # fmt: skip
    if kind != "drifting-target":
        options |= {"current_speed": rng.uniform(0.2, 2.0), "current_towards_deg": rng.uniform(0.0, 360.0)}
    if kind == "crossing":
        options |= {"angle_deg": rng.uniform(20.0, 170.0), "at": rng.uniform(-0.5, 0.5)}
    made = encounter(kind, hydrodynamics=True, after=0.5, own_speed=6.0, **options)
    around = made.scenario.environment
    assert around.wind is not None
    assert (around.wind.speed, around.wind.from_deg) == (options["wind_speed"], options["wind_from_deg"])
    if kind != "drifting-target":
        towards = radians(options["current_towards_deg"])
        current = options["current_speed"] * np.array([cos(towards), sin(towards)])
        assert around.current == pytest.approx(current, abs=1e-9)
    start = made.scenario.ships["own"].start
    c, s = cos(start.attitude[2]), sin(start.attitude[2])
    through_water = np.array(start.velocity[:2]) - np.array([[c, s], [-s, c]]) @ around.current
    assert through_water == pytest.approx([6.0, 0.0], abs=1e-7)
    run = simulate(made.scenario, in_process=True)
    (first, *_) = run.events["collisions"]
    k = int(np.searchsorted(run.states["time"], made.time)) - 2  # before the impact
    turning = sum(abs(float(run.states[f"{name}.rate.yaw"][k])) for name in ("own", "target"))
    check(made, run, 1e-4 + 1.1 * degrees(turning) * abs(first["start"] - made.time))


def test_wind_turns_a_ship_that_lies_stopped() -> None:
    """The start of the approach is another than in calm water, and the impact the same."""
    calm, windy = (
        encounter("t-bone", hydrodynamics=True, after=0.5, target="kcs", **around)
        for around in ({}, {"wind_speed": 20.0, "wind_from_deg": 60.0})
    )
    a, b = (made.scenario.ships["target"].start for made in (calm, windy))
    assert hypot(a.position[0] - b.position[0], a.position[1] - b.position[1]) > 5.0
    check(windy, simulate(windy.scenario, in_process=True))


@pytest.mark.slow
def test_the_heading_is_found_where_the_wind_turns_the_ships_for_long() -> None:
    """Corrections by the error alone do not come to an end here."""
    made = encounter("t-bone", hydrodynamics=True, after=0.5, target="kcs", time=300.0, step=0.2, wind_speed=30.0,
                     wind_from_deg=60.0)  # fmt: skip
    check(made)


@pytest.mark.slow
def test_a_heading_from_which_the_wind_turns_a_ship_is_refused() -> None:
    """A stopped ship does not lie with its bow to the wind for five minutes."""
    with pytest.raises(
        ScenarioError, match=r"^ship 'kcs' does not come to 0.0 deg in this current and wind: take less"
    ):
        encounter("t-bone", hydrodynamics=True, target="kcs", time=300.0, step=0.5, wind_speed=20.0, wind_from_deg=10.0)


@pytest.mark.slow
@pytest.mark.parametrize("free", [4, 6])
def test_a_ship_that_heels_in_its_turn_collides_as_requested(free: int) -> None:
    """Own's deck edge leans half a metre outwards at the impact."""
    made = encounter("late-evasive", time=25.0, before=22.0, after=0.5, degrees_of_freedom=free)
    assert [ship.free for ship in made.scenario.ships.values()] == [free, free]
    check(made)


def test_coasting_ships_have_the_degrees_of_freedom_that_are_asked_for() -> None:
    usual, asked = encounter("t-bone"), encounter("t-bone", degrees_of_freedom=6)
    assert [made.scenario.ships["own"].free for made in (usual, asked)] == [3, 6]
    assert "degrees_of_freedom = 3" in usual.text


def grid(
    angles: range, places: tuple[float, ...], speeds: tuple[tuple[float, float], ...],
    sides: tuple[str, ...] = ("starboard", "port"),
) -> Iterator[Request]:  # fmt: skip
    for angle, s, side, (own, target) in product(angles, places, sides, speeds):
        yield Request("crossing", angle_deg=float(angle), at=s, side=side, own_speed=own, target_speed=target,
                     time=3.0, after=0.2)  # type: ignore[arg-type]  # fmt: skip


def sweep(own: str, target: str, requests: Iterator[Request]) -> tuple[int, int]:
    """How many were made and how many refused, because they open or graze there; every one made collides so."""
    made, refused = 0, 0
    for one in requests:
        try:
            found = encounter(replace(one, own=own, target=target))
        except ScenarioError as error:
            if "there they close at" not in str(error):
                raise
            refused += 1
            continue
        check(found)
        made += 1
    return made, refused


@pytest.mark.slow
def test_a_coarse_grid_collides_as_requested() -> None:
    """Of one side: the other is its mirror, see test_port_is_the_mirror_of_starboard."""
    made, refused = sweep("kvlcc2", "kvlcc2", grid(range(0, 181, 45), (-0.5, 0.2, 0.5), ((6.0, 3.0),), ("port",)))
    assert made + refused == 15
    assert made >= 8


@pytest.mark.one_in(2)
@pytest.mark.parametrize(
    ("own", "target", "angle", "at"),
    [
        ("guan2014_target", "guan2014_own", 30.0, 0.0),  # sides 0.3 deg from parallel: a line of 3.8 m
        ("guan2014_own", "guan2014_target", 75.0, 0.5),  # the same beside the stem: another corner of the bow meets it
        ("guan2014_target", "guan2014_own", 15.0, -0.4),  # in the bend of the stern
        ("guan2014_own", "guan2014_target", 15.0, 0.3),  # a raked bow against a lower deck
    ],
)
def test_hulls_that_meet_nearly_parallel_meet_with_the_middle_of_the_line(
    own: str, target: str, angle: float, at: float
) -> None:
    check(encounter(Request("crossing", own=own, target=target, angle_deg=angle, at=at, time=3.0, after=0.2)))


SPEEDS = ((5.0, 5.0), (6.0, 0.0), (4.0, 7.0))


@pytest.mark.soak
@pytest.mark.parametrize(
    ("own", "target"),
    [
        ("kvlcc2", "kvlcc2"), ("guan2014_target", "kvlcc2"), ("kvlcc2", "guan2014_target"),
        ("guan2014_own", "guan2014_target"), ("guan2014_target", "guan2014_own"), ("kcs", "kvlcc2"),
    ],
)  # fmt: skip
def test_the_whole_grid_collides_as_requested(own: str, target: str) -> None:
    made, refused = sweep(own, target, grid(range(0, 181, 15), (-0.5, -0.4, 0.0, 0.3, 0.5), SPEEDS))
    assert made + refused == 390
    assert made > 240


@pytest.mark.slow
def test_a_part_of_the_grid_collides_as_requested() -> None:
    made, _ = sweep("guan2014_target", "guan2014_own", grid(range(15, 181, 45), (-0.4, 0.3, 0.5), SPEEDS[:2]))
    assert made > 20


@pytest.mark.soak
def test_the_grid_under_way_collides_as_requested() -> None:
    """With the manoeuvring model: rudder over before the impact, either way, and a drifting target."""
    for angle, s, rudder, before in product((45.0, 75.0, 100.0), (-0.2, 0.3), (-35.0, 20.0), (20.0, 60.0)):
        check(encounter(Request("late-evasive", angle_deg=angle, at=s, rudder_deg=rudder, before=before, after=0.5)))
    for freedom, angle in product((4, 6), (50.0, 90.0)):
        check(encounter(Request("late-evasive", angle_deg=angle, degrees_of_freedom=freedom, after=0.5)))
    for angle, s, side in product((60.0, 90.0, 120.0), (-0.3, 0.2), ("port", "starboard")):
        check(encounter(Request("drifting-target", angle_deg=angle, at=s, side=side, hydrodynamics=True, after=0.5)))  # type: ignore[arg-type]  # texts of Side


def test_port_is_the_mirror_of_starboard() -> None:
    starboard, port = (encounter(Request("glancing", side=side)) for side in ("starboard", "port"))  # type: ignore[arg-type]  # texts of Side
    a, b = (made.scenario.ships["own"].start for made in (starboard, port))
    assert a.position == pytest.approx([b.position[0], -b.position[1], 0.0])
    assert a.attitude[2] + b.attitude[2] == pytest.approx(2 * np.pi)
    assert port.point == pytest.approx((starboard.point[0], -starboard.point[1]))


def test_the_heading_turns_the_whole_encounter() -> None:
    north, turned = (encounter(Request("t-bone", heading_deg=h)).scenario.ships["own"].start for h in (0.0, 30.0))
    assert hypot(*north.position) == pytest.approx(hypot(*turned.position), abs=1e-4)
    assert turned.attitude[2] - north.attitude[2] == pytest.approx(np.radians(30))


def test_the_file_is_an_ordinary_scenario(tmp_path: Path) -> None:
    made = encounter(Request("late-evasive", name="mine", time=20.0, before=15.0), tmp_path)
    path = tmp_path / "mine.toml"
    path.write_text(made.text, encoding="utf-8")
    loaded = load_scenario(path)
    assert loaded.model_dump() == made.scenario.model_dump()
    assert loaded.name == "mine"
    assert made.text.startswith("# Made by `shipcollision encounter late-evasive`, backwards from the impact.\n")
    assert max(map(len, made.text.splitlines())) <= 120
    assert "rudder_deg = 35.0" in made.text


def test_a_ship_given_by_path_is_found_from_the_file(tmp_path: Path) -> None:
    ship = tmp_path / "ships" / "mine.toml"
    ship.parent.mkdir()
    ship.write_text('extends = "kvlcc2"\n', encoding="utf-8")
    made = encounter(Request("t-bone", own=str(ship)), tmp_path / "scenarios")
    assert 'ship = "../ships/mine.toml"' in made.text


@pytest.mark.parametrize(
    ("request_", "line"),
    [
        (Request("tbone"), r"unknown encounter 'tbone': did you mean t-bone\?$"),
        (Request("glancing", angle_deg=0.0), r"glancing: at 0 deg KVLCC2 does not meet KVLCC2 at s = 0.1 of its "
         r"starboard side: there they close at 0.00 m/s, at least 0.05 m/s is needed; change the angle"),
        (Request("overtaking", own_speed=3.0, target_speed=7.0), r"s = -0.5 of its end: there they close at -4.00 m/s"),
        (Request("crossing", angle_deg=15.0, own_speed=2.0, target_speed=10.0, at=-0.5), r"they close at -8.\d\d m/s"),
        (Request("t-bone", own_speed=0.0), r"there they close at 0.00 m/s"),
        (Request("crossing", angle_deg=190.0), r"angle_deg = 190 must be 0 to 180: 0 is overtaking, 180 head-on"),
        (Request("crossing", at=20.0), r"at = 20 must be -0.5 to 0.5: -0.5 is the target's stern, 0.5 its stem"),
        (Request("crossing", own_speed=float("nan")), r"own_speed = nan must be 0 to 50: give metres per second"),
        (Request("crossing", own_speed=-5.0), r"own_speed = -5 must be 0 to 50: give metres per second"),
        (Request("crossing", time=0.0), r"time = 0 must be 0.05 to 7200: give seconds from the start to the impact"),
        (Request("crossing", side="left"), r"side = 'left' must be port or starboard"),  # type: ignore[arg-type]  # what is refused
        (Request("crossing", degrees_of_freedom=5), r"degrees_of_freedom = 5 must be 3 \(surge, sway, yaw\), 4 \(and"),
        (Request("crossing", before=20.0), r"encounter crossing has no before: leave it out, or take another type"),
        (Request("t-bone", drift_speed=2.0), r"encounter t-bone has no drift_speed: leave it out"),
        (Request("drifting-target", target_speed=2.0), r"the target drifts: give drift_speed, not target_speed"),
        (Request("late-evasive", hydrodynamics=False), r"late-evasive needs ships that steer: leave out --coasting"),
        (Request("late-evasive", time=30.0, before=60.0), r"before = 60 must be 0 to 30: the order is given within"),
        (Request("late-evasive", own="guan2014_own"), r"ship 'guan2014_own' can only coast, it has no \[manoeuvring\]"),
        (Request("crossing", wind_speed=9.0, wind_from_deg=1.0),
         r"^encounter crossing: wind_speed has no effect on ships that coast: give --hydrodynamics, or leave it out$"),
        (Request("crossing", current_towards_deg=9.0), r"current_towards_deg has no effect on ships that coast: give"),
        (Request("crossing", current_speed=1.0, hydrodynamics=True),
         r"current_towards_deg is missing: a current has a speed and a direction$"),
        (Request("late-evasive", wind_from_deg=1.0), r"wind_speed is missing: a wind has a speed and a direction$"),
        (Request("late-evasive", wind_speed=70.0, wind_from_deg=1.0), r"wind_speed = 70 must be 0 to 60: give"),
        (Request("drifting-target", hydrodynamics=True, current_speed=1.0, current_towards_deg=0.0),
         r"the drift is that of the water: give drift_speed and drift_deg, not current_speed$"),
        (Request("crossing", own_speed=12.0, hydrodynamics=True), r"'kvlcc2' needs 1.846 rev/s for 12 m/s; must"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_in_one_line(request_: Request, line: str) -> None:
    with pytest.raises(ScenarioError, match=line) as refused:
        encounter(request_)
    assert "\n" not in str(refused.value)


def test_an_unknown_ship_is_refused() -> None:
    with pytest.raises(ShipError, match=r"unknown ship 'kvlc2': did you mean kvlcc2\?"):
        encounter(Request("t-bone", own="kvlc2"))


@pytest.mark.slow
def test_ships_that_touch_before_are_refused() -> None:
    """Hard over for forty minutes: own has gone round through the target's place."""
    with pytest.raises(
        ScenarioError, match=r"the ships touch elsewhere \d+.\d s before the impact that is wanted: change"
    ):
        encounter(Request("loss-of-steering", target_speed=0.0, before=2400.0, time=2400.0, rudder_deg=35.0, step=0.5))


@pytest.mark.parametrize(
    ("kind", "angle", "limits"),
    [("head-on", 90.0, "135 to 180"), ("overtaking", 90.0, "0 to 67.5"), ("glancing", 46.0, "0 to 45")],
)
def test_an_angle_that_the_kind_does_not_allow_is_refused_with_the_limits(kind: str, angle: float, limits: str) -> None:
    line = rf"^encounter {kind}: angle_deg = {angle:g} must be {limits} for this type: take crossing for another angle$"
    with pytest.raises(ScenarioError, match=line):
        encounter(kind, angle_deg=angle)


def test_the_description_names_the_place_that_is_struck() -> None:
    assert "strikes its stern" in encounter("overtaking", step=0.5).text
    amidships = encounter("overtaking", at=0.3, angle_deg=30.0, step=0.5).text
    assert "Own overtakes target and strikes it." in amidships
    assert "stern" not in amidships


def test_the_description_says_that_the_target_lies_stopped_only_where_it_does() -> None:
    assert "Own strikes the side of target, which lies stopped." in encounter("t-bone", step=0.5).text
    moving = encounter("t-bone", step=0.5, target_speed=3.0).text
    assert "Own strikes the side of target." in moving
    assert "stopped" not in moving
