"""Block projected Gauss-Seidel: what any solution satisfies, over random ships and contacts."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from shipcollision_fmu.collision.dynamics.contact import point_jacobian
from shipcollision_fmu.collision.dynamics.contact_frame import contact_axes
from shipcollision_fmu.collision.solvers.aclm_fixed_point import solve_aclm
from shipcollision_fmu.collision.solvers.contact_law import law_residual
from shipcollision_fmu.collision.solvers.gauss_seidel import solve_gauss_seidel
from shipcollision_fmu.collision.solvers.poisson_restitution import solve_poisson_impact
from shipcollision_fmu.ship.degrees_of_freedom import FREE, free_inverse, level_axes
from shipcollision_fmu.ship.frames import rotation
from shipcollision_fmu.ship.inertia import added_mass_matrix, rigid_body_inertia
from tests.collision.impacts import Impact, Ship, floats, impacts

SEEDS = st.integers(0, 2**32 - 1)
SHARE = floats(0.0, 1.0)  # without subnormal numbers: at a friction of 5e-324 the search on the disc overflows


def random_patch(
    seed: int, contacts: int, degrees_of_freedom: int = 6, scatter: float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    """W and v of two random ships with added mass that touch at points within some metres of each other. scatter: how
    far the normals differ [rad, about]."""
    rng = np.random.default_rng(seed)
    normal = rng.normal(size=3) * [1.0, 1.0, 0.1 if degrees_of_freedom == 6 or scatter else 0.0]
    normal = normal / np.linalg.norm(normal)
    normals = [normal + scatter * rng.normal(size=3) for _ in range(contacts)]
    axes = [contact_axes(n / np.linalg.norm(n)) for n in normals]
    offsets = rng.normal(size=(contacts, 3)) * ([8.0, 8.0, 6.0] if scatter else [1.0, 1.0, 6.0])
    W = np.zeros((3 * contacts, 3 * contacts))
    v = np.zeros(3 * contacts)
    for sign in (-1.0, 1.0):
        m = 10 ** rng.uniform(6.5, 8.7)
        M = rigid_body_inertia(m, rng.normal(size=3) * [5, 0, 3], [12.0, 60.0, 60.0]) + added_mass_matrix(
            0.05 * m, 0.85 * m, m, 0.2 * m * 144, m * 3600, 0.21 * m * 3600, z_y=4.0
        )
        base = rng.normal(size=3) * [100.0, 15.0, 8.0]
        G = sign * np.vstack([a @ point_jacobian(np.eye(3), base + o) for a, o in zip(axes, offsets, strict=True)])
        nu = rng.normal(size=6) * [4.0, 1.0, 0.1, 0.01, 0.003, 0.01]
        nu *= np.isin(range(6), FREE[degrees_of_freedom])
        W += G @ free_inverse(M, degrees_of_freedom) @ G.T
        v += G @ nu
    return W, v


def check_solution(W: np.ndarray, v: np.ndarray, mu: float, P: np.ndarray, accuracy: float) -> None:
    """The conditions of plastic impact with Coulomb friction, relative to approach speed and impulse."""
    speed, impulse = -v[0::3].min(), max(P[:, 0].max(), 1e-300)
    after = (v + W @ P.ravel()).reshape(-1, 3)
    assert after[:, 0].min() >= -accuracy * speed, "approach left"
    assert P[:, 0].min() >= 0.0, "pull"
    assert np.abs(P[:, 0] * after[:, 0]).max() <= accuracy * speed * impulse, "impulse where the contact opens"
    tangential, slip = np.hypot(P[:, 1], P[:, 2]), np.hypot(after[:, 1], after[:, 2])
    assert (tangential - mu * P[:, 0]).max() <= 1e-12 * impulse, "friction outside the cone"
    for P_i, v_i, slip_i in zip(P, after, slip, strict=True):
        if slip_i > 1e-6 * speed and P_i[0] > 1e-6 * impulse:
            against = P_i[1:] + mu * P_i[0] * v_i[1:] / slip_i
            assert np.hypot(*against) <= 1e3 * accuracy * impulse, "friction not against the slip"


@given(SEEDS, SHARE, st.sampled_from([3, 4, 6]))
def test_one_contact_is_solved_exactly(seed: int, mu: float, dof: int) -> None:
    W, v = random_patch(seed, 1, dof)
    assume(v[0] < 0.0)
    solution = solve_gauss_seidel(W, v, mu)
    assert solution.sweeps == 1
    assert solution.residual <= 1e-12
    check_solution(W, v, mu, solution.P, 1e-12)


@given(SEEDS, st.integers(2, 4), SHARE, st.sampled_from([3, 4, 6]))
def test_several_contacts_obey_the_law(seed: int, contacts: int, mu: float, dof: int) -> None:
    W, v = random_patch(seed, contacts, dof)
    assume(v[0::3].min() < 0.0)
    solution = solve_gauss_seidel(W, v, mu)
    assert solution.residual == pytest.approx(law_residual(W, v, mu, solution.P) / -v[0::3].min(), abs=1e-12)
    assert solution.residual <= 1e-10
    check_solution(W, v, mu, solution.P, 1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("scatter", [0.0, 0.5])
def test_every_patch_is_solved(scatter: float) -> None:
    """Contacts some metres apart on ships of hundreds, nearly dependent; normals alike, and up to a wedge apart."""
    patches = [
        (seed, k, dof, mu) for dof in (3, 4, 6) for k in (2, 4, 6) for mu in (0.0, 0.3, 1.0) for seed in range(15)
    ]  # fmt: skip
    missed = {p: solve_gauss_seidel(*random_patch(*p[:3], scatter), p[3]).residual for p in patches}
    assert {p: r for p, r in missed.items() if r > 1e-10} == {}


@pytest.mark.parametrize("case", [(35, 3, 4, 1.0), (22, 6, 4, 1.0), (26, 6, 4, 1.0), (11, 8, 6, 1.0), (9, 6, 4, 1.0)])
def test_wedges_are_solved_by_newtons_method_and_aclm_in_turns(case: tuple[int, int, int, float]) -> None:
    """Patches with normals up to a wedge apart. Newton's method alone leaves the first unsolved, ACLM the last."""
    seed, k, dof, mu = case
    assert solve_gauss_seidel(*random_patch(seed, k, dof, 0.5), mu).residual <= 1e-10


