"""Restitution of a whole impact: Poisson's share, one patch as one impact, and never a gain of energy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from shipcollision_fmu.collision.solvers.gauss_seidel import solve_gauss_seidel
from shipcollision_fmu.collision.solvers.poisson_restitution import solve_poisson_impact

from .test_gauss_seidel import SEEDS, SHARE, random_patch


@given(SEEDS, SHARE)
def test_frictionless_contact_returns_that_share_of_the_approach(seed: int, e: float) -> None:
    W, v = random_patch(seed, 1)
    assume(v[0] < -1e-3)
    after = v + W @ solve_poisson_impact(W, v, 0.0, e).P.ravel()
    assert after[0] == pytest.approx(-e * v[0], rel=1e-9, abs=1e-12)


@given(SEEDS, SHARE)
def test_sticking_contact_sticks_to_the_end(seed: int, e: float) -> None:
    """With friction without limit slip stays zero in both phases, and the normal impulse is 1 + e times the plastic."""
    W, v = random_patch(seed, 1)
    assume(v[0] < -1e-3)
    plastic = -np.linalg.solve(W, v)
    assume(np.hypot(*plastic[1:]) < 2.0 * plastic[0])
    P = solve_poisson_impact(W, v, 50.0, e).P[0]
    after = v + W @ P
    assert P[0] == pytest.approx((1 + e) * plastic[0], rel=1e-9)
    assert np.abs(after[1:]).max() <= 1e-9 * np.abs(v).max()


@given(SEEDS, SHARE)
def test_contact_that_slides_one_way_follows_newtons_rule_too(seed: int, e: float) -> None:
    """Slip in the line of the first tangent, ships that do not turn it: P = (1 + e) v_n / (W_nn + s mu W_nt)."""
    W, v = random_patch(seed, 1, degrees_of_freedom=3)
    s, mu = -np.sign(v[1]), 0.1
    P_n = -v[0] / (W[0, 0] + s * mu * W[0, 1])
    slip_after = v[1] + (1 + e) * P_n * (W[1, 0] + s * mu * W[1, 1])
    assume(v[0] < -1e-3)
    assume(slip_after * v[1] > 0.0)
    P = solve_poisson_impact(W, v, mu, e).P[0]
    np.testing.assert_allclose(P, (1 + e) * P_n * np.array([1.0, s * mu, 0.0]), rtol=1e-8, atol=1e-8 * P_n)
    assert (v + W @ P)[0] == pytest.approx(-e * v[0], rel=1e-8, abs=1e-9)


@given(SEEDS, st.integers(1, 4), SHARE, SHARE)
def test_energy_is_never_created(seed: int, contacts: int, mu: float, e: float) -> None:
    W, v = random_patch(seed, contacts)
    assume(e == 0.0 or e > 1e-9)  # at 1e-213 squares of the impulse of restitution are zero, and it is divided by them
    P = solve_poisson_impact(W, v, mu, e).P.ravel()
    assert P @ (v + 0.5 * W @ P) <= 1e-9 * np.abs(P * v).sum()


@given(SEEDS, st.integers(1, 3), SHARE, SHARE)
def test_no_approach_is_left_and_friction_stays_in_the_cone(seed: int, contacts: int, mu: float, e: float) -> None:
    W, v = random_patch(seed, contacts)
    assume(v[0::3].min() < 0.0)
    solution = solve_poisson_impact(W, v, mu, e)
    assume(solution.residual <= 1e-11)
    after = v + W @ solution.P.ravel()
    assert after[0::3].min() >= 1e-8 * v[0::3].min()
    P = solution.P
    assert (np.hypot(P[:, 1], P[:, 2]) - mu * P[:, 0]).max() <= 1e-9 * max(P[:, 0].max(), 1e-300)


@given(SEEDS, SHARE)
def test_a_patch_springs_back_as_one(seed: int, e: float) -> None:
    """Four corners of an area closing at the same speed return e of it: the patch as a whole, not each on its own."""
    W, v = random_patch(seed, 1)
    W_four, v_four = np.tile(W, (4, 4)), np.tile(v, 4)
    assume(v[0] < -1e-3)
    one, four = solve_poisson_impact(W, v, 0.2, e), solve_poisson_impact(W_four, v_four, 0.2, e)
    scale = np.abs(one.P).max()
    np.testing.assert_allclose(four.P.sum(axis=0), one.P.sum(axis=0), rtol=1e-7, atol=1e-7 * scale)


def test_plastic_impact_is_the_plain_solution() -> None:
    W, v = random_patch(5, 3)
    v[0::3] = -np.abs(v[0::3])
    np.testing.assert_array_equal(solve_poisson_impact(W, v, 0.3, 0.0).P, solve_gauss_seidel(W, v, 0.3).P)


@given(SEEDS, st.floats(0.1, 1.0), st.sampled_from([3, 6]))
def test_friction_of_one_contact_is_against_the_slip_or_sticks(seed: int, mu: float, dof: int) -> None:
    """Also for ships held in some direction, whose W is singular."""
    W, v = random_patch(seed, 1, dof)
    assume(v[0] < -1e-3)
    P = solve_poisson_impact(W, v, mu, 0.0).P[0]
    after = v + W @ P
    assert float(P[1:] @ after[1:]) <= 1e-9 * float(np.abs(P).max() * np.abs(v).max())
    assert float(P @ (v + 0.5 * W @ P)) <= 0.0
