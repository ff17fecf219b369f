"""DNV-RP-C204 (2010), Design against accidental loads: energy of a collision with an installation that gives way.

    E = 1/2 M_s v_s^2 (1 - v_i/v_s)^2 / (1 + M_s/M_i)     compliant: free to move
    E = 1/2 M_s v_s^2                                     fixed, test_norsok_2004.py

    M_s, M_i    masses of ship and installation with their added masses [kg];  v_s, v_i    velocities, v_i < v_s [m/s]

The formula is recalled with high confidence. Its case v_i = 0, E = 1/2 v^2 M_s M_i/(M_s + M_i), is read on a page on
collision energy that names the recommended practice as its source.
"""

from __future__ import annotations

from math import pi

import pytest

from tests.oracles.conftest import Collide, box_ship

LENGTH, SIDE = 90.0, 20.0


@pytest.mark.one_in(5)
@pytest.mark.parametrize("response", ["pgs", "closed_form"])
@pytest.mark.parametrize("v_i", [-0.5, 0.0, 0.8])
@pytest.mark.parametrize("ratio", [0.02, 0.5, 30.0])
@pytest.mark.parametrize(("part", "added"), [("bow", 0.1), ("side", 0.4)])
def test_energy_of_a_compliant_installation(
    collide: Collide, part: str, added: float, ratio: float, v_i: float, response: str
) -> None:
    """A ship meets the side of a floating box, in line with both centres. ratio: masses of installation and ship."""
    mass, v_s, drift = 5e6, 2.0, 0.25
    M_s, M_i = mass * (1.0 + added), ratio * mass * (1.0 + drift)
    ahead = part == "bow"
    half = 0.5 * (LENGTH if ahead else SIDE)
    nu = (v_s, 0, 0, 0, 0, 0) if ahead else (0, v_s, 0, 0, 0, 0)
    # The installation drifts across its own length: its sway is the ship's course.
    heading = 0.5 * pi if ahead else 0.0
    sway = -v_i if ahead else v_i
    away = half + 0.5 * SIDE + 0.01
    place = (away, 0.0, 0.0) if ahead else (0.0, away, 0.0)
    w = collide(
        [box_ship(LENGTH, SIDE, 7.0, mass, m_x=0.1, m_y=0.4), box_ship(LENGTH, SIDE, 7.0, ratio * mass, m_y=drift)],
        [
            {"position": (0.0, 0.0, 0.0), "nu": nu},
            {"position": place, "attitude": (0.0, 0.0, heading), "nu": (0, sway, 0, 0, 0, 0)},
        ],
        0.3, degrees_of_freedom=3, restitution=0.0, response=response,
    )  # fmt: skip
    out = w.model.outputs
    E = 0.5 * M_s * v_s**2 * (1.0 - v_i / v_s) ** 2 / (1.0 + M_s / M_i)
    assert out.collision_count == 1
    assert out.energy.dissipated == pytest.approx(E, rel=1e-9)
