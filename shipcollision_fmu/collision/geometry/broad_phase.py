"""Which bodies could come near each other: a uniform grid, so that far pairs cost nothing.

Every body is a rectangle in the plane, north and east. A body is entered in each cell of the grid that its rectangle
meets; bodies that share a cell are compared, the rest is never looked at. With cells as large as a ship's rectangle a
ship lies in at most four, and the cost of n ships spread over a harbour grows with n. Up to FEW bodies are compared
with each other directly, which is then quicker.

A quay is long: it lies in many cells, and its rectangle is its own, not that of a circle around it. Two bodies that
cannot move are no pair.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from math import floor, sqrt

__all__ = ["Pair", "Rectangle", "near_pairs"]

Rectangle = tuple[float, float, float, float]
"""(north from, north to, east from, east to) [m]."""

Pair = tuple[int, int]
"""Indices (a, b) of two bodies, a < b."""

FEW = 64
"""Bodies up to which comparing all with all is quicker than a grid; measured."""

MOST_CELLS = 1_000
"""Cells that one body may lie in; the cells are made larger where a quay would lie in more."""


def near_pairs(rectangles: Sequence[Rectangle], moving: int) -> list[Pair]:
    """Pairs (a, b), a < b, sorted, whose rectangles overlap or touch and of which the first is one of the `moving`.

    The first `moving` bodies move, the others do not.
    """
    if len(rectangles) <= FEW:
        return [
            (a, b)
            for a in range(moving)
            for b in range(a + 1, len(rectangles))
            if _meet(rectangles[a], rectangles[b])
        ]  # fmt: skip
    cells: dict[tuple[int, int], list[int]] = defaultdict(list)
    size = _cell_size(rectangles, moving)
    for i, (n_0, n_1, e_0, e_1) in enumerate(rectangles):
        for row in range(floor(n_0 / size), floor(n_1 / size) + 1):
            for column in range(floor(e_0 / size), floor(e_1 / size) + 1):
                cells[row, column].append(i)  # in rising order of i
    pairs = set()
    for members in cells.values():
        for k, a in enumerate(members):
            if a >= moving:
                break
            for b in members[k + 1 :]:
                if _meet(rectangles[a], rectangles[b]):
                    pairs.add((a, b))
    return sorted(pairs)


def _meet(one: Rectangle, other: Rectangle) -> bool:
    return one[0] <= other[1] and other[0] <= one[1] and one[2] <= other[3] and other[2] <= one[3]


def _cell_size(rectangles: Sequence[Rectangle], moving: int) -> float:
    """The largest side of a moving body [m], or more where a body that does not move would lie in too many cells."""
    size = max((max(r[1] - r[0], r[3] - r[2]) for r in rectangles[:moving]), default=1.0)
    longest = max(max(r[1] - r[0], r[3] - r[2]) for r in rectangles)
    return max(size, longest / sqrt(MOST_CELLS), 1e-6)
