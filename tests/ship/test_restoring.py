"""Buoyancy and weight: the slope of a potential, whatever the attitude."""

from __future__ import annotations

from dataclasses import replace
from math import atan, cos, radians, sin, tan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.ship.frames import rotation
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.restoring import Restoring
from shipcollision_fmu.ship.seakeeping import compute_seakeeping

SEA = compute_seakeeping(load_ship("kvlcc2"))
SHIFTED = Restoring(replace(SEA, x_F=-6.0))
restoring = Restoring(SEA)

heel = st.floats(-3.0, 3.0)
trim = st.floats(-1.2, 1.2)
rate = st.floats(-1.0, 1.0)


def wrench(group: Restoring, D: float, phi: float, theta: float) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return np.array(group(D, sin(phi), cos(phi), sin(theta), cos(theta)))


@given(st.floats(-5.0, 5.0), heel, trim, st.lists(rate, min_size=6, max_size=6))
def test_power_is_the_loss_of_potential_energy(D: float, phi: float, theta: float, nu: list[float]) -> None:
    """tau . nu = -dV/dt for any velocity, with the kinematics of the Euler angles."""
    v, (p, q, r) = np.array(nu[:3]), nu[3:]
    D_dot = float((rotation([phi, theta, 0.3]) @ v)[2])
    phi_dot = p + (q * sin(phi) + r * cos(phi)) * tan(theta)
    theta_dot = q * cos(phi) - r * sin(phi)
    e = 1e-6

    def V(s: float) -> float:
        return SHIFTED.compute_energy(D + s * D_dot, phi + s * phi_dot, theta + s * theta_dot)

    power = float(wrench(SHIFTED, D, phi, theta) @ nu)
    scale = SEA.K_55 * (abs(theta_dot) + 1e-3) + SEA.K_44 * (abs(phi_dot) + 1e-3) + SEA.K_33 * (abs(D_dot) + 1e-3)
    assert -(V(e) - V(-e)) / (2 * e) == pytest.approx(power, abs=1e-6 * scale)


def test_small_angles() -> None:
    Z = wrench(restoring, 0.1, 0.0, 0.0)
    np.testing.assert_allclose(Z, [0.0, 0.0, -0.1 * SEA.K_33, 0.0, 0.0, 0.0])
    K = wrench(restoring, 0.0, 1e-4, 0.0)
    np.testing.assert_allclose(K, [0.0, 0.0, 0.0, -1e-4 * SEA.K_44, 0.0, 0.0], rtol=1e-7)
    M = wrench(restoring, 0.0, 0.0, 1e-4)
    np.testing.assert_allclose(M, [0.0, 0.0, 0.0, 0.0, -1e-4 * SEA.K_55, 0.0], rtol=1e-7)


def test_wall_sided_to_the_deck_edge() -> None:
    """GZ = (GM_T + 1/2 BM_T tan^2 phi) sin phi; KVLCC2's deck edge comes to the water at 17.6 deg."""
    deck = atan(SEA.tan_deck)
    assert deck == pytest.approx(radians(17.6), abs=1e-3)
    for phi in (0.1, 0.3, -0.2):
        GZ = (SEA.GM_T + 0.5 * SEA.BM_T * tan(phi) ** 2) * sin(phi)
        assert restoring.compute_roll_moment(sin(phi), cos(phi)) == pytest.approx(-SEA.K_44 / SEA.GM_T * GZ)
    below, above = (restoring.compute_roll_moment(sin(deck + e), cos(deck + e)) for e in (-1e-9, 1e-9))
    assert above == pytest.approx(below, rel=1e-7)
    beyond = (SEA.GM_T + 0.5 * SEA.BM_T * SEA.tan_deck**2) * sin(1.0)
    assert restoring.compute_roll_moment(sin(1.0), cos(1.0)) == pytest.approx(-SEA.K_44 / SEA.GM_T * beyond)


def test_centre_of_flotation_couples_heave_and_pitch() -> None:
    """Sunk evenly, a ship whose waterplane lies aft is pushed up aft: bow down."""
    X, _, Z, _, M, _ = wrench(SHIFTED, 0.1, 0.0, 0.0)
    assert X == 0.0
    assert pytest.approx(-0.1 * SEA.K_33) == Z
    assert pytest.approx(-6.0 * 0.1 * SEA.K_33 * 1.0) == M
