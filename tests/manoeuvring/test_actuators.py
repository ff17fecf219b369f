"""Actuators: rate, range, and independence of the step."""

from __future__ import annotations

from collections.abc import Callable
from math import radians

import pytest

from shipcollision_fmu.manoeuvring.actuators import Actuator
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring

Start = Callable[..., ShipManoeuvring]
GEAR = Actuator(least=-0.5, most=0.5, rate=0.1)


@pytest.mark.parametrize(
    ("value", "order", "time", "expected"),
    [(0.0, 0.3, 1.0, 0.1), (0.0, 0.3, 10.0, 0.3), (0.2, -0.3, 1.0, 0.1), (0.0, 9.0, 100.0, 0.5), (0.3, 0.3, 1.0, 0.3)],
)
def test_follows(value: float, order: float, time: float, expected: float) -> None:
    assert GEAR.followed(value, order, time) == pytest.approx(expected, rel=1e-14)


def test_rudder_rate_and_range(start: Start) -> None:
    ship = start(degrees_of_freedom=3, hydrodynamics=True, velocity=[7.0, 0.0, 0.0], orders=[0.0, 1.2])
    ship.inputs.orders[:] = [1.0, 1.2]
    ship.step(0.0, 10.0)
    assert ship.outputs.actuators[0] == pytest.approx(radians(23.4), rel=1e-12)
    ship.step(10.0, 10.0)
    assert ship.outputs.actuators[0] == radians(35.0)


def test_propeller_ramps(start: Start) -> None:
    ship = start(degrees_of_freedom=3, hydrodynamics=True, orders=[0.0, 1.0])
    assert ship.outputs.actuators == [0.0, 1.0]  # turns as ordered from the start
    ship.inputs.orders[1] = -3.0
    ship.step(0.0, 10.0)
    assert ship.outputs.actuators[1] == pytest.approx(0.8, rel=1e-12)
    ship.step(10.0, 200.0)
    assert ship.outputs.actuators[1] == -1.0


def test_start_order_is_limited(start: Start) -> None:
    ship = start(degrees_of_freedom=3, hydrodynamics=True, orders=[1.0, 99.0])
    assert ship.outputs.actuators == [0.0, 1.6]
