"""Scratches: lines of contact points, laid onto the hull that bears them.

A contact point lies where two solids overlap, so it is inside at least one of them. Each point is moved to the nearest
point of the hull. Points more than SPACING apart get points between them, so that the line follows a round hull.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...ship.frames import Array
from .resample import choose_samples
from .run_folder import ScratchEvent
from .surface import Surface, find_nearest_points

__all__ = ["LINE_ERROR", "Scratch", "lay_scratches"]

LINE_ERROR = 0.02
"""[m] Largest error of a line at any time; contact points are known to about as much."""
SPACING = 1.0
"""[m] Largest distance of neighbouring points of a line."""


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


def lay_scratches(events: Sequence[ScratchEvent], hulls: Mapping[str, Surface]) -> tuple[Scratch, ...]:
    """Two scratches per event, of ship_a and of ship_b; one where the other is an obstacle."""
    found = []
    for event in events:
        for ship, other, line in ((event.ship_a, event.ship_b, event.b_a), (event.ship_b, event.ship_a, event.b_b)):
            if ship in hulls:
                times, points, normals = _lay_line(np.array(event.time), np.array(line, dtype=float), hulls[ship])
                found.append(Scratch(event.id, event.collision, ship, other, times, points, normals))
    return tuple(found)


def _lay_line(times: Array, points: Array, hull: Surface) -> tuple[Array, Array, Array]:
    """Times, points and normals of a line: thinned, divided by SPACING and laid onto the hull."""
    rows = choose_samples(times, points, LINE_ERROR)
    times, points = times[rows], points[rows]
    counts = [max(1, int(np.ceil(length / SPACING))) for length in np.linalg.norm(np.diff(points, axis=0), axis=1)]
    at = np.concatenate([[0.0], *(i + np.arange(1, n + 1) / n for i, n in enumerate(counts))])
    whole = np.arange(len(times))
    divided = np.column_stack([np.interp(at, whole, points[:, axis]) for axis in range(3)])
    return np.interp(at, whole, times), *find_nearest_points(hull, divided)
