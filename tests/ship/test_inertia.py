"""Inertia: identities that hold for every ship."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.ship.degrees_of_freedom import free_inverse
from shipcollision_fmu.ship.frames import Array, skew
from shipcollision_fmu.ship.inertia import (
    H,
    added_mass_matrix,
    is_positive_definite,
    rigid_body_inertia,
)

MASS, R_BG, RADII = 3.2e8, [11.2, -0.5, 2.2], [20.3, 80.0, 78.0]
component = st.floats(-10.0, 10.0)
vector = st.lists(component, min_size=3, max_size=3)


@given(vector)
def test_H_is_inverted_by_the_opposite_vector(r: list[float]) -> None:
    np.testing.assert_array_equal(H(r) @ H([-x for x in r]), np.eye(6))


def test_H_gives_the_velocity_at_a_point() -> None:
    v, w, r = np.array([1.0, -2.0, 0.5]), np.array([0.1, 0.2, -0.3]), np.array([4.0, -5.0, 6.0])
    at_r = H(r) @ np.concatenate([v, w])
    np.testing.assert_allclose(at_r, np.concatenate([v + np.cross(w, r), w]), rtol=1e-15)


@given(vector, vector, vector)
def test_kinetic_energy_does_not_depend_on_the_reference_point(r: list[float], v: list[float], w: list[float]) -> None:
    nu = np.array(v + w)
    about_co = 0.5 * nu @ rigid_body_inertia(MASS, R_BG, RADII) @ nu
    nu_there = H(r) @ nu
    about_r = 0.5 * nu_there @ rigid_body_inertia(MASS, np.array(R_BG) - r, RADII) @ nu_there
    v_g = nu[:3] + np.cross(nu[3:], R_BG)
    textbook = 0.5 * MASS * (v_g @ v_g + (np.square(RADII) * nu[3:]) @ nu[3:])
    assert about_r == pytest.approx(about_co, rel=1e-11, abs=1e-3)
    assert about_co == pytest.approx(textbook, rel=1e-11, abs=1e-3)


def test_matrices_are_symmetric_to_the_bit() -> None:
    M_RB = rigid_body_inertia(MASS, R_BG, RADII)
    M_A = added_mass_matrix(1.6e7, 2.7e8, 3.2e8, 2e10, 2e12, 4e11, z_y=10.4)
    np.testing.assert_array_equal(M_RB, M_RB.T)
    np.testing.assert_array_equal(M_A, M_A.T)


def test_sway_added_mass_acts_at_its_depth() -> None:
    """A roll rate that leaves the point at depth z_y at rest feels no sway added mass."""
    z_y = 10.4
    M_A = added_mass_matrix(0.0, 2.7e8, 0.0, 0.0, 0.0, 0.0, z_y=z_y)
    p = 0.3
    at_rest_there = np.array([0.0, p * z_y, 0.0, p, 0.0, 0.0])  # v - p z = 0 at z = z_y
    np.testing.assert_allclose(M_A @ at_rest_there, np.zeros(6), atol=1e-6)
    assert M_A[1, 3] == -2.7e8 * z_y


def test_planar_effective_mass_is_the_textbook_one() -> None:
    """J M^-1 J' = 1/m + (r x n)_z^2 / I_z for a free body hit in the horizontal plane of its CG."""
    M = rigid_body_inertia(MASS, [0.0, 0.0, 0.0], RADII)
    n, r = np.array([np.cos(0.7), np.sin(0.7), 0.0]), np.array([120.0, -20.0, 0.0])
    J = np.concatenate([n, skew(r) @ n])
    m_n = 1.0 / (J @ free_inverse(M, 3) @ J)
    assert m_n == pytest.approx(1.0 / (1.0 / MASS + np.cross(r, n)[2] ** 2 / (MASS * RADII[2] ** 2)), rel=1e-13)


def _with(i: int, j: int, value: float) -> Array:
    M = np.eye(6)
    M[i, j] = M[j, i] = value
    return M


@pytest.mark.parametrize(
    ("M", "expected"),
    [
        (np.eye(6), True),
        (np.diag([1.0, 1.0, 1.0, 1e12, 1e12, 1e12]), True),
        (_with(0, 1, 0.999), True),
        (_with(0, 1, 1.0), False),
        (_with(2, 2, 0.0), False),
        (_with(2, 2, -1.0), False),
        (_with(2, 3, float("nan")), False),
        (np.eye(6) + np.eye(6, k=1) * 0.1, False),
    ],
    ids=["unit", "units mixed", "nearly singular", "singular", "zero", "negative", "nan", "not symmetric"],
)
def test_positive_definite(M: Array, expected: bool) -> None:
    assert is_positive_definite(M) is expected
