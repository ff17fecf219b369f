"""The hull as a solid: a closed surface, and convex parts that together fill it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..frames import Array
from .convex import Indices, enclosed_volume

__all__ = ["HullMesh"]


@dataclass(frozen=True, eq=False)  # hulls are told apart by identity: what is worked out of one can be kept
class HullMesh:
    """A closed hull surface and its convex parts, in b about CO [m].

    vertices (n, 3); triangles (m, 3), counter-clockwise seen from outside; parts: vertex sets (k_i, 3) whose convex
    hulls together are the solid; planes: of each part, half-spaces (m_i, 4) as convex.half_spaces gives them, by which
    contact finds where parts are joined (without planes, no parts are joined). Excess of the parts over the solid:
    volume_error, relative, and bulge, their largest distance from it where it is hollow [m].
    """

    vertices: Array
    triangles: Indices
    parts: tuple[Array, ...]
    planes: tuple[Array, ...] = ()
    volume_error: float = 0.0
    bulge: float = 0.0

    @property
    def volume(self) -> float:
        """Enclosed volume [m3]; positive when the normals point outwards."""
        return enclosed_volume(self.vertices, self.triangles)

    @property
    def reach(self) -> float:
        """Largest horizontal distance of any point of the hull from CO [m]."""
        return float(np.hypot(self.vertices[:, 0], self.vertices[:, 1]).max())
