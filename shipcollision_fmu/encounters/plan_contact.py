"""Where two upright hulls touch, seen from above: horizontal sections as convex polygons.

Upright hulls on one waterline that are widest at the deck (rake and flare lean outwards, the bilge inwards) touch first
at the lower of the two decks, so contact is a question of two polygons: the sections at that height.

    section   polygon (n, 2) of a hull at height z, in b: x forward, y starboard; corners in the order of rising angle
    place     point of the boundary with its outward normals: one on an edge, two at a corner, and all between them
    touch     where the other ship's CO must be so that she touches the place, with that normal which faces her bow most
    touches   the same, and the other ways in which she can, at a corner

Coasting ships that keep their headings move on a straight line relative to each other. If they close along the normals
there, they touch there first: the difference of two convex sets is convex and lies behind those normals.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, inf, pi, remainder, sin
from typing import Literal

import numpy as np

from ..ship.frames import Array
from ..ship.hull.solid import HullMesh

__all__ = ["Place", "Side", "Touch", "common_deck", "gap", "moved", "place", "section", "touch", "touches"]

Side = Literal["port", "starboard"]

NEAR = 1e-6
"""[m] Distance within which a point is a corner of a section."""
FLAT = 2e-3
"""[m] Difference in reach of an edge's ends up to which it lies flat: contact is then along it, not at its corner."""


@dataclass(frozen=True)
class Place:
    """A point of a section (2,) [m] and the directions of the first and last outward normal there, rising [rad]."""

    point: Array
    normals: tuple[float, float]

    def normal_towards(self, direction: float) -> float:
        """The outward normal nearest to a direction [rad]."""
        first, last = self.normals
        middle, half = 0.5 * (first + last), 0.5 * (last - first)
        return middle + min(half, max(-half, remainder(direction - middle, 2.0 * pi)))


@dataclass(frozen=True)
class Touch:
    """The other ship's CO (2,) [m], the normals at which they touch (k, 2), and the point of her section (2,) [m].

    CO and normals, outwards, in the struck ship's b, the point in the other's. The first normal faces her bow most; the
    others bound those that both hulls have in common there: ships meet when they close along all of them.
    """

    position: Array
    normals: Array
    point: Array


def common_deck(a: HullMesh, b: HullMesh) -> float:
    """Height z (down) of the lower deck of two hulls [m]."""
    return float(max(a.vertices[:, 2].min(), b.vertices[:, 2].min()))


def section(hull: HullMesh, z: float) -> Array:
    """Convex hull of the hull's section at height z (down) [m]; (n, 2) in b."""
    corners = hull.vertices[hull.triangles]
    points = [corners[np.abs(corners[..., 2] - z) <= NEAR][:, :2]]
    for i, j in ((0, 1), (1, 2), (2, 0)):
        p, q = corners[:, i], corners[:, j]
        crossing = (p[:, 2] - z) * (q[:, 2] - z) < 0.0
        p, q = p[crossing], q[crossing]
        share = ((z - p[:, 2]) / (q[:, 2] - p[:, 2]))[:, None]
        points.append((p + share * (q - p))[:, :2])
    return _convex_hull(np.vstack(points))


def place(polygon: Array, x: float, side: Side) -> Place:
    """The boundary's point at x forward of CO [m] on a side; beyond an end, the middle of that end."""
    foremost, aftmost = float(polygon[:, 0].max()), float(polygon[:, 0].min())
    if x >= foremost - NEAR or x <= aftmost + NEAR:
        end = foremost if x >= foremost - NEAR else aftmost
        there = polygon[np.abs(polygon[:, 0] - end) <= NEAR]
        return _place_at(polygon, np.array([end, 0.5 * (there[:, 1].min() + there[:, 1].max())]))
    sign = 1.0 if side == "starboard" else -1.0
    best = -inf
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        if min(p[0], q[0]) <= x <= max(p[0], q[0]) and abs(q[0] - p[0]) > NEAR:
            best = max(best, sign * float(p[1] + (x - p[0]) / (q[0] - p[0]) * (q[1] - p[1])))
    return _place_at(polygon, np.array([x, sign * best]))


