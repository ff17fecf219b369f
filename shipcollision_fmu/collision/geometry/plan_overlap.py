"""Overlap of two convex solids in plan: its least size, and the horizontal direction of it.

Used where hulls overlap deeply and have no last normal: a start inside each other, or a ship that the host has moved.
The direction of least overlap in space would soon be the vertical, since a ship is lower than it is long. Ships part
sideways.
"""

from __future__ import annotations

from math import hypot

import numpy as np

from ...ship.frames import Array
from .clipping import Point, convex_polygon

__all__ = ["least_overlap"]


def least_overlap(points_a: Array, points_b: Array) -> tuple[float, Array, int]:
    """(least overlap [m], horizontal unit normal (3,) from a to b, body whose side it is: 0 or 1), in plan.

    points (n, 3): corners of either solid in n. A negative overlap is a distance: the plans are at least so far apart.
    Method of separating axes, which are the sides of both plans.
    """
    plan_a, plan_b = (convex_polygon((float(x), float(y)) for x, y, _ in p) for p in (points_a, points_b))
    best, normal, owner = float("inf"), (1.0, 0.0), 0
    for carrier, (plan, sign) in enumerate(((plan_a, 1.0), (plan_b, -1.0))):
        for x, y in _outward(plan):
            n = (sign * x, sign * y)
            overlap = max(_along(n, plan_a)) - min(_along(n, plan_b))
            if overlap < best:
                best, normal, owner = overlap, n, carrier
    return best, np.array([normal[0], normal[1], 0.0]), owner


def _outward(plan: list[Point]) -> list[Point]:
    """Unit normals of the sides of a counter-clockwise polygon; of a line both, of a point the four quarters."""
    if len(plan) < 2:
        return [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)]
    normals = []
    for (x_0, y_0), (x_1, y_1) in zip(plan, plan[1:] + plan[:1], strict=True):
        length = hypot(x_1 - x_0, y_1 - y_0)
        normals.append(((y_1 - y_0) / length, (x_0 - x_1) / length))
    return normals


def _along(n: Point, plan: list[Point]) -> list[float]:
    return [n[0] * x + n[1] * y for x, y in plan]
