"""The level polygons of a parametric hull, read back from its mesh.

ship/hull/hull.py stacks them from the keel up: rings of n corners, the first at the stem, then along starboard to the
transom and back along port. Pictures draw a hull anew between these rings, so it lies on the hull that touches.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ...ship.frames import Array

__all__ = ["HullRings", "read_rings"]


@dataclass(frozen=True, eq=False)
class HullRings:
    """Starboard corners (k, m, 3) of k levels from the deck down, each from the stem to the transom."""

    corners: Array
    _sections: dict[float, Array] = field(init=False, repr=False, default_factory=dict)
    """Sections by height, as asked for so far: most heights are asked for at each of 150 stations."""

    @cached_property
    def z_deck(self) -> float:
        """Height of the deck [m], negative."""
        return float(self.corners[0, 0, 2])

    @cached_property
    def z_keel(self) -> float:
        """Depth of the keel [m]."""
        return float(self.corners[-1, 0, 2])

    @cached_property
    def edge(self) -> Array:
        """The deck's edge (m, 2), from the stem to the transom."""
        corners: Array = self.corners[0, :, :2]
        return corners

    def at(self, z: float) -> Array:
        """Corners (m, 2) of the hull's section at a height z [m]; above the deck those of the deck."""
        found = self._sections.get(z)
        if found is None:
            found = self._sections[z] = self._cut(z)
            found.flags.writeable = False
        return found

    def _cut(self, z: float) -> Array:
        heights = self.corners[:, 0, 2]
        i = int(np.clip(np.searchsorted(heights, z, side="right") - 1, 0, len(heights) - 2))
        share = float(np.clip((z - heights[i]) / (heights[i + 1] - heights[i]), 0.0, 1.0))
        corners: Array = (1.0 - share) * self.corners[i, :, :2] + share * self.corners[i + 1, :, :2]
        return corners

    def half_breadth(self, x: Array | float, z: float) -> Array:
        """Half breadth of the hull at stations x [m] and one height z; 0 before the stem and abaft the transom."""
        corners = self.at(z)[::-1]
        return np.asarray(np.interp(x, corners[:, 0], corners[:, 1], left=0.0, right=0.0))


def read_rings(vertices: Array) -> HullRings | None:
    """The rings of a hull; None for vertices that are not stacked rings of a ship's form."""
    n = int(np.argmax(vertices[:, 2] != vertices[0, 2]))
    if n < 5 or n % 2 == 0 or len(vertices) % n:
        return None
    rings = vertices.reshape(-1, n, 3)[::-1]
    m = (n + 1) // 2
    starboard, port = rings[:, :m], rings[:, m:]
    is_level = np.ptp(rings[..., 2], axis=1).max() == 0.0 and bool(np.all(np.diff(rings[:, 0, 2]) > 0.0))
    is_symmetric = np.allclose(starboard[:, :0:-1], port * [1.0, -1.0, 1.0], atol=1e-6)
    is_ordered = bool(np.all(np.diff(starboard[..., 0], axis=1) < 1e-9)) and np.allclose(starboard[:, 0, 1], 0.0)
    return HullRings(starboard) if is_level and is_symmetric and is_ordered else None
