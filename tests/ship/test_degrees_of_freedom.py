"""Free motions: level axes are those of the Euler angles' rates, and an impulse changes level momentum by itself."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.ship.degrees_of_freedom import (
    FREE,
    free_inverse,
    from_level,
    level_axes,
    tilted_inverse,
    to_level,
)
from shipcollision_fmu.ship.frames import attitude_from_rotation, rotation, rotation_vector
from shipcollision_fmu.ship.loading.library import load_ship

M = load_ship("kvlcc2").M
SCALE = np.sqrt(np.diag(M))  # makes units comparable
HEEL, TRIM, HEADING = st.floats(-1.2, 1.2), st.floats(-0.5, 0.5), st.floats(-3.0, 3.0)
SIX = st.lists(st.floats(-1.0, 1.0), min_size=6, max_size=6)


@pytest.mark.parametrize("degrees_of_freedom", [3, 4, 6])
def test_free_inverse_inverts_the_free_block_and_only_that(degrees_of_freedom: int) -> None:
    inverse = free_inverse(M, degrees_of_freedom)
    free = list(FREE[degrees_of_freedom])
    product = (M @ inverse)[np.ix_(free, free)]
    np.testing.assert_allclose(product * SCALE[free][None, :] / SCALE[free][:, None], np.eye(len(free)), atol=1e-14)
    held = [i for i in range(6) if i not in free]
    assert not inverse[held].any()
    assert not inverse[:, held].any()
    np.testing.assert_array_equal(inverse, inverse.T)


@pytest.mark.parametrize("degrees_of_freedom", [0, 2, 5, 7])
def test_other_degrees_of_freedom_are_refused(degrees_of_freedom: int) -> None:
    with pytest.raises(ShipError, match=rf"degrees_of_freedom = {degrees_of_freedom} must be 3 .* 4 .* or 6"):
        free_inverse(np.eye(6), degrees_of_freedom)


@given(HEEL, TRIM, HEADING, SIX)
def test_level_twists_are_velocities_along_the_heading_and_rates_of_the_angles(
    phi: float, theta: float, psi: float, nu_l: list[float]
) -> None:
    """By difference quotients of the attitude, which know nothing of L."""
    nu = level_axes([phi, theta, psi]) @ nu_l
    R, h = rotation([phi, theta, psi]), 1e-6
    heading = rotation([0.0, 0.0, psi])
    np.testing.assert_allclose(heading.T @ R @ nu[:3], nu_l[:3], atol=1e-12)
    ends = [attitude_from_rotation(R @ rotation_vector(sign * h * nu[3:])) for sign in (1.0, -1.0)]
    np.testing.assert_allclose((ends[0] - ends[1]) / (2 * h), nu_l[3:], atol=1e-7)


@given(HEEL, TRIM, HEADING, SIX, st.sampled_from([3, 4]))
def test_an_impulse_changes_what_is_free_and_level_by_itself(
    phi: float, theta: float, psi: float, J: list[float], dof: int
) -> None:
    """M_free of the level twist gained is the impulse's level part; heave and pitch are held, roll too in 3."""
    attitude, impulse = [phi, theta, psi], np.array(J) * SCALE
    gained = tilted_inverse(free_inverse(M, dof), dof, attitude) @ impulse
    level = np.linalg.solve(level_axes(attitude), gained)
    free, held = list(FREE[dof]), [i for i in range(6) if i not in FREE[dof]]
    np.testing.assert_allclose((level * SCALE)[held], 0.0, atol=1e-12)
    # Forces along and across the heading, the moment about the vertical, and that about b's x.
    R = rotation([phi, theta, 0.0])
    force, moment = R @ impulse[:3], R @ impulse[3:]
    taken = np.array([force[0], force[1], 0.0, impulse[3], 0.0, moment[2]])
    np.testing.assert_allclose((M[np.ix_(free, free)] @ level[free]) / SCALE[free], (taken / SCALE)[free], atol=1e-11)


@given(HEEL, TRIM, SIX)
def test_all_six_and_upright_nothing_is_turned(phi: float, theta: float, J: list[float]) -> None:
    six, four = free_inverse(M, 6), free_inverse(M, 4)
    assert tilted_inverse(six, 6, [phi, theta, 0.0]) is six
    assert tilted_inverse(four, 4, [0.0, 0.0, 2.0]) is four


@given(HEEL, SIX)
def test_to_level_is_L_without_trim(phi: float, nu: list[float]) -> None:
    x = tuple(nu)
    np.testing.assert_allclose(level_axes([phi, 0.0, 0.0]) @ to_level(x, phi), nu, atol=1e-14)
    np.testing.assert_allclose(level_axes([phi, 0.0, 0.0]).T @ nu, to_level(x, phi), atol=1e-14)
    np.testing.assert_allclose(to_level(from_level(x, phi), phi), nu, atol=1e-14)