@pytest.mark.one_in(2)
@pytest.mark.parametrize("case", [(35, 2, 3, 1.0), (26, 6, 4, 1.0), (22, 6, 6, 1.0), (32, 3, 6, 0.6)])
def test_aclm_alone_solves_these_patches(case: tuple[int, int, int, float]) -> None:
    """From zero impulses, to the law of contact."""
    seed, k, dof, mu = case
    W, v = random_patch(seed, k, dof, 0.5)
    P, wanted = np.zeros((k, 3)), 1e-9 * -v[0::3].min()
    for _ in range(20):
        P = solve_aclm(W, v, mu, P, wanted)
    assert law_residual(W, v, mu, P) <= wanted
    check_solution(W, v, mu, P, 1e-6)


@given(SEEDS, st.integers(2, 4), SHARE)
def test_a_warm_start_does_not_change_the_motion(seed: int, contacts: int, mu: float) -> None:
    W, v = random_patch(seed, contacts)
    assume(v[0::3].min() < -1e-3)
    cold = solve_gauss_seidel(W, v, mu)
    warm = solve_gauss_seidel(W, v, mu, 1e-3 * cold.P)
    assume(max(cold.residual, warm.residual) <= 1e-10)
    np.testing.assert_allclose(W @ warm.P.ravel(), W @ cold.P.ravel(), atol=1e-6 * np.abs(v).max())


def test_a_warm_start_saves_sweeps() -> None:
    """In the sum over many patches; in a single one the last sweep may be one more."""
    cold_sweeps = warm_sweeps = 0
    for seed in range(100):
        W, v = random_patch(seed, 2 + seed % 3)
        cold = solve_gauss_seidel(W, v, 0.3)
        cold_sweeps, warm_sweeps = (
            cold_sweeps + cold.sweeps,
            warm_sweeps + solve_gauss_seidel(W, v, 0.3, 1e-3 * cold.P).sweeps,
        )
    assert 100 < warm_sweeps < cold_sweeps


@given(SEEDS, st.integers(1, 4), SHARE)
def test_plastic_impact_never_creates_energy(seed: int, contacts: int, mu: float) -> None:
    W, v = random_patch(seed, contacts)
    P = solve_gauss_seidel(W, v, mu).P.ravel()
    gained = P @ (v + 0.5 * W @ P)
    assert gained <= 1e-9 * np.abs(P * v).sum()


def test_frictionless_impact_is_the_effective_mass_times_the_approach() -> None:
    W, v = random_patch(7, 1)
    v[0] = -3.0
    assert solve_gauss_seidel(W, v, 0.0).P[0] == pytest.approx([3.0 / W[0, 0], 0.0, 0.0])


def test_a_row_repeated_shares_the_same_total() -> None:
    """Two contacts at one place are one contact: the split is free, the sum is not."""
    W, v = random_patch(3, 1)
    v[0] = -abs(v[0])
    single = solve_gauss_seidel(W, v, 0.3).P.sum(axis=0)
    double = solve_gauss_seidel(np.tile(W, (2, 2)), np.tile(v, 2), 0.3).P.sum(axis=0)
    np.testing.assert_allclose(double, single, rtol=1e-9, atol=1e-6 * np.abs(single).max())


