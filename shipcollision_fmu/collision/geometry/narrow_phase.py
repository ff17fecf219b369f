"""What is asked of the narrow phase, Bullet's closest points of convex parts, whichever adapter gives them.

Both adapters give the same bits: PyBullet (bullet.py) and this package's own library (closest_points.py).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from ...ship.frames import Array
from ..dynamics.body_state import BodyState

__all__ = ["MARGIN", "SNAP_PLACE", "SNAP_QUATERNION", "Closest", "NarrowPhase"]

MARGIN = 0.001
"""PyBullet's collision margin [m], which it adds to every hull and which is taken off again. It cannot be zero: without
it Bullet returns wrong normals for faces that lie flat on each other."""

SNAP_PLACE, SNAP_QUATERNION = 786432.0, 6144.0  # 1.5 * 2**19, 1.5 * 2**12
"""Added and taken off again, they round places [m] to 2**-33 and quaternions to 2**-40: poses are shown to Bullet to
0.1 nm. Where features are equal, the last bits of a pose would choose the normal, and two hosts or languages would see
two collisions."""


@dataclass(frozen=True)
class Closest:
    """Closest points of two convex parts: on_a, on_b (3,) in n [m], normal (3,) from a to b, gap [m] (< 0: overlap)."""

    on_a: Array
    on_b: Array
    normal: Array
    gap: float
    part_a: int
    part_b: int


class NarrowPhase(Protocol):
    """The hulls of some ships, each of convex parts. Bullet is used without memory: what a call returns depends on its
    arguments alone, so that a restored FMU repeats every bit. Close it when done."""

    def close(self) -> None:
        """Free Bullet's hulls; safe to call twice."""

    def closest(self, a: int, b: int, states: Sequence[BodyState], distance: float) -> list[Closest]:
        """Closest points of every pair of parts of ships a and b not farther apart than `distance` [m]."""

    def closest_of_parts(
        self, one: tuple[int, int, Array, Array], other: tuple[int, int, Array, Array], distance: float
    ) -> tuple[float, Array] | None:
        """(gap [m], normal (3,) from one to the other) of two convex parts; None: farther apart than `distance` [m].

        one, other: ship, its part, and its pose: CO in n [m], R_nb.
        """

    def corners(self, ship: int, part: int) -> Array:
        """The corners (n, 3) of a part as Bullet rounded them to 1/10216 of the hull's extent, in b about CO [m]."""

    def gap(self, a: int, b: int, states: Sequence[BodyState], cap: float) -> float:
        """Least distance [m] between ships a and b, negative in overlap, at most `cap`."""
