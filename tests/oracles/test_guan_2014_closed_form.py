"""Table 2 of Guan et al. (2014) against the closed form, and what the table says of itself.

The printed table is read as corrected in models/scenarios/guan2014.toml. Restitution, friction and place of contact of
the replay are fitted to the table: it shows that table and closed form are consistent, and predicts nothing. The checks
before it have no fitted number. Paper's axes: x east, y north, z up; ships' forward axis +y, rates right-handed.
"""

from __future__ import annotations

from math import asin, atan2, cos, degrees, hypot, sin

import numpy as np
import pytest

from tests.oracles.guan2014 import GuanImpact, GuanShip, solve_guan_impact

M_OWN = 170.162e6
OWN_BEFORE = {"x": -343.2120, "y": 81.6614, "h": 0.2908, "v": (-2.8282, 4.2215, 0.0)}
OWN_AFTER = {"x": -356.0430, "y": 102.4450, "h": 0.2827, "v": (-2.4997, 4.0865, 0.0392), "w_z": -0.0037}
TARGET_BEFORE = {"x": -438.6740, "y": 227.0860, "h": -0.0872, "v": (0.4467, 2.5331, 0.0)}
TARGET_AFTER = {"x": -448.0250, "y": 244.7020, "h": -0.1138, "v": (-2.0830, 3.5730, -0.3018), "w_z": -0.0121}

GAIN_OWN = np.subtract(OWN_AFTER["v"], OWN_BEFORE["v"])
GAIN_TARGET = np.subtract(TARGET_AFTER["v"], TARGET_BEFORE["v"])


def test_momentum_is_that_of_one_mass_ratio() -> None:
    """Changes of velocity are anti-parallel and in one ratio on every axis: mass is a scalar, no added mass acted."""
    ratio = -GAIN_OWN / GAIN_TARGET
    np.testing.assert_allclose(ratio, 0.12985, atol=1e-4)
    cosine = -GAIN_OWN @ GAIN_TARGET / np.linalg.norm(GAIN_OWN) / np.linalg.norm(GAIN_TARGET)
    assert degrees(np.arccos(min(1.0, cosine))) < 0.01
    # Table 1's masses are 0.4 % off, outside of rounding.
    assert ratio.mean() / (22_000 / 170_162) == pytest.approx(1.0044, abs=2e-4)


@pytest.mark.parametrize("ship", [OWN_BEFORE, TARGET_BEFORE])
def test_heading_is_twice_the_arcsine_of_h(ship: dict) -> None:
    """h is the z component of a quaternion: the ships then run straight ahead."""
    v_x, v_y, _ = ship["v"]
    course = atan2(-v_x, v_y)  # from +y, counter-clockwise
    assert degrees(2.0 * asin(ship["h"]) - course) == pytest.approx(0.0, abs=0.01)
    assert degrees(ship["h"] - course) != pytest.approx(0.0, abs=4.0)  # h is no angle


def test_speeds_are_round_numbers_of_knots() -> None:
    assert hypot(*OWN_BEFORE["v"]) / 0.514444 == pytest.approx(9.877, abs=2e-3)
    assert hypot(*TARGET_BEFORE["v"]) / 0.514444 == pytest.approx(5.0, abs=2e-3)


def test_friction_ratio() -> None:
    """Tangential over normal impulse, with the normal across the target's side: Bullet's 0.5 x 0.5 to 2 %."""
    psi = 2.0 * asin(TARGET_BEFORE["h"])
    side = np.array([-cos(psi), -sin(psi), 0.0])  # to port of the target, from her struck starboard side
    J_n = GAIN_TARGET @ side
    J_t = GAIN_TARGET - J_n * side
    assert np.linalg.norm(J_t) / J_n == pytest.approx(0.246, abs=1e-3)
    assert hypot(J_t[0], J_t[1]) / J_n == pytest.approx(0.219, abs=1e-3)
    assert abs(J_t[2]) / J_n == pytest.approx(0.113, abs=1e-3)


# -- the replay -------------------------------------------------------------------------------------------------------

MU, E, ABAFT = 0.219, 0.06, 30.06
"""Fitted: in-plane friction, restitution, place of the contact on the target's starboard side, from midship [m]."""
TIME_OF_IMPACT = 0.478
"""[s] after the row "before": least squares of the printed positions."""


