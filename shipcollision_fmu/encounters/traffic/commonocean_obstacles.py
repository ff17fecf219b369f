"""Tables [obstacles.NAME] of CommonOcean's static obstacles.

rectangle    a box, its heading 90 deg - (orientation of the state and of the rectangle)
circle       a cylinder
polygon      a convex polygon
depth        the depth of its foot; the usual one where it is infinite
"""

from __future__ import annotations

from math import degrees
from typing import Any

from ...errors import ScenarioError
from .commonocean_schema import Obstacle, Point
from .commonocean_shapes import Frame, place_corners, read_position

__all__ = ["build_obstacle_tables"]


def build_obstacle_tables(obstacle: Obstacle, frame: Frame) -> dict[str, dict[str, Any]]:
    """Tables [obstacles.NAME], one for each area of the shape."""
    name = f"staticObstacle {obstacle.id}"
    at = read_position(obstacle.initialState, name, frame.file)
    turn = obstacle.initialState.orientation
    psi = 0.0 if turn is None else turn.middle or 0.0
    rest = {"bottom": obstacle.foot}
    shape, tables = obstacle.shape, list[dict[str, Any]]()
    for rectangle in shape.rectangle:
        position = frame.place(_add(rectangle.center, at))
        heading = round(90.0 - degrees(psi + rectangle.orientation), 6) % 360.0
        tables.append({"shape": "box", "length": rectangle.length, "breadth": rectangle.width,
                       "position": list(position), "heading_deg": heading})  # fmt: skip
    for circle in shape.circle:
        position = frame.place(_add(circle.center, at))
        tables.append({"shape": "cylinder", "diameter": 2.0 * circle.radius, "position": list(position)})
    for polygon in shape.polygon:
        middle = frame.place(at)
        corners = [frame.place(point) for point in place_corners(polygon.point, at, psi)]
        points = [[round(n - middle[0], 6) + 0.0, round(e - middle[1], 6) + 0.0] for n, e in corners]
        tables.append({"shape": "polygon", "points": points, "position": list(middle)})
    if not tables:
        raise ScenarioError(f"{frame.file}: {name} has no shape: give a rectangle, a circle or a polygon")
    label = _make_identifier(f"{obstacle.type}_{obstacle.id}")
    several = len(tables) > 1
    return {
        f"{label}_{i}" if several else label: {"kind": obstacle.type, **table, **rest}
        for i, table in enumerate(tables, start=1)
    }


def _add(a: Point, b: Point) -> Point:
    return Point(x=a.x + b.x, y=a.y + b.y)


def _make_identifier(text: str) -> str:
    return "".join(c if c.isascii() and (c.isalnum() or c == "_") else "_" for c in text)
