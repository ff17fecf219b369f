"""Volume, half-spaces and convexity of a solid given by a closed triangle mesh.

Triangles are (m, 3) indices, counter-clockwise seen from outside. Any unit of length.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..frames import Array

__all__ = [
    "CONVEX_WITHIN",
    "LEAST_VOLUME",
    "Indices",
    "enclosed_volume",
    "half_spaces",
    "has_flat_triangles",
    "is_convex",
]

Indices = npt.NDArray[np.int64]

CONVEX_WITHIN = 1e-3
"""A vertex may lie this far [m] before a face of a mesh that still counts as convex."""
LEAST_VOLUME = 0.01
"""Volume over that of the box around it below which a mesh is no solid: a ship has 0.4 to 0.9."""
_SAME_PLANE = 1e-6
"""Difference of a unit normal's components, and of the offset over the solid's size, up to which planes are one."""
_AT_ONCE = 4_000_000
"""Distances computed in one go: 32 MB."""


def enclosed_volume(vertices: Array, triangles: Indices) -> float:
    """Volume inside a closed mesh, by the divergence theorem; positive when the normals point outwards."""
    p, q, r = (vertices[triangles[:, k]] - vertices.mean(axis=0) for k in range(3))
    return float(np.einsum("ij,ij->", p, np.cross(q, r)) / 6.0)


def half_spaces(vertices: Array, triangles: Indices) -> Array:
    """Planes (k, 4) of a convex solid: a point p is inside where n . p <= d for every row (n, d), n of unit length.

    Triangles of one plane give one row; slivers, whose normal is noise, give none.
    """
    p, q, r = (vertices[triangles[:, k]] for k in range(3))
    normals = np.cross(q - p, r - p)
    twice_area = np.linalg.norm(normals, axis=1)
    size = float(np.ptp(vertices, axis=0).max())
    real = twice_area > 1e-9 * size**2
    normals = normals[real] / twice_area[real, None]
    # The farthest vertex, not the triangle's own: then rounding leaves no vertex outside.
    offsets = (normals @ vertices.T).max(axis=1)
    rows = np.column_stack([normals, offsets])
    _, first = np.unique(
        np.round(rows / [1.0, 1.0, 1.0, size] / _SAME_PLANE).astype(np.int64), axis=0, return_index=True
    )
    planes: Array = rows[np.sort(first)]
    return planes


def is_convex(vertices: Array, triangles: Indices, tolerance: float) -> bool:
    """Whether no vertex lies more than `tolerance` before any triangle's plane."""
    p, q, r = (vertices[triangles[:, k]] for k in range(3))
    normals = np.cross(q - p, r - p)
    length = np.linalg.norm(normals, axis=1)
    real = length > 0.0
    normals = normals[real] / length[real, None]
    own = np.einsum("ij,ij->i", normals, p[real])
    rows = max(1, _AT_ONCE // len(vertices))
    for i in range(0, len(own), rows):
        before = normals[i : i + rows] @ vertices.T - own[i : i + rows, None]
        if before.max() > tolerance:
            return False
    return True


def has_flat_triangles(vertices: Array, triangles: Indices) -> npt.NDArray[np.bool_]:
    """(m,) which triangles have their corners on one line."""
    p, q, r = (vertices[triangles[:, k]] for k in range(3))
    area = 0.5 * np.linalg.norm(np.cross(q - p, r - p), axis=1)
    longest = np.sqrt(np.maximum.reduce([((b - a) ** 2).sum(axis=1) for a, b in ((p, q), (q, r), (r, p))]))
    flat: npt.NDArray[np.bool_] = area <= 1e-7 * longest**2
    return flat
