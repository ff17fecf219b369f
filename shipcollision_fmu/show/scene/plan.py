"""Outlines seen from above: the convex hull of a body's vertices in plan."""

from __future__ import annotations

import numpy as np

from ...collision.geometry.clipping import convex_polygon
from ...ship.frames import Array
from .scene import Obstacle

__all__ = ["find_convex_hull", "find_plan"]


def find_convex_hull(points: Array) -> Array:
    """Corners (k, 2) of the convex hull of plane points (n, 2), one after the other."""
    return np.array(convex_polygon(map(tuple, points.tolist())))


def find_plan(obstacle: Obstacle) -> Array:
    """Outline of an obstacle, (k, 2) north and east [m]."""
    c, s = np.cos(obstacle.heading), np.sin(obstacle.heading)
    turned = obstacle.surface.vertices[:, :2] @ np.array([[c, s], [-s, c]])
    return find_convex_hull(obstacle.position[:2] + turned)
