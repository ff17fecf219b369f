"""One formula of coasting in two forms: eta and nu of a ship, and place and rotation matrix of a body."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.ship.coasting import coast, coast_pose
from shipcollision_fmu.ship.frames import attitude_from_rotation, rotation, skew

ANGLE, RATE = st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)
X, V, R_BG = [100.0, -50.0, 1.0], [4.0, 0.5, -0.1], [-3.0, 0.5, 2.0]


@given(st.tuples(ANGLE, ANGLE, st.floats(-9, 9)), st.tuples(RATE, RATE, RATE), st.floats(0.01, 5.0))
def test_both_forms_are_one_motion(attitude: tuple[float, ...], rate: tuple[float, ...], h: float) -> None:
    R, omega = rotation(attitude), np.array(rate)
    v_g = R @ (V + skew(omega) @ R_BG)
    place, angles, velocity = coast(X, attitude, V, rate, R_BG, h)
    x_after, R_after = coast_pose(np.array(X), R, v_g, R @ omega, np.array(R_BG), h)
    np.testing.assert_allclose(place, x_after, atol=1e-12)
    np.testing.assert_allclose(rotation(angles), R_after, atol=1e-12)
    np.testing.assert_allclose(R_after @ (velocity + skew(omega) @ R_BG), v_g, atol=1e-12)


def test_a_straight_course_stays_straight_to_the_bit() -> None:
    attitude = [0.1, -0.2, 7.0]
    place, angles, velocity = coast([0.0, 0.0, 0.0], attitude, V, [0.0, 0.0, 0.0], R_BG, 0.1)
    assert (angles, velocity) == (attitude, V)
    np.testing.assert_allclose(place, rotation(attitude) @ V * 0.1, rtol=1e-14)


@pytest.mark.parametrize("attitude", [[0.0, 0.0, 3.0], [0.3, 0.0, 3.0]])
def test_whole_turns_are_counted(attitude: list[float]) -> None:
    """Two and a half turns in one step, about the vertical."""
    vertical = (rotation(attitude)[2] * 0.5 * np.pi).tolist()
    _, angles, _ = coast(X, attitude, V, vertical, R_BG, 10.0)
    assert angles == pytest.approx([attitude[0], 0.0, 3.0 + 5.0 * np.pi], abs=1e-12)


def test_a_bow_straight_up_keeps_a_defined_heading() -> None:
    R = rotation([0.0, 0.5 * np.pi - 0.1, 0.3])
    _, angles, _ = coast(X, attitude_from_rotation(R).tolist(), V, [0.0, 0.1, 0.0], R_BG, 1.0)
    assert angles[:2] == pytest.approx([0.0, 0.5 * np.pi], abs=1e-7)
