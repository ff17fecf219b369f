"""The adapter of this package's own library: closest points by the same lines of Bullet, with PyBullet's bits.

Its twin is native/collision/geometry/closest_points.cpp, where all is done: poses and hulls go there in n and b.
"""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import CDLL, c_double, c_int, c_void_p
from functools import cache

import numpy as np

from ...ship.frames import Array
from ...ship.hull.solid import HullMesh
from ...toolchain.load import load_library
from ..dynamics.body_state import BodyState
from .narrow_phase import Closest

__all__ = ["PlacedHulls", "open_library"]

ROW = 11
"""Doubles in a row of results: on_a, on_b, normal, gap, and in the last the two numbers of the parts."""


@cache
def open_library() -> CDLL:
    """The library with the types of what is called here. Raises HostError."""
    library = load_library()
    library.shipcollision_hulls_open.restype = c_void_p
    library.shipcollision_hulls_open.argtypes = (c_int, c_void_p, c_void_p, c_void_p)
    library.shipcollision_hulls_close.argtypes = (c_void_p,)
    library.shipcollision_hulls_place.argtypes = (c_void_p, c_int, c_void_p)
    library.shipcollision_hulls_closest.argtypes = (c_void_p, c_int, c_int, c_double, c_void_p)
    library.shipcollision_hulls_closest_of_parts.argtypes = (c_void_p, c_int, c_int, c_int, c_int, c_double, c_void_p)
    library.shipcollision_hulls_gap.restype = c_double
    library.shipcollision_hulls_gap.argtypes = (c_void_p, c_int, c_int, c_double)
    library.shipcollision_hulls_corners.argtypes = (c_void_p, c_int, c_int, c_void_p, c_int)
    return library


class PlacedHulls:
    """The hulls' convex parts in the library, and where they were placed last."""

    def __init__(self, hulls: Sequence[HullMesh]) -> None:
        """hulls: one per ship; their vertices are in b about CO [m]. Raises HostError without the library."""
        self._library = library = open_library()
        parts = [part for hull in hulls for part in hull.parts]
        counts = np.array([len(hull.parts) for hull in hulls], dtype=np.intc)
        corners = np.array([len(part) for part in parts], dtype=np.intc)
        coordinates = np.ascontiguousarray(np.vstack(parts), dtype=np.float64) if parts else np.empty((0, 3))
        self._world: int | None = library.shipcollision_hulls_open(
            len(hulls), counts.ctypes.data, corners.ctypes.data, coordinates.ctypes.data
        )
        # Kept buffers, whose addresses are asked for once: that costs more than the call.
        pose = np.empty(12)
        self._x, self._R, self._pose = pose[:3], pose[3:].reshape(3, 3), pose.ctypes.data
        most = max(counts.tolist(), default=0) ** 2
        self._rows = np.empty((max(1, most), ROW))
        self._parts = self._rows.view(np.intc)[:, 2 * ROW - 2 :]
        self._found = self._rows.ctypes.data
        self._placed: list[tuple[Array, Array] | None] = [None] * len(hulls)
        self._place_there = library.shipcollision_hulls_place
        self._closest_there = library.shipcollision_hulls_closest
        self._closest_of_parts_there = library.shipcollision_hulls_closest_of_parts
        self._gap_there = library.shipcollision_hulls_gap

    def close(self) -> None:
        """Free the hulls; safe to call twice."""
        if self._world is not None:
            self._library.shipcollision_hulls_close(self._world)
        self._world = None

    def __del__(self) -> None:
        if getattr(self, "_world", None) is not None:
            self.close()

    def _place(self, ship: int, x: Array, R_nb: Array) -> None:
        """Put a ship at CO = x (3,) in n [m] with the attitude R_nb. The same objects as before move nothing."""
        before = self._placed[ship]
        if before is not None and before[0] is x and before[1] is R_nb:
            return
        self._placed[ship] = x, R_nb
        self._x[:] = x
        self._R[:] = R_nb
        self._place_there(self._world, ship, self._pose)

    def closest(self, a: int, b: int, states: Sequence[BodyState], distance: float) -> list[Closest]:
        """Closest points of every pair of parts of ships a and b not farther apart than `distance` [m]."""
        self._place(a, states[a].x, states[a].R)
        self._place(b, states[b].x, states[b].R)
        count = self._closest_there(self._world, a, b, distance, self._found)
        if not count:
            return []
        rows, gaps = self._rows[:count].copy(), self._rows[:count, 9].tolist()
        return [
            Closest(row[0:3], row[3:6], row[6:9], gap, i, j)
            for row, gap, (i, j) in zip(rows, gaps, self._parts[:count].tolist(), strict=True)
        ]

    def closest_of_parts(
        self, one: tuple[int, int, Array, Array], other: tuple[int, int, Array, Array], distance: float
    ) -> tuple[float, Array] | None:
        """(gap [m], normal (3,) from one to the other) of two convex parts; None: farther apart than `distance` [m].

        one, other: ship, its part, and its pose: CO in n [m], R_nb.
        """
        (a, i, x_a, R_a), (b, j, x_b, R_b) = one, other
        self._place(a, x_a, R_a)
        self._place(b, x_b, R_b)
        if not self._closest_of_parts_there(self._world, a, i, b, j, distance, self._found):
            return None
        row = self._rows[0]
        return float(row[9]), row[6:9].copy()

    def corners(self, ship: int, part: int) -> Array:
        """The corners (n, 3) of a part as Bullet rounded them, in b about CO [m]."""
        count = self._library.shipcollision_hulls_corners(self._world, ship, part, None, 0)
        found = np.empty((count, 3))
        self._library.shipcollision_hulls_corners(self._world, ship, part, found.ctypes.data, count)
        return found

    def gap(self, a: int, b: int, states: Sequence[BodyState], cap: float) -> float:
        """Least distance [m] between ships a and b, negative in overlap, at most `cap`."""
        self._place(a, states[a].x, states[a].R)
        self._place(b, states[b].x, states[b].R)
        gap: float = self._gap_there(self._world, a, b, cap)
        return gap