@pytest.mark.parametrize("speed", [0.0, 2.0])
def test_parting_or_resting_contacts_get_nothing(speed: float) -> None:
    W, v = random_patch(1, 2)
    v[0::3] = speed
    assert not solve_gauss_seidel(W, v, 0.5).P.any()


@given(SEEDS, st.integers(1, 3), st.floats(-np.pi, np.pi))
def test_turning_the_tangents_turns_the_friction(seed: int, contacts: int, angle: float) -> None:
    """The cone is round: an answer must not depend on which way the tangents happen to point."""
    W, v = random_patch(seed, contacts)
    c, s = np.cos(angle), np.sin(angle)
    turn = np.kron(np.eye(contacts), np.array([[1, 0, 0], [0, c, -s], [0, s, c]]))
    straight, turned = solve_gauss_seidel(W, v, 0.4), solve_gauss_seidel(turn @ W @ turn.T, turn @ v, 0.4)
    assume(max(straight.residual, turned.residual) <= 1e-11)
    # The split among redundant contacts may differ; the motion may not.
    np.testing.assert_allclose(
        turn @ (W @ straight.P.ravel()), turn @ W @ turn.T @ turned.P.ravel(), atol=1e-7 * (np.abs(v).max() + 1e-9)
    )


# -- any two ships, on any headings, heeled and trimmed ---------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Patch:
    """Several contacts of the same two ships: each an impact of these."""

    contacts: list[Impact]

    @property
    def G(self) -> tuple[np.ndarray, np.ndarray]:
        """(3k, 6) of both ships, in the axes of each contact."""
        one, other = (
            np.vstack([c.axes @ ship(c).jacobian(c.point) for c in self.contacts])
            for ship in (lambda c: c.a, lambda c: c.b)
        )
        return one, other

    @property
    def W_friction(self) -> np.ndarray:
        """W of the free motions, and what those that are held add to it for friction."""
        W = np.zeros((3 * len(self.contacts), 3 * len(self.contacts)))
        down = [np.outer([0.0, *c.axes[1:, 2]], [0.0, 0.0, 1.0]) for c in self.contacts]
        for G, one in zip(self.G, ("a", "b"), strict=True):
            ship = getattr(self.contacts[0], one)
            vertical = np.vstack(
                [d @ getattr(c, one).jacobian(c.point) for d, c in zip(down, self.contacts, strict=True)]
            )
            W += G @ ship.M_inverse @ G.T + vertical @ ship.held @ vertical.T
        return W

    @property
    def v(self) -> np.ndarray:
        return np.concatenate([c.v for c in self.contacts])

    def alike(self, turn: float, shift: np.ndarray) -> list[tuple[Patch, np.ndarray]]:
        """The same seen otherwise (ships swapped, mirrored, world turned and shifted), and from contact axes to its."""
        R = rotation([0.0, 0.0, turn])
        seen = []
        for change, of_n in (
            (Impact.swapped, -np.eye(3)),
            (Impact.mirrored, np.diag([1.0, -1.0, 1.0])),
            (lambda c: c.moved(R, shift), R),
        ):
            other = Patch([change(c) for c in self.contacts])
            axes = np.zeros((3 * len(self.contacts), 3 * len(self.contacts)))
            for i, (old, new) in enumerate(zip(self.contacts, other.contacts, strict=True)):
                axes[3 * i : 3 * i + 3, 3 * i : 3 * i + 3] = new.axes @ of_n @ old.axes.T
            seen.append((other, axes))
        return seen


@st.composite
def patches(draw: st.DrawFn) -> Patch:
    """Two to four contacts within some metres of each other, with normals up to some degrees apart."""
    first = draw(impacts(e=st.just(0.0), slope=floats(-0.3, 0.3)))
    contacts = [first]
    for _ in range(draw(st.integers(1, 3))):
        offset = np.array([draw(floats(-8, 8)), draw(floats(-8, 8)), draw(floats(-6, 6))])
        tilt = np.array([draw(floats(-0.2, 0.2)) for _ in range(3)])
        normal = first.normal + tilt
        contacts.append(replace(first, point=first.point + offset, normal=normal / np.linalg.norm(normal)))
    return Patch(contacts)


SHIFTS = st.tuples(floats(-1e4, 1e4), floats(-1e4, 1e4))


@given(impacts(), floats(-np.pi, np.pi), SHIFTS)
def test_the_impulse_of_one_contact_swaps_mirrors_and_turns(
    impact: Impact, turn: float, shift: tuple[float, float]
) -> None:
    P = solve_poisson_impact(impact.W_friction, impact.v, impact.mu, impact.e).P[0]
    for other, axes in Patch([impact]).alike(turn, np.array([*shift, 0.0])):
        found = solve_poisson_impact(other.W_friction, other.v, impact.mu, impact.e).P[0]
        np.testing.assert_allclose(found, axes @ P, rtol=0.0, atol=1e-8 * np.linalg.norm(P))


