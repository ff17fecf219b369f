"""native/collision: from contacts to impulses, their energy and what is shown of them, beside the Python twins."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, replace
from math import nan

import numpy as np
import pytest

from shipcollision_fmu.collision.contact_problem import ContactCaches, ContactProblem
from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import Contact, Impulse, book_impulses, make_contact
from shipcollision_fmu.collision.dynamics.delassus import approach_velocities, delassus, held_delassus, mobility
from shipcollision_fmu.collision.dynamics.other_forces import OtherForces
from shipcollision_fmu.collision.dynamics.passivity import enforce_passivity
from shipcollision_fmu.collision.dynamics.self_stress import remove_self_stress
from shipcollision_fmu.collision.responses import respond_pgs
from shipcollision_fmu.collision.solvers.energy_split import split_losses
from shipcollision_fmu.collision.solvers.impact_process import estimate_losses
from shipcollision_fmu.ship.degrees_of_freedom import FREE, free_inverse, held_mobility, tilted_inverse
from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.ship.inertia import added_mass_matrix, rigid_body_inertia
from tests.native.collision.kernels import evaluate

CLOSE = 1e-9
SLOW = pytest.mark.slow


@dataclass(frozen=True)
class Patch:
    """Bodies that touch, and impulses at their contacts. rows: the same as a kernel takes it."""

    states: list[BodyState]
    contacts: list[Contact]
    impulses: list[Impulse]
    mu: float
    e: float
    row: list[float]

    @property
    def impulse(self) -> float:
        """Their size [N s]."""
        return max(float(np.abs(i.P).max()) for i in self.impulses)


def draw_body(random: np.random.Generator, free: int, biased: bool) -> tuple[BodyState, list[float]]:
    """A ship at the origin, or an obstacle (free = 0), and its row."""
    attitude = random.normal(size=3) * [0.1, 0.02, 2.0] * (1 if free != 3 else [0.0, 0.0, 1.0])
    m = 10 ** random.uniform(6.5, 8.5)
    M = rigid_body_inertia(m, random.normal(size=3) * [5, 0, 3], [12.0, 60.0, 60.0]) + added_mass_matrix(
        0.05 * m, 0.85 * m, m, 0.2 * m * 144, m * 3600, 0.21 * m * 3600, z_y=4.0
    )
    held = held_mobility(M, free) if free else None
    inverse = tilted_inverse(free_inverse(M, free), free, attitude) if free else np.zeros((6, 6))
    nu = random.normal(size=6) * [4.0, 1.0, 0.1, 0.01, 0.003, 0.01] * np.isin(range(6), FREE[free] if free else [])
    x, bias = random.normal(size=3) * 5.0, 0.01 * random.normal(size=6) * [1.0, 1.0, 0.0, 0.0, 0.0, 0.01]
    state = BodyState.at(x, attitude, nu, inverse, np.zeros(3), held)
    state.fixed = not free
    if biased:
        state.expect(OtherForces(bias, bias, None))
    values = [x, attitude, nu, inverse, np.zeros(3), [state.fixed], [held is not None]]
    values += [np.zeros(9) if held is None else held, [biased], bias]
    return state, np.concatenate([np.asarray(value, dtype=float).ravel() for value in values]).tolist()


def draw_patch(seed: int, bodies: int, contacts: int) -> Patch:
    """A row of bodies of which the last may be an obstacle, with some contacts between each two that follow."""
    random = np.random.default_rng(seed)
    free = int(random.choice([3, 4, 6]))
    kinds = [*[free] * (bodies - 1), free if seed % 3 else 0]
    drawn = [draw_body(random, kind, seed % 5 == 0 and kind > 0) for kind in kinds]
    states, row = [state for state, _ in drawn], [float(bodies)]
    for _, values in drawn:
        row += values
    row.append(float(contacts * (bodies - 1)))
    made, impulses = [], []
    for a in range(bodies - 1):
        normal = random.normal(size=3) * [1.0, 1.0, 0.1 if seed % 2 else 0.0]
        normal /= np.linalg.norm(normal)
        middle = random.normal(size=3) * [100.0, 15.0, 5.0]
        for _ in range(contacts):
            point, gap = middle + random.normal(size=3) * [2.0, 2.0, 4.0], -float(random.random())
            contact = make_contact(a, a + 1, states, point, normal, gap)
            push = 10 ** random.uniform(5.0, 7.0)
            friction = push * random.normal(size=2) * 0.3
            P = contact.axes.T @ np.array([push, *friction]) * (random.random() < 0.9)
            made.append(contact)
            impulses.append(Impulse(contact, P))
            row += [a, a + 1, *point, *normal, gap, *P]
    mu = 0.0 if seed % 7 == 0 else float(random.uniform(0.05, 0.8))
    e = float(random.choice([0.0, 0.3, 1.0]))
    return Patch(states, made, impulses, mu, e, [*row, mu, e])


def draw_patches(count: int) -> list[Patch]:
    shapes = [(2, 1), (2, 2), (2, 4), (3, 2), (4, 3)]
    return [draw_patch(seed, *shapes[seed % len(shapes)]) for seed in range(count)]


def run(kernel: str, patch: Patch, outs: int) -> Array:
    return np.asarray(evaluate("impulses", kernel, [patch.row], outs)[0])


def test_operators() -> None:
    held = 0
    for patch in draw_patches(60):
        contacts, states, k = patch.contacts, patch.states, 3 * len(patch.contacts)
        H, alone = held_delassus(contacts, states), held_delassus(contacts[:1], states)
        W, v = delassus(contacts, states), approach_velocities(contacts, states)
        found = run("operators", patch, k + k * k + 9 + 2 + (0 if H is None else k * k) + 9)
        np.testing.assert_allclose(found[:k], v, rtol=0.0, atol=1e-12 * max(np.abs(v).max(), 1.0))
        stiff = np.sqrt(np.outer(W.diagonal(), W.diagonal())) + 1e-6 * W.max()
        assert (np.abs(found[k : k + k * k].reshape(k, k) - W) <= 1e-12 * stiff).all()
        rest = found[k + k * k :]
        np.testing.assert_allclose(rest[:9], mobility(contacts[0], states).ravel(), rtol=0.0, atol=1e-12 * W.max())
        assert rest[9:11].tolist() == [H is not None, alone is not None]
        if H is not None:
            np.testing.assert_allclose(rest[11 : 11 + k * k], H.ravel(), rtol=0.0, atol=1e-12 * np.abs(H).max())
            held += 1
        if alone is not None:
            np.testing.assert_allclose(rest[-9:], alone.ravel(), rtol=0.0, atol=1e-12 * np.abs(alone).max())
    assert held > 20


def test_passivity() -> None:
    scaled = 0
    for patch in draw_patches(120):
        expected, taken_off = enforce_passivity(patch.impulses, patch.states)
        found = run("passivity", patch, 1 + 6 * len(expected))
        assert found[0] == pytest.approx(taken_off, rel=1e-9, abs=1e-12)
        rows = found[1:].reshape(-1, 6)
        assert rows[:, :3].tolist() == [[i.contact.a, i.contact.b, i.contact.gap] for i in expected]
        np.testing.assert_allclose(rows[:, 3:], [i.P for i in expected], rtol=0.0, atol=1e-10 * patch.impulse)
        scaled += taken_off > 0.0
    assert 10 < scaled < 110


def test_the_split_of_the_energy() -> None:
    shared = 0
    for patch in draw_patches(150):
        booked = book_impulses(patch.impulses, patch.states)
        expected = np.array(split_losses(booked, patch.states, patch.mu, patch.e))
        found = run("energy_split", patch, expected.size).reshape(-1, 2)
        assert np.abs(found - expected).max() <= CLOSE * np.abs(expected).max()
        shared += bool((expected[:, 1] != 0.0).any())
    assert shared > 60


@pytest.mark.parametrize("language", ["Python", "native"])
def test_a_slip_that_stops_is_split_alike_whichever_way_rounding_leaves_it(language: str) -> None:
    """Impulses that stop the slip at a contact but for 1e-10 of it, either way."""
    differ = []
    for seed in range(1, 60):
        patch = draw_patch(seed, 2, 1)
        (contact,), (impulse,), states = patch.contacts, patch.impulses, patch.states
        W, v = delassus([contact], states), approach_velocities([contact], states)
        if v[0] > -0.1 or patch.mu == 0.0:
            continue
        losses = []
        for left in (1e-10, -1e-10):
            P = contact.axes.T @ np.linalg.lstsq(W, np.array([0.0, *(left * v[1:])]) - v, rcond=1e-9)[0]
            pushed = replace(patch, impulses=[replace(impulse, P=P)], row=[*patch.row[:-5], *P, *patch.row[-2:]])
            if language == "native":
                losses.append(run("energy_split", pushed, 2))
            else:
                booked = book_impulses(pushed.impulses, [copy(state) for state in states])
                losses.append(np.array(split_losses(booked, states, patch.mu, patch.e)[0]))
        differ.append(float(np.abs(losses[0] - losses[1]).max() / np.abs(losses[0]).sum()))
    assert len(differ) > 15
    assert max(differ) < 1e-7


@pytest.mark.parametrize("count", [400, pytest.param(5000, marks=SLOW)])
def test_losses_of_an_impact_process(count: int) -> None:
    rows, expected = [], []
    for seed in range(count):
        random = np.random.default_rng(seed)
        factor, held = random.normal(size=(3, 3)) * 10.0 ** random.uniform(-1.0, 0.0, (3, 1)), random.normal(size=3)
        W, H = 1e-8 * factor @ factor.T, 1e-9 * np.outer(held, held) if seed % 3 == 0 else None
        if seed % 4 == 0:
            W[2], W[:, 2] = 0.0, 0.0
        v = random.normal(size=3) * [1.0, 0.5, 0.5 * (seed % 4 > 0)]
        mu, e = float(random.uniform(0.0, 1.5)) * (seed % 9 > 0), float(random.choice([0.0, 0.5, 1.0]))
        rows.append(np.concatenate([W.ravel(), v, [mu, e, H is not None], np.zeros(9) if H is None else H.ravel()]))
        expected.append(estimate_losses(W, v, mu, e, H))
    found, wanted = evaluate("impulses", "losses", rows, 2), np.array(expected)
    whole = np.abs(wanted).sum(axis=1)
    missed = np.abs(found - wanted).max(axis=1) / np.where(whole > 0.0, whole, 1.0)
    assert (missed > CLOSE).sum() <= 0.001 * count
    assert 0.3 * count < (wanted[:, 1] > 0.0).sum() < 0.9 * count


def test_friction_without_self_stress() -> None:
    """Impulses of bodies that then rest, so that all contacts stick."""
    changed = booked = 0
    for patch in draw_patches(150):
        for state in patch.states:
            state.velocity_bias = None
            state.set_twist(np.zeros(6))
        resting = replace(patch, row=list(patch.row))
        size = 52 + 10 + 7
        for i in range(len(patch.states)):
            resting.row[1 + i * size + 6 : 1 + i * size + 12] = [0.0] * 6
            resting.row[1 + i * size + 62] = 0.0
        shown = remove_self_stress(patch.impulses, patch.states, patch.mu)
        k = 3 * len(shown)
        found = run("self_stress", resting, k + 12 * len(patch.states))
        expected = np.concatenate([i.P for i in shown])
        np.testing.assert_allclose(found[:k], expected, rtol=0.0, atol=CLOSE * patch.impulse)
        twists = np.concatenate([np.concatenate([state.nu, state.issued]) for state in patch.states])
        units = [1e-8, 1e-8, 1e-8, 1e-9, 1e-9, 1e-9, 1.0, 1.0, 1.0, 1e2, 1e2, 1e2]
        scale = patch.impulse * np.tile(units, len(patch.states))
        np.testing.assert_array_less(np.abs(found[k:] - twists), CLOSE * scale + 1e-300)
        changed += np.abs(expected - np.concatenate([i.P for i in patch.impulses])).max() > 1e-3 * patch.impulse
        booked += bool(np.any(twists))
    assert changed > 40
    assert booked > 20


class Touching:
    """A detector that finds given contacts."""

    def __init__(self, contacts: list[Contact]) -> None:
        self.found = contacts

    def contacts(self, *_: object) -> list[Contact]:
        return self.found


def run_response(patch: Patch) -> list[float]:
    """What the kernel `response` gives, by the Python model."""
    caches, states, found = ContactCaches(), patch.states, list[float]()
    problem = ContactProblem([(0, 1)], states, Touching(patch.contacts), [], patch.mu, patch.e, 0.01)  # type: ignore[arg-type]  # stands for a detector
    caches.work.renew(len(states), 0.1)
    for _ in range(2):
        solution = respond_pgs(problem, caches)
        found += [solution.residual, solution.sweeps, *np.concatenate([i.P for i in solution.impulses])]
        for state in states:
            if not state.fixed:
                state.set_twist(state.nu + state.nu_received)
    impulses, taken_off = enforce_passivity(solution.impulses, states)
    book_impulses(impulses, states)
    shown = remove_self_stress(impulses, states, patch.mu)
    found += [taken_off, *np.concatenate([i.P for i in shown])]
    for state in states:
        found += [*state.nu, *state.issued]
    return found


def measure_difference(found: Array, expected: Array, contacts: int) -> float:
    """Largest difference of the impulses of both answers and of what is shown, as a share of the largest."""
    k = 3 * contacts
    parts = [slice(2, 2 + k), slice(4 + k, 4 + 2 * k), slice(5 + 2 * k, 5 + 3 * k)]
    scale = max(float(np.abs(expected[part]).max()) for part in parts) or 1.0
    return max(float(np.abs(found[part] - expected[part]).max()) for part in parts) / scale


@pytest.mark.parametrize("count", [80, pytest.param(800, marks=SLOW)])
def test_the_response(count: int) -> None:
    """The sweeps end at a tolerance: where one language takes a sweep more, friction that sticks may be split otherwise
    between contacts."""
    apart, answered = [], 0
    for patch in draw_patches(count):
        k = len(patch.contacts)
        found = run("response", patch, 5 + 9 * k + 12 * len(patch.states))
        expected = np.array(run_response(patch))
        apart.append(measure_difference(found, expected, k))
        answered += expected[1] > 0
        assert found[0] <= max(1.1 * expected[0], 1e-10)
    assert answered > 0.3 * count
    assert (np.array(apart) > CLOSE).sum() <= 0.002 * count + 1


def test_the_state_of_the_caches() -> None:
    rows = [[a, b, c, *place, *P] for a, b, c, place, P in [
        (0, 1, 1, (1.0, 2.0, 3.0), (4.0, 5.0, 6.0)), (0, 2, 0, (0.1, 0.2, nan), (7.0, 8.0, 9.0)),
        (3, 4, 1, (-0.0, 1e300, 3.0), (1.0, 0.0, 0.0)), (5, 6, 0, (1.0, 1.0, 1.0), (0.0, 0.0, 0.0)),
    ]]  # fmt: skip
    found = evaluate("impulses", "caches", [[len(rows), *np.concatenate(rows)]], 25)[0]
    expected = [[a, b, c, *place, *place, *P] for a, b, c, *rest in rows[1:3] for place, P in [(rest[:3], rest[3:])]]
    np.testing.assert_array_equal(found, [1.0, *np.concatenate(expected)])
