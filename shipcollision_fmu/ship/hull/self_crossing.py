"""Places where a surface passes through itself: edges that pierce triangles with which they share no corner.

An edge from p to q pierces a triangle (a, b, c) where p + t (q - p) = a + u (b - a) + v (c - a) with 0 < t < 1, u > 0,
v > 0 and u + v < 1 (Moeller and Trumbore 1997, J. Graph. Tools 2(1)).
"""

from __future__ import annotations

import numpy as np

from ..frames import Array
from .convex import Indices

__all__ = ["find_crossings"]

MARGIN = 1e-6
"""Distance from an end or a border, as a fraction, within which an edge touches and does not pierce."""
AT_ONCE = 256
"""Edges whose boxes are compared with those of the triangles near them in one go."""


def find_crossings(vertices: Array, triangles: Indices) -> Array:
    """Points (k, 3) at which an edge of the mesh passes through a triangle of it."""
    edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    edges = edges[np.argsort(vertices[edges, 0].min(axis=1), kind="stable")]  # neighbours along x in one go
    corners, ends = vertices[triangles], vertices[edges]
    low, high = corners.min(axis=1), corners.max(axis=1)
    found = [np.empty((0, 3))]
    for i in range(0, len(edges), AT_ONCE):
        rows = slice(i, i + AT_ONCE)
        edge_low, edge_high = ends[rows].min(axis=1), ends[rows].max(axis=1)
        own = np.flatnonzero(((low < edge_high.max(axis=0)) & (high > edge_low.min(axis=0))).all(axis=1))
        near = np.ones((len(edge_low), len(own)), dtype=bool)
        for axis in range(3):
            near &= edge_low[:, axis, None] < high[own, axis]
            near &= edge_high[:, axis, None] > low[own, axis]
        edge, place = np.nonzero(near)
        edge, triangle = edge + i, own[place]
        apart = (edges[edge][:, :, None] != triangles[triangle][:, None, :]).all(axis=(1, 2))
        found.append(_pierce(ends[edge[apart]], corners[triangle[apart]]))
    return np.concatenate(found)


def _pierce(ends: Array, corners: Array) -> Array:
    """The points of those of the edges (k, 2, 3) that pierce their triangles (k, 3, 3)."""
    along, (b, c) = ends[:, 1] - ends[:, 0], (corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    from_a = ends[:, 0] - corners[:, 0]
    across = np.cross(along, c)
    determinant = np.einsum("ij,ij->i", b, across)
    size = np.linalg.norm(along, axis=1) * np.linalg.norm(b, axis=1) * np.linalg.norm(c, axis=1)
    crossed = np.abs(determinant) > MARGIN * size
    scale = 1.0 / np.where(crossed, determinant, 1.0)
    u = np.einsum("ij,ij->i", from_a, across) * scale
    turned = np.cross(from_a, b)
    v = np.einsum("ij,ij->i", along, turned) * scale
    t = np.einsum("ij,ij->i", c, turned) * scale
    inside = np.minimum.reduce([u, v, 1.0 - u - v, t, 1.0 - t]) > MARGIN
    hit = crossed & inside
    points: Array = ends[hit, 0] + t[hit, None] * along[hit]
    return points
