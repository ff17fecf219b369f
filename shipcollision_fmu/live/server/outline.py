"""Obstacles as the chart of the live page draws them: the convex outline in plan."""

from __future__ import annotations

from math import cos, sin
from typing import Any

import numpy as np

from ...show.scene.scene import Obstacle, Scene

__all__ = ["describe_obstacles"]


def describe_obstacles(scene: Scene) -> list[dict[str, Any]]:
    """An obstacle each: name, kind, outline [[north, east], ...] in n [m], clockwise."""
    return [{"name": one.name, "kind": one.kind, "outline": _find_outline(one)} for one in scene.obstacles]


def _find_outline(obstacle: Obstacle) -> list[list[float]]:
    """The convex hull in plan. Andrew (1979), Information Processing Letters 9(5), 216-219."""
    c, s = cos(obstacle.heading), sin(obstacle.heading)
    plan = obstacle.surface.vertices[:, :2] @ np.array([[c, s], [-s, c]]) + obstacle.position[:2]
    points = sorted({(round(north, 2), round(east, 2)) for north, east in plan.tolist()})
    return [list(point) for point in (*_chain(points), *_chain(points[::-1]))]


def _chain(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """From the first point to the last, without it, along the left side of the way."""
    chain: list[tuple[float, float]] = []
    for p in points:
        while len(chain) > 1 and _turn(chain[-2], chain[-1], p) >= 0.0:
            chain.pop()
        chain.append(p)
    return chain[:-1]


def _turn(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
    """Positive where a, b, c turn from north towards east."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
