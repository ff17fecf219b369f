"""thin_track(): the corners of a track, by Douglas and Peucker (1973), Cartographica 10(2):112-122.

A part of the track is straight when all its points are within a distance of its chord; else it is divided at the point
that is farthest from the chord.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot

__all__ = ["thin_track"]

Position = tuple[float, float]


def thin_track(track: Sequence[Position], off: float, shortest: float) -> list[int]:
    """Numbers of the points kept: the first, and those from which the track is met within `off` [m].

    A point nearer than `shortest` [m] to the one before is left out.
    """
    kept, parts = {0, len(track) - 1}, [(0, len(track) - 1)]
    while parts:
        first, last = parts.pop()
        between = range(first + 1, last)
        distances = [_measure_distance(track[i], track[first], track[last]) for i in between]
        if distances and max(distances) > off:
            corner = between[distances.index(max(distances))]
            kept.add(corner)
            parts += [(first, corner), (corner, last)]
    far: list[int] = [0]
    for i in sorted(kept - {0}):
        if hypot(track[i][0] - track[far[-1]][0], track[i][1] - track[far[-1]][1]) >= shortest:
            far.append(i)
    return far


def _measure_distance(point: Position, a: Position, b: Position) -> float:
    """Distance [m] of a point from the segment a b."""
    x, y = b[0] - a[0], b[1] - a[1]
    length2 = x * x + y * y
    along = 0.0 if length2 == 0.0 else ((point[0] - a[0]) * x + (point[1] - a[1]) * y) / length2
    t = min(max(along, 0.0), 1.0)
    return hypot(point[0] - a[0] - t * x, point[1] - a[1] - t * y)
