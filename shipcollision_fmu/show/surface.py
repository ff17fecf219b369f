"""Triangle surfaces as pictures need them: normals with creases, bands of height, and the nearest point.

A surface is vertices (n, 3) [m] and triangles (m, 3), counter-clockwise seen from outside, in the frame of its body.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..ship.convex import Indices
from ..ship.frames import Array

__all__ = ["Surface", "bands", "corner_normals", "nearest", "solid_triangles"]

FLAT = 1e-9
"""Twice the area over the squared longest edge below which a triangle counts as none: it has no normal."""
EDGE = 0.01
"""Faces whose distance differs by less than this meet at an edge, as far as a picture is concerned [m]."""
CREASE = np.cos(np.radians(35.0))
"""Faces that meet at less than 35 deg are shaded as one round surface."""


@dataclass(frozen=True, eq=False)
class Surface:
    """vertices (n, 3) [m], triangles (m, 3)."""

    vertices: Array
    triangles: Indices


def solid_triangles(surface: Surface) -> Surface:
    """The surface without triangles that have no area in single precision, in which pictures store vertices."""
    p, q, r = (surface.vertices[surface.triangles[:, k]].astype(np.float32).astype(float) for k in range(3))
    area = np.linalg.norm(np.cross(q - p, r - p), axis=1)
    longest = np.max([((a - b) ** 2).sum(axis=1) for a, b in ((p, q), (q, r), (r, p))], axis=0)
    return Surface(surface.vertices, surface.triangles[area > FLAT * longest])


def face_normals(surface: Surface) -> Array:
    """Outward unit normals (m, 3) of triangles that have an area."""
    p, q, r = (surface.vertices[surface.triangles[:, k]] for k in range(3))
    normals = np.cross(q - p, r - p)
    unit: Array = normals / np.linalg.norm(normals, axis=1)[:, None]
    return unit


def corner_normals(surface: Surface) -> Array:
    """Normals (m, 3, 3) per corner: the mean, by area, of the faces at that place that are not across a crease."""
    p, q, r = (surface.vertices[surface.triangles[:, k]] for k in range(3))
    areas = np.cross(q - p, r - p)
    normals = areas / np.linalg.norm(areas, axis=1)[:, None]
    _, place = np.unique(np.round(surface.vertices, 6), axis=0, return_inverse=True)
    corners = place.reshape(-1)[surface.triangles].reshape(-1)  # (3 m,) by place
    order = np.argsort(corners, kind="stable")
    starts = np.flatnonzero(np.diff(corners[order], prepend=-1))
    result = np.empty((len(corners), 3))
    for group in np.split(order, starts[1:]):
        faces = group // 3
        together = (normals[faces] @ normals[faces].T) > CREASE
        result[group] = together @ areas[faces]
    result /= np.linalg.norm(result, axis=1)[:, None]
    return result.reshape(-1, 3, 3)


def bands(surface: Surface, levels: list[float]) -> list[Surface]:
    """The surface cut at heights z = `levels` (increasing, z down): len(levels) + 1 surfaces, the highest first."""
    rest, cut = surface, []
    for level in levels:
        cut.append(_half(rest, level, above=True))
        rest = _half(rest, level, above=False)
    return [*cut, rest]


def _half(surface: Surface, level: float, above: bool) -> Surface:
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


def nearest(surface: Surface, points: Array) -> tuple[Array, Array]:
    """Nearest points of the surface (k, 3) and its outward unit normals there (k, 3), of `points` (k, 3).

    At an edge, where faces meet, the normal is that of the steepest face: ships touch side by side, not from above.
    """
    faces = _Faces(surface)
    found, outwards = np.empty((len(points), 3)), np.empty((len(points), 3))
    for i, point in enumerate(points):
        candidates, rows = faces.nearest(point)
        gap = np.sqrt(((candidates - point) ** 2).sum(axis=1))
        level = np.abs(faces.normals[rows, 2])
        at = int(np.where(gap <= gap.min() + EDGE, level, np.inf).argmin())
        found[i], outwards[i] = candidates[at], faces.normals[rows[at]]
    return found, outwards


class _Faces:
    """The triangles of a surface, with what does not depend on the point that is asked for."""

    def __init__(self, surface: Surface) -> None:
        self._corners = surface.vertices[surface.triangles]  # (m, 3, 3)
        self._edges = np.roll(self._corners, -1, axis=1) - self._corners
        self._squares = (self._edges**2).sum(axis=2)
        self._centres = self._corners.mean(axis=1)
        self._radii = np.sqrt(((self._corners - self._centres[:, None]) ** 2).sum(axis=2).max(axis=1))
        self.normals = face_normals(surface)
        self._inwards = np.cross(self.normals[:, None], self._edges)  # of each edge, in the triangle's plane

    def nearest(self, x: Array) -> tuple[Array, Indices]:
        """Nearest point to x of every triangle that may be the nearest (j, 3), and which these are (j,).

        That of the triangle's plane where it is inside, else that of the nearest edge.
        """
        away = np.sqrt(((self._centres - x) ** 2).sum(axis=1))
        rows = np.flatnonzero(away - self._radii <= (away + self._radii).min())
        corners, edges, normals = self._corners[rows], self._edges[rows], self.normals[rows]
        foot = x - ((x - corners[:, 0]) * normals).sum(axis=1)[:, None] * normals
        inside = (((foot[:, None] - corners) * self._inwards[rows]).sum(axis=2) >= 0.0).all(axis=1)
        share = np.clip(((x - corners) * edges).sum(axis=2) / self._squares[rows], 0.0, 1.0)
        on_edges = corners + share[..., None] * edges
        pick = ((on_edges - x) ** 2).sum(axis=2).argmin(axis=1)
        return np.where(inside[:, None], foot, on_edges[np.arange(len(rows)), pick]), rows
