"""Four degrees of freedom in Guan's symbols against the 6 x 6 form, and what the corrections are for."""

from __future__ import annotations

from math import cos, inf, sin

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from shipcollision_fmu.collision.dynamics.contact import point_jacobian
from shipcollision_fmu.collision.solvers.impact_process import solve_impact_process
from shipcollision_fmu.ship.degrees_of_freedom import free_inverse
from shipcollision_fmu.ship.frames import rotation
from tests.collision.impacts import Array, floats
from tests.oracles.guan2014 import GuanImpact, GuanShip, solve_guan_impact
from tests.oracles.newton_impact import solve_newton_impact, stick_energy

Case = tuple[GuanShip, GuanShip, float, float, float, float, float]


@st.composite
def ships(draw: st.DrawFn) -> GuanShip:
    m = 10.0 ** draw(floats(4.0, 8.6))
    L = 2.0 * m ** (1 / 3)
    return GuanShip(
        M_x=m * (1 + draw(floats(0, 0.1))), M_y=m * (1 + draw(floats(0, 1.3))), J_z=m * (0.25 * L) ** 2 * 1.21,
        J_x=m * (0.06 * L) ** 2 * 1.2, x=draw(floats(-0.5, 0.5)) * L, y=draw(floats(-0.2, 0.2)) * L,
        h=draw(floats(-0.05, 0.05)) * L, u=draw(floats(-10, 10)), v=draw(floats(-3, 3)), p=draw(floats(-0.1, 0.1)),
        r=draw(floats(-0.03, 0.03)),
    )  # fmt: skip


@st.composite
def cases(draw: st.DrawFn) -> Case:
    """Ships that close at (1, 2): A, B, alpha, beta, mu, e and the closing speed."""
    A, B, alpha, beta = draw(ships()), draw(ships()), draw(floats(-np.pi, np.pi)), draw(floats(-np.pi, np.pi))
    xi_0 = solve_guan_impact(A, B, 1.0, 2.0, alpha, beta, 0.0, 0.0).xi_0 if _moving(A, B) else 0.0
    assume(abs(xi_0) > 1e-3)
    if xi_0 < 0.0:
        A, B = ({**s.__dict__, "u": -s.u, "v": -s.v, "p": -s.p, "r": -s.r} for s in (A, B))  # type: ignore[assignment]  # ships mirrored by their fields
        A, B = GuanShip(**A), GuanShip(**B)  # type: ignore[arg-type]  # ships mirrored by their fields
    return A, B, alpha, beta, draw(floats(0.0, 1.0)), draw(floats(0.0, 1.0)), abs(xi_0)


def _moving(*both: GuanShip) -> bool:
    return any(x for s in both for x in (s.u, s.v, s.p, s.r))


def general(case: Case) -> tuple[Array, Array, Array, Array]:
    """The same in 6 x 6: W and v (2, 2), (2,) along (n, t), and the twist per unit of (n, t) impulse of A and of B.

    Everything in axes x forward, y to port, z up: the vector algebra is that of any right-handed axes.
    """
    A, B, alpha, beta, *_ = case
    n, t = np.array([sin(alpha), cos(alpha), 0.0]), np.array([cos(alpha), -sin(alpha), 0.0])
    W, v, gains = np.zeros((2, 2)), np.zeros(2), []
    for ship, turn, sign in ((A, 0.0, -1.0), (B, -beta, 1.0)):
        R = rotation([0.0, 0.0, turn])
        G = np.array([n, t]) @ point_jacobian(R, R.T @ np.array([1.0 - ship.x, 2.0 - ship.y, ship.h]))
        inverse = free_inverse(np.diag([ship.M_x, ship.M_y, 7e7, ship.J_x, 5e9, ship.J_z]), 4)
        W += G @ inverse @ G.T
        v += sign * G @ np.array([ship.u, ship.v, 0.0, ship.p, 0.0, ship.r])
        gains.append(sign * inverse @ G.T)
    return W, v, gains[0], gains[1]


def solved(case: Case, e: float | None = None) -> GuanImpact:
    A, B, alpha, beta, mu, restitution, _ = case
    return solve_guan_impact(A, B, 1.0, 2.0, alpha, beta, mu, restitution if e is None else e)


@given(cases())
def test_the_general_form_is_guans_in_four_degrees_of_freedom(case: Case) -> None:
    W, v, *_ = general(case)
    r = solved(case)
    size = max(r.W_nn, r.W_tt)
    np.testing.assert_allclose(W, [[r.W_nn, r.W_nt], [r.W_nt, r.W_tt]], rtol=1e-12, atol=1e-13 * size)
    # v is of B relative to A, Guan's speeds are of A relative to B.
    np.testing.assert_allclose(-v, [r.xi_0, r.eta_0], rtol=1e-12, atol=1e-12 * np.linalg.norm(v))


