"""Obstacles in the chart."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.live.server.outline import describe_obstacles


def outline_of(vertices: Any, position: tuple[float, float], heading: float) -> Any:
    surface = SimpleNamespace(vertices=np.array(vertices, dtype=float))
    one = SimpleNamespace(
        name="pier", kind="quay", surface=surface, position=np.array([*position, 0.0]), heading=heading
    )
    return describe_obstacles(SimpleNamespace(obstacles=(one,)))[0]["outline"]  # type: ignore[arg-type]


def test_a_box_is_its_four_corners_turned_and_moved() -> None:
    """200 m along north and 20 m across, turned by 90 degrees: 200 m from west to east, around (100, 50)."""
    box = [(x, y, z) for x in (-100.0, 100.0) for y in (-10.0, 10.0) for z in (-5.0, 3.0)]
    found = outline_of(box, (100.0, 50.0), 0.5 * np.pi)
    assert sorted(found) == [[90.0, -50.0], [90.0, 150.0], [110.0, -50.0], [110.0, 150.0]]
    # Corners that follow each other are neighbours, and the area is that of the box.
    area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(found, [*found[1:], found[0]], strict=True)) / 2.0
    assert abs(area) == pytest.approx(4000.0)


def test_points_within_and_on_the_edges_are_left_out() -> None:
    square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0), (2.0, 2.0), (2.0, 0.0), (1.0, 3.0)]
    found = outline_of([(x, y, 0.0) for x, y in square], (0.0, 0.0), 0.0)
    assert sorted(found) == [[0.0, 0.0], [0.0, 4.0], [4.0, 0.0], [4.0, 4.0]]
