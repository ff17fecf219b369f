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
    p, q, r = (surface.vertices[surface.triangles[:, k]] for k in range(3))
    centre = (p + q + r) / 3
    radius = np.sqrt(np.max([((x - centre) ** 2).sum(axis=1) for x in (p, q, r)], axis=0))
    normals = face_normals(surface)
    found, outwards = np.empty((len(points), 3)), np.empty((len(points), 3))
    for i, point in enumerate(points):
        away = np.sqrt(((centre - point) ** 2).sum(axis=1))
        near = np.flatnonzero(away - radius <= (away + radius).min())
        candidates = _nearest_of_triangles(p[near], q[near], r[near], point)
        gap = np.sqrt(((candidates - point) ** 2).sum(axis=1))
        level = np.abs(normals[near, 2])
        at = int(np.where(gap <= gap.min() + EDGE, level, np.inf).argmin())
        found[i], outwards[i] = candidates[at], normals[near[at]]
    return found, outwards


def _nearest_of_triangles(a: Array, b: Array, c: Array, x: Array) -> Array:
    """Nearest point of each triangle (m, 3) to x: that of its plane where inside, else that of its edges."""
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    foot = x - np.einsum("ij,ij->i", x - a, normal)[:, None] * normal
    inside = np.ones(len(a), bool)
    edges = []
    for start, end in ((a, b), (b, c), (c, a)):
        along = end - start
        inside &= np.einsum("ij,ij->i", np.cross(along, foot - start), normal) >= 0.0
        share = np.clip(np.einsum("ij,ij->i", x - start, along) / np.einsum("ij,ij->i", along, along), 0.0, 1.0)
        edges.append(start + share[:, None] * along)
    best = np.stack(edges)
    pick = ((best - x) ** 2).sum(axis=2).argmin(axis=0)
    result: Array = np.where(inside[:, None], foot, best[pick, np.arange(len(a))])
    return result
