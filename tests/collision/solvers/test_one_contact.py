"""One contact of ships that are held while the normal slopes: of many impulses that stop them, the least is given."""

from __future__ import annotations

from math import cos, sin

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, example, given, settings
from hypothesis import strategies as st

from shipcollision_fmu.collision.solvers.gauss_seidel import solve_gauss_seidel
from shipcollision_fmu.collision.solvers.impact_process import solve_impact_process
from shipcollision_fmu.ship.frames import rotation
from tests.collision.impacts import SHARE, Impact, floats, impacts

PLANE = {"degrees_of_freedom": (3,), "e": st.just(0.0)}


def impulse(impact: Impact) -> np.ndarray:
    """In n."""
    P: np.ndarray = impact.axes.T @ solve_gauss_seidel(impact.W, impact.v, impact.mu).P[0]
    return P


@given(floats(0.05, 1.2), floats(1e-3, 1.0), st.booleans())
def test_head_on_against_a_slope_friction_helps_at_its_limit(slope: float, mu: float, outwards: bool) -> None:
    """m V = P_n (cos(slope) + mu sin(slope)): the hulls slide up or down the slope until the ship has stopped."""
    m, V = 4e7, 3.0
    s = sin(slope) if outwards else -sin(slope)
    normal, down = np.array([cos(slope), 0.0, s]), np.array([-s, 0.0, cos(slope)])  # held: nothing moves down
    axes = np.array([normal, [0.0, 1.0, 0.0], down])
    W = axes @ np.diag([1.0 / m, 1.0 / m, 0.0]) @ axes.T
    P = solve_gauss_seidel(W, axes @ [-V, 0.0, 0.0], mu).P[0]
    assert P[0] == pytest.approx(m * V / (cos(slope) + mu * abs(s)), rel=1e-10)
    assert (axes.T @ P)[0] == pytest.approx(m * V, rel=1e-10)
    assert abs(P[2]) == pytest.approx(mu * P[0], rel=1e-10)


@settings(suppress_health_check=[HealthCheck.filter_too_much, HealthCheck.too_slow])
@given(impacts(**PLANE, mu=floats(0.3, 1.0)))
def test_no_smaller_impulse_would_stop_them(impact: Impact) -> None:
    W, v, mu = impact.W, impact.v, impact.mu
    values, axes = np.linalg.eigh(W)
    assume(values[0] <= 1e-12 * values[2] < 1e-3 * values[1])
    free = axes[:, 0] * np.sign(axes[0, 0])  # this impulse does nothing to the ships
    assume(free[0] > 1e-3 < abs(impact.normal[2]))  # less slope is none
    P = solve_gauss_seidel(W, v, mu).P[0]
    assume(np.linalg.norm(v + W @ P) <= 1e-9 * np.linalg.norm(v))  # it sticks
    less = P - 1e-5 * P[0] * free
    assert np.hypot(*less[1:]) > mu * less[0]


@given(impacts(**PLANE), st.floats(-np.pi, np.pi), st.tuples(floats(-1e4, 1e4), floats(-1e4, 1e4)))
def test_the_impulse_turns_with_the_world_swaps_and_mirrors(
    impact: Impact, turn: float, shift: tuple[float, float]
) -> None:
    R = rotation([0.0, 0.0, turn])
    F = np.diag([1.0, -1.0, 1.0])
    P = impulse(impact)
    for other, change in (
        (impact.moved(R, np.array([*shift, 0.0])), R), (impact.swapped(), -np.eye(3)), (impact.mirrored(), F),
    ):  # fmt: skip
        np.testing.assert_allclose(impulse(other), change @ P, rtol=0.0, atol=1e-7 * np.linalg.norm(P))


def head_on(slope: float, V: float) -> tuple[np.ndarray, np.ndarray]:
    """W and v of a ship that is held in heave and runs against a slope."""
    normal, down = np.array([cos(slope), 0.0, sin(slope)]), np.array([-sin(slope), 0.0, cos(slope)])
    axes = np.array([normal, [0.0, 1.0, 0.0], down])
    return axes @ np.diag([1.0 / 4e7, 0.2 / 4e7, 0.0]) @ axes.T, axes @ [-V, 0.0, 0.0]


@given(floats(0.01, 0.7), st.just(0.0) | floats(2e-3, 1.0), floats(0.1, 5.0))
def test_it_is_the_impulse_along_the_path_where_the_slip_keeps_its_direction(slope: float, mu: float, V: float) -> None:
    """Where the slip only slows down, the impact process gives the same impulse. Friction below 0.002 has
    a test of its own."""
    W, v = head_on(slope, V)
    path = solve_impact_process(W, v, mu, 0.0)
    np.testing.assert_allclose(solve_gauss_seidel(W, v, mu).P[0], path.P, rtol=0.0, atol=1e-9 * np.linalg.norm(path.P))


@given(floats(0.01, 0.7), SHARE, floats(0.1, 5.0))
@example(0.625, 2.0**-24, 1.0)
def test_it_is_the_motion_of_the_path_at_any_friction(slope: float, mu: float, V: float) -> None:
    W, v = head_on(slope, V)
    path = solve_impact_process(W, v, mu, 0.0)
    np.testing.assert_allclose(W @ solve_gauss_seidel(W, v, mu).P[0], W @ path.P, rtol=0.0, atol=1e-9 * V)


@pytest.mark.xfail(strict=True, reason="where many impulses stop a ship, friction below 0.002 is none by rounding")
def test_it_is_the_impulse_of_the_path_with_little_friction() -> None:
    missed = {}
    for slope in np.linspace(0.01, 0.7, 300):
        W, v = head_on(slope, 1.0)
        P, path = solve_gauss_seidel(W, v, 2.0**-24).P[0], solve_impact_process(W, v, 2.0**-24, 0.0).P
        missed[slope] = np.linalg.norm(P - path) / np.linalg.norm(path)
    assert {slope: m for slope, m in missed.items() if m > 1e-9} == {}


@pytest.mark.parametrize("mu", [5e-324, 1e-320, 1e-310, 1e-30])
def test_friction_next_to_nothing_is_none(mu: float) -> None:
    """Any inertia: some of these are solved by the bracketed search, which divides by what friction may give."""
    rng = np.random.default_rng(1)
    for _ in range(100):
        root, v = rng.normal(size=(3, 3)), rng.normal(size=3)
        W, v[0] = root @ root.T / 1e8, -abs(v[0])
        without, P = (solve_gauss_seidel(W, v, friction).P for friction in (0.0, mu))
        assert np.abs(P - without).max() <= 1e-12 * np.abs(without).max()
