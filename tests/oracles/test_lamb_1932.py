"""Kirchhoff's equations, as Lamb (1932), Hydrodynamics, chapter VI, has them: integrals, and solutions in closed form.

A ship that coasts is a solid that moves through a perfect liquid without circulation. The energy and the momentum of
ship and water stay; an elliptic cylinder turns like a pendulum about the broadside attitude (section 127).
"""

from __future__ import annotations

from dataclasses import replace
from math import asin, cos, pi, sin, sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.errors import InputError, ShipError, StepError
from shipcollision_fmu.ship.coasting import coast
from shipcollision_fmu.ship.coasting_law import COASTING, CoastingLaw, make_coasting
from shipcollision_fmu.ship.frames import Array, rotation
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.ship import Ship
from tests.ship_files import NO_ADDED_MASS, ship_tables

KVLCC2 = load_ship("kvlcc2")
LOPSIDED = load_ship(ship_tables(particulars={"r_bg": [2.0, 0.7, 0.4]}))
START = ([10.0, -20.0, 0.0], [0.0, 0.0, 0.6], [5.0, 1.0, 0.0], [0.0, 0.0, 0.01])
ZERO = [0.0, 0.0, 0.0]


def run(law: CoastingLaw, state: Any, h: float, steps: int) -> Any:
    for _ in range(steps):
        state = law.coast(*state, h)
    return state


def integrals(ship: Ship, state: Any, free: list[int]) -> Array:
    """Energy, momentum in n, and angular momentum about the origin of n, of the motions that are free."""
    x, attitude, velocity, rate = state
    nu = np.array([*velocity, *rate])
    M = np.zeros((6, 6))
    M[np.ix_(free, free)] = ship.M[np.ix_(free, free)]
    R, P = rotation(attitude), M @ nu
    p = R @ P[:3]
    return np.array([0.5 * nu @ P, *p, *(R @ P[3:] + np.cross(x, p))])


@pytest.mark.one_in(3)
@pytest.mark.parametrize("h", [0.05, 1.0, 20.0])
@pytest.mark.parametrize("ship", [KVLCC2, LOPSIDED], ids=["kvlcc2", "lopsided"])
@pytest.mark.parametrize("degrees_of_freedom", [3, 4, 6])
def test_energy_and_momentum_stay(ship: Ship, degrees_of_freedom: int, h: float) -> None:
    """Energy to 1e-12, momentum in n, linear and about a fixed point, to 1e-11, over 400 s or steps."""
    _, attitude, velocity, rate = START
    state: Any = (ZERO, attitude, [*velocity[:2], 0.1 if degrees_of_freedom == 6 else 0.0], rate)
    if degrees_of_freedom == 6:
        state = (ZERO, [0.1, -0.05, 0.6], state[2], [0.02, -0.004, 0.01])
    law = make_coasting(ship, degrees_of_freedom, "free")
    free = {3: [0, 1, 5], 4: [0, 1, 5], 6: list(range(6))}[degrees_of_freedom]
    if degrees_of_freedom == 4:  # roll is cyclic: look at the level momenta with roll at its sway-roll coupling
        free = [0, 1, 3, 5]
    before = _level_integrals(ship, state, free) if degrees_of_freedom < 6 else integrals(ship, state, free)
    state = run(law, state, h, 400 if h <= 1.0 else 20)
    after = _level_integrals(ship, state, free) if degrees_of_freedom < 6 else integrals(ship, state, free)
    assert after[0] == pytest.approx(before[0], rel=1e-12)
    p, L = (
        np.linalg.norm(before[1:4]),
        np.linalg.norm(before[4:]) + np.linalg.norm(before[1:4]) * np.linalg.norm(state[0]),
    )
    np.testing.assert_allclose(after[1:4], before[1:4], atol=1e-11 * p)
    np.testing.assert_allclose(after[4:], before[4:], atol=1e-11 * L)


def _level_integrals(ship: Ship, state: Any, free: list[int]) -> Array:
    """The same with the twist (u, v, phi_dot, psi_dot) of the level axes; the last three: 0, L_x, L_z."""
    x, (phi, _, psi), (u, v, w), (p, q, r) = state
    c, s = cos(phi), sin(phi)
    nu = np.array([u, c * v - s * w, 0.0, p, 0.0, s * q + c * r])
    M = np.zeros((6, 6))
    M[np.ix_(free, free)] = ship.M[np.ix_(free, free)]
    P = M @ nu
    n = rotation([0.0, 0.0, psi]) @ [P[0], P[1], 0.0]
    return np.array([0.5 * nu @ P, *n, 0.0, P[3], P[5] + x[0] * n[1] - x[1] * n[0]])


