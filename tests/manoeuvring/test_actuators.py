"""Actuators: rate, range, and independence of the step."""

from __future__ import annotations

from collections.abc import Callable
from math import radians

import pytest

from shipcollision_fmu.manoeuvring.actuators import Actuator, Engine
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring

Start = Callable[..., ShipManoeuvring]
GEAR = Actuator(least=-0.5, most=0.5, rate=0.1)


@pytest.mark.parametrize(
    ("value", "order", "time", "expected"),
    [(0.0, 0.3, 1.0, 0.1), (0.0, 0.3, 10.0, 0.3), (0.2, -0.3, 1.0, 0.1), (0.0, 9.0, 100.0, 0.5), (0.3, 0.3, 1.0, 0.3)],
)
def test_follows(value: float, order: float, time: float, expected: float) -> None:
    assert GEAR.follow(value, order, time) == pytest.approx(expected, rel=1e-14)


def test_rudder_rate_and_range(start: Start) -> None:
    ship = start(degrees_of_freedom=3, hydrodynamics=True, velocity=[7.0, 0.0, 0.0], orders=[0.0, 1.2])
    ship.inputs.rudder_order, ship.inputs.propeller_order = 1.0, 1.2
    ship.step(0.0, 10.0)
    assert ship.outputs.rudder_angle == pytest.approx(radians(23.4), rel=1e-12)
    ship.step(10.0, 10.0)
    assert ship.outputs.rudder_angle == radians(35.0)


def test_propeller_ramps(start: Start) -> None:
    ship = start(degrees_of_freedom=3, hydrodynamics=True, orders=[0.0, 1.0])
    assert (ship.outputs.rudder_angle, ship.outputs.propeller_speed) == (0.0, 1.0)  # turns as ordered from the start
    ship.inputs.propeller_order = -3.0
    ship.step(0.0, 10.0)
    assert ship.outputs.propeller_speed == pytest.approx(0.8, rel=1e-12)
    ship.step(10.0, 200.0)
    assert ship.outputs.propeller_speed == -1.0


def test_start_order_is_limited(start: Start) -> None:
    ship = start(degrees_of_freedom=3, hydrodynamics=True, orders=[1.0, 99.0])
    assert (ship.outputs.rudder_angle, ship.outputs.propeller_speed) == (0.0, 1.6)


DIESEL = Engine(Actuator(least=-1.0, most=1.6, rate=0.1), reversal_delay=30.0)


@pytest.mark.parametrize(
    ("time", "n", "gear"),
    [
        (2.0, 0.3, (1.0, 0.0)),  # running down
        (5.0, 0.0, (1.0, 0.0)),  # stopped, at this moment
        (20.0, 0.0, (1.0, 15.0)),  # being reversed
        (35.0, 0.0, (-1.0, 0.0)),
        (40.0, -0.5, (-1.0, 0.0)),  # running up astern
        (60.0, -0.8, (-1.0, 0.0)),
    ],
)
def test_reversal_takes_its_time(time: float, n: float, gear: tuple[float, float]) -> None:
    reached, state = DIESEL.follow(0.5, DIESEL.find_gear(0.5), -0.8, time)
    assert reached == pytest.approx(n, abs=1e-12)
    assert state == pytest.approx(gear, abs=1e-12)


@pytest.mark.parametrize("steps", [7, 60, 1000])
def test_reversal_does_not_depend_on_the_step(steps: int) -> None:
    n, gear = 0.5, DIESEL.find_gear(0.5)
    for _ in range(steps):
        n, gear = DIESEL.follow(n, gear, -0.8, 40.0 / steps)
    assert n == pytest.approx(-0.5, abs=1e-9)


def test_an_order_back_ends_the_reversal() -> None:
    n, gear = DIESEL.follow(0.5, DIESEL.find_gear(0.5), -0.8, 20.0)
    n, gear = DIESEL.follow(n, gear, 0.3, 2.0)
    assert (n, gear) == (pytest.approx(0.2), (1.0, 0.0))
    n, gear = DIESEL.follow(n, gear, -0.8, 2.0 + 29.0)
    assert n == 0.0  # waits anew


def test_a_stop_is_no_reversal() -> None:
    n, gear = DIESEL.follow(0.5, DIESEL.find_gear(0.5), 0.0, 100.0)
    assert (n, gear) == (0.0, (1.0, 0.0))
    n, gear = DIESEL.follow(n, gear, 0.4, 1.0)
    assert n == pytest.approx(0.1)


@pytest.mark.parametrize("order", [0.5, -0.5])
def test_an_engine_at_rest_starts_either_way_at_once(order: float) -> None:
    n, gear = DIESEL.follow(0.0, DIESEL.find_gear(0.0), order, 2.0)
    assert n == pytest.approx(0.4 * order)
    assert gear == (2.0 * order, 0.0)


def test_without_delay_the_engine_runs_through() -> None:
    n, _ = Engine(DIESEL.speed).follow(0.5, (1.0, 0.0), -0.8, 10.0)
    assert n == pytest.approx(-0.5)


def test_a_direct_reversing_ship(start: Start) -> None:
    """KCS: 63 s to stop the propeller from 1.9 rev/s, 90 s to reverse the engine; saved in the middle of it."""
    ship = start("kcs", degrees_of_freedom=3, hydrodynamics=True, velocity=[12.0, 0.0, 0.0], orders=[0.0, 1.9])
    ship.inputs.propeller_order = -1.0
    for k in range(10):
        ship.step(10.0 * k, 10.0)
    assert ship.outputs.propeller_speed == 0.0
    saved = ship.get_state()
    assert "gear" not in saved or saved["gear"] == pytest.approx([1.0, 100.0 - 1.9 / 0.03])  # FMUs show bytes
    after = []
    for _ in range(2):
        for k in range(10, 20):
            ship.step(10.0 * k, 10.0)
        after.append((list(ship.outputs.velocity), (ship.outputs.rudder_angle, ship.outputs.propeller_speed)))
        ship.set_state(saved)
    assert after[0] == after[1]
    assert after[0][1][1] == pytest.approx(-1.0)
