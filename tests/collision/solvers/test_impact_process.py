"""The impact process of one contact: exact cases, an independent integration, and what holds for all impacts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from shipcollision_fmu.collision.solvers.gauss_seidel import solve_gauss_seidel
from shipcollision_fmu.collision.solvers.impact_process import ImpactProcess, solve_impact_process
from shipcollision_fmu.collision.solvers.poisson_restitution import solve_poisson_impact
from shipcollision_fmu.errors import StepError
from shipcollision_fmu.ship.frames import rotation
from tests.collision.impacts import Array, Impact, check_momentum, floats, impacts
from tests.oracles.newton_impact import solve_newton_impact, stick_energy

PLASTIC = st.just(0.0)


def solved(impact: Impact) -> ImpactProcess:
    return solve_impact_process(impact.W_friction, impact.v, impact.mu, impact.e)


# -- cases with an analytic answer ------------------------------------------------------------------------------------


def river(kappa: float, psi_0: float, psi_f: float) -> tuple[Array, Array, Array]:
    """W, v, and P with mu, of a plastic impact whose slip turns from psi_0 to psi_f.

    With W_tt = a I the slip is a swimmer's course across a river: with psi from W_tn and kappa = mu a/|W_tn|,
        sigma = C tan(psi/2)^kappa / sin(psi),    sigma (cos psi + kappa) = its start + |W_tn| (1 - kappa^2) p
    """
    W_nn, w, a, mu = 1.0, 0.4, 1.7, 0.4 * kappa / 1.7
    sigma = [1.3 * np.tan(0.5 * psi) ** kappa / np.sin(psi) for psi in (psi_0, psi_f)]
    along = [s * (np.cos(psi) + kappa) for s, psi in zip(sigma, (psi_0, psi_f), strict=True)]
    p = (along[1] - along[0]) / (w * (1.0 - kappa**2))
    slip_0, slip_f = (s * np.array([np.cos(psi), np.sin(psi)]) for s, psi in zip(sigma, (psi_0, psi_f), strict=True))
    P_t = (slip_f - slip_0 - [w * p, 0.0]) / a
    W = np.array([[W_nn, w, 0.0], [w, a, 0.0], [0.0, 0.0, a]])
    v = np.array([-(W_nn * p + w * P_t[0]), *slip_0])
    return W, v, np.array([p, *P_t, mu])


@pytest.mark.parametrize("kappa", [0.2, 0.7, 1.6, 3.0])
@pytest.mark.parametrize(("psi_0", "psi_f"), [(3.0, 1.0), (2.0, 0.3), (1.0, 0.1), (3.1, 3.0), (0.5, 0.001)])
@pytest.mark.parametrize("turn", [0.0, 0.7])
def test_turning_slip_has_the_swimmers_course(kappa: float, psi_0: float, psi_f: float, turn: float) -> None:
    """The one turning slip with an analytic answer, which the integration meets to 1e-10 in any tangents."""
    W, v, (*P, mu) = river(kappa, psi_0, psi_f)
    Q = np.eye(3)
    Q[1:, 1:] = rotation([0.0, 0.0, turn])[:2, :2]
    path = solve_impact_process(Q @ W @ Q.T, Q @ v, mu, 0.0)
    np.testing.assert_allclose(path.P, Q @ P, rtol=0.0, atol=1e-10 * np.linalg.norm(P))
    assert path.ending == "slip"


def test_stick_slides_on_and_turns_back_in_the_plane() -> None:
    """Two dimensions, by hand: slip of 1 m/s stops at p = 1/(mu W_tt - W_nt), and what then happens depends on mu."""
    W = np.array([[1.0, 0.4], [0.4, 0.5]])
    v = np.array([-5.0, -1.0])  # friction and coupling both slow the slip
    mu = 0.9  # above W_nt/W_tt = 0.8: it sticks
    path = solve_impact_process(W, v, mu, 0.0)
    assert path.ending == "stick"
    np.testing.assert_allclose(path.P, -np.linalg.solve(W, v), rtol=1e-14)
    mu = 0.3  # below: the slip starts again, the other way
    stop = 1.0 / (0.4 + 0.3 * 0.5)
    v_n = -5.0 + stop * (1.0 + 0.4 * mu)
    rest = -v_n / (1.0 - 0.4 * mu)
    path = solve_impact_process(W, v, mu, 0.0)
    assert path.ending == "reslip"
    np.testing.assert_allclose(path.P, [stop + rest, mu * (stop - rest)], rtol=1e-14)
    # Restitution after the turn: the same slope, and e^2 of the work of compression.
    work = -0.5 * stop * (-5.0 + v_n) - 0.5 * rest * v_n
    back = np.sqrt(2.0 * 0.25 * work / (1.0 - 0.4 * mu))
    path = solve_impact_process(W, v, mu, 0.5)
    np.testing.assert_allclose(path.P, [stop + rest + back, mu * (stop - rest - back)], rtol=1e-14)
    assert path.energy_normal == pytest.approx(0.75 * work, rel=1e-13)


def test_a_jam_is_passed_by_the_stop_of_the_slip() -> None:
    """mu |W_nt| > W_nn: until slip stops, friction presses the hulls together more than the normal parts them."""
    W = np.array([[1.0, 1.5], [1.5, 3.0]])
    mu, e, v = 0.9, 0.5, np.array([-1.0, 2.0])
    assert W[0, 0] - mu * W[0, 1] < 0.0
    path = solve_impact_process(W, v, mu, e)
    stop = 2.0 / (mu * 3.0 - 1.5)
    v_n = -1.0 + stop * (1.0 - 1.5 * mu)
    assert v_n < -1.0
    k = 1.0 - 1.5**2 / 3.0  # stick
    work = 0.5 * stop * (1.0 - v_n) + 0.5 * v_n**2 / k
    p = stop - v_n / k + np.sqrt(2.0 * e**2 * work / k)
    np.testing.assert_allclose(path.P, [p, -mu * stop - 0.5 * (p - stop)], rtol=1e-13)
    assert path.ending == "stick"


def runge_kutta(W: Array, v: Array, mu: float, e: float, steps: int) -> tuple[Array, float]:
    """P, and the least slip on the way: dv/dp = W (n - mu slip direction) literally, in steps of v_n/W_nn/steps."""
    h, least = -v[0] / W[0, 0] / steps, [np.inf]

    def rate(x: Array) -> Array:  # of v, P, work
        least[0] = min(least[0], float(np.hypot(x[1], x[2])))
        q = np.array([1.0, *(-mu * x[1:3] / np.hypot(x[1], x[2]))])
        return np.array([*(W @ q), *q, x[0]])

    def step(x: Array, h: float) -> Array:
        k_1 = rate(x)
        k_2 = rate(x + 0.5 * h * k_1)
        k_3 = rate(x + 0.5 * h * k_2)
        k_4 = rate(x + h * k_3)
        return x + h / 6.0 * (k_1 + 2.0 * k_2 + 2.0 * k_3 + k_4)

    def until(x: Array, reached: Callable[[Array], bool]) -> Array:
        for _ in range(20 * steps):
            new = step(x, h)
            if reached(new):
                low, high = 0.0, h
                for _ in range(55):
                    middle = 0.5 * (low + high)
                    low, high = (low, middle) if reached(step(x, middle)) else (middle, high)
                return step(x, high)
            x = new
        return np.full(7, np.nan)

    x = until(np.array([*v, 0.0, 0.0, 0.0, 0.0]), lambda x: x[0] >= 0.0)
    if e > 0.0:
        left = (1.0 - e**2) * x[6]
        x = until(x, lambda x: x[6] >= left)
    return x[3:6], least[0]


@pytest.mark.slow
@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_turning_slip_equals_the_literal_integration(e: float) -> None:
    """Random W with strong coupling, slips that do not stop: Runge-Kutta's answer, as far as that is accurate."""
    rng, compared = np.random.default_rng(5), 0
    while compared < 6:
        A = rng.normal(size=(3, 3))
        W, v, mu = A @ A.T, np.array([-1.0, *rng.normal(size=2)]), float(rng.uniform(0.1, 1.0))
        coarse, least = runge_kutta(W, v, mu, e, 200)
        if not least > 0.1:
            continue
        fine = runge_kutta(W, v, mu, e, 400)[0]
        best = fine + (fine - coarse) / 15.0
        path = solve_impact_process(W, v, mu, e)
        np.testing.assert_allclose(path.P, best, rtol=0.0, atol=1e-9 * np.linalg.norm(best))
        compared += 1