def _symmetric(A: float, B: float, C: float) -> Ship:
    M = np.diag([A, B, 2.0 * B, 1e9, C, C])
    return replace(KVLCC2, M=M, r_bg=np.zeros(3))


def _cd(x: float, k: float) -> float:
    """Jacobi's elliptic function cd(x, k) = sn(x + K, k), by the descending Landen transformation (Abramowitz 16.4)."""
    a, b, c = [1.0], [sqrt(1.0 - k * k)], [k]
    while abs(c[-1]) > 1e-16:
        a.append(0.5 * (a[-1] + b[-1]))
        c.append(0.5 * (a[-2] - b[-1]))
        b.append(sqrt(a[-2] * b[-1]))
    K = 0.5 * pi / a[-1]
    phase = 2 ** (len(a) - 1) * a[-1] * (x + K)
    for n in range(len(a) - 1, 0, -1):
        phase = 0.5 * (phase + asin(c[n] / a[n] * sin(phase)))
    return sin(phase)


@pytest.mark.one_in(2)
@pytest.mark.parametrize("degrees_of_freedom", [3, 6])
@pytest.mark.parametrize("drift", [0.05, 1.0, 1.5])
def test_a_drifting_body_swings_about_broadside_like_a_pendulum(degrees_of_freedom: int, drift: float) -> None:
    """Lamb, section 127: C theta_dd = (B - A) p^2/(2 A B) sin(2 theta), theta between axis and momentum p.

    From rest, alpha = 2 (theta - pi/2) is 2 arcsin(k cd(w t, k)), w^2 = (B - A) p^2/(A B C), k = sin(alpha_0/2).
    """
    A, B, C, p = 3.3e8, 5.9e8, 3.2e12, 2.0e9
    law = make_coasting(_symmetric(A, B, C), degrees_of_freedom, "free")
    state: Any = (ZERO, [0.0, 0.0, drift], [p * cos(drift) / A, -p * sin(drift) / B, 0.0], ZERO)
    alpha, w = 2.0 * drift - pi, sqrt((B - A) * p * p / (A * B * C))
    k, h = sin(abs(alpha) / 2.0), 0.2
    for n in range(1, 2001):
        state = law.coast(*state, h)
        if n % 100 == 0:
            theta = 0.5 * pi + asin(-k * _cd(w * n * h, k))
            assert state[1][2] == pytest.approx(theta, abs=2e-4)


def test_the_scheme_is_of_second_order() -> None:
    law = make_coasting(KVLCC2, 3, "free")
    fine = run(law, START, 0.05, 8000)[1][2]
    errors = [abs(run(law, START, h, round(400.0 / h))[1][2] - fine) for h in (0.4, 0.2)]
    assert 3.0 < errors[0] / errors[1] < 5.0
    assert errors[0] < 1e-4


