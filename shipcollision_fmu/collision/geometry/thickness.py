"""Least width of a hull: how far a body may move into it before the other side is nearer."""

from __future__ import annotations

import numpy as np

from ...ship.frames import Array
from ...ship.hull.convex import half_spaces
from ...ship.hull.solid import HullMesh

__all__ = ["least_width"]


def least_width(hull: HullMesh) -> float:
    """Least distance [m] of two parallel planes that hold a convex part between them, one of them along a face.

    Of several parts the thinnest counts. Parts without known faces are measured along the axes of b.
    """
    return min(_width_across(part, normals) for part, normals in zip(hull.parts, _face_normals(hull), strict=True))


def _face_normals(hull: HullMesh) -> list[Array]:
    if len(hull.planes) == len(hull.parts):
        return [planes[:, :3] for planes in hull.planes]
    if len(hull.parts) == 1:
        return [half_spaces(hull.vertices, hull.triangles)[:, :3]]
    return [np.eye(3) for _ in hull.parts]


def _width_across(part: Array, normals: Array) -> float:
    return float(np.ptp(part @ normals.T, axis=0).min())
