"""The chord of a motion: a body that keeps it, by the exact motion of ship/coasting.py, is at the second pose."""

import numpy as np
import pytest

from shipcollision_fmu.collision.dynamics.chord import find_chord, rotation_vector_of
from shipcollision_fmu.ship.coasting import coast, coast_pose
from shipcollision_fmu.ship.frames import Array, attitude_from_rotation, rotation, rotation_vector, skew

R_BG = [-3.0, 0.4, 1.5]
H = 0.5


def _poses(seed: int) -> tuple[Array, Array, Array, Array, Array]:
    """Two poses as far apart as a step leads, and a twist."""
    rng = np.random.default_rng(seed)
    x, R = rng.normal(size=3) * 100.0, rotation(rng.uniform(-1.0, 1.0, 3))
    turn = rotation_vector(rng.uniform(-0.7, 0.7, 3))
    return x, R, x + rng.normal(size=3), R @ turn, rng.normal(size=6)


@pytest.mark.parametrize("seed", range(20))
def test_a_body_that_keeps_the_chord_is_at_the_second_pose(seed: int) -> None:
    x, R, x_end, R_end, nu = _poses(seed)
    chord, _ = find_chord((x.tolist(), R.tolist()), x_end.tolist(), attitude_from_rotation(R_end).tolist(), R_BG, nu, H)
    v, omega = np.array(chord[:3]), np.array(chord[3:])
    reached, turned = coast_pose(x, R, R @ (v + skew(omega) @ R_BG), R @ omega, np.array(R_BG), H)
    np.testing.assert_allclose(reached, x_end, atol=1e-12)
    np.testing.assert_allclose(turned, R_end, atol=1e-13)


@pytest.mark.parametrize("seed", range(20))
def test_the_twist_is_carried_as_by_a_body_on_which_nothing_acts(seed: int) -> None:
    x, R, _, _, nu = _poses(seed)
    attitude = attitude_from_rotation(R).tolist()
    position, after, velocity = coast(x.tolist(), attitude, nu[:3].tolist(), nu[3:].tolist(), R_BG, H)
    chord, carried = find_chord((x.tolist(), R.tolist()), position, after, R_BG, nu.tolist(), H)
    np.testing.assert_allclose(chord, nu, atol=1e-13)
    np.testing.assert_allclose(carried, [*velocity, *nu[3:]], atol=1e-13)


@pytest.mark.parametrize("size", [1e-12, 1e-3, 1.0, 1.6, 3.0])
def test_the_rotation_vector_belongs_to_the_rotation(size: float) -> None:
    axis = np.array([2.0, -1.0, 2.0]) / 3.0
    np.testing.assert_allclose(rotation_vector_of(rotation_vector(size * axis).tolist()), size * axis, rtol=1e-9)
