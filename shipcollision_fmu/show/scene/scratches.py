"""Scratches: lines of contact points, laid onto the hull that bears them.

A contact point lies where two solids overlap, so a little inside at least one of them. Each is moved to the nearest
point of the hull, and so are points between two of them that are more than SPACING apart: the line follows a round
hull. What is moved farther than STRAY is in the run's own data and is moved all the same: paint is on the hull.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...ship.frames import Array
from .resample import kept
from .run_folder import ScratchEvent
from .surface import Surface, nearest

__all__ = ["LINE_ERROR", "Scratch", "scratches_of"]

LINE_ERROR = 0.02
"""What thinning may move any point of a line by, at the time it is drawn [m]."""
SPACING = 1.0
"""Between neighbouring points of a line, at most [m]."""


@dataclass(frozen=True, eq=False)
class Scratch:
    """A line on a ship, in its b: times (k,) [s], points (k, 3) [m], the hull's outward normals there (k, 3).

    `id` is the scratch in events.json, which has two of these: one on each ship, unless one is an obstacle. Times do
    not decrease; a line of one point is a dent.
    """

    id: int
    collision: int
    ship: str
    other: str
    times: Array
    points: Array
    normals: Array


def scratches_of(events: Sequence[ScratchEvent], hulls: Mapping[str, Surface]) -> tuple[Scratch, ...]:
    """Two scratches per event, of ship_a and of ship_b; one where the other is an obstacle."""
    found = []
    for event in events:
        for ship, other, line in ((event.ship_a, event.ship_b, event.b_a), (event.ship_b, event.ship_a, event.b_b)):
            if ship in hulls:
                times, points, normals = _laid(np.array(event.time), np.array(line, dtype=float), hulls[ship])
                found.append(Scratch(event.id, event.collision, ship, other, times, points, normals))
    return tuple(found)


def _laid(times: Array, points: Array, hull: Surface) -> tuple[Array, Array, Array]:
    """Thinned, divided and laid onto the hull."""
    rows = kept(times, points, LINE_ERROR)
    times, points = times[rows], points[rows]
    counts = [max(1, int(np.ceil(length / SPACING))) for length in np.linalg.norm(np.diff(points, axis=0), axis=1)]
    at = np.concatenate([[0.0], *(i + np.arange(1, n + 1) / n for i, n in enumerate(counts))])
    whole = np.arange(len(times))
    divided = np.column_stack([np.interp(at, whole, points[:, axis]) for axis in range(3)])
    return np.interp(at, whole, times), *nearest(hull, divided)