# -- what holds for all -----------------------------------------------------------------------------------------------


def well_conditioned(W: Array) -> bool:
    """Not where the ships are a million times heavier across the normal than along it and feel it all the same: there
    W, and with it every figure, holds only some seven digits."""
    mobility, axes = np.linalg.eigh(W[1:, 1:])
    return bool(((mobility > 1e-6 * W[0, 0]) | (np.abs(W[0, 1:] @ axes) < 1e-12 * W[0, 0])).all())


@given(impacts())
def test_energy_is_never_created_and_its_parts_add_up(impact: Impact) -> None:
    assume(well_conditioned(impact.W_friction))
    path = solved(impact)
    after = impact.after(path.P)
    lost = impact.scale - after.scale
    assert path.energy_normal >= -1e-12 * stick_energy(impact.W_friction, impact.v)
    assert path.energy_tangential >= -1e-12 * stick_energy(impact.W_friction, impact.v)
    parts = path.energy_normal + path.energy_tangential + impact.held_energy(path.P)
    assert parts == pytest.approx(lost, rel=1e-9, abs=1e-12 * impact.scale)


@given(impacts())
def test_ships_take_equal_and_opposite_impulses_at_one_point(impact: Impact) -> None:
    check_momentum(impact, solved(impact).P)


@given(impacts())
def test_no_approach_is_left_and_friction_stays_in_its_cone(impact: Impact) -> None:
    path, closing = solved(impact), -float(impact.v[0])
    v = impact.after(path.P).v
    size = np.linalg.norm(impact.v)
    assert v[0] >= -1e-11 * size
    if impact.e == 0.0:
        assert abs(v[0]) <= 1e-11 * size
    assert np.hypot(path.P[1], path.P[2]) <= impact.mu * path.P[0] * (1 + 1e-12) + 1e-12 * path.P[0]
    if path.ending == "stick":
        slip = (impact.v + impact.W_friction @ path.P)[1:]
        assert np.hypot(*slip) <= 1e-11 * size
    assert closing > 0.0


