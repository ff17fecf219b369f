"""Positions in which two upright hulls touch at a given place, in plan.

Upright hulls on one waterline are widest at the deck: rake and flare lean outwards, the bilge inwards. They therefore
touch first at the height of the lower deck, and contact is a question of two convex polygons, the sections there.

    section        polygon (n, 2) of a hull at height z, in b: x forward, y starboard; corners by rising angle
    place          point of the boundary with its outward normals: one on an edge, two at a corner, and all between them
    plan contact   position of the other ship's CO in which it touches the place along one of these normals

Coasting ships that keep their headings move on a straight line relative to each other. If they close along the normals
at the place, they touch there first: the difference of two convex sets is convex and lies behind those normals.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, inf, pi, remainder, sin
from typing import Literal

import numpy as np

from ..collision.geometry.clipping import convex_polygon
from ..ship.frames import Array
from ..ship.hull.solid import HullMesh

__all__ = [
    "Place", "PlanContact", "Side", "cut_section", "find_contact_height", "find_contacts", "find_top",
    "locate_place",
    "measure_gap", "move_polygon",
]  # fmt: skip

Side = Literal["port", "starboard"]

NEAR = 1e-6
"""[m] Distance within which a point is a corner of a section, or on it. Rounding of coordinates is 1e-13 m; a larger
value would join neighbouring corners of a fine mesh."""
FLAT = 2e-3
"""[m] An edge whose ends differ in reach by less lies flat: contact is then along it. Smaller, and the place would be
met by one of two corners, by rounding."""


@dataclass(frozen=True)
class Place:
    """A point of a section (2,) [m] and the directions of its first and last outward normal, rising [rad]."""

    point: Array
    normals: tuple[float, float]

    def nearest_normal(self, direction: float) -> float:
        """The outward normal nearest to a direction [rad]."""
        first, last = self.normals
        middle, half = 0.5 * (first + last), 0.5 * (last - first)
        return middle + min(half, max(-half, remainder(direction - middle, 2.0 * pi)))


@dataclass(frozen=True)
class PlanContact:
    """A position in which the other ship touches the struck ship.

    position   CO of the other ship (2,), in the struck ship's b [m]
    normals    outward normals of the contact (k, 2), in the struck ship's b. The first is that along which they touch;
               the others bound those that both hulls have there. Ships meet when they close along all of them.
    point      the point of contact (2,), in the other ship's b [m]
    """

    position: Array
    normals: Array
    point: Array


def find_contact_height(a: HullMesh, b: HullMesh) -> float:
    """Height z (down) at which two upright hulls touch in plan: that of the lower deck [m]."""
    return max(find_top(a), find_top(b))


def find_top(hull: HullMesh) -> float:
    """Height z (down) of the deck of an upright hull, where it is highest [m]."""
    return float(hull.vertices[:, 2].min())


def cut_section(hull: HullMesh, z: float) -> Array:
    """Convex hull of the hull's section at height z (down) [m]; (n, 2) in b."""
    corners = hull.vertices[hull.triangles]
    points = [corners[np.abs(corners[..., 2] - z) <= NEAR][:, :2]]
    for i, j in ((0, 1), (1, 2), (2, 0)):
        p, q = corners[:, i], corners[:, j]
        crossing = (p[:, 2] - z) * (q[:, 2] - z) < 0.0
        p, q = p[crossing], q[crossing]
        share = ((z - p[:, 2]) / (q[:, 2] - p[:, 2]))[:, None]
        points.append((p + share * (q - p))[:, :2])
    return np.array(convex_polygon((round(float(x), 9), round(float(y), 9)) for x, y in np.vstack(points)))


def locate_place(section: Array, x: float, side: Side) -> Place:
    """The boundary's point at x forward of CO [m] on a side; beyond an end, the middle of that end."""
    foremost, aftmost = float(section[:, 0].max()), float(section[:, 0].min())
    if x >= foremost - NEAR or x <= aftmost + NEAR:
        end = foremost if x >= foremost - NEAR else aftmost
        corners = section[np.abs(section[:, 0] - end) <= NEAR]
        return _place_at(section, np.array([end, 0.5 * (corners[:, 1].min() + corners[:, 1].max())]))
    sign = 1.0 if side == "starboard" else -1.0
    best = -inf
    for p, q in zip(section, np.roll(section, -1, axis=0), strict=True):
        if min(p[0], q[0]) <= x <= max(p[0], q[0]) and abs(q[0] - p[0]) > NEAR:
            best = max(best, sign * float(p[1] + (x - p[0]) / (q[0] - p[0]) * (q[1] - p[1])))
    return _place_at(section, np.array([x, sign * best]))


def find_contacts(place: Place, section: Array, heading: float) -> list[PlanContact]:
    """Positions in which a ship of this section and heading [rad], relative to the struck ship, touches the place.

    In the first its bow faces the place most. At a corner of the struck ship there are others, one for each corner of
    the other ship that fits on it.
    """
    preferred = place.nearest_normal(heading + pi)
    directions = [preferred]
    width = place.normals[1] - place.normals[0]
    for corner in section if width > 0.0 else ():
        first, last = (place.normals[0] + remainder(n + heading + pi - place.normals[0], 2.0 * pi)
                       for n in _place_at(section, corner).normals)  # fmt: skip
        if last < first:
            last += 2.0 * pi
        low, high = max(first, place.normals[0]), min(last, place.normals[1])
        if high > low:
            directions.append(0.5 * (low + high))
    return [_touch_along(place, section, heading, n) for n in sorted(directions, key=lambda n: abs(n - preferred))]


def _touch_along(place: Place, section: Array, heading: float, direction: float) -> PlanContact:
    """The contact whose normal at the place has a direction [rad]."""
    R = _rotation(heading)
    towards = R.T @ -_unit(direction)
    reach = section @ towards
    foremost = section[reach >= reach.max() - FLAT]  # a corner, or the ends of an edge that lies flat
    point = foremost.mean(axis=0)
    point = point + (reach.max() - float(point @ towards)) * towards
    bounds = [direction]
    if len(foremost) == 1:  # where the normals of two corners overlap
        theirs = [n + heading + pi for n in _place_at(section, foremost[0]).normals]
        first, last = (direction + remainder(n - direction, 2.0 * pi) for n in theirs)
        bounds += [max(first, direction + remainder(place.normals[0] - direction, 2.0 * pi))]
        bounds += [min(last, direction + remainder(place.normals[1] - direction, 2.0 * pi))]
    return PlanContact(place.point - R @ point, np.array([_unit(n) for n in bounds]), point)


def move_polygon(polygon: Array, position: Array, heading: float) -> Array:
    """The polygon of a ship with CO at `position` (2,) and `heading` [rad], in n."""
    turned: Array = polygon @ _rotation(heading).T + position
    return turned


def measure_gap(a: Array, b: Array) -> float:
    """Largest distance [m] along any edge's normal between two convex polygons: negative where they overlap."""
    return max(_gap_along_normals(a, b), _gap_along_normals(b, a))


def _gap_along_normals(a: Array, b: Array) -> float:
    edges = np.roll(a, -1, axis=0) - a
    normals = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.linalg.norm(edges, axis=1)[:, None]
    return float(((normals @ b.T).min(axis=1) - np.einsum("ij,ij->i", normals, a)).max())


def _unit(direction: float) -> Array:
    return np.array([cos(direction), sin(direction)])


def _rotation(heading: float) -> Array:
    c, s = cos(heading), sin(heading)
    return np.array([[c, -s], [s, c]])


def _place_at(polygon: Array, point: Array) -> Place:
    """The point with the normals of its edge, or of both edges that meet in it."""
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