def box(mass: float, length: float, breadth: float, **state: float) -> GuanShip:
    return GuanShip(mass, mass, mass * (length**2 + breadth**2) / 12.0, float("inf"), **state)


def replayed(m_x: float = 0.0, m_y: float = 0.0, j_z: float = 0.0, mu: float = MU, e: float = E) -> GuanImpact:
    """The impact in ship A's axes; A is the own ship, B the target."""
    m_target = 0.12985 * M_OWN
    psi_A, psi_B = 2.0 * asin(OWN_BEFORE["h"]), 2.0 * asin(TARGET_BEFORE["h"])
    at = [np.array([s["x"], s["y"]]) + TIME_OF_IMPACT * np.array(s["v"][:2]) for s in (OWN_BEFORE, TARGET_BEFORE)]
    forward_A, port_A = np.array([-sin(psi_A), cos(psi_A)]), np.array([-cos(psi_A), -sin(psi_A)])
    forward_B, port_B = np.array([-sin(psi_B), cos(psi_B)]), np.array([-cos(psi_B), -sin(psi_B)])
    contact = at[1] - ABAFT * forward_B - 16.1 * port_B  # starboard side, half the breadth off
    local = [np.array([(p - contact) @ forward_A, (p - contact) @ port_A]) for p in at]
    A = box(M_OWN, 288.1, 44.0, x=local[0][0], y=local[0][1], u=hypot(*OWN_BEFORE["v"]))
    B = box(m_target, 263.2, 32.2, x=local[1][0], y=local[1][1], u=hypot(*TARGET_BEFORE["v"]))
    A, B = (GuanShip(s.M_x * (1 + m_x), s.M_y * (1 + m_y), s.J_z * (1 + j_z), s.J_x, s.x, s.y, u=s.u) for s in (A, B))
    beta = psi_A - psi_B  # clockwise from A's forward axis to B's
    # The normal points into B: to B's port, n = v_B, so t = u_B and alpha = beta.
    return solve_guan_impact(A, B, 0.0, 0.0, beta, beta, mu, e)


def in_the_papers_axes(ship: GuanShip, h: float) -> tuple[float, float]:
    psi = 2.0 * asin(h)
    return -ship.u * sin(psi) - ship.v * cos(psi), ship.u * cos(psi) - ship.v * sin(psi)


def test_contact_is_where_the_own_ships_bow_is() -> None:
    """At the fitted place of the target's side: 139.6 m ahead of the own ship's origin, 6.7 m off her centreline."""
    A = replayed().A
    assert -A.x == pytest.approx(139.6, abs=0.5)
    assert A.y == pytest.approx(-6.7, abs=0.1)


def test_every_printed_horizontal_velocity_to_a_millimetre_per_second() -> None:
    r = replayed()
    assert in_the_papers_axes(r.A, OWN_BEFORE["h"]) == pytest.approx(OWN_AFTER["v"][:2], abs=1e-3)
    assert in_the_papers_axes(r.B, TARGET_BEFORE["h"]) == pytest.approx(TARGET_AFTER["v"][:2], abs=1e-3)
    assert r.A.r == pytest.approx(OWN_AFTER["w_z"], abs=2e-4)
    assert r.B.r == pytest.approx(TARGET_AFTER["w_z"], abs=2e-4)
    assert not r.stuck
    assert (r.E_xi + r.E_eta) / 1e6 == pytest.approx(111.1, abs=1.0)


def test_added_mass_changes_the_answer_by_far_more_than_that() -> None:
    """What the paper's run leaves out: half a metre per second of the target, and 60 % of the energy."""
    r = replayed(m_x=0.05, m_y=0.85, j_z=0.21, mu=0.25, e=0.0)
    assert in_the_papers_axes(r.A, OWN_BEFORE["h"]) == pytest.approx((-2.448, 3.940), abs=0.012)
    assert in_the_papers_axes(r.B, TARGET_BEFORE["h"]) == pytest.approx((-1.581, 3.889), abs=0.012)
    assert (r.E_xi + r.E_eta) / 1e6 == pytest.approx(180.0, abs=2.0)
