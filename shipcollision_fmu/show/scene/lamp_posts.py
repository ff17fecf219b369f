"""What bears the navigation lights: posts, brackets with screens, where nothing that is drawn is near enough.

A lamp within REACH of a part needs nothing. Else a sidelight has a bracket from the wall beside it, with a screen
towards the ship (COLREG annex I 5), if that is nearer than what is below; all others have a post from what is below.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ...ship.frames import Array
from .lights import Light
from .solids import Shape, make_box, make_rod
from .surface import Surface

__all__ = ["REACH", "bear_lights"]

REACH = 0.3
"""[m] Distance from a lamp's centre to what bears it at most: the lamp itself is as large."""
ASTRIDE = 0.02
"""[m] Rays are cast this far beside the centreline, along which the edges of triangles lie."""


def bear_lights(lights: Sequence[Light], parts: Iterable[Surface], unit: float) -> list[Shape]:
    """Posts, brackets and screens by paint; `unit` is the scale of all things made for people."""
    corners = np.concatenate([part.vertices[part.triangles] for part in parts])
    shapes: list[Shape] = []
    for light in lights:
        shapes += _bear(light, corners, unit)
    return shapes


def _bear(light: Light, corners: Array, unit: float) -> list[Shape]:
    x, y, z = (float(c) for c in light.point)
    near = [_find_hit(corners, light.point, axis, sign) for axis in range(3) for sign in (1.0, -1.0)]
    if min(near) <= REACH:
        return []
    foot, at = _find_foot(corners, light.point, unit)
    wall = _find_hit(corners, light.point, 1, -float(np.sign(y))) if y else np.inf
    if wall <= abs(y) and wall < foot:
        return _hang(x, y, z, wall, unit)
    if not np.isfinite(foot):
        return []
    radius = unit * float(np.clip(0.05 + 0.012 * foot / unit, 0.06, 0.2))
    behind = radius * np.array([-np.sign(light.direction[0]), 0.0] if not y else [0.0, -np.sign(y)])
    # The lamp is before its post.
    start, end = np.array(at) + behind, light.point[:2] + behind
    return [("mast", make_rod((*start, z + foot + 0.05 * unit), (*end, z + 0.1 * unit), radius))]


def _hang(x: float, y: float, z: float, wall: float, unit: float) -> list[Shape]:
    """A bracket from the wall out to the lamp, and its screen."""
    inner = y - np.sign(y) * (wall + 0.1 * unit)
    screen = y - np.sign(y) * min(0.35 * unit, 0.6 * wall)
    low, high = sorted((float(inner), y))
    return [
        ("house", make_box((x - 0.5 * unit, x + 0.8 * unit), (low, high), (z + 0.2 * unit, z + 0.35 * unit))),
        (
            "funnel-top",
            make_box(
                (x - 0.45 * unit, x + 0.75 * unit),
                (float(screen) - 0.03 * unit, float(screen) + 0.03 * unit),
                (z - 0.35 * unit, z + 0.2 * unit),
            ),
        ),
    ]


def _find_foot(corners: Array, point: Array, unit: float) -> tuple[float, tuple[float, float]]:
    """How far below a lamp the highest part is [m], and where: a little inboard, where nothing is right below."""
    x, y, z = (float(c) for c in point)
    for by in (0.0, 0.4 * unit, 1.0 * unit, 2.0 * unit):
        at = (x + (by if not y else 0.0), y - float(np.sign(y)) * by)
        distance = _find_hit(corners, np.array([*at, z]), 2, 1.0)
        if np.isfinite(distance):
            return distance, at
    return np.inf, (x, y)


def _find_hit(corners: Array, point: Array, axis: int, sign: float) -> float:
    """Distance from a point (3,) along an axis to the first of triangles (n, 3, 3) [m]; infinite if there is none."""
    across = [k for k in range(3) if k != axis]
    beside = np.array([0.7, -1.0 if point[1] > 0.0 else 1.0, 0.5])  # inboard, the same on both sides
    p = (point + ASTRIDE * beside)[across]
    a, b, c = (corners[:, k][:, across] for k in range(3))
    area = _cross(b - a, c - a)
    flat = np.abs(area) < 1e-12
    area = np.where(flat, 1.0, area)
    u, v = _cross(p - a, c - a) / area, _cross(b - a, p - a) / area
    hit = (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0) & ~flat
    height = corners[:, 0, axis] + u * (corners[:, 1, axis] - corners[:, 0, axis])
    height = height + v * (corners[:, 2, axis] - corners[:, 0, axis])
    distance = sign * (height - point[axis])
    ahead = distance[hit & (distance >= 0.0)]
    return float(ahead.min()) if len(ahead) else np.inf


def _cross(a: Array, b: Array) -> Array:
    result: Array = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return result
