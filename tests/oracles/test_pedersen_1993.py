"""Pedersen, Valsgard, Olsen and Spangenberg (1993), Ship impacts: bow collisions, Int. J. Impact Eng. 13:163-187.

    P = P_0 L' sqrt(E' + (5 - L') L'^1.6)        E' >= L'^2.6        P_0 = 210 MN, L' = L/275 m, E' = E/1425 MJ
    P = 2.24 P_0 sqrt(E' L')                     E' <  L'^2.6
    s = pi E / (2 P),   T = 1.67 s/V             E = 1/2 1.05 M V^2

Greatest force P, crush s and duration T of a bow against a rigid wall, for ships of 500 to 300 000 DWT. The formula is
recalled with high confidence. That its branches meet (2.236 against 2.24) and that it gives table C.4 of EN 1991-1-7
confirms it.
"""

from __future__ import annotations

from math import pi, sqrt

import pytest

from shipcollision_fmu.results.damage import estimate_damage
from tests.oracles.conftest import Collide
from tests.oracles.test_en_1991_1_7_2006 import head_on


def published(L: float, mass: float, V: float) -> tuple[float, float, float]:
    """P [MN], s [m], T [s] as printed, in the units of the paper."""
    E = 0.5 * 1.05 * (mass / 1e6) * V**2  # MJ: mass in thousands of tonnes
    length, energy = L / 275.0, E / 1425.0
    if energy >= length**2.6:
        P = 210.0 * length * sqrt(energy + (5.0 - length) * length**1.6)
    else:
        P = 2.24 * 210.0 * sqrt(energy * length)
    s = pi * E / (2.0 * P)
    return P, s, 1.67 * s / V


@pytest.mark.one_in(3)
@pytest.mark.parametrize("V", [1.0, 4.0, 8.0])
@pytest.mark.parametrize(
    ("L", "mass"), [(60.0, 1.5e6), (100.0, 10e6), (145.0, 18e6), (200.0, 40e6), (275.0, 80e6), (340.0, 350e6)]
)
def test_bow_of_a_ship_that_the_model_stops(collide: Collide, L: float, mass: float, V: float) -> None:
    """The model loses the energy; the report of indicative damage makes P, s and T of it."""
    damage = estimate_damage(
        head_on(collide, L, mass, V, 0.05), 0.1, 0.5, bow_length=L, closing_speed=V
    )["pedersen_1993"]  # fmt: skip
    P, s, T = published(L, mass, V)
    assert damage["peak_force"] / 1e6 == pytest.approx(P, rel=1e-9)
    assert damage["crush_length"] == pytest.approx(s, rel=1e-9)
    assert damage["duration"] == pytest.approx(T, rel=1e-9)


def test_both_branches_are_met_and_join() -> None:
    """E' = L'^2.6 lies between 1 and 8 m/s; there the first gives sqrt(5) and the second 2.24."""
    for L, mass in ((100.0, 10e6), (275.0, 80e6)):
        meet = sqrt(2.0 * 1425.0 * (L / 275.0) ** 2.6 / (1.05 * mass / 1e6))
        assert 1.0 < meet < 8.0
        below, above = published(L, mass, meet * (1.0 - 1e-9))[0], published(L, mass, meet * (1.0 + 1e-9))[0]
        assert below / above == pytest.approx(2.24 / sqrt(5.0), rel=1e-6)