@given(impacts(mu=st.just(0.0)))
def test_without_friction_it_is_newtons_restitution(impact: Impact) -> None:
    path = solved(impact)
    assert path.P[0] == pytest.approx(-(1 + impact.e) * impact.v[0] / impact.W_friction[0, 0], rel=1e-13)
    assert path.energy_tangential == pytest.approx(0.0, abs=1e-12 * impact.scale)


def same(impact: Impact, one: ImpactProcess, other: ImpactProcess, change: Array) -> None:
    size = np.linalg.norm(one.P)
    # Of the work e^2 comes back. Below 1e-7 its rounding, 1e-15 of the work, is seen in e: up to e itself.
    unsure = min(impact.e, 1e-15 / impact.e) if 0.0 < impact.e < 1e-7 else 0.0
    np.testing.assert_allclose(other.P, change @ one.P, rtol=0.0, atol=(1e-9 + unsure) * size)
    np.testing.assert_allclose(
        [other.energy_normal, other.energy_tangential], [one.energy_normal, one.energy_tangential],
        rtol=0.0, atol=1e-9 * stick_energy(impact.W_friction, impact.v),
    )  # fmt: skip


def axes_change(old: Impact, new: Impact, of_n: Array) -> Array:
    """From contact axes of one impact to those of another, through the change `of_n` of n."""
    return new.axes @ of_n @ old.axes.T


@given(impacts())
def test_swapping_the_ships_swaps_the_impulse(impact: Impact) -> None:
    other = impact.swapped()
    same(impact, solved(impact), solved(other), axes_change(impact, other, -np.eye(3)))


