"""Common corners of two plane features: a point, the ends of a line, or the corners of a polygon.

Bullet reports one point of a line or area of contact, at an arbitrary place. The height of a stem on a vertical side
would then be chance. Instead, the features that face each other (vertices, edges or faces: the extreme points of both
convex parts along the normal) are projected on the plane of contact and clipped against each other.

Plane coordinates are pairs [m]; the corners of a polygon are counter-clockwise.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import hypot

__all__ = ["Point", "common_corners", "common_points", "convex_polygon"]

Point = tuple[float, float]
TOUCH = 1e-6
"""Distance [m] within which a point still counts as lying on a line: far below any size of a ship."""


def _cross(o: Point, a: Point, b: Point) -> float:
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])


def convex_polygon(points: Iterable[Point]) -> list[Point]:
    """Convex hull of plane points, counter-clockwise, without collinear corners (Andrew's monotone chain).

    One point stays a point, points on a line give its two ends.
    """
    p = sorted(set(points))
    if len(p) < 3:
        return p

    def chain(order: list[Point]) -> list[Point]:
        out: list[Point] = []
        for q in order:
            while len(out) >= 2 and _cross(out[-2], out[-1], q) <= TOUCH * _span(out[-2], q):
                out.pop()
            out.append(q)
        return out

    lower, upper = chain(p), chain(p[::-1])
    return lower[:-1] + upper[:-1]


def _span(a: Point, b: Point) -> float:
    return hypot(b[0] - a[0], b[1] - a[1])


def common_corners(first: Iterable[Point], second: Iterable[Point]) -> list[Point]:
    """Corners of the intersection of the convex hulls of two sets of points; empty when they do not overlap."""
    return common_points(convex_polygon(first), convex_polygon(second))


def common_points(first: list[Point], second: list[Point]) -> list[Point]:
    """Corners of the intersection of two convex sets given by their corners; empty when they do not overlap."""
    if len(first) > len(second):
        first, second = second, first
    if len(first) == 0:
        return []
    if len(second) >= 3:
        return _clip(first, second)
    if len(first) == 1:
        return first if _on_segment(first[0], second) else []
    return _segments(first, second)


def _clip(subject: list[Point], polygon: list[Point]) -> list[Point]:
    """Sutherland-Hodgman: cut away what lies to the right of each side of a counter-clockwise polygon."""
    out = subject
    for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        length = _span(a, b)
        inside = [_cross(a, b, q) >= -TOUCH * length for q in out]
        kept: list[Point] = []
        # A segment has one side, a polygon closes on itself.
        pairs = list(range(len(out))) if len(out) != 2 else [0]
        for i in pairs:
            j = (i + 1) % len(out)
            if inside[i]:
                kept.append(out[i])
            if inside[i] != inside[j]:
                kept.append(_meet(a, b, out[i], out[j]))
        if len(out) == 2 and inside[1]:
            kept.append(out[1])
        out = kept
        if not out:
            return []
    return _distinct(out)


def _meet(a: Point, b: Point, p: Point, q: Point) -> Point:
    """Where the segment p q crosses the line a b."""
    s, t = _cross(a, b, p), _cross(a, b, q)
    w = s / (s - t)
    return (p[0] + w * (q[0] - p[0]), p[1] + w * (q[1] - p[1]))


def _segments(first: list[Point], second: list[Point]) -> list[Point]:
    """Crossing point of two segments, or the ends of their common stretch when they lie on one line."""
    (a, b), (c, d) = first, second
    length = max(_span(a, b), _span(c, d))
    s, t = _cross(a, b, c), _cross(a, b, d)
    if max(abs(s), abs(t)) <= TOUCH * length:
        ends = [q for q in second if _on_segment(q, first)] + [q for q in first if _on_segment(q, second)]
        return _distinct(ends)
    if s * t > 0 or _cross(c, d, a) * _cross(c, d, b) > 0:
        return []
    return [_meet(a, b, c, d)]


def _on_segment(q: Point, segment: list[Point]) -> bool:
    if len(segment) == 1:
        return _span(q, segment[0]) <= TOUCH
    a, b = segment
    length = _span(a, b)
    along = ((q[0] - a[0]) * (b[0] - a[0]) + (q[1] - a[1]) * (b[1] - a[1])) / length
    return abs(_cross(a, b, q)) <= TOUCH * length and -TOUCH <= along <= length + TOUCH


def _distinct(points: list[Point]) -> list[Point]:
    out: list[Point] = []
    for q in points:
        if all(_span(q, other) > TOUCH for other in out):
            out.append(q)
    return out