def touches(at: Place, other: Array, heading: float) -> list[Touch]:
    """The ways in which another ship of section `other` and `heading` [rad], relative to the struck one, can be there.

    The first has her bow to the place. At a corner there are others, one for each corner of hers that fits on it.
    """
    preferred = at.normal_towards(heading + pi)
    directions = [preferred]
    width = at.normals[1] - at.normals[0]
    for corner in other if width > 0.0 else ():
        first, last = (at.normals[0] + remainder(n + heading + pi - at.normals[0], 2.0 * pi)
                       for n in _place_at(other, corner).normals)  # fmt: skip
        if last < first:
            last += 2.0 * pi
        low, high = max(first, at.normals[0]), min(last, at.normals[1])
        if high > low:
            directions.append(0.5 * (low + high))
    return [_touch_along(at, other, heading, n) for n in sorted(directions, key=lambda n: abs(n - preferred))]


def touch(at: Place, other: Array, heading: float) -> Touch:
    """The other ship, of section `other` and `heading` [rad] relative to the struck one, with her bow at a place."""
    return touches(at, other, heading)[0]


def _touch_along(at: Place, other: Array, heading: float, direction: float) -> Touch:
    """With that normal of the place, a direction [rad], at which both touch."""
    R = _rotation(heading)
    towards = R.T @ -_unit(direction)
    reach = other @ towards
    touching = other[reach >= reach.max() - FLAT]  # a corner, or the ends of an edge that lies flat
    point = touching.mean(axis=0)
    point = point + (reach.max() - float(point @ towards)) * towards
    bounds = [direction]
    if len(touching) == 1:  # where the normals of two corners overlap
        theirs = [n + heading + pi for n in _place_at(other, touching[0]).normals]
        first, last = (direction + remainder(n - direction, 2.0 * pi) for n in theirs)
        bounds += [max(first, direction + remainder(at.normals[0] - direction, 2.0 * pi))]
        bounds += [min(last, direction + remainder(at.normals[1] - direction, 2.0 * pi))]
    return Touch(at.point - R @ point, np.array([_unit(n) for n in bounds]), point)


def moved(polygon: Array, position: Array, heading: float) -> Array:
    """The polygon of a ship with CO at `position` (2,) and `heading` [rad], in n."""
    turned: Array = polygon @ _rotation(heading).T + position
    return turned


def gap(a: Array, b: Array) -> float:
    """Largest distance [m] along any edge's normal between two convex polygons: negative where they overlap."""
    return max(_along_normals(a, b), _along_normals(b, a))


def _along_normals(a: Array, b: Array) -> float:
    edges = np.roll(a, -1, axis=0) - a
    normals = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.linalg.norm(edges, axis=1)[:, None]
    return float(((normals @ b.T).min(axis=1) - np.einsum("ij,ij->i", normals, a)).max())


def _unit(direction: float) -> Array:
    return np.array([cos(direction), sin(direction)])


def _rotation(heading: float) -> Array:
    c, s = cos(heading), sin(heading)
    return np.array([[c, -s], [s, c]])


def _place_at(polygon: Array, point: Array) -> Place:
    """With the normals of the edge, or of both edges that meet there."""
    edges = np.roll(polygon, -1, axis=0) - polygon
    directions = [atan2(-dx, dy) for dx, dy in edges]
    distances = np.linalg.norm(polygon - point, axis=1)
    k = int(distances.argmin())
    if distances[k] <= NEAR:
        first = directions[k - 1]
        return Place(polygon[k], (first, first + remainder(directions[k] - first, 2.0 * pi)))
    along = np.einsum("ij,ij->i", edges, point - polygon) / np.einsum("ij,ij->i", edges, edges)
    feet = polygon + np.clip(along, 0.0, 1.0)[:, None] * edges
    k = int(np.linalg.norm(feet - point, axis=1).argmin())
    return Place(point, (directions[k], directions[k]))


def _convex_hull(points: Array) -> Array:
    """Andrew's monotone chain; corners in the order of rising angle from x to y."""
    ordered = sorted({(round(float(x), 9), round(float(y), 9)) for x, y in points})

    def chain(along: list[tuple[float, float]]) -> list[tuple[float, float]]:
        kept: list[tuple[float, float]] = []
        for x, y in along:
            while len(kept) > 1:
                (x_0, y_0), (x_1, y_1) = kept[-2:]
                if (x_1 - x_0) * (y - y_0) - (y_1 - y_0) * (x - x_0) > 1e-9:
                    break
                kept.pop()
            kept.append((x, y))
        return kept[:-1]

    return np.array(chain(ordered) + chain(ordered[::-1]))