@given(impacts(), st.floats(-np.pi, np.pi), st.tuples(floats(-1e4, 1e4), floats(-1e4, 1e4)))
def test_turning_and_shifting_the_world_turns_the_impulse(
    impact: Impact, turn: float, shift: tuple[float, float]
) -> None:
    R = rotation([0.0, 0.0, turn])
    other = impact.moved(R, np.array([*shift, 0.0]))
    same(impact, solved(impact), solved(other), axes_change(impact, other, R))


@given(impacts())
def test_mirroring_port_and_starboard_mirrors_the_impulse(impact: Impact) -> None:
    other = impact.mirrored()
    same(impact, solved(impact), solved(other), axes_change(impact, other, np.diag([1.0, -1.0, 1.0])))


@given(impacts(), floats(1e-3, 1e3), floats(1e-3, 1e3))
def test_speed_and_mass_only_set_the_scale(impact: Impact, speed: float, mass: float) -> None:
    W, v = impact.W_friction, impact.v
    one = solve_impact_process(W, v, impact.mu, impact.e)
    other = solve_impact_process(W / mass, v * speed, impact.mu, impact.e)
    np.testing.assert_allclose(other.P / (mass * speed), one.P, rtol=0.0, atol=1e-9 * np.linalg.norm(one.P))


# -- against the other laws -------------------------------------------------------------------------------------------


@given(impacts(mu=floats(1.0, 10.0), e=PLASTIC))
def test_plastic_impact_that_ends_in_stick_is_that_of_newton_and_gauss_seidel(impact: Impact) -> None:
    path = solved(impact)
    assume(path.ending == "stick")
    newton = solve_newton_impact(impact.W_friction, impact.v, impact.mu, 0.0)
    assert newton.mode == "stick"
    gauss_seidel = solve_gauss_seidel(impact.W_friction, impact.v, impact.mu).P[0]
    # Ships that move along a direction by a share below 1e-12 count as held there: sqrt(share) of the speed is left.
    # Above, the inverse of W in Newton's impact is accurate to eps/share.
    values = np.linalg.eigvalsh(impact.W_friction)
    share = abs(values[0] / values[2])
    assume(share < 1e-12 or share > 1e-7)
    accuracy = max(1e-8, 2.0 * share**0.5 if share < 1e-12 else 0.0)
    for P in (newton.P, gauss_seidel):
        # Velocities, not impulses: W of ships that move in the plane leaves some of the impulse free.
        np.testing.assert_allclose(
            impact.W_friction @ P, impact.W_friction @ path.P, rtol=0.0, atol=accuracy * np.linalg.norm(impact.v)
        )
    lost = path.energy_normal + path.energy_tangential
    assert lost == pytest.approx(stick_energy(impact.W_friction, impact.v), rel=accuracy)


@given(impacts(degrees_of_freedom=(3,), slope=st.just(0.0)))
def test_impact_in_the_plane_that_slides_one_way_is_that_of_newton_and_gauss_seidel(impact: Impact) -> None:
    """With restitution too: over a constant slope the rules of Newton, Poisson and Stronge are one."""
    path = solved(impact)
    assume(path.ending == "slip")
    newton = solve_newton_impact(impact.W_friction, impact.v, impact.mu, impact.e)
    gauss_seidel = solve_poisson_impact(impact.W_friction, impact.v, impact.mu, impact.e).P[0]
    for P in (newton.P, gauss_seidel):
        np.testing.assert_allclose(P, path.P, rtol=0.0, atol=1e-8 * np.linalg.norm(path.P))


@given(impacts(mu=st.just(0.0)))
def test_frictionless_impact_is_that_of_gauss_seidel(impact: Impact) -> None:
    path, gauss_seidel = solved(impact), solve_poisson_impact(impact.W_friction, impact.v, impact.mu, impact.e)
    np.testing.assert_allclose(gauss_seidel.P[0], path.P, rtol=0.0, atol=1e-8 * np.linalg.norm(path.P))


