"""Where two hulls touch: Bullet's answer, cleaned until a solver can trust it.

1. A closest point at a positive distance is a prediction, not a contact: only gap <= 0 counts.
2. Bullet gives one point, at an arbitrary place along a line or an area of contact. The contact points are the corners
   of what the two facing features have in common (clipping.py).
3. In deep overlap the direction of least overlap jumps, for a ship soon to the vertical: while the overlap is deeper
   than SHALLOW the last normal from before is kept, turning with the hull whose face it belongs to.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..ship.frames import Array
from ..ship.hull import HullMesh
from .clipping import common_points, convex_polygon
from .contact import Contact
from .engine import Closest, Engine
from .shadow import Shadow

__all__ = ["FEATURE_DEPTH", "SHALLOW", "Detector", "KeptNormals"]

SHALLOW = 0.5
"""Overlap [m] down to which Bullet's normal is taken: some steps of a fast approach, far below a hull's breadth, beyond
which least overlap no longer tells the side that was struck."""

FEATURE_DEPTH = 0.05
"""Points of a hull within this depth [m] of the foremost one belong to the touching feature: plates, edges and stems
count as such while they are within 0.2 degrees of parallel over 15 m."""

SAME_POINT = 0.5
"""Contact points of different convex parts closer than this [m] are one point."""

MANIFOLD = 4
"""Contact points kept of one pair of parts: enough for the resultant of an area."""

KeptNormals = dict[tuple[int, int], tuple[int, list[float]]]
"""Per pair of ships (a, b): which of them carries the last shallow normal, and that normal in its body frame."""


class Detector:
    """Contacts and clearance between hulls. Holds no state that matters: the kept normals belong to the caller."""

    def __init__(self, hulls: Sequence[HullMesh]) -> None:
        self._hulls = tuple(hulls)
        self.engine = Engine(hulls)

    def place(self, ship: int, shadow: Shadow) -> None:
        """Move a hull to its shadow's predicted pose."""
        self.engine.place(ship, shadow.x, shadow.R)

    def clearance(self, a: int, b: int, cap: float) -> float:
        """Least distance [m] between two placed hulls, negative in overlap, at most `cap`."""
        return min((c.gap for c in self.engine.closest(a, b, cap)), default=cap)

    def contacts(self, a: int, b: int, shadows: Sequence[Shadow], kept: KeptNormals) -> list[Contact]:
        """Contact points of two placed hulls, gap <= 0. Updates `kept` while the overlap is shallow."""
        touching = [c for c in self.engine.closest(a, b, 0.0) if c.gap <= 0.0]
        if not touching:
            kept.pop((a, b), None)
            return []
        shallow = min(c.gap for c in touching) > -SHALLOW
        carried = None if shallow else kept.get((a, b))
        found: list[Contact] = []
        for closest in touching:
            if carried is not None:
                carrier, normal_b = carried
                normal = shadows[(a, b)[carrier]].R @ np.array(normal_b)
            else:
                normal = closest.normal
            features = self._features(a, b, closest, normal, shadows)
            if shallow:
                carrier = 0 if len(features[0]) > len(features[1]) else 1
                kept[(a, b)] = (carrier, (shadows[(a, b)[carrier]].R.T @ normal).tolist())
            for point, gap in _manifold(features, normal, closest):
                if gap <= 0.0 and all(np.linalg.norm(point - c.point) > SAME_POINT for c in found):
                    found.append(make_contact(a, b, shadows, point, normal, gap))
        return found

    def _features(
        self, a: int, b: int, closest: Closest, normal: Array, shadows: Sequence[Shadow]
    ) -> tuple[Array, Array]:
        """Points (n, 3) of either part that face the other one: foremost along the normal, within FEATURE_DEPTH."""
        in_a = shadows[a].x + self._hulls[a].parts[closest.part_a] @ shadows[a].R.T
        in_b = shadows[b].x + self._hulls[b].parts[closest.part_b] @ shadows[b].R.T
        height_a, height_b = in_a @ normal, in_b @ normal
        return in_a[height_a >= height_a.max() - FEATURE_DEPTH], in_b[height_b <= height_b.min() + FEATURE_DEPTH]


def make_contact(a: int, b: int, shadows: Sequence[Shadow], point: Array, normal: Array, gap: float) -> Contact:
    """Contact at `point` (n, predicted poses), with its place on either hull and where its impulse is booked."""
    r_a, r_b = shadows[a].body(point), shadows[b].body(point)
    at = 0.5 * (shadows[a].point_received(r_a) + shadows[b].point_received(r_b))
    return Contact(a, b, point, normal, gap, r_a, r_b, at)


def _manifold(features: tuple[Array, Array], normal: Array, closest: Closest) -> list[tuple[Array, float]]:
    """Contact points in n, midway between the two features, with their gaps along the normal."""
    feature_a, feature_b = features
    t1 = np.cross(normal, [0.0, 0.0, 1.0] if abs(normal[2]) < 0.9 else [1.0, 0.0, 0.0])
    t1 /= np.linalg.norm(t1)
    plane = np.column_stack([t1, np.cross(normal, t1)])
    origin = feature_a[0]
    corners = common_points(convex_polygon((feature_a - origin) @ plane), convex_polygon((feature_b - origin) @ plane))
    if not corners:  # the features pass each other (a corner beside a face's edge): Bullet's own point is the contact
        return [(0.5 * (closest.on_a + closest.on_b), min(closest.gap, 0.0))]
    uv = np.array(_spread(corners))
    height_a = _height(feature_a - origin, plane, normal, uv)
    height_b = _height(feature_b - origin, plane, normal, uv)
    points = origin + uv @ plane.T + np.outer(0.5 * (height_a + height_b), normal)
    gaps = height_b - height_a
    if gaps.min() > 0.0:  # tilted within FEATURE_DEPTH, and the true touch is at an end that the other does not reach
        gaps = gaps - gaps.min()
    return list(zip(points, gaps.tolist(), strict=True))


def _height(feature: Array, plane: Array, normal: Array, uv: Array) -> Array:
    """Height (n,) of a feature along the normal over the plane points uv: the plane (or line, or point) through it."""
    here = feature @ plane
    centre = here.mean(axis=0)
    heights = feature @ normal
    slope = np.linalg.lstsq(here - centre, heights - heights.mean(), rcond=1e-9)[0]
    result: Array = heights.mean() + (uv - centre) @ slope
    return result


def _spread(corners: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """At most MANIFOLD corners that still span the area: the extremes along the two diagonals."""
    if len(corners) <= MANIFOLD:
        return corners
    picks = [max(corners, key=lambda q, s=s: s[0] * q[0] + s[1] * q[1]) for s in ((1, 1), (-1, 1), (-1, -1), (1, -1))]  # type: ignore[misc]
    return list(dict.fromkeys(picks))
