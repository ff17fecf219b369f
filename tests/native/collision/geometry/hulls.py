"""set_hulls(): the hulls of the kernels of kernels_geometry.cpp."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence

import numpy as np

from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.ship.hull.convex import half_spaces
from shipcollision_fmu.ship.hull.solid import HullMesh
from tests.native.collision.kernels import load_kernels

__all__ = ["set_hulls"]


def find_planes(hull: HullMesh) -> Sequence[Array]:
    """The half-spaces of each part, as a prepared file has them."""
    return hull.planes or [half_spaces(hull.vertices, hull.triangles)]


def set_hulls(hulls: Sequence[HullMesh]) -> None:
    """Hand hulls to the kernels; whose corners are those of their parts."""
    parts = np.array([len(hull.parts) for hull in hulls], dtype=np.intc)
    extents = np.array([np.ptp(hull.vertices, axis=0).min() for hull in hulls])
    pairs = [pair for hull in hulls for pair in zip(hull.parts, find_planes(hull), strict=True)]
    sizes = np.array([(len(part), len(planes)) for part, planes in pairs], dtype=np.intc)
    corners = np.ascontiguousarray(np.vstack([part for part, _ in pairs]))
    planes = np.ascontiguousarray(np.vstack([planes for _, planes in pairs]))
    load_kernels().shipcollision_set_hulls(
        len(hulls), *(ctypes.c_void_p(array.ctypes.data) for array in (parts, extents, sizes, corners, planes))
    )
