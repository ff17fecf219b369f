"""Places in CommonOcean's x, y: middles, boxes and corners of shapes, and the same in n.

An obstacle's shape is turned about its own middle, by the orientation of the initial state, and then moved by its
position. So does the project's own library; the middle of a polygon is its centroid.
"""

from __future__ import annotations

from math import cos, sin
from typing import NamedTuple

from ...errors import ScenarioError
from .commonocean_schema import Area, Point, State

__all__ = ["Frame", "find_box", "find_middle", "place_box", "place_corners", "read_position"]

Box = tuple[Point, float, float]
"""Middle, length along x, width along y [m]."""


class Frame(NamedTuple):
    """Own ship's position, which is n's origin, the length of a time step [s], and the file's name for messages."""

    origin: Point
    time_step: float
    file: str

    def place(self, point: Point) -> tuple[float, float]:
        """North and east [m]."""
        return point.y - self.origin.y, point.x - self.origin.x


def read_position(state: State, name: str, file: str) -> Point:
    """The position of a state: a point, or the middle of an area. Raises ScenarioError for a state without one."""
    middle = None if state.position is None else find_middle(state.position)
    if middle is None:
        raise ScenarioError(f"{file}: {name} has no position in its initialState: give a point")
    return middle


def find_middle(area: Area) -> Point | None:
    """The point of a position, or the middle of its first area; None for a reference to waters."""
    if area.point is not None:
        return area.point
    middles = [r.center for r in area.rectangle] + [c.center for c in area.circle]
    middles += [_find_centroid(p.point) for p in area.polygon]
    return middles[0] if middles else None


def find_box(shape: Area) -> Box | None:
    """The rectangle of a shape, or the box about its polygon; None for a circle and for several areas."""
    if len(shape.rectangle) + len(shape.circle) + len(shape.polygon) != 1 or shape.circle:
        return None
    if shape.rectangle:
        (rectangle,) = shape.rectangle
        return rectangle.center, rectangle.length, rectangle.width
    xs, ys = [p.x for p in shape.polygon[0].point], [p.y for p in shape.polygon[0].point]
    middle = Point(x=0.5 * (min(xs) + max(xs)), y=0.5 * (min(ys) + max(ys)))
    return middle, max(xs) - min(xs), max(ys) - min(ys)


def place_box(shape: Area, at: Point, psi: float) -> Point:
    """The middle of the box of a ship in the file's x, y; its position for a shape without a box."""
    box, middle = find_box(shape), find_middle(shape)
    if box is None or middle is None:
        return at
    return _turn(box[0], middle, at, psi)


def place_corners(corners: list[Point], at: Point, psi: float) -> list[Point]:
    """The corners of a polygon in the file's x, y; without the last, where it repeats the first."""
    kept = corners[:-1] if corners[-1] == corners[0] else corners
    middle = _find_centroid(kept)
    return [_turn(point, middle, at, psi) for point in kept]


def _turn(point: Point, about: Point, at: Point, psi: float) -> Point:
    x, y = point.x - about.x, point.y - about.y
    return Point(
        x=at.x + about.x + x * cos(psi) - y * sin(psi),
        y=at.y + about.y + x * sin(psi) + y * cos(psi),
    )


def _find_centroid(corners: list[Point]) -> Point:
    """Centroid of the area of a polygon; the mean of its corners where it has none."""
    ring = list(zip(corners, [*corners[1:], corners[0]], strict=True))
    parts = [a.x * b.y - b.x * a.y for a, b in ring]
    area6 = 3.0 * sum(parts)
    if area6 == 0.0:
        return Point(x=sum(p.x for p in corners) / len(corners), y=sum(p.y for p in corners) / len(corners))
    return Point(
        x=sum((a.x + b.x) * part for (a, b), part in zip(ring, parts, strict=True)) / area6,
        y=sum((a.y + b.y) * part for (a, b), part in zip(ring, parts, strict=True)) / area6,
    )
