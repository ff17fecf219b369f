"""The bound on the work of a step: what is spent is counted, and the best answer so far obeys the one-sided laws."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from shipcollision_fmu.collision.solvers.contact_law import law_residual
from shipcollision_fmu.collision.solvers.gauss_seidel import LEAST_SWEEPS, principal_axes, solve_gauss_seidel
from shipcollision_fmu.collision.solvers.poisson_restitution import LEAST_REBOUNDING_APPROACH, solve_poisson_impact
from shipcollision_fmu.collision.solvers.work_limit import FOUR_SHIPS, FURTHER_SHIP, StepWork, WorkLimit

from .test_gauss_seidel import SEEDS, SHARE, random_patch


@given(SEEDS, st.integers(2, 10), SHARE, SHARE, st.sampled_from([0.0, 1e2, 1e3, 1e4]))
def test_an_early_end_keeps_to_the_cone_and_has_its_own_residual(
    seed: int, contacts: int, mu: float, e: float, left: float
) -> None:
    W, v = random_patch(seed, contacts, scatter=0.5)
    assume(v[0::3].min() < -1e-2)
    work = WorkLimit(left)
    solution = solve_poisson_impact(W, v, mu, e, work=work)
    P = solution.P
    assert np.isfinite(P).all()
    assert P[:, 0].min() >= 0.0
    assert (np.hypot(P[:, 1], P[:, 2]) - mu * P[:, 0]).max() <= 1e-9 * max(P[:, 0].max(), 1e-300)
    plastic = solve_gauss_seidel(W, v, mu, work=WorkLimit(left))
    T = principal_axes(W)
    W_p, v_p, P_p = T @ W @ T.T, T @ v, (T @ plastic.P.ravel()).reshape(-1, 3)
    assert plastic.residual == pytest.approx(law_residual(W_p, v_p, mu, P_p) / -v[0::3].min(), rel=1e-6, abs=1e-12)


@given(SEEDS, st.integers(2, 10), SHARE)
def test_work_is_bounded(seed: int, contacts: int, mu: float) -> None:
    """By the limit, the sweeps that are made in any case, and one step that was begun."""
    W, v = random_patch(seed, contacts, scatter=0.5)
    work, one = WorkLimit(2e3), WorkLimit(0.0)
    solve_poisson_impact(W, v, mu, 0.5, work=work)
    for _ in range(2 * LEAST_SWEEPS + 2):
        one.spend_sweep(contacts)
    one.spend_newton_step(contacts, contacts)
    one.spend_gradient_step(contacts)
    assert work.left >= one.left


@given(SEEDS, st.integers(1, 4), SHARE, SHARE)
def test_a_limit_that_is_not_reached_changes_nothing(seed: int, contacts: int, mu: float, e: float) -> None:
    W, v = random_patch(seed, contacts)
    free, bounded = solve_poisson_impact(W, v, mu, e), solve_poisson_impact(W, v, mu, e, work=WorkLimit(1e9))
    np.testing.assert_array_equal(free.P, bounded.P)


@given(SEEDS, st.integers(1, 4), SHARE, SHARE)
def test_what_approaches_more_slowly_than_any_rebound_is_plastic(seed: int, k: int, mu: float, e: float) -> None:
    W, v = random_patch(seed, k)
    assume(v[0::3].min() < -1e-3)
    slow = v * (0.5 * LEAST_REBOUNDING_APPROACH / -v[0::3].min())
    plastic = solve_gauss_seidel(W, slow, mu, scale=LEAST_REBOUNDING_APPROACH)
    np.testing.assert_array_equal(solve_poisson_impact(W, slow, mu, e).P, plastic.P)


@pytest.mark.parametrize(("ships", "H", "work"), [
    (2, 0.1, FOUR_SHIPS), (4, 0.01, FOUR_SHIPS), (8, 0.1, FOUR_SHIPS + 4 * FURTHER_SHIP), (2, 1.0, 10 * FOUR_SHIPS),
])  # fmt: skip
def test_a_step_has_work_by_its_ships_and_length(ships: int, H: float, work: float) -> None:
    step = StepWork()
    assert step.lend().left == inf
    step.renew(ships, H)
    total = 0.0
    for _ in range(100):
        lent = step.lend()
        total += lent.left
        lent.left = 0.0
        step.settle(lent)
    assert total == pytest.approx(work)


@pytest.mark.parametrize("contacts", [4, 12])
@pytest.mark.parametrize("left", [0.0, 3e2])
def test_an_early_end_gains_no_energy_and_moves_the_ships_by_equal_impulses(contacts: int, left: float) -> None:
    """W P is the change of the relative velocity by P on one body and -P on the other: momentum balances by
    construction. An unconverged plastic answer may miss the law, by less than the approach; passivity.py scales back
    what would gain energy, so P.(v + W P / 2) stays small against the energy of the impact."""
    for seed in range(12):
        W, v = random_patch(seed, contacts, scatter=0.3)
        v[0::3] = -np.abs(v[0::3])
        solution = solve_gauss_seidel(W, v, 0.4, work=WorkLimit(left))
        P = solution.P.ravel()
        assert solution.residual <= 1.0
        assert P @ (v + 0.5 * W @ P) <= 1e-9 * abs(P @ v)
