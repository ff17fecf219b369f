"""Where two hulls touch: Bullet's answer, cleaned until a solver can trust it.

1. A closest point at a positive distance is a prediction, not a contact: only gap <= 0 counts.
2. Bullet gives one point, at an arbitrary place along a line or an area of contact. The contact points are the corners
   of what the two facing features have in common (manifold.py).
3. In deep overlap the direction of least overlap jumps, for a ship soon to the vertical: while the overlap is deeper
   than SHALLOW the last normal from before is kept, turning with the hull whose face it belongs to.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import dist

import numpy as np

from ..ship.frames import Array
from ..ship.hull import HullMesh
from .contact import Contact, make_contact
from .engine import Closest, Engine
from .manifold import contact_manifold, foremost
from .shadow import Shadow

__all__ = ["SHALLOW", "Detector", "KeptNormals"]

SHALLOW = 0.5
"""Overlap [m] down to which Bullet's normal is taken: some steps of a fast approach, far below a hull's breadth, beyond
which least overlap no longer tells the side that was struck."""

SAME_POINT = 0.5
"""Contact points of different convex parts closer than this [m] are one point."""

KeptNormals = dict[tuple[int, int], tuple[int, list[float]]]
"""Per pair of ships (a, b): which of them carries the last shallow normal, and that normal in its body frame."""


class Detector:
    """Contacts and clearance between hulls. Holds no state that matters: the kept normals belong to the caller."""

    def __init__(self, hulls: Sequence[HullMesh]) -> None:
        self._hulls = tuple(hulls)
        self.engine = Engine(hulls)

    def place(self, ship: int, shadow: Shadow) -> None:
        """Move a hull to its shadow's predicted pose."""
        self.engine.place(ship, shadow.x, shadow.R)

    def clearance(self, a: int, b: int, cap: float) -> float:
        """Least distance [m] between two placed hulls, negative in overlap, at most `cap`."""
        return min((c.gap for c in self.engine.closest(a, b, cap)), default=cap)

    def touching(self, a: int, b: int) -> bool:
        """Whether two placed hulls touch or overlap."""
        return any(c.gap <= 0.0 for c in self.engine.closest(a, b, 0.0))

    def contacts(self, a: int, b: int, shadows: Sequence[Shadow], kept: KeptNormals) -> list[Contact]:
        """Contact points of two placed hulls, gap <= 0. Updates `kept` while the overlap is shallow."""
        touching = [c for c in self.engine.closest(a, b, 0.0) if c.gap <= 0.0]
        if not touching:
            kept.pop((a, b), None)
            return []
        shallow = min(c.gap for c in touching) > -SHALLOW
        carried = None if shallow else kept.get((a, b))
        found: list[Contact] = []
        for closest in touching:
            normal = closest.normal if carried is None else _turned(carried, shadows[a], shadows[b])
            feature_a, feature_b = self._features(a, b, closest, normal, shadows)
            if shallow:
                carrier = 0 if len(feature_a) > len(feature_b) else 1
                kept[(a, b)] = (carrier, (normal @ shadows[(a, b)[carrier]].R).tolist())
            # Features that pass each other (a corner beside a face's edge) leave Bullet's own point.
            places = contact_manifold(feature_a, feature_b, normal) or [
                (0.5 * (closest.on_a + closest.on_b), closest.gap)
            ]
            for point, gap in places:
                if gap <= 0.0 and all(dist(point, c.point) > SAME_POINT for c in found):
                    found.append(make_contact(a, b, shadows, point, normal, gap))
        return found

    def _features(
        self, a: int, b: int, closest: Closest, normal: Array, shadows: Sequence[Shadow]
    ) -> tuple[Array, Array]:
        """Points (n, 3) of either part that face the other one: foremost along the normal."""
        in_a = shadows[a].x + self._hulls[a].parts[closest.part_a] @ shadows[a].R.T
        in_b = shadows[b].x + self._hulls[b].parts[closest.part_b] @ shadows[b].R.T
        return foremost(in_a, normal), foremost(in_b, -normal)


def _turned(carried: tuple[int, list[float]], one: Shadow, other: Shadow) -> Array:
    """A kept normal in n, as it has turned with the hull that carries it."""
    carrier, normal_b = carried
    normal: Array = (one, other)[carrier].R @ np.array(normal_b)
    return normal
