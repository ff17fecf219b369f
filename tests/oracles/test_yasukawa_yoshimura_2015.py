"""Turning circles of KVLCC2 against Yasukawa & Yoshimura (2015), J. Mar. Sci. Technol. 20:37-52, tables 4 and 6.

35 deg rudder at 15.5 kn (full-scale equivalent). The rows are the paper's as quoted in a public validation script. The
7 m model runs with its own resistance and 10.4 rev/s, as in its free-running tests; the full ship with ship-scale
resistance and the revolutions that go with it: lower resistance means fewer revolutions, a weaker race on the rudder
and a wider turn. The order of port and starboard is not tested: the published one depends on details that these
equations do not settle.
"""

from __future__ import annotations

from functools import cache
from math import copysign, pi, radians

import pytest

from shipcollision_fmu.ship.loading.library import load_ship
from tests.ship_engines import make_model

TOLERANCE = 0.10
ROWS = [
    # ship, source, rudder [deg], advance / L, tactical diameter / L
    ("kvlcc2_l7", "computed", 35.0, 3.31, 3.36),
    ("kvlcc2_l7", "computed", -35.0, 3.26, 3.26),
    ("kvlcc2_l7", "free-running test", 35.0, 3.25, 3.34),
    ("kvlcc2_l7", "free-running test", -35.0, 3.11, 3.08),
    ("kvlcc2", "computed", 35.0, 3.62, 3.71),
    ("kvlcc2", "computed", -35.0, 3.56, 3.59),
]


@cache
def turning_circle(engine: str, name: str, rudder_deg: float) -> tuple[float, float]:
    """(advance, tactical diameter) over L_pp: north at 90 deg, east at 180 deg of change of heading."""
    table = load_ship(name).propeller
    assert table is not None
    assert table.service_speed is not None
    assert table.service_rev_per_s is not None
    L = load_ship(name).L_pp
    ship = make_model()
    ship.parameters.ship, ship.parameters.degrees_of_freedom, ship.parameters.hydrodynamics = name, 3, True
    ship.parameters.initial_velocity[0] = table.service_speed
    ship.inputs.rudder_order, ship.inputs.propeller_order = radians(rudder_deg), table.service_rev_per_s
    ship.initialise()
    h = 0.05 * L / table.service_speed  # a twentieth of a ship's length at service speed
    found: list[float] = []
    for quarter, axis in ((1, 0), (2, 1)):
        while True:
            before = (ship.outputs.attitude[2], ship.outputs.position[axis])
            ship.step(0.0, h)
            after = (ship.outputs.attitude[2], ship.outputs.position[axis])
            heading = copysign(quarter * pi / 2, rudder_deg)
            if abs(after[0]) >= abs(heading):
                share = (heading - before[0]) / (after[0] - before[0])
                found.append(abs(before[1] + share * (after[1] - before[1])) / L)
                break
    return found[0], found[1]


@pytest.mark.parametrize(("name", "source", "rudder_deg", "advance", "diameter"), ROWS)
def test_turning_circle(
    engine: str, name: str, source: str, rudder_deg: float, advance: float, diameter: float
) -> None:
    assert source
    computed = turning_circle(engine, name, rudder_deg)
    assert computed == pytest.approx((advance, diameter), rel=TOLERANCE)


def test_full_ship_turns_wider_than_its_model(engine: str) -> None:
    assert turning_circle(engine, "kvlcc2", 35.0) > turning_circle(engine, "kvlcc2_l7", 35.0)
    assert turning_circle(engine, "kvlcc2", 35.0)[1] > turning_circle(engine, "kvlcc2_l7", 35.0)[1]


@pytest.mark.parametrize("name", ["kvlcc2", "kvlcc2_l7"])
def test_imo_criteria(engine: str, name: str) -> None:
    """MSC.137(76): advance at most 4.5 L, tactical diameter at most 5 L."""
    advance, diameter = turning_circle(engine, name, 35.0)
    assert advance <= 4.5
    assert diameter <= 5.0
