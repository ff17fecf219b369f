"""Frames: identities of rotations, and the one converter to Bullet's world that must swap both sides."""

from __future__ import annotations

from math import pi, radians

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.ship.frames import (
    SWAP,
    attitude_from_quaternion,
    attitude_from_rotation,
    quaternion,
    quaternion_w,
    rotation,
    rotation_from_quaternion,
    rotation_vector,
    skew,
    swap_axes,
    unwrap_attitude,
)

angle = st.floats(-3.1, 3.1)
attitudes = st.tuples(angle, st.floats(-1.55, 1.55), angle)
vectors = st.tuples(*[st.floats(-10.0, 10.0)] * 3)

BOW, STARBOARD, DOWN = np.eye(3)


@given(vectors, vectors)
def test_skew_is_the_cross_product(a: tuple[float, ...], b: tuple[float, ...]) -> None:
    np.testing.assert_allclose(skew(a) @ b, np.cross(a, b), atol=1e-12)


@given(attitudes)
def test_attitude_round_trip(attitude: tuple[float, ...]) -> None:
    R = rotation(attitude)
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-14)
    assert np.linalg.det(R) == pytest.approx(1.0)
    np.testing.assert_allclose(attitude_from_rotation(R), attitude, atol=1e-12)


@given(attitudes)
def test_quaternion_round_trip(attitude: tuple[float, ...]) -> None:
    R = rotation(attitude)
    np.testing.assert_allclose(rotation_from_quaternion(quaternion(R)), R, atol=1e-14)
    np.testing.assert_allclose(attitude_from_quaternion(quaternion(R)), attitude, atol=1e-12)


@pytest.mark.parametrize(
    ("attitude", "axis", "points_to"),
    [
        ((0, 0, radians(30)), BOW, (np.cos(pi / 6), 0.5, 0)),  # heading 030: the bow towards north-north-east
        ((0, radians(10), 0), BOW, (np.cos(radians(10)), 0, -np.sin(radians(10)))),  # positive pitch: bow up
        ((radians(10), 0, 0), STARBOARD, (0, np.cos(radians(10)), np.sin(radians(10)))),  # roll: starboard side down
        ((0, 0, pi / 2), STARBOARD, (-1, 0, 0)),  # heading east: starboard is south
    ],
)
def test_signs_of_the_angles(attitude: tuple[float, ...], axis: np.ndarray, points_to: tuple[float, ...]) -> None:
    np.testing.assert_allclose(rotation(attitude) @ axis, points_to, atol=1e-12)


@given(vectors)
def test_rotation_vector_is_the_exponential(w: tuple[float, ...]) -> None:
    R = rotation_vector(w)
    np.testing.assert_allclose(R @ np.array(w), w, atol=1e-12)  # its axis stays
    np.testing.assert_allclose(R @ rotation_vector(-np.array(w)), np.eye(3), atol=1e-12)
    np.testing.assert_allclose(rotation_vector(np.array(w) / 2) @ rotation_vector(np.array(w) / 2), R, atol=1e-12)


def test_rotation_vector_is_smooth_at_zero() -> None:
    for size in (1e-7, 0.99e-8, 1e-9, 0.0):
        R = rotation_vector([size, 0.0, 0.0])
        assert R[2, 1] == pytest.approx(size, rel=1e-9, abs=0.0)


def test_the_swap_is_a_rotation_and_its_own_inverse() -> None:
    np.testing.assert_array_equal(SWAP @ SWAP, np.eye(3))
    assert np.linalg.det(SWAP) == pytest.approx(1.0)
    assert swap_axes((1.0, 2.0, 3.0)) == (2.0, 1.0, -3.0)
    np.testing.assert_array_equal(SWAP @ [1.0, 2.0, 3.0], swap_axes((1.0, 2.0, 3.0)))


@given(attitudes)
def test_bullets_quaternion_swaps_both_sides(attitude: tuple[float, ...]) -> None:
    R_nb = rotation(attitude)
    np.testing.assert_allclose(rotation_from_quaternion(quaternion_w(R_nb)), SWAP @ R_nb @ SWAP, atol=1e-13)


def test_a_point_on_the_port_bow_stays_on_the_port_bow() -> None:
    port_bow = np.array([100.0, -5.0, 0.0])
    R_nb = rotation((0.0, 0.0, radians(30)))
    in_world = rotation_from_quaternion(quaternion_w(R_nb)) @ np.array(swap_axes(port_bow))
    np.testing.assert_allclose(in_world, swap_axes(R_nb @ port_bow), atol=1e-12)
    assert in_world[0] < 100 * np.sin(radians(30))  # west of the stem: to port on a northerly heading


@given(st.floats(-50.0, 50.0), angle)
def test_unwrapped_heading_has_no_jump(near: float, psi: float) -> None:
    unwrapped = unwrap_attitude(np.array([0.0, 0.0, psi]), near)[2]
    assert abs(unwrapped - near) <= pi + 1e-9
    assert np.cos(unwrapped - psi) == pytest.approx(1.0)