def test_where_the_laws_differ_a_slip_that_turns() -> None:
    """Friction of Gauss-Seidel has one direction per impact, that of the last slip; Newton's impact has that of the
    first slip. In the impact process friction turns with the slip. The impulses then differ by per cents, and all three
    are plastic and inside the cone."""
    W, v, (*P, mu) = river(0.7, 2.0, 0.3)
    ours, last, first = np.array(P), solve_gauss_seidel(W, v, mu).P[0], solve_newton_impact(W, v, mu, 0.0).P
    for other in (last, first):
        assert 0.01 < np.linalg.norm(other - ours) / np.linalg.norm(ours) < 0.2
        assert (v + W @ other)[0] == pytest.approx(0.0, abs=1e-12)
        assert np.hypot(*other[1:]) == pytest.approx(mu * other[0], rel=1e-12)
    assert np.hypot(*ours[1:]) < mu * ours[0]


@given(impacts())
def test_a_fixed_obstacle_stops_the_ship_and_stays(impact: Impact) -> None:
    """M^-1 = 0, the limit of mass to infinity: all the energy lost is the ship's."""
    against = replace(impact, b=replace(impact.b, M_inverse=np.zeros((6, 6)), nu=np.zeros(6), fixed=True))
    assume(against.v[0] < -1e-3)
    assume(well_conditioned(against.W_friction))
    path = solved(against)
    after = against.after(path.P)
    assert not after.b.nu.any()
    assert after.v[0] >= -1e-11 * np.linalg.norm(against.v)
    lost = against.a.energy - after.a.energy
    parts = path.energy_normal + path.energy_tangential + against.held_energy(path.P)
    assert parts == pytest.approx(lost, rel=1e-9, abs=1e-12 * against.a.energy)


@pytest.mark.parametrize("e", [0.0, 0.4])
def test_mass_to_infinity_is_the_fixed_obstacle(e: float) -> None:
    W_a = np.array([[1.0, 0.3, -0.2], [0.3, 0.8, 0.1], [-0.2, 0.1, 2.0]])
    W_b = np.array([[2.0, -0.4, 0.1], [-0.4, 1.5, 0.0], [0.1, 0.0, 0.7]])
    v = np.array([-3.0, 2.0, -1.0])
    fixed = solve_impact_process(W_a, v, 0.3, e).P
    for lightness in (1e-4, 1e-6, 1e-8):
        P = solve_impact_process(W_a + lightness * W_b, v, 0.3, e).P
        assert np.linalg.norm(P - fixed) <= 10.0 * lightness * np.linalg.norm(fixed)


# -- refusals ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("v_n", [0.0, 2.0, -1e-200])
def test_no_approach_no_impulse(v_n: float) -> None:
    path = solve_impact_process(np.eye(3), np.array([v_n, 1.0, 0.0]), 0.3, 0.5)
    assert not path.P.any()
    assert (path.ending, path.energy_normal, path.energy_tangential) == ("apart", 0.0, 0.0)


def test_two_fixed_bodies_are_refused() -> None:
    with pytest.raises(
        StepError, match="W_nn = 0 1/kg at a contact must be > 0: neither ship can move along the normal"
    ):
        solve_impact_process(np.zeros((3, 3)), np.array([-1.0, 0.0, 0.0]), 0.3, 0.0)


@pytest.mark.parametrize("slip", [1e-300, 1e-16, 1e-9, 1e9, 1e17])
@pytest.mark.parametrize("mu", [1e-300, 1e-9, 0.5])
def test_slips_and_frictions_of_any_size_end(slip: float, mu: float) -> None:
    W = np.array([[1.0, 0.3, -0.2], [0.3, 0.8, 0.1], [-0.2, 0.1, 2.0]])
    path = solve_impact_process(W, np.array([-1.0, slip, 0.5 * slip]), mu, 0.5)
    assert np.isfinite(path.P).all()
    assert np.hypot(*path.P[1:]) <= mu * path.P[0] * (1 + 1e-12)
    assert path.energy_normal > 0.0