@given(cases())
def test_impulse_speeds_and_energies_agree(case: Case) -> None:
    W, v, gain_A, gain_B = general(case)
    r, mu, e = solved(case), case[4], case[5]
    form = solve_newton_impact(W, v, mu, e)
    assert r.stuck == (form.mode == "stick")
    P = np.array([r.I_xi, r.I_eta])
    np.testing.assert_allclose(P, form.P, rtol=0.0, atol=1e-9 * np.linalg.norm(P))
    np.testing.assert_allclose([-r.xi_f, -r.eta_f], form.after, rtol=0.0, atol=1e-9 * np.linalg.norm(v))
    np.testing.assert_allclose([r.E_xi, r.E_eta], [form.energy_normal, form.energy_tangential], rtol=0.0,
                               atol=1e-9 * stick_energy(W, v))  # fmt: skip
    for before, after, gain in ((case[0], r.A, gain_A), (case[1], r.B, gain_B)):
        change = np.array([after.u - before.u, after.v - before.v, after.p - before.p, after.r - before.r])
        expected = (gain @ P)[[0, 1, 3, 5]]
        speeds = np.array([before.u, before.v, before.p, before.r])
        np.testing.assert_allclose(change, expected, rtol=0.0, atol=1e-12 * np.abs([*expected, *speeds]).max())


@given(cases())
def test_momentum_is_kept_linear_and_about_the_vertical(case: Case) -> None:
    """With the printed arm of B's yaw, (x_C - x_A), the last of these fails; with B's own it holds."""
    r, beta = solved(case), case[3]

    def momentum(A: GuanShip, B: GuanShip) -> Array:
        p_A = np.array([A.M_x * A.u, A.M_y * A.v])
        c, s = cos(beta), sin(beta)
        p_B = np.array([[c, s], [-s, c]]) @ [B.M_x * B.u, B.M_y * B.v]
        spin = A.J_z * A.r + B.J_z * B.r
        arms = A.x * p_A[1] - A.y * p_A[0] + B.x * p_B[1] - B.y * p_B[0]
        return np.array([*(p_A + p_B), spin + arms])

    before, after = momentum(case[0], case[1]), momentum(r.A, r.B)
    exchanged = np.hypot(r.I_xi, r.I_eta) * np.array([1.0, 1.0, 1e3])
    np.testing.assert_allclose(after, before, rtol=1e-10, atol=1e-10 * exchanged.max())


@given(cases())
def test_slip_path_is_the_same_impact_where_the_slip_does_not_stop_or_sticks_at_once(case: Case) -> None:
    W, v, *_ = general(case)
    path, r = solve_impact_process(W, v, case[4], 0.0), solved(case, e=0.0)
    assume(path.ending != "again")
    np.testing.assert_allclose(path.P, [r.I_xi, r.I_eta], rtol=0.0, atol=1e-8 * np.linalg.norm(path.P))


def test_a_fixed_obstacle_is_infinite_mass() -> None:
    ship = GuanShip(M_x=1e7, M_y=1.8e7, J_z=3e10, J_x=1e9, x=-60.0, y=-3.0, h=2.0, u=4.0, v=0.5, r=0.01)
    wall = GuanShip(M_x=inf, M_y=inf, J_z=inf, J_x=inf, x=5.0, y=9.0)
    exact = solve_guan_impact(ship, wall, 0.0, 0.0, 1.2, 0.4, 0.3, 0.2)
    assert (exact.B.u, exact.B.v, exact.B.r, exact.B.p) == (0.0, 0.0, 0.0, 0.0)
    for mass in (1e12, 1e14):
        heavy = solve_guan_impact(
            ship, GuanShip(mass, mass, mass * 1e4, mass * 1e3, 5.0, 9.0), 0.0, 0.0, 1.2, 0.4, 0.3, 0.2
        )
        assert heavy.I_xi == pytest.approx(exact.I_xi, rel=2e7 / mass)
        assert heavy.E_xi + heavy.E_eta == pytest.approx(exact.E_xi + exact.E_eta, rel=2e7 / mass)


@given(floats(0.0, 1.0), floats(0.1, 10.0), floats(4.0, 8.0))
def test_head_on_equal_ships(e: float, speed: float, log_mass: float) -> None:
    """Each goes back with the share e of its speed: alpha = pi/2 turns the normal ahead, beta = pi faces B."""
    m = 10.0**log_mass
    A = GuanShip(1.05 * m, 1.85 * m, 1e3 * m, 50.0 * m, x=-50.0, y=0.0, u=speed)
    B = GuanShip(1.05 * m, 1.85 * m, 1e3 * m, 50.0 * m, x=50.0, y=0.0, u=speed)
    r = solve_guan_impact(A, B, 0.0, 0.0, np.pi / 2, np.pi, 0.3, e)
    assert r.A.u == pytest.approx(-e * speed, abs=1e-12 * speed)
    assert r.B.u == pytest.approx(-e * speed, abs=1e-12 * speed)
    assert r.E_xi + r.E_eta == pytest.approx(1.05 * m * speed**2 * (1 - e**2), rel=1e-9, abs=1e-9 * m * speed**2)
