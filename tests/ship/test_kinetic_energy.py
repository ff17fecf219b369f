"""Kinetic energy in level axes: the definition by L, upright ships, many states at once, the work of an impulse."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.ship.degrees_of_freedom import FREE, free_inverse, level_axes, tilted_inverse
from shipcollision_fmu.ship.kinetic_energy import kinetic_energy, motion_twist
from shipcollision_fmu.ship.loading.library import load_ship

M = load_ship("kvlcc2").M
ATTITUDE = st.tuples(st.floats(-1.2, 1.2), st.floats(-1.2, 1.2), st.floats(-3.0, 3.0)).map(np.array)
TWIST = st.lists(st.floats(-1.0, 1.0), min_size=6, max_size=6).map(np.array)


@given(ATTITUDE, TWIST, st.sampled_from([3, 4]))
def test_the_level_twist_is_the_inverse_of_the_level_axes(attitude: np.ndarray, nu_l: np.ndarray, free: int) -> None:
    nu = level_axes(attitude) @ nu_l
    np.testing.assert_allclose(motion_twist(attitude, nu, free), nu_l, atol=1e-13)
    assert kinetic_energy(M, attitude, nu, free) == pytest.approx(0.5 * nu_l @ M @ nu_l, rel=1e-11)


@given(TWIST)
def test_in_six_degrees_of_freedom_the_twist_is_that_of_b(nu: np.ndarray) -> None:
    heeled, upright = np.array([0.5, 0.2, 1.0]), np.zeros(3)
    assert motion_twist(heeled, nu, 6) is nu
    assert kinetic_energy(M, upright, nu, 4) == pytest.approx(float(kinetic_energy(M, heeled, nu, 6)), rel=1e-12)


@given(ATTITUDE, TWIST, TWIST, st.sampled_from([3, 4, 6]))
def test_an_impulse_works_by_the_mean_velocity(
    attitude: np.ndarray, nu_l: np.ndarray, scaled: np.ndarray, free: int
) -> None:
    """T(nu + dnu) - T(nu) = impulse . (nu + dnu/2), with dnu the answer of the ship models."""
    moving = np.isin(np.arange(6), FREE[free])
    nu = (level_axes(attitude) if free < 6 else np.eye(6)) @ (nu_l * moving)
    impulse = scaled * np.array([1.0, 1.0, 1.0, 20.0, 100.0, 100.0]) * 1e8
    change = tilted_inverse(free_inverse(M, free), free, attitude) @ impulse
    gained = kinetic_energy(M, attitude, nu + change, free) - kinetic_energy(M, attitude, nu, free)
    work = impulse @ (nu + 0.5 * change)
    size = kinetic_energy(M, attitude, nu, free) + kinetic_energy(M, attitude, change, free)
    assert gained == pytest.approx(work, abs=1e-9 * float(size) + 1e-9)


def test_many_states_at_once_are_the_same_as_one_by_one() -> None:
    rng = np.random.default_rng(1)
    attitudes, twists = rng.uniform(-1.0, 1.0, (20, 3)), rng.uniform(-1.0, 1.0, (20, 6))
    for free in (3, 4, 6):
        together = kinetic_energy(M, attitudes, twists, free)
        assert together.shape == (20,)
        for k in range(20):
            assert together[k] == pytest.approx(float(kinetic_energy(M, attitudes[k], twists[k], free)), rel=1e-14)


def test_a_ship_on_end_has_a_finite_energy() -> None:
    on_end = np.array([0.0, np.pi / 2, 0.0])
    assert np.isfinite(kinetic_energy(M, on_end, np.ones(6), 4))
