"""AASHTO (2020), LRFD Bridge design specifications, 9th edition, article 3.14.7: energy of a vessel at a pier.

    KE = C_H W V^2 / 29.2                              [kip ft]; W displacement [t], V [ft/s]
    C_H = 1.05 for a keel clearance above half the draught, 1.25 below a tenth of it, linear between

Equation numbers, constants and units are read in a public calculator that cites the clauses. The constant is rounded:
in exact units 29.2 is 29.187, so that the published energy is 0.04 % below 1/2 C_H W V^2. The article treats a head-on
blow at a rigid pier, in which all of the energy goes into the bow.
"""

from __future__ import annotations

from math import cos, pi

import pytest

from shipcollision_fmu.collision.obstacles import CYLINDER_SIDES
from tests.oracles.conftest import Collide, box_ship

FOOT, KIP_FOOT = 0.3048, 1355.8179483314
"""[m] and [J]."""
KNOT = 1852.0 / 3600.0


def C_H(clearance: float) -> float:
    """Of the keel's clearance over the draught."""
    return min(1.25, max(1.05, 1.25 - 0.2 * (clearance - 0.1) / 0.4))


def kinetic_energy(mass: float, speed: float, clearance: float) -> float:
    """KE [J] of equation 3.14.7-1, from SI."""
    return C_H(clearance) * (mass / 1000.0) * (speed / FOOT) ** 2 / 29.2 * KIP_FOOT


@pytest.mark.one_in(3)
@pytest.mark.parametrize("clearance", [0.05, 0.1, 0.3, 0.5, 2.0])
@pytest.mark.parametrize(
    ("mass", "length", "speed", "shape"),
    [(1.8e5, 59.4, 2.0, "box"), (12e6, 120.0, 8.0, "box"), (76e6, 220.0, 12.0, "cylinder")],
)
def test_a_pier_takes_the_kinetic_energy(
    collide: Collide, mass: float, length: float, speed: float, clearance: float, shape: str
) -> None:
    """From an empty hopper barge to a ship of 60 000 DWT, speed in knots, on a pier of 12 m."""
    V = speed * KNOT
    plan = "length = 12.0\nbreadth = 12.0" if shape == "box" else "diameter = 12.0"
    # The circle is a polygon, of which a flat side faces the bow.
    face = 6.0 if shape == "box" else 6.0 * cos(pi / CYLINDER_SIDES)
    pier = f'[pier]\nkind = "pier"\nshape = "{shape}"\n{plan}\nposition = [{0.5 * length + face + 0.3 * V}, 0.0]\n'
    w = collide(
        [box_ship(length, 0.15 * length, 0.05 * length, mass, m_x=C_H(clearance) - 1.0, m_y=0.8)],
        [{"position": (0.0, 0.0, 0.0), "nu": (V, 0, 0, 0, 0, 0)}], 1.0,
        obstacles=pier, degrees_of_freedom=3, restitution=0.0,
    )  # fmt: skip
    out = w.model.outputs
    assert out.collision_count == 1
    assert out.energy.dissipated == pytest.approx(kinetic_energy(mass, V, clearance), rel=5e-4)
    assert out.energy.dissipated == pytest.approx(0.5 * C_H(clearance) * mass * V**2, rel=1e-9)


def test_the_constant_is_that_of_its_units() -> None:
    """1/2 t (ft/s)^2 in kip ft is 1/29.187."""
    assert pytest.approx(29.2, rel=5e-4) == 1.0 / (0.5 * 1000.0 * FOOT**2 / KIP_FOOT)


def test_ship_of_60_000_dwt_at_12_knots() -> None:
    """1521 MJ: 76 000 t with ample water below the keel, from the clauses in SI."""
    assert kinetic_energy(76e6, 12.0 * KNOT, 1.0) == pytest.approx(1521e6, rel=1e-3)
