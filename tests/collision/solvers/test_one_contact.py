"""One contact of ships that are held, at a normal that slopes: friction meets the inertia of their heave, so that one
impulse stops them."""

from __future__ import annotations

from math import cos, sin

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from shipcollision_fmu.collision.solvers.gauss_seidel import solve_gauss_seidel
from shipcollision_fmu.collision.solvers.impact_process import solve_impact_process
from shipcollision_fmu.ship.frames import rotation
from tests.collision.impacts import SHARE, Impact, floats, impacts

PLANE = {"degrees_of_freedom": (3,), "e": st.just(0.0)}


def impulse(impact: Impact) -> np.ndarray:
    """In n."""
    P: np.ndarray = impact.axes.T @ solve_gauss_seidel(impact.W_friction, impact.v, impact.mu).P[0]
    return P


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


def head_on(slope: float, V: float, climbing: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """W and v of a ship that is held in heave, in which it weighs twice as much, and runs against a slope."""
    normal, down = np.array([cos(slope), 0.0, sin(slope)]), np.array([-sin(slope), 0.0, cos(slope)])
    axes = np.array([normal, [0.0, 1.0, 0.0], down])
    W = axes @ np.diag([1.0 / 4e7, 0.2 / 4e7, 0.0]) @ axes.T
    W[2, 2] += cos(slope) ** 2 * 0.5 / 4e7
    return W, axes @ [-V, 0.0, 0.0] + [0.0, 0.0, climbing]


@given(floats(0.01, 0.7), SHARE, floats(0.1, 5.0), floats(0.0, 5.0))
def test_it_is_the_impulse_along_the_path_where_the_slip_keeps_its_direction(
    slope: float, mu: float, V: float, climbing: float
) -> None:
    W, v = head_on(slope, V, climbing)
    path = solve_impact_process(W, v, mu, 0.0)
    assume(path.ending == "slip")
    np.testing.assert_allclose(solve_gauss_seidel(W, v, mu).P[0], path.P, rtol=0.0, atol=1e-9 * np.linalg.norm(path.P))


@pytest.mark.parametrize("mu", [2.0**-40, 2.0**-24, 1e-4])
def test_it_is_the_impulse_of_the_path_with_little_friction(mu: float) -> None:
    """But for friction on the way, which turns when the slip stops. By rounding, little friction was none or full."""
    for slope in np.linspace(0.01, 0.7, 300):
        W, v = head_on(slope, 1.0)
        P, path = solve_gauss_seidel(W, v, mu).P[0], solve_impact_process(W, v, mu, 0.0).P
        assert np.linalg.norm(P - path) <= 3.0 * mu * np.linalg.norm(path)


@pytest.mark.parametrize("mu", [5e-324, 1e-320, 1e-310, 1e-30])
def test_friction_next_to_nothing_is_none(mu: float) -> None:
    """Any inertia: some of these are solved by the bracketed search, which divides by what friction may give."""
    rng = np.random.default_rng(1)
    for _ in range(100):
        root, v = rng.normal(size=(3, 3)), rng.normal(size=3)
        W, v[0] = root @ root.T / 1e8, -abs(v[0])
        without, P = (solve_gauss_seidel(W, v, friction).P for friction in (0.0, mu))
        assert np.abs(P - without).max() <= 1e-12 * np.abs(without).max()
