"""Hull forces: the paper's polynomials at small drift, safe everywhere else."""

from __future__ import annotations

from math import cos, pi, radians, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.manoeuvring.hull_forces import BETA, GAMMA, HullForces, integrate_cross_flow
from shipcollision_fmu.ship.loading.library import load_ship

SHIP = load_ship("kvlcc2")
assert SHIP.manoeuvring is not None
hull = HullForces(SHIP, SHIP.manoeuvring)
L, D, RHO = 320.0, 20.8, 1025.0
FORCE, MOMENT = 0.5 * RHO * L * D, 0.5 * RHO * L**2 * D

speed = st.floats(-12.0, 12.0)
turning = st.floats(-0.1, 0.1)


def at(U: float, beta: float, r_prime: float) -> tuple[float, float, float]:
    """hull at speed U, drift beta and r' = r L/U."""
    return hull(U * cos(beta), -U * sin(beta), r_prime * U / L)


def test_polynomials_of_the_paper() -> None:
    """KVLCC2 at beta = 12 deg, r' = 0.4, the published coefficients written out again."""
    U, v, r = 6.0, -sin(radians(12.0)), 0.4
    X = -0.00785 - 0.040 * v**2 + 0.002 * v * r + 0.011 * r**2 + 0.771 * v**4
    Y = -0.315 * v + 0.083 * r - 1.607 * v**3 + 0.379 * v**2 * r - 0.391 * v * r**2 + 0.008 * r**3
    N = -0.137 * v - 0.049 * r - 0.030 * v**3 - 0.294 * v**2 * r + 0.055 * v * r**2 - 0.013 * r**3
    expected = [FORCE * U**2 * X, FORCE * U**2 * Y, MOMENT * U**2 * N]
    np.testing.assert_allclose(at(U, radians(12.0), 0.4), expected, rtol=1e-12)


@given(speed, speed, turning)
def test_mirror_symmetry(u: float, v: float, r: float) -> None:
    X, Y, N = hull(u, v, r)
    assert hull(u, -v, -r) == pytest.approx((X, -Y, -N), rel=1e-12, abs=1e-9)


@given(speed, speed, turning, st.floats(1e-3, 10.0))
def test_forces_grow_with_the_square_of_the_motion(u: float, v: float, r: float, k: float) -> None:
    scaled = np.array(hull(k * u, k * v, k * r))
    np.testing.assert_allclose(scaled / k**2, hull(u, v, r), rtol=1e-6, atol=1e-3)


@given(speed, speed, turning)
def test_bounded_in_every_direction(u: float, v: float, r: float) -> None:
    """No direction, not even sideways, astern or spinning, has a coefficient above a few."""
    X, Y, N = hull(u, v, r)
    scale = u**2 + v**2 + (r * L) ** 2 + 1e-12
    assert abs(X) <= 1.0 * FORCE * scale
    assert abs(Y) <= 2.0 * FORCE * scale
    assert abs(N) <= 1.0 * MOMENT * scale


@pytest.mark.parametrize("nu", [(0.0, 0.0, 0.0), (1e-300, 0.0, 0.0), (0.0, -0.0, 1e-300), (-0.0, 0.0, 0.0)])
def test_at_rest_there_is_no_force(nu: tuple[float, float, float]) -> None:
    assert hull(*nu) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("edge", [*BETA, -BETA[0], -BETA[1], pi])
def test_no_jump_over_drift(edge: float) -> None:
    below, above = np.array(at(5.0, edge - 1e-9, 0.2)), np.array(at(5.0, edge + 1e-9, 0.2))
    np.testing.assert_allclose(above / [FORCE, FORCE, MOMENT], below / [FORCE, FORCE, MOMENT], atol=1e-6)


@pytest.mark.parametrize("edge", GAMMA)
def test_no_jump_over_yaw(edge: float) -> None:
    below, above = np.array(at(5.0, 0.1, 2 * np.tan(edge - 1e-9))), np.array(at(5.0, 0.1, 2 * np.tan(edge + 1e-9)))
    np.testing.assert_allclose(above / [FORCE, FORCE, MOMENT], below / [FORCE, FORCE, MOMENT], atol=1e-6)


def test_sideways_is_cross_flow_drag() -> None:
    """C_D = 1 on the lateral area, against the motion, no turning moment."""
    sideways = hull(0.0, 2.0, 0.0)
    assert sideways == pytest.approx((0.0, -FORCE * 4.0, 0.0), abs=1e-6)


def test_spinning_on_the_spot_is_braked() -> None:
    """C_D = 1 over the length: N = -1/2 rho d int |x r| x r x dx = -1/2 rho L^2 d (r L)^2 / 32."""
    r = 0.02
    spinning = hull(0.0, 0.0, r)
    assert spinning == pytest.approx((0.0, 0.0, -MOMENT * (r * L) ** 2 / 32.0), abs=1e-6)


def test_astern_is_braked_as_ahead() -> None:
    surge, sway, yaw = hull(-3.0, 0.0, 0.0)
    assert surge == pytest.approx(FORCE * 0.00785 * 9.0)
    assert sway == yaw == 0.0


@given(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0))
def test_cross_flow_against_strips(v: float, s: float) -> None:
    xi = (np.arange(4000) + 0.5) / 2000.0 - 1.0
    w = v + s * xi
    drag, moment = integrate_cross_flow(v, s)
    assert drag == pytest.approx(np.mean(w * np.abs(w)), abs=1e-4)
    assert moment == pytest.approx(np.mean(0.5 * xi * w * np.abs(w)), abs=1e-4)


@given(st.floats(-5.0, 5.0))
def test_cross_flow_is_one_function_where_its_halves_meet(v: float) -> None:
    np.testing.assert_allclose(
        integrate_cross_flow(v, v * (1 + 1e-12)), integrate_cross_flow(v, v), rtol=1e-9, atol=1e-300
    )
