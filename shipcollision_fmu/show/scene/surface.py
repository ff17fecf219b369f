"""Triangle surfaces of pictures: normals with creases, bands of height, and nearest points.

A surface is vertices (n, 3) [m] and triangles (m, 3), counter-clockwise seen from outside, in the frame of its body.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...ship.frames import Array
from ...ship.hull.convex import Indices

__all__ = ["Surface", "compute_corner_normals", "cut_into_bands", "drop_flat_triangles", "find_nearest_points"]

FLAT = 1e-9
"""Least ratio of twice the area to the squared longest edge; a flatter triangle has no reliable normal."""
EDGE = 0.01
"""[m] Faces whose distances from a point differ by less count as equally near, as at an edge."""
TOGETHER = 32
"""Number of neighbouring points that are searched together, for speed."""
CREASE = np.cos(np.radians(35.0))
"""Faces that meet at less than 35 deg are shaded as one round surface."""


@dataclass(frozen=True, eq=False)
class Surface:
    """vertices (n, 3) [m], triangles (m, 3)."""

    vertices: Array
    triangles: Indices


def drop_flat_triangles(surface: Surface) -> Surface:
    """The surface without triangles that have no area in single precision, in which pictures store vertices."""
    p, q, r = (surface.vertices[surface.triangles[:, k]].astype(np.float32).astype(float) for k in range(3))
    area = np.linalg.norm(np.cross(q - p, r - p), axis=1)
    longest = np.max([((a - b) ** 2).sum(axis=1) for a, b in ((p, q), (q, r), (r, p))], axis=0)
    return Surface(surface.vertices, surface.triangles[area > FLAT * longest])


def compute_face_normals(surface: Surface) -> Array:
    """Outward unit normals (m, 3) of triangles that have an area."""
    p, q, r = (surface.vertices[surface.triangles[:, k]] for k in range(3))
    normals = np.cross(q - p, r - p)
    unit: Array = normals / np.linalg.norm(normals, axis=1)[:, None]
    return unit


def compute_corner_normals(surface: Surface) -> Array:
    """Normals (m, 3, 3) per corner: the mean, by area, of the faces at that place that are not across a crease."""
    p, q, r = (surface.vertices[surface.triangles[:, k]] for k in range(3))
    areas = np.cross(q - p, r - p)
    normals = areas / np.linalg.norm(areas, axis=1)[:, None]
    _, place = np.unique(np.round(surface.vertices, 6), axis=0, return_inverse=True)
    corners = place.reshape(-1)[surface.triangles].reshape(-1)  # (3 m,) by place
    order = np.argsort(corners, kind="stable")
    starts = np.flatnonzero(np.diff(corners[order], prepend=-1))
    counts = np.diff(starts, append=len(order))
    result = np.empty((len(corners), 3))
    for count in np.unique(counts):  # the places at which so many corners meet, all at once
        groups = order[starts[counts == count, None] + np.arange(count)]
        faces = groups // 3
        together = (normals[faces] @ normals[faces].transpose(0, 2, 1)) > CREASE
        result[groups] = together.astype(float) @ areas[faces]
    result /= np.linalg.norm(result, axis=1)[:, None]
    return result.reshape(-1, 3, 3)


def cut_into_bands(surface: Surface, levels: list[float]) -> list[Surface]:
    """The surface cut at heights z = `levels` (increasing, z down): len(levels) + 1 surfaces, the highest first."""
    rest, cut = surface, []
    for level in levels:
        cut.append(_cut_half(rest, level, above=True))
        rest = _cut_half(rest, level, above=False)
    return [*cut, rest]


def _cut_half(surface: Surface, level: float, above: bool) -> Surface:
    """What lies above (z < level) or below; triangles across are clipped."""
    sign = 1.0 if above else -1.0
    height = sign * (level - surface.vertices[:, 2])  # positive: kept
    keep = height[surface.triangles] > 0.0
    whole = surface.triangles[keep.all(axis=1)]
    vertices, triangles = [*surface.vertices], [*map(tuple, whole.tolist())]
    for corners in surface.triangles[keep.any(axis=1) & ~keep.all(axis=1)].tolist():
        polygon: list[int] = []
        for a, b in zip(corners, [*corners[1:], corners[0]], strict=True):
            if height[a] > 0.0:
                polygon.append(a)
            if (height[a] > 0.0) != (height[b] > 0.0):
                share = height[a] / (height[a] - height[b])
                point = surface.vertices[a] + share * (surface.vertices[b] - surface.vertices[a])
                point[2] = level
                polygon.append(len(vertices))
                vertices.append(point)
        triangles += [(polygon[0], polygon[i], polygon[i + 1]) for i in range(1, len(polygon) - 1)]
    return Surface(np.array(vertices), np.array(triangles, dtype=np.int64).reshape(-1, 3))


def find_nearest_points(surface: Surface, points: Array) -> tuple[Array, Array]:
    """Nearest points of the surface (k, 3) and its outward unit normals there (k, 3), of `points` (k, 3).

    At an edge, where faces meet, the normal is that of the steepest face: ships touch side by side, not from above.
    """
    faces = _Faces(surface)
    found, outwards = np.empty((len(points), 3)), np.empty((len(points), 3))
    for start in range(0, len(points), TOGETHER):
        rows = slice(start, start + TOGETHER)
        found[rows], outwards[rows] = faces.nearest(points[rows])
    return found, outwards


class _Faces:
    """The triangles of a surface, with all quantities that do not depend on the point."""

    def __init__(self, surface: Surface) -> None:
        self._corners = surface.vertices[surface.triangles]  # (m, 3, 3)
        self._edges = np.roll(self._corners, -1, axis=1) - self._corners
        self._squares = (self._edges**2).sum(axis=2)
        self._centres = self._corners.mean(axis=1)
        self._radii = np.sqrt(((self._corners - self._centres[:, None]) ** 2).sum(axis=2).max(axis=1))
        self.normals = compute_face_normals(surface)
        self._inwards = np.cross(self.normals[:, None], self._edges)  # of each edge, in the triangle's plane

    def nearest(self, points: Array) -> tuple[Array, Array]:
        """Nearest points (k, 3) and normals there (k, 3), of neighbouring points (k, 3)."""
        near = self._near(points)
        on_faces = self._nearest_of_each(points[:, None], near)  # (k, j, 3)
        gaps = np.sqrt(((on_faces - points[:, None]) ** 2).sum(axis=2))
        level = np.abs(self.normals[near, 2])
        pick = np.where(gaps <= gaps.min(axis=1)[:, None] + EDGE, level, np.inf).argmin(axis=1)
        return on_faces[np.arange(len(points)), pick], self.normals[near[pick]]

    def _near(self, points: Array) -> Indices:
        """Rows of all triangles that may be the nearest to one of the points."""
        middle = points.mean(axis=0)
        spread = np.sqrt(((points - middle) ** 2).sum(axis=1).max())
        away = np.sqrt(((self._centres - middle) ** 2).sum(axis=1))
        return np.flatnonzero(away - self._radii <= (away + self._radii).min() + 2.0 * spread + EDGE)

    def _nearest_of_each(self, x: Array, rows: Indices) -> Array:
        """Nearest point of each triangle (j) to x (k, 1, 3): that of its plane if inside, else that of an edge."""
        corners, edges, normals = self._corners[rows], self._edges[rows], self.normals[rows]
        foot = x - ((x - corners[:, 0]) * normals).sum(axis=2)[..., None] * normals
        inside = (((foot[:, :, None] - corners) * self._inwards[rows]).sum(axis=3) >= 0.0).all(axis=2)
        from_corners = x[:, :, None] - corners
        share = np.clip((from_corners * edges).sum(axis=3) / self._squares[rows], 0.0, 1.0)
        on_edges = corners + share[..., None] * edges  # (k, j, 3, 3)
        pick = ((on_edges - x[:, :, None]) ** 2).sum(axis=3).argmin(axis=2)
        on_edge = np.take_along_axis(on_edges, pick[..., None, None], axis=2)[:, :, 0]
        return np.where(inside[..., None], foot, on_edge)
