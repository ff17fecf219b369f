"""At most four corners stand for an area of contact: which ones."""

from __future__ import annotations

from math import cos, pi, sin

import pytest

from shipcollision_fmu.collision.geometry.contact_place import spread

Point = tuple[float, float]


def area(corners: list[Point]) -> float:
    """Of a polygon whose corners are in turn, by the shoelace formula."""
    return 0.5 * abs(sum(x * b - a * y for (x, y), (a, b) in zip(corners, corners[1:] + corners[:1], strict=True)))


@pytest.mark.parametrize("n", [6, 8, 12])
@pytest.mark.parametrize("turn", [0.0, 0.1, 0.3, 0.5, 0.7])
def test_four_corners_span_a_regular_polygon(n: int, turn: float) -> None:
    whole = [(cos(turn + 2 * pi * k / n), sin(turn + 2 * pi * k / n)) for k in range(n)]
    kept = spread(whole)
    assert 3 <= len(kept) <= 4
    assert set(kept) <= set(whole)
    in_turn = [q for q in whole if q in kept]
    assert area(in_turn) >= 0.5 * area(whole)
    # The centre is on the inner side of every edge.
    for (x, y), (a, b) in zip(in_turn, in_turn[1:] + in_turn[:1], strict=True):
        assert x * b - a * y > -1e-12


@pytest.mark.parametrize("n", [1, 2, 3, 4])
def test_up_to_four_are_kept_as_they_are(n: int) -> None:
    corners = [(float(k), float(k * k)) for k in range(n)]
    assert spread(corners) == corners
