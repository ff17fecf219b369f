"""Rudder: the paper's forces ahead, and sense in every other flow."""

from __future__ import annotations

from math import atan2, cos, hypot, pi, sin, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.manoeuvring.propeller import Propeller, speed_and_drift_angle
from shipcollision_fmu.manoeuvring.rudder import Rudder
from shipcollision_fmu.ship.loading.library import load_ship

SHIP = load_ship("kvlcc2")
assert SHIP.rudder is not None
assert SHIP.propeller is not None
PROPELLER = Propeller(SHIP, SHIP.propeller)
RUDDER = Rudder(SHIP, SHIP.rudder, SHIP.propeller)


@pytest.mark.parametrize(("v", "r"), [(-1.0, 0.01), (1.0, -0.01), (0.3, 0.02)])
@pytest.mark.parametrize("delta", [0.6, -0.3])
def test_forces_of_the_paper(v: float, r: float, delta: float) -> None:
    """The equations as published, with J and K_T, at u = 6 m/s, n = 1.2 /s."""
    u, n, L, rho, D_P, H_R, A_R = 6.0, 1.2, 320.0, 1025.0, 9.86, 15.8, 112.5
    U, beta, r_prime = hypot(u, v), atan2(-v, u), r * L / hypot(u, v)
    u_P = PROPELLER.compute_inflow(u, *speed_and_drift_angle(u, v), r)
    J = u_P / (n * D_P)
    K_T = 0.2931 - 0.2753 * J - 0.1385 * J**2
    eta, kappa, epsilon = D_P / H_R, 0.50, 1.09
    u_R = epsilon * u_P * sqrt(eta * (1 + kappa * (sqrt(1 + 8 * K_T / (pi * J**2)) - 1)) ** 2 + 1 - eta)
    beta_R = beta + 0.710 * r_prime
    v_R = U * (0.395 if beta_R < 0 else 0.640) * beta_R
    F_N = 0.5 * rho * A_R * (u_R**2 + v_R**2) * 2.747 * sin(delta - atan2(v_R, u_R))
    expected = (
        -(1 - 0.387) * F_N * sin(delta), -(1 + 0.312) * F_N * cos(delta), (0.500 + 0.312 * 0.464) * L * F_N * cos(delta)
    )  # fmt: skip
    assert RUDDER(*speed_and_drift_angle(u, v), r, u_P, PROPELLER.compute_thrust(u_P, n), delta) == pytest.approx(
        expected, rel=1e-12
    )


def test_starboard_rudder_turns_to_starboard_and_brakes() -> None:
    X, Y, N = RUDDER(*speed_and_drift_angle(6.0, 0.0), 0.0, 3.9, PROPELLER.compute_thrust(3.9, 1.2), 0.3)
    assert X < 0.0
    assert Y < 0.0
    assert N > 0.0


def test_race_steers_a_ship_at_rest() -> None:
    _, _, N = RUDDER(*speed_and_drift_angle(0.0, 0.0), 0.0, 0.0, PROPELLER.compute_thrust(0.0, 1.0), 0.3)
    assert N > 0.0


def test_astern_the_rudder_turns_the_other_way() -> None:
    u_P = PROPELLER.compute_inflow(-3.0, *speed_and_drift_angle(-3.0, 0.0), 0.0)
    _, _, N = RUDDER(*speed_and_drift_angle(-3.0, 0.0), 0.0, u_P, PROPELLER.compute_thrust(u_P, 0.0), 0.3)
    assert N < 0.0


@given(st.floats(-12.0, 12.0), st.floats(-12.0, 12.0), st.floats(-0.1, 0.1), st.floats(-1.5, 1.5), st.floats(-0.6, 0.6))
def test_bounded_in_every_motion(u: float, v: float, r: float, n: float, delta: float) -> None:
    u_P = PROPELLER.compute_inflow(u, *speed_and_drift_angle(u, v), r)
    X, Y, N = RUDDER(*speed_and_drift_angle(u, v), r, u_P, PROPELLER.compute_thrust(u_P, n), delta)
    speed = abs(u) + abs(v) + abs(r) * 320.0 + abs(n) * 9.86
    most = 4.0 * 0.5 * 1025.0 * 112.5 * 2.747 * speed**2 + 1e-9
    assert abs(X) <= most
    assert abs(Y) <= most
    assert abs(N) <= most * 320.0


def test_nothing_moves_nothing_pushes() -> None:
    assert RUDDER(*speed_and_drift_angle(0.0, 0.0), 0.0, 0.0, 0.0, 0.5) == pytest.approx((0.0, 0.0, 0.0), abs=0.0)
