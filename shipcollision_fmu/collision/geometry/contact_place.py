"""Contact points of two convex parts, given the normal: what their facing features have in common.

The features are the foremost points of either part along the normal. Along the normal they look like a point, an edge
or a face. Their common corners (clipping.py) are the contact points, each with the gap of the two features there.
"""

from __future__ import annotations

from functools import reduce
from operator import add  # sum() rounds otherwise from Python 3.12 on

import numpy as np

from ...ship.frames import Array
from .clipping import Point, common_corners

__all__ = ["FEATURE_DEPTH", "MANIFOLD", "contact_manifold", "facing_features", "spread"]

FEATURE_DEPTH = 0.05
"""Points of a part within this depth [m] of the foremost one belong to the touching feature: plates, edges and stems
count as such while they are within 0.2 degrees of parallel over 15 m."""

MANIFOLD = 4
"""Contact points kept of one pair of parts: enough for the resultant of an area."""


def facing_features(part_a: Array, part_b: Array, normal: Array, depth: float = FEATURE_DEPTH) -> tuple[Array, Array]:
    """Points (k, 3) of the parts a and b (n, 3) that face the other: within `depth` [m] of the foremost along the
    normal, which points from a to b.
    """
    return _foremost(part_a, normal, depth), _foremost(part_b, -normal, depth)


def _foremost(points: Array, direction: Array, depth: float) -> Array:
    height = points @ direction
    feature: Array = points[height >= height.max() - depth]
    return feature


def contact_manifold(feature_a: Array, feature_b: Array, axes: Array) -> list[tuple[Array, float]]:
    """(point in n midway between the features, gap) of each common corner; empty when the features pass each other.

    axes (3, 3): rows normal, t1, t2 in n.
    """
    origin = feature_a[0]
    a = ((feature_a - origin) @ axes.T).tolist()  # rows (height along the normal, u, v)
    b = ((feature_b - origin) @ axes.T).tolist()
    corners = common_corners([(u, v) for _, u, v in a], [(u, v) for _, u, v in b])
    if not corners:
        return []
    plane_a, plane_b = _plane(a), _plane(b)
    places = []
    for u, v in spread(corners):
        height_a, height_b = _height(plane_a, u, v), _height(plane_b, u, v)
        places.append((np.array([0.5 * (height_a + height_b), u, v]), height_b - height_a))
    least = min(gap for _, gap in places)
    # Tilted within FEATURE_DEPTH, with the true touch at an end that the other does not reach: the nearest is in touch.
    shift = max(least, 0.0)
    return [(origin + place @ axes, gap - shift) for place, gap in places]


Plane = tuple[float, float, float, float, float]


def _plane(feature: list[list[float]]) -> Plane:
    """Plane through a feature, by least squares: (u, v, height) of its middle, slopes along u and v.

    Through an edge passes the plane that is level across it, through a point the level one.
    """
    n = len(feature)
    h_0, u_0, v_0 = (reduce(add, (row[k] for row in feature)) / n for k in range(3))
    uu = uv = vv = uh = vh = 0.0
    for h, u, v in feature:
        du, dv, dh = u - u_0, v - v_0, h - h_0
        uu, uv, vv, uh, vh = uu + du * du, uv + du * dv, vv + dv * dv, uh + du * dh, vh + dv * dh
    spread, area = uu + vv, uu * vv - uv * uv
    if area > 1e-9 * spread * spread:
        return u_0, v_0, h_0, (vv * uh - uv * vh) / area, (uu * vh - uv * uh) / area
    if spread > 0.0:
        return u_0, v_0, h_0, (uu * uh + uv * vh) / spread**2, (uv * uh + vv * vh) / spread**2
    return u_0, v_0, h_0, 0.0, 0.0


def _height(plane: Plane, u: float, v: float) -> float:
    u_0, v_0, h_0, along_u, along_v = plane
    return h_0 + (u - u_0) * along_u + (v - v_0) * along_v


def spread(corners: list[Point]) -> list[Point]:
    """At most MANIFOLD corners that still span the area: the extremes along the two diagonals."""
    if len(corners) <= MANIFOLD:
        return corners
    rising = sorted(corners, key=lambda q: q[0] + q[1])
    falling = sorted(corners, key=lambda q: q[0] - q[1])
    return list(dict.fromkeys((rising[0], falling[-1], rising[-1], falling[0])))
