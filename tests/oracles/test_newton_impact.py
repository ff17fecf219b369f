"""Newton's impact of one contact: its identities, and the limits that its docstring states."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from shipcollision_fmu.collision.solvers.impact_process import solve_impact_process
from shipcollision_fmu.errors import StepError
from shipcollision_fmu.ship.frames import rotation
from tests.collision.impacts import Impact, check_momentum, floats, impacts
from tests.oracles.newton_impact import NewtonImpact, solve_newton_impact, stick_energy

PLASTIC = st.just(0.0)


def solved(impact: Impact) -> NewtonImpact:
    """Newton's solution of an impact that has one."""
    try:
        return solve_newton_impact(impact.W_friction, impact.v, impact.mu, impact.e)
    except StepError:
        assume(False)
        raise


@given(impacts())
def test_restitution_cone_and_the_energy_that_the_ships_lose(impact: Impact) -> None:
    form = solved(impact)
    after, size = impact.after(form.P), np.linalg.norm(impact.v)
    np.testing.assert_allclose(after.v[0], form.after[0], rtol=0.0, atol=1e-10 * size)
    assert form.after[0] == pytest.approx(-impact.e * impact.v[0], rel=1e-8, abs=1e-10 * size)
    assert np.hypot(*form.P[1:]) <= impact.mu * form.P[0] * (1 + 1e-12)
    lost = impact.scale - after.scale
    parts = form.energy_normal + form.energy_tangential + impact.held_energy(form.P)
    assert parts == pytest.approx(lost, rel=1e-9, abs=1e-12 * impact.scale)


@given(impacts())
def test_ships_take_equal_and_opposite_impulses_at_one_point(impact: Impact) -> None:
    check_momentum(impact, solved(impact).P)


@given(impacts(e=PLASTIC))
def test_plastic_impact_never_creates_energy(impact: Impact) -> None:
    form = solved(impact)
    assert form.energy_normal + form.energy_tangential >= -1e-12 * stick_energy(impact.W_friction, impact.v)


@given(impacts(mu=st.just(1e6), e=PLASTIC))
def test_stick_takes_all_the_energy_of_the_relative_motion(impact: Impact) -> None:
    form = solved(impact)
    assume(form.mode == "stick")
    stick = stick_energy(impact.W_friction, impact.v)
    assert form.energy_normal + form.energy_tangential == pytest.approx(stick, rel=1e-9)


@given(impacts(), st.floats(-np.pi, np.pi))
def test_swap_mirror_and_turn(impact: Impact, turn: float) -> None:
    form, R = solved(impact), rotation([0.0, 0.0, turn])
    changed = (
        (impact.swapped(), -np.eye(3)),
        (impact.mirrored(), np.diag([1.0, -1.0, 1.0])),
        (impact.moved(R, np.array([700.0, -30.0, 0.0])), R),
    )
    for other, of_n in changed:
        expected = other.axes @ of_n @ impact.axes.T @ form.P
        P = solved(other).P
        # Next to the edge of the cone rounding decides between stick and slide, and both are the same there.
        np.testing.assert_allclose(P, expected, rtol=0.0, atol=1e-8 * np.linalg.norm(form.P))


def test_newtons_restitution_can_create_energy_and_stronges_cannot() -> None:
    """The defect, in the plane: all slip is stopped, most of the approach with it, and half of it is given back."""
    W, v, mu, e = np.array([[1.0, -1.2], [-1.2, 1.5]]), np.array([-1.0, 1.0]), 0.9, 0.5
    form, path = solve_newton_impact(W, v, mu, e), solve_impact_process(W, v, mu, e)
    assert form.mode == "stick"
    had = 0.5 * v @ np.linalg.solve(W, v)
    gained = 0.5 * form.after @ np.linalg.solve(W, form.after) - had
    assert gained == pytest.approx(-(form.energy_normal + form.energy_tangential), rel=1e-12)
    assert gained == pytest.approx(2.75 * had, rel=1e-9)
    assert path.energy_normal > 0.0
    assert path.energy_tangential > 0.0


@pytest.mark.slow
def test_newtons_restitution_creates_energy_in_some_random_geometries() -> None:
    """How often, over 4000 random W in the plane with mu 0 to 1, as shares: none at e = 0, some at e = 0.5."""
    for e, least, most in ((0.0, 0, 0), (0.5, 4, 200)):
        rng, gains = np.random.default_rng(2014), 0
        for _ in range(4000):
            A = rng.normal(size=(2, 3))
            W, v = A @ A.T, np.array([-1.0, rng.normal()])
            form = solve_newton_impact(W, v, rng.uniform(), e)
            path = solve_impact_process(W, v, rng.uniform(), e)
            gains += form.energy_normal + form.energy_tangential < -1e-9
            assert min(path.energy_normal, path.energy_tangential) >= -1e-12
        assert least <= gains <= most


def test_sliding_formula_says_where_it_has_no_solution() -> None:
    W = np.array([[0.4, 0.5, 0.0], [0.5, 3.0, 0.0], [0.0, 0.0, 0.6]])
    v = np.array([-1.0, 12.0, -16.0])
    with pytest.raises(StepError, match=r"sliding has no solution: W_nn - mu W_nt.D = -0.2 1/kg at mu = 2 must be"):
        solve_newton_impact(W, v, 2.0, 0.0)
    assert solve_impact_process(W, v, 2.0, 0.0).after[0] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("v_n", [0.0, 1.0])
def test_no_approach_no_impulse(v_n: float) -> None:
    form = solve_newton_impact(np.eye(2), np.array([v_n, 1.0]), 0.3, 0.5)
    assert (form.mode, form.P.any(), form.energy_normal) == ("apart", False, 0.0)


@given(floats(0.0, 0.99), floats(0.0, 1.0))
def test_slip_that_has_yet_to_start_goes_where_the_normal_impulse_drives_it(mu: float, e: float) -> None:
    W, v = np.array([[1.0, 0.9], [0.9, 0.9]]), np.array([-2.0, 0.0])
    form = solve_newton_impact(W, v, mu, e)
    assert form.mode == "slide"
    assert form.P[1] == pytest.approx(-mu * form.P[0])
