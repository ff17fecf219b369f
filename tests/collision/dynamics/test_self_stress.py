"""Friction that is shown of a patch: the same resultant, within the cones, and no contacts that pull at each other."""

from __future__ import annotations

import numpy as np
import pytest

from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import Impulse, make_contact
from shipcollision_fmu.collision.dynamics.self_stress import remove_self_stress

MU = 0.4


def bodies(slip: float = 0.0) -> list[BodyState]:
    nu = np.array([slip, 0, 0, 0, 0, 0])
    return [BodyState.at(np.zeros(3), np.zeros(3), v, np.eye(6)) for v in (np.zeros(6), nu)]


def patch(states: list[BodyState], places: np.ndarray, N: np.ndarray, T: np.ndarray, spread: float) -> list[Impulse]:
    """Contacts with normals up to about `spread` [rad] from east; T (k, 2) along the tangents."""
    rng, impulses = np.random.default_rng(0), []
    for place, n, t in zip(places, N, T, strict=True):
        normal = np.array([0.0, 1.0, 0.0]) + spread * rng.uniform(-1, 1, 3)
        c = make_contact(0, 1, states, place, normal / np.linalg.norm(normal), 0.0)
        impulses.append(Impulse(c, n * c.normal + t @ c.axes[1:]))
    return impulses


def wrench(impulses: list[Impulse]) -> np.ndarray:
    return sum((np.concatenate([i.P, np.cross(i.contact.at, i.P)]) for i in impulses), start=np.zeros(6))


def friction(impulse: Impulse) -> np.ndarray:
    return impulse.P - (impulse.P @ impulse.contact.normal) * impulse.contact.normal


def load(impulse: Impulse) -> float:
    """|T|^2 / N [N s]."""
    n = impulse.P @ impulse.contact.normal
    return float(np.sum(friction(impulse) ** 2) / n) if n > 0.0 else 0.0


@pytest.mark.parametrize("spread", [0.0, 0.3])
@pytest.mark.parametrize("k", [2, 3, 4, 7])
def test_resultant_cones_and_normal_impulses_are_kept(k: int, spread: float) -> None:
    rng, states = np.random.default_rng(k), bodies()
    for _ in range(50):
        N = 1e6 * rng.uniform(0, 1, k) * (rng.random(k) < 0.8)
        angle, share = rng.uniform(0, 2 * np.pi, k), np.where(rng.random(k) < 0.5, 1.0, rng.random(k))
        T = (MU * N * share)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        solved = patch(states, rng.uniform(-1, 1, (k, 3)) * [60.0, 0.1, 10.0], N, T, spread)
        shown = remove_self_stress(solved, states, MU)
        np.testing.assert_allclose(wrench(shown)[:3], wrench(solved)[:3], rtol=0, atol=1e-9 * N.sum())
        np.testing.assert_allclose(wrench(shown)[3:], wrench(solved)[3:], rtol=0, atol=1e-9 * N.sum() * 60.0)
        for i, n in zip(shown, N, strict=True):
            assert i.P @ i.contact.normal == pytest.approx(n, rel=1e-12)
            assert np.linalg.norm(friction(i)) <= MU * n * (1 + 1e-12)
        before, after = (sum(load(i) for i in of) for of in (solved, shown))
        assert after <= before * (1 + 1e-9)


def test_opposed_friction_at_the_edge_of_the_cone_is_not_shown() -> None:
    states = bodies()
    places, N = np.array([[-50.0, 0, 0], [50.0, 0, 0]]), np.array([1e5, 1e5])
    solved = patch(states, places, N, np.array([[MU * 1e5, 0.0], [-MU * 1e5, 0.0]]), 0.0)
    for i in remove_self_stress(solved, states, MU):
        np.testing.assert_allclose(friction(i), 0.0, atol=1e-9)


def test_friction_in_one_direction_is_shared_by_load() -> None:
    """What a unit of load takes is then the same at all contacts, and stays in the cones whenever any split does."""
    states = bodies()
    places, N = np.array([[-50.0, 0, 3], [50.0, 0, -2], [50.0, 0, 3]]), np.array([1e5, 3e5, 2e5])
    moment_free = np.array([[0.0, 0.0], [MU * 3e5, 0.0], [0.0, 0.0]])
    solved = patch(states, places[[1, 1, 1]], N, moment_free, 0.0)
    for i, n in zip(remove_self_stress(solved, states, MU), N, strict=True):
        assert np.linalg.norm(friction(i)) == pytest.approx(MU * 3e5 / 6e5 * n, rel=1e-9)


def test_sliding_friction_is_shown_as_solved() -> None:
    states = bodies(slip=0.01)
    places, N = np.array([[-50.0, 0, 0], [50.0, 0, 0]]), np.array([1e5, 1e5])
    solved = patch(states, places, N, np.array([[MU * 1e5, 0.0], [-MU * 1e5, 0.0]]), 0.0)
    assert remove_self_stress(solved, states, MU) == solved