@pytest.fixture
def held() -> Impact:
    """Two heeled boats of 10 t in 3 degrees of freedom that spring apart at a level normal: e = 1, mu = 1."""

    def boat(x: list[float], heading: float, heel: float, surge: float) -> Ship:
        m, attitude = 1e4, [heel, 0.0, heading]
        M = rigid_body_inertia(m, [0.0, 0.0, 0.0], [2.6, 10.8, 10.8])
        M = M + added_mass_matrix(0.05 * m, 0.8 * m, m, 0.2 * m * 6.7, m * 116.0, 0.5 * m * 116.0, z_y=0.4)
        axes = level_axes(attitude)
        inverse = axes @ free_inverse(M, 3) @ axes.T
        nu = axes @ [surge, 0.0, 0.0, 0.0, 0.0, 0.0]
        return Ship(np.array(x), rotation(attitude), M, inverse, nu, axes, rotation([0.0, 0.0, heading]), 3)

    a, b = boat([-9.0, -1.0, 0.0], 0.4, 0.2, 2.0), boat([3.0, 8.0, 0.0], 2.1, -0.1, 0.0)
    return Impact(a, b, np.zeros(3), np.array([1.0, 0.0, 0.0]), 1.0, 1.0)


def turned_impulses(impact: Impact) -> np.ndarray:
    """(400, 3): what is found in 400 turned worlds, turned back; rounding differs between them."""
    found = []
    for turn in np.linspace(-3.0, 3.0, 400):
        other, axes = Patch([impact]).alike(turn, np.zeros(3))[2]
        found.append(axes.T @ solve_poisson_impact(other.W_friction, other.v, impact.mu, impact.e).P[0])
    return np.array(found)


def test_friction_that_is_held_turns_with_the_world(held: Impact) -> None:
    found = turned_impulses(held)
    assert np.ptp(found, axis=0).max() <= 1e-8 * found.max()


@given(impacts())
def test_one_contact_keeps_its_cone_parts_and_gains_nothing(impact: Impact) -> None:
    solution = solve_poisson_impact(impact.W_friction, impact.v, impact.mu, impact.e)
    P, size = solution.P[0], np.linalg.norm(impact.v)
    assert solution.residual <= 1e-10
    assert np.hypot(*P[1:]) <= impact.mu * P[0] * (1 + 1e-12)
    after = impact.after(P)
    assert after.v[0] >= -1e-10 * size
    # The ships' own energy, from M and their twists, not from W.
    assert after.scale - impact.scale <= 1e-12 * impact.scale
    if impact.e == 0.0 and P[0] > 0.0:
        assert abs(after.v[0]) <= 1e-10 * size


@given(patches(), floats(-np.pi, np.pi), SHIFTS)
def test_the_motion_after_a_patch_swaps_mirrors_and_turns(
    patch: Patch, turn: float, shift: tuple[float, float]
) -> None:
    """The impulses of contacts that depend on each other may be shared otherwise; what they do may not."""
    mu, W, v = patch.contacts[0].mu, patch.W_friction, patch.v
    moved = W @ solve_gauss_seidel(W, v, mu).P.ravel()
    for other, axes in patch.alike(turn, np.array([*shift, 0.0])):
        found = other.W_friction @ solve_gauss_seidel(other.W_friction, other.v, mu).P.ravel()
        np.testing.assert_allclose(found, axes @ moved, rtol=0.0, atol=1e-7 * np.linalg.norm(v))


@given(patches())
def test_a_patch_is_solved_in_its_cones_and_gains_nothing(patch: Patch) -> None:
    mu, W, v = patch.contacts[0].mu, patch.W_friction, patch.v
    solution = solve_gauss_seidel(W, v, mu)
    P, speed = solution.P, -v[0::3].min()
    assert solution.residual <= 1e-10
    assert (np.hypot(P[:, 1], P[:, 2]) <= mu * P[:, 0] + 1e-12 * P[:, 0].max()).all()
    assert P[:, 0].min() >= 0.0
    assert (v + W @ P.ravel())[0::3].min() >= -1e-9 * speed
    G, c = patch.G, patch.contacts[0]
    a = replace(c.a, nu=c.a.nu - c.a.M_inverse @ G[0].T @ P.ravel())
    b = replace(c.b, nu=c.b.nu + c.b.M_inverse @ G[1].T @ P.ravel())
    had = c.a.energy + c.b.energy
    assert a.energy + b.energy - had <= 1e-12 * had
