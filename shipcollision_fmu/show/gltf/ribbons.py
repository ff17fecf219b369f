"""A scratch as a ribbon of triangles on the hull, because viewers draw lines one pixel wide.

Edges and middle of the ribbon are laid onto the hull and lifted by LIFT, so that the ribbon does not flicker in the
plating. A line shorter than its breadth becomes a short dent.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...ship.frames import Array
from ...ship.hull.convex import Indices
from ..scene.scratches import Scratch
from ..scene.surface import Surface, drop_flat_triangles, find_nearest_points

__all__ = ["LIFT", "Ribbon", "lay_ribbon"]

LIFT = 0.06
"""[m] Distance of a ribbon from the plating; less flickers in viewers of single precision."""


@dataclass(frozen=True, eq=False)
class Ribbon:
    """vertices (2 k, 3) [m] in b, normals (2 k, 3), times (2 k,) [s] at which they are drawn, triangles (m, 3)."""

    vertices: Array
    normals: Array
    times: Array
    triangles: Indices


def lay_ribbon(scratch: Scratch, hull: Surface, length: float) -> Ribbon:
    """The ribbon of a scratch on a ship's hull; breadth and the least length follow the ship's `length` [m]."""
    half = float(np.clip(0.0016 * length, 0.02, 0.6))
    times, middle, normals = _find_middle_line(scratch, half)
    along = np.gradient(middle, axis=0)
    across = np.cross(along, normals)
    size = np.linalg.norm(across, axis=1)[:, None]
    fallback = np.cross(normals, np.roll(normals, 1, axis=1))
    across = np.where(size > 1e-9, across / np.maximum(size, 1e-9), fallback)
    edges = np.stack([middle - half * across, middle + half * across], axis=1).reshape(-1, 3)
    laid, outwards = find_nearest_points(hull, edges)
    i = 2 * np.arange(len(middle) - 1)
    triangles = np.concatenate([np.column_stack([i, i + 1, i + 3]), np.column_stack([i, i + 3, i + 2])])
    triangles = triangles[np.argsort(np.concatenate([i, i]), kind="stable")]
    vertices = laid + LIFT * outwards
    solid = drop_flat_triangles(Surface(vertices, triangles))
    return Ribbon(vertices, outwards, np.repeat(times, 2), solid.triangles)


def _find_middle_line(scratch: Scratch, half: float) -> tuple[Array, Array, Array]:
    """Times, points and normals of the middle line, without points that coincide; two at least."""
    rows, last = [0], scratch.points[0]
    for i, point in enumerate(scratch.points):
        if np.linalg.norm(point - last) > 0.25 * half:
            rows.append(i)
            last = point
    points, normals, times = scratch.points[rows], scratch.normals[rows], scratch.times[rows]
    if np.linalg.norm(np.diff(points, axis=0), axis=1).sum() > 2.0 * half:
        return times, points, normals
    level = np.cross(normals[0], [0.0, 0.0, 1.0])
    level = level / np.linalg.norm(level) if np.linalg.norm(level) > 1e-6 else np.array([1.0, 0.0, 0.0])
    ends = points[0] + 2.0 * half * np.array([-1.0, 0.0, 1.0])[:, None] * level
    return np.repeat(times[0], 3), ends, np.repeat(normals[:1], 3, axis=0)
