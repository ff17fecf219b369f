"""Simple solids of pictures: boxes, prisms over a plan, rods, and flat faces. All normals point outwards.

Frame b: x forward, y starboard, z down. A plan (k, 2) runs from the bow along starboard and back along port.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ...ship.frames import Array
from ...ship.hull.convex import Indices
from .surface import Surface

__all__ = [
    "Shape",
    "join_shapes",
    "join_surfaces",
    "make_box",
    "make_faces",
    "make_loft",
    "make_prism",
    "make_rod",
    "mirror_surface",
]

Span = tuple[float, float]
Shape = tuple[str, Surface]
"""A part of a mesh: the name of its paint, and its surface."""

_BOX = np.array([
    (0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2),
    (1, 3, 7), (1, 7, 5),
])  # fmt: skip


def make_box(x: Span, y: Span, z: Span) -> Surface:
    """A box from (x0, y0, z0) to (x1, y1, z1), each pair increasing [m]."""
    return Surface(np.array([(a, b, c) for c in z for b in y for a in x]), _BOX)


def make_loft(lower: Array, z_lower: float, upper: Array, z_upper: float) -> Surface:
    """A solid between two convex plans (k, 2) of as many corners, `lower` at z_lower > z_upper."""
    k = len(lower)
    vertices = np.vstack([
        np.column_stack([lower, np.full(k, z_lower)]),
        np.column_stack([upper, np.full(k, z_upper)]),
    ])  # fmt: skip
    i = np.arange(k)
    j = np.roll(i, -1)
    fan = np.arange(1, k - 1)
    triangles = np.vstack([
        np.column_stack([i, i + k, j + k]), np.column_stack([i, j + k, j]),
        np.column_stack([0 * fan, fan, fan + 1]), np.column_stack([0 * fan + k, fan + 1 + k, fan + k]),
    ])  # fmt: skip
    return Surface(vertices, triangles)


def make_prism(plan: Array, z: Span) -> Surface:
    """A solid with the convex plan (k, 2) from z0 down to z1 > z0."""
    return make_loft(plan, z[1], plan, z[0])


def make_rod(start: Sequence[float], end: Sequence[float], radius: float, sides: int = 6) -> Surface:
    """A closed rod between two points [m]."""
    a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    along = (b - a) / np.linalg.norm(b - a)
    first = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
    first /= np.linalg.norm(first)
    second = np.cross(along, first)
    angle = 2.0 * np.pi * (np.arange(sides) + 0.5) / sides
    ring = radius * (np.cos(angle)[:, None] * first + np.sin(angle)[:, None] * second)
    i = np.arange(sides)
    j, fan = np.roll(i, -1), np.arange(1, sides - 1)
    triangles = np.vstack([
        np.column_stack([i, j, j + sides]), np.column_stack([i, j + sides, i + sides]),
        np.column_stack([0 * fan, fan + 1, fan]), np.column_stack([0 * fan + sides, fan + sides, fan + 1 + sides]),
    ])  # fmt: skip
    return Surface(np.vstack([a + ring, b + ring]), triangles)


def make_faces(corners: Array) -> Surface:
    """Plane quadrilaterals (k, 4, 3), corners counter-clockwise seen from their outside."""
    first = 4 * np.arange(len(corners), dtype=np.int64)[:, None]
    triangles: Indices = np.vstack([first + np.array([0, 1, 2]), first + np.array([0, 2, 3])])
    return Surface(np.asarray(corners, dtype=float).reshape(-1, 3), triangles)


def mirror_surface(surface: Surface) -> Surface:
    """The surface on the other side of the centre plane, its normals outwards again."""
    return Surface(surface.vertices * [1.0, -1.0, 1.0], surface.triangles[:, ::-1])


def join_surfaces(surfaces: Sequence[Surface]) -> Surface:
    """All triangles of some surfaces as one surface."""
    if not surfaces:
        return Surface(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))
    offsets = np.cumsum([0, *(len(surface.vertices) for surface in surfaces[:-1])])
    triangles: Indices = np.vstack([s.triangles + offset for s, offset in zip(surfaces, offsets, strict=True)])
    return Surface(np.vstack([surface.vertices for surface in surfaces]), triangles)


def join_shapes(shapes: Iterable[Shape]) -> list[Shape]:
    """Surfaces of the same paint joined to one."""
    by_paint: dict[str, list[Surface]] = {}
    for paint, surface in shapes:
        by_paint.setdefault(paint, []).append(surface)
    return [(paint, join_surfaces(surfaces)) for paint, surfaces in by_paint.items()]
