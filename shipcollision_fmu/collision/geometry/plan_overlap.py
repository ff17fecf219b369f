"""Two solids seen from above: by how much, and in which level direction, they overlap least.

Where hulls overlap deeply with no normal known from before (a start inside each other, a jump of a ship's position),
the direction of least overlap in space is soon the vertical: a ship is lower than she is long. Ships part sideways.
"""

from __future__ import annotations

from math import hypot

import numpy as np

from ...ship.frames import Array
from .clipping import Point, convex_polygon

__all__ = ["least_overlap"]


def least_overlap(points_a: Array, points_b: Array) -> tuple[float, Array, int]:
    """(overlap [m], level unit normal (3,) from a to b, whose side it is, 0 or 1) of the plans of two convex solids.

    Points (n, 3) in n.

    Negative: the plans are apart, by at least so much. Separating axes: the sides of both plans.
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
