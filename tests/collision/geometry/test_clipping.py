"""Common points of two convex sets: 0, 1, 2 and more corners, in any order and orientation."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.collision.geometry.clipping import common_points, convex_polygon

SQUARE = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]


def as_set(points: list[tuple[float, float]]) -> set[tuple[float, float]]:
    return {(round(u, 6) + 0.0, round(v, 6) + 0.0) for u, v in points}


def area(p: list[tuple[float, float]]) -> float:
    return 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(p, p[1:] + p[:1], strict=True))


@pytest.mark.parametrize(
    ("first", "second", "common"),
    [
        ([], SQUARE, []),
        ([(1.0, 1.0)], SQUARE, [(1.0, 1.0)]),
        ([(3.0, 1.0)], SQUARE, []),
        ([(1.0, 1.0)], [(1.0, 1.0)], [(1.0, 1.0)]),
        ([(1.0, 1.0)], [(0.0, 0.0), (2.0, 2.0)], [(1.0, 1.0)]),
        ([(1.0, 1.1)], [(0.0, 0.0), (2.0, 2.0)], []),
        ([(1.0, -5.0), (1.0, 5.0)], SQUARE, [(1.0, 0.0), (1.0, 2.0)]),  # a stem across a side
        ([(1.0, 0.5), (1.0, 5.0)], SQUARE, [(1.0, 0.5), (1.0, 2.0)]),
        ([(1.0, 0.5), (1.0, 1.5)], SQUARE, [(1.0, 0.5), (1.0, 1.5)]),
        ([(5.0, 0.5), (5.0, 1.5)], SQUARE, []),
        ([(0.0, 0.0), (0.0, 3.0)], [(0.0, 2.0), (0.0, 9.0)], [(0.0, 2.0), (0.0, 3.0)]),  # two stems on one line
        ([(-1.0, 0.0), (1.0, 0.0)], [(0.0, -1.0), (0.0, 1.0)], [(0.0, 0.0)]),
        ([(-1.0, 0.0), (1.0, 0.0)], [(0.0, 0.5), (0.0, 1.0)], []),
        (SQUARE, [(1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 3.0)], [(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)]),
        (SQUARE, [(5.0, 5.0), (6.0, 5.0), (6.0, 6.0)], []),
    ],
)
def test_known_intersections(first: list, second: list, common: list) -> None:
    assert as_set(common_points(first, second)) == as_set(common)
    assert as_set(common_points(second, first)) == as_set(common)


def test_convex_polygon_drops_inner_and_collinear_points() -> None:
    points = np.array([[0, 0], [1, 0], [2, 0], [2, 2], [1, 1], [0, 2], [0, 1]], dtype=float)
    assert as_set(convex_polygon(map(tuple, points.tolist()))) == as_set(SQUARE)
    assert area(convex_polygon(map(tuple, points.tolist()))) == pytest.approx(4.0)  # counter-clockwise


def test_points_on_a_line_become_its_ends() -> None:
    assert as_set(convex_polygon([(0.0, 0.0), (1.0, 1.0), (3.0, 3.0), (2.0, 2.0)])) == {(0.0, 0.0), (3.0, 3.0)}


coordinate = st.floats(-5.0, 5.0)
polygons = st.lists(st.tuples(coordinate, coordinate), min_size=3, max_size=9).map(
    convex_polygon
).filter(lambda p: len(p) >= 3 and area(p) > 0.1)  # fmt: skip


@given(polygons, polygons)
def test_intersection_lies_in_both_and_is_symmetric(first: list, second: list) -> None:
    one, two = common_points(first, second), common_points(second, first)
    for polygon in (first, second):
        for q in one:
            for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True):
                side = (b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0])
                assert side >= -1e-4 * np.hypot(b[0] - a[0], b[1] - a[1])
    if len(one) >= 3 and len(two) >= 3:
        assert area(one) == pytest.approx(area(two), abs=1e-3)