@pytest.mark.parametrize("degrees_of_freedom", [3, 4, 6])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_along_a_principal_axis_the_motion_is_steady(degrees_of_freedom: int, axis: int) -> None:
    """Lamb, section 124. About the longest of them stability is lost; rounding does not show in 100 s."""
    if degrees_of_freedom < 6 and axis == 2:
        return
    velocity = [3.0 if k == axis else 0.0 for k in range(3)]
    ship = _symmetric(3.3e8, 5.9e8, 3.2e12)
    x, attitude, v, rate = run(make_coasting(ship, degrees_of_freedom, "free"), (ZERO, ZERO, velocity, ZERO), 0.5, 200)
    np.testing.assert_allclose(x, np.array(velocity) * 100.0, rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose([*attitude, *v, *rate], [0, 0, 0, *velocity, 0, 0, 0], atol=1e-12)


def test_a_straight_course_goes_by_the_formula_of_straight_coasting() -> None:
    for degrees_of_freedom, name in ((3, "kirchhoff"), (4, "kirchhoff"), (6, "kirchhoff"), (6, "free")):
        state = ([1.0, 2.0, 0.0], [0.0, 0.0, 0.7], [5.0, 0.0, 0.0], ZERO)
        law = make_coasting(KVLCC2, degrees_of_freedom, name)
        assert law.coast(*state, 7.0)[:3] == coast(*state, KVLCC2.r_bg.tolist(), 7.0)


def test_without_added_mass_the_plane_motion_is_straight_to_the_bit() -> None:
    ship = load_ship(ship_tables(added_mass=NO_ADDED_MASS, particulars={"r_bg": [2.0, 0.0, 0.4]}))
    assert make_coasting(ship, 3, "kirchhoff").coast(*START, 5.0)[:3] == coast(*START, [2.0, 0.0, 0.0], 5.0)


def test_without_added_mass_a_body_is_eulers_top() -> None:
    """Torque-free: CG goes straight, the angular momentum stays in n, and the free symmetric top precesses at
    (C - A)/A r about its axis."""
    ship = load_ship(ship_tables(added_mass=NO_ADDED_MASS, particulars={"k_xx": 9.0, "k_yy": 9.0, "k_zz": 25.0}))
    r, q, t = 0.3, 0.05, 20.0
    law = make_coasting(ship, 6, "free")
    x, attitude, velocity, rate = run(law, (ZERO, ZERO, [2.0, 1.0, 0.5], [0.0, q, r]), 0.01, 2000)
    np.testing.assert_allclose(x, np.array([2.0, 1.0, 0.5]) * t, rtol=1e-5)
    phase = (25.0**2 - 9.0**2) / 9.0**2 * r * t
    np.testing.assert_allclose(rate, [-q * sin(phase), q * cos(phase), r], atol=2e-4)
    np.testing.assert_allclose(rotation(attitude) @ velocity, [2.0, 1.0, 0.5], atol=1e-5)


@given(st.floats(0.5, 8.0), st.floats(-1.0, 1.0), st.floats(-0.02, 0.02), st.floats(0.01, 0.3))
def test_it_runs_back(u: float, v: float, r: float, h: float) -> None:
    """Reversed, the ship takes its way back: the scheme is symmetric."""
    law = make_coasting(KVLCC2, 3, "kirchhoff")
    x, attitude, velocity, rate = law.coast(ZERO, [0.0, 0.0, 0.3], [u, v, 0.0], [0.0, 0.0, r], h)
    back = law.coast(x, attitude, [-a for a in velocity], [-a for a in rate], h)
    np.testing.assert_allclose(back[0], ZERO, atol=1e-9)
    np.testing.assert_allclose(back[2], [-u, -v, 0.0], atol=1e-10)


@pytest.mark.parametrize("law", ["kirchhoff", "free"])
def test_a_heeled_ship_of_3_degrees_of_freedom_moves_as_an_upright_one(law: str) -> None:
    """In level axes."""
    heel = rotation([0.2, -0.1, 0.0]).T
    upright = run(make_coasting(KVLCC2, 3, law), START, 0.5, 100)
    start = (START[0], [0.2, -0.1, 0.6], (heel @ START[2]).tolist(), (heel @ START[3]).tolist())
    heeled = run(make_coasting(KVLCC2, 3, law), start, 0.5, 100)
    np.testing.assert_allclose(heeled[0], upright[0], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(heeled[1], [0.2, -0.1, upright[1][2]], rtol=1e-12)
    np.testing.assert_allclose(heel.T @ heeled[2], upright[2], atol=1e-12)
    np.testing.assert_allclose(heel.T @ heeled[3], upright[3], atol=1e-12)


def test_what_is_not_a_law_is_refused() -> None:
    with pytest.raises(InputError, match="coasting = 'curved' must be one of kirchhoff, free, straight"):
        make_coasting(KVLCC2, 3, "curved")
    assert COASTING[0] == "kirchhoff"


def test_a_ship_that_does_not_float_upright_is_refused_with_the_remedy() -> None:
    ship = load_ship(ship_tables(particulars={"GM_T": 0.001}))
    with pytest.raises(ShipError, match=r"GM_T = 0\.001 m.*coasting = 'straight'"):
        make_coasting(ship, 6, "kirchhoff")
    make_coasting(ship, 6, "free")
    make_coasting(ship, 3, "kirchhoff")


def test_a_step_that_takes_too_long_is_refused() -> None:
    with pytest.raises(StepError, match=r"a step of 1e\+06 s takes .* substeps .* at most 10000: take shorter steps"):
        make_coasting(KVLCC2, 3, "kirchhoff").coast(*START, 1e6)
