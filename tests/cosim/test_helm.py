"""Who steers: signs and limits of each helm as a function, then ships that are steered in a run."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot, pi, radians
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.cosim.autopilot import Autopilot, steer_heading
from shipcollision_fmu.cosim.evasion import Evasion, closest_approach
from shipcollision_fmu.cosim.helm import HelmState, Steering, steer
from shipcollision_fmu.cosim.route import Route, line_of_sight
from shipcollision_fmu.cosim.run import Run
from shipcollision_fmu.errors import ScenarioError
from shipcollision_fmu.ship.ship_state import ShipState
from tests.conftest import BARGE, Write

PILOT = Autopilot(gain=1.5, rate_gain=60.0, integral_gain=0.01, rudder_limit=radians(20))
ROUTE = Route((0.0, 0.0), ((1000.0, 0.0), (1000.0, 1000.0)), lookahead=200.0, acceptance=100.0)


def ship(
    north: float = 0.0, east: float = 0.0, heading_deg: float = 0.0, surge: float = 5.0, r: float = 0.0
) -> ShipState:
    return ShipState.upright(north, east, radians(heading_deg), surge, 0.0, r)


def test_a_heading_to_starboard_takes_starboard_rudder() -> None:
    assert steer_heading(PILOT, radians(5), 0.0, ship(), 0.1) == (
        pytest.approx(radians(7.5)),
        pytest.approx(0.1 * radians(5)),
    )
    assert steer_heading(PILOT, radians(-5), 0.0, ship(), 0.1)[0] == pytest.approx(radians(-7.5))


def test_the_autopilot_turns_the_short_way_round_and_a_heading_that_is_unwrapped_is_the_same() -> None:
    assert steer_heading(PILOT, radians(2), 0.0, ship(heading_deg=358), 0.1)[0] == pytest.approx(radians(6))
    assert steer_heading(PILOT, radians(358), 0.0, ship(heading_deg=2 + 720), 0.1)[0] == pytest.approx(radians(-6))


def test_a_rate_of_turn_is_met_by_the_rudder_against_it() -> None:
    assert steer_heading(PILOT, 0.0, 0.0, ship(r=radians(0.1)), 0.1)[0] == pytest.approx(radians(-6))


def test_at_its_limit_the_order_is_cut_and_the_integral_waits() -> None:
    assert steer_heading(PILOT, radians(90), 0.3, ship(), 0.1) == (radians(20), 0.3)
    assert steer_heading(PILOT, radians(-90), 0.3, ship(), 0.1) == (radians(-20), 0.3)


def test_line_of_sight_steers_back_to_the_leg() -> None:
    assert line_of_sight(ROUTE, 0, ship(300.0, 0.0)) == (0.0, 0)
    heading, leg = line_of_sight(ROUTE, 0, ship(300.0, 200.0))  # 200 m to starboard, 200 m of lookahead
    assert (heading, leg) == (pytest.approx(-pi / 4), 0)
    assert line_of_sight(ROUTE, 0, ship(300.0, -200.0))[0] == pytest.approx(pi / 4)


def test_a_leg_ends_before_its_waypoint_and_the_last_never() -> None:
    assert line_of_sight(ROUTE, 0, ship(899.0, 0.0))[1] == 0
    heading, leg = line_of_sight(ROUTE, 0, ship(901.0, 0.0))
    assert leg == 1
    assert heading == pytest.approx(pi / 2 - np.arctan2(99.0, 200.0))  # 99 m to starboard of the new leg
    assert line_of_sight(ROUTE, 1, ship(1000.0, 5000.0)) == (pytest.approx(pi / 2), 1)


def test_closest_approach_is_the_textbook_one() -> None:
    """Crossing at right angles, both 5 m/s, 1000 m and 800 m from the crossing: the first is late by 200 m."""
    time, distance = closest_approach(ship(-1000.0, 0.0), ship(0.0, 800.0, heading_deg=270))
    assert time == pytest.approx((1000 + 800) / (2 * 5))
    assert distance == pytest.approx(200 / 2**0.5)
    assert closest_approach(ship(), ship(100.0, 0.0)) == (0.0, 100.0)  # together for ever


@pytest.mark.parametrize(
    "evasion",
    [Evasion("target", 900.0, 0.0, radians(35), -0.5), Evasion("target", 0.0, 90.0, radians(35), -0.5)],
)
def test_evasion_begins_when_it_is_late_and_never_ends(evasion: Evasion) -> None:
    steering = Steering(PILOT, None, evasion)
    orders, state = steer(steering, HelmState(heading=0.0), (0.0, 1.0), ship(), ship(2000.0, heading_deg=180), 0.1)
    assert (orders, state.evading) == ((0.0, 1.0), False)
    near, far = ship(899.0, heading_deg=180), ship(9999.0, heading_deg=0)
    orders, state = steer(steering, state, (0.0, 1.0), ship(), near, 0.1)
    assert (orders, state.evading) == ((radians(35), -0.5), True)
    assert steer(steering, state, (0.0, 1.0), ship(), far, 0.1)[0] == (radians(35), -0.5)


Sail = Callable[..., Run]


@pytest.fixture
def sail(tmp_path: Path) -> Sail:
    """A run of a KVLCC2 with some keys in its table, and a barge far away."""

    def run(
        keys: str, duration: float, step: float = 0.5, target: str = "position = [0.0, -50000.0]", **how: object
    ) -> Run:
        (tmp_path / "barge.toml").write_text(BARGE, encoding="utf-8")
        path = tmp_path / "sail.toml"
        path.write_text(
            f'[scenario]\nname = "sail"\nduration = {duration}\nstep = {step}\n'
            f'[ships.own]\nship = "kvlcc2"\nposition = [0, 0]\nheading_deg = 0.0\n'
            f"speed = 7.974\nhydrodynamics = true\n{keys}\n"
            f'[ships.target]\nship = "./barge.toml"\nheading_deg = 0.0\n{target}\n',
            encoding="utf-8",
        )
        return simulate(load_scenario(path), **{"in_process": True, **how})  # type: ignore[arg-type]  # passed on

    return run


SERVICE = "rev_per_s = 1.2268"


def test_an_autopilot_brings_a_tanker_to_her_heading(sail: Sail) -> None:
    run = sail(f"orders = [{{time = 0, {SERVICE}}}, {{time = 30, heading_deg = 30}}]", 900.0)
    heading = np.degrees(run.states["own.attitude.yaw"])
    assert abs(heading[run.states["time"] <= 30]).max() == 0.0
    assert heading.max() < 33.0  # overshoot below a tenth
    assert abs(heading[run.states["time"] > 600] - 30).max() < 1.0


def test_a_rudder_order_takes_the_rudder_back(sail: Sail) -> None:
    run = sail(
        f"orders = [{{time = 0, {SERVICE}, heading_deg = 350}}, {{time = 100, rudder_deg = 20}}]\n"
        "autopilot = {gain = 2.0, rudder_limit_deg = 10}",
        300.0,
    )
    rate = run.states["own.rate.yaw"]
    assert rate[100] < 0.0
    assert rate[-1] > 0.001


def test_a_route_is_followed(sail: Sail) -> None:
    run = sail(
        f"orders = [{{time = 0, {SERVICE}}}]\nroute = {{waypoints = [[4000, 0], [6000, 2000], [6000, 12000]]}}",
        2000.0,
        1.0,
    )
    north, east = run.states["own.position.north"], run.states["own.position.east"]
    on_last_leg = east > 4500.0
    assert on_last_leg.sum() > 50
    assert abs(north[on_last_leg][-1] - 6000.0) < 30.0
    assert abs(np.degrees(run.states["own.attitude.yaw"][-1]) - 90.0) < 2.0
    assert np.hypot(north - 6000, east - 2000).min() < 640.0  # within the acceptance of two lengths


def test_a_late_evasive_helm_acts_at_its_distance(sail: Sail) -> None:
    run = sail(
        f'orders = [{{time = 0, {SERVICE}}}]\nevasion = {{of = "target", distance = 900.0, rudder_deg = 35.0}}',
        120.0,
        target="position = [1500.0, 0.0]",
    )
    apart = 1500.0 - run.states["own.position.north"]
    turning = run.states["own.rate.yaw"] != 0.0
    assert turning[np.argmax(apart <= 900.0) + 2]
    assert not turning[: np.argmax(apart <= 900.0) + 1].any()


def test_a_helm_gives_the_same_bits_through_fmus_and_in_process(sail: Sail) -> None:
    keys = (
        f"orders = [{{time = 0, {SERVICE}}}, {{time = 3, heading_deg = 40}}]\n"
        "route = {waypoints = [[0, 900], [500, 900]]}\n"
        'evasion = {of = "target", time_to_closest = 193.0, rudder_deg = -35.0, rev_per_s = -0.5}'
    )
    target = "position = [2000.0, 300.0]\nspeed = -2.0"
    first, second = (sail(keys, 30.0, 0.2, target, in_process=how) for how in (True, False))
    np.testing.assert_array_equal(first.states, second.states)
    assert first.states["own.rate.yaw"].max() > 0.0 > first.states["own.rate.yaw"][-1]


SAILS = (
    'ship = "./barge.toml"\nposition = [5.0, -64.0]',
    'ship = "kvlcc2"\nhydrodynamics = true\nposition = [5.0, -640.0]',
)
EVADE = 'evasion = {of = "target", distance = 900.0, rudder_deg = 35.0}'


@pytest.mark.parametrize(
    ("keys", "line"),
    [
        ("orders = [{time = 0.0, rudder_deg = 5.0, heading_deg = 5.0}]", r"gives both rudder_deg and heading_deg"),
        ("orders = [{time = 0.0, rev_per_s = 92.0}]", r"orders\[0\].rev_per_s = 92.0 must be less than or equal to 20"),
        ("autopilot = {gain = 1.0}", r"\[ships.own\] has an autopilot with nothing to steer: give"),
        ("autopilot = {gain = 0.0}", r"\[ships.own.autopilot\] gain = 0.0 must be greater than 0: .*rudder per error"),
        ("route = {waypoints = []}", r"\[ships.own.route\] waypoints = \[\] must have at least 1 value, it has 0"),
        ("route = {waypoints = [[1.0]]}", r"\[ships.own.route\] waypoints\[0\] = \[1.0\] must have at least 2 values"),
        ("route = {waypoints = [[5.0, -640.0]]}", r"\[ships.own\] route: waypoint \[5.0, -640.0\] must be 1 m or more"),
        ("route = {waypoint = [[0.0, 0.0]]}", r"waypoint is not a known key: did you mean waypoints\?"),
        (EVADE.replace("target", "own"), r"\[ships.own\] evasion: of = 'own' is no other ship here: take target"),
        (EVADE.replace("distance = 900.0, ", ""), r"evasion\] evasion needs one trigger: give distance or time_to"),
        (EVADE.replace("distance", "time_to_closest = 60.0, distance"), r"evasion needs one trigger: .* one of"),
        (EVADE.replace("35.0", "nan"), r"\[ships.own.evasion\] rudder_deg = nan must be a finite number"),
    ],
)  # fmt: skip
def test_a_helm_that_cannot_be_is_refused_in_one_line(scenario_file: Write, keys: str, line: str) -> None:
    with pytest.raises(ScenarioError, match=line) as refused:
        load_scenario(scenario_file(SAILS, ("speed = 4.0", f"speed = 4.0\n{keys}")))
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("key", ["route = {waypoints = [[0.0, 0.0]]}", EVADE, "autopilot = {gain = 1.0}"])
def test_a_ship_that_coasts_has_no_helm(scenario_file: Write, key: str) -> None:
    with pytest.raises(
        ScenarioError, match=rf"\[ships.own\] has {key.split()[0]}, but coasts: set hydrodynamics = true"
    ):
        load_scenario(scenario_file(("speed = 4.0", f"speed = 4.0\n{key}")))


def test_speed_over_ground() -> None:
    assert ShipState.upright(0, 0, pi / 2, 3.0, 4.0).plan_velocity == (pytest.approx(-4.0), pytest.approx(3.0))
    assert hypot(*ShipState.upright(0, 0, 0.3, 3.0, 4.0).plan_velocity) == pytest.approx(5.0)
