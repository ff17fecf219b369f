"""The figure of the frames, docs/images/frames.svg; `python docs/generate/frames.py` draws it anew.

All axes are computed from the converters that the code uses, and drawn in one projection: from the south-south-east,
looking down. So the figure cannot disagree with the code, and a test compares the stored file with what is drawn here.
"""

from __future__ import annotations

from math import cos, radians, sin, sqrt
from pathlib import Path

import numpy as np

from shipcollision_fmu.ship.frames import SWAP, Array, rotation, rotation_from_quaternion

__all__ = ["FIGURE", "GLTF_FROM_N", "svg"]

FIGURE = Path(__file__).parents[1] / "images" / "frames.svg"

GLTF_FROM_N: Array = rotation_from_quaternion([sqrt(0.5), 0.0, 0.0, sqrt(0.5)])
"""v_gltf = GLTF_FROM_N v_n: the rotation of the root node of scene.glb."""

LOOK, DOWN = radians(-30.0), radians(35.0)
"""Heading that the observer looks along, and how far down [rad]."""
HEADING = radians(40.0)
"""Heading of the ship in the lower row [rad]."""
HEIGHT = 930
"""Of the drawing."""
RED, GREEN, BLUE, INK, PALE = "#c0392b", "#1e8449", "#1f5fa8", "#222222", "#8a949e"

Point = tuple[float, float]


def svg() -> str:
    """The whole figure: the worlds above, the bodies below."""
    to_b = rotation([0.0, 0.0, HEADING]).T
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 960 {HEIGHT}" font-family="sans-serif" font-size="14">',
        _arrow_heads(),
        f'<rect width="960" height="{HEIGHT}" rx="8" fill="#ffffff"/>',
        _title(30, 30, "Worlds: the same three directions, named by each convention"),
        _triad((130, 165), np.eye(3), ("north", "east", "down"), "n: Fossen, FMI, files"),
        _triad((450, 165), SWAP, ("x east", "y north", "z up"), "w: Bullet, OpenSceneGraph, Guan 2014"),
        _triad((770, 165), GLTF_FROM_N, ("x north", "y up", "z east"), "glTF, replay page"),
        _title(30, 315, "Bodies: a ship on the heading 40 deg, origin at CO"),
        _ship((240, 435)),
        _triad((240, 435), to_b, ("x forward", "y starboard", "z down"), "b: Fossen, MMG, FMI, glTF nodes", 1.35),
        _ship((690, 435)),
        _triad((690, 435), SWAP @ to_b, ("x starboard", "y forward", "z up"), "Bullet, OSG, Guan 2014", 1.35),
        _title(30, 606, "From above: heading, course, drift angle, rudder, wind and current"),
        _plan((480, 765)),
        "</svg>",
    ]  # fmt: skip
    return "\n".join(parts) + "\n"


def _projected(v: Array) -> Point:
    """A vector in n on paper: x to the right, y down."""
    north, east, down = (float(x) for x in v)
    right = -north * sin(LOOK) + east * cos(LOOK)
    away = north * cos(LOOK) + east * sin(LOOK)
    return right, -(away * sin(DOWN) - down * cos(DOWN))


def _triad(at: Point, frame_from_n: Array, names: tuple[str, str, str], caption: str, size: float = 1.0) -> str:
    """The axes of a frame. Row i of `frame_from_n` is its axis i in n."""
    parts = [_text(at[0], at[1] + 82 * size + 28, caption, INK, "middle", "font-weight='bold'")]
    for axis, name, colour in zip(frame_from_n, names, (RED, GREEN, BLUE), strict=True):
        dx, dy = _projected(85.0 * size * axis)
        parts.append(_line(at, (at[0] + dx, at[1] + dy), colour, "arrow" + colour[1:]))
        length = max(1.0, sqrt(dx * dx + dy * dy))
        x, y = at[0] + dx + 12 * dx / length, at[1] + dy + 14 * dy / length + 4
        anchor = "middle" if abs(dx) < 12 else "start" if dx > 0 else "end"
        parts.append(_text(x, y, name, colour, anchor))
    return "\n".join(parts)


def _ship(at: Point) -> str:
    """The waterplane of a ship around CO."""
    R = rotation([0.0, 0.0, HEADING])
    outline = [(75, 0), (55, 14), (-70, 14), (-70, -14), (55, -14)]
    points = [_projected(R @ np.array([x, y, 0.0])) for x, y in outline]
    corners = " ".join(f"{at[0] + x:.1f},{at[1] + y:.1f}" for x, y in points)
    return f'<polygon points="{corners}" fill="#e8edf2" stroke="{PALE}"/>'


def _plan(at: Point) -> str:
    """Heading, course, drift and rudder angle seen from above: north up, east to the right."""
    heading, course, rudder = radians(40.0), radians(62.0), radians(25.0)

    def towards(angle: float, length: float, of: Point = at) -> Point:
        return of[0] + length * sin(angle), of[1] - length * cos(angle)

    R = rotation([0.0, 0.0, heading])
    outline = [R @ np.array([x, y, 0.0]) for x, y in ((75, 0), (50, 15), (-70, 15), (-70, -15), (50, -15))]
    corners = " ".join(f"{at[0] + e:.1f},{at[1] - n:.1f}" for n, e, _ in outline)
    stern = towards(heading, -70.0)
    wind = towards(radians(-60.0), 175.0)
    beside = (at[0] + 300.0, at[1] + 60.0)
    return "\n".join([
        f'<polygon points="{corners}" fill="#e8edf2" stroke="{PALE}"/>',
        _line(at, towards(0.0, 130.0), PALE, "arrow" + PALE[1:]), _text(at[0], at[1] - 138, "north", PALE, "middle"),
        _line(at, towards(heading, 130.0), RED, "arrow" + RED[1:]),
        _label(towards(heading, 145.0), "forward", RED),
        _line(at, towards(course, 130.0), GREEN, "arrow" + GREEN[1:]),
        _label(towards(course, 142.0), "velocity over ground", GREEN),
        _arc(at, 0.0, heading, 62.0, RED), _label(towards(heading / 2, 72.0), "ψ", RED, "middle"),
        _arc(at, heading, course, 95.0, BLUE), _label(towards((heading + course) / 2, 103.0), "-β", BLUE),
        _line(stern, towards(heading - rudder, -45.0, stern), BLUE, ""),
        _label(towards(heading - rudder, -62.0, stern), "rudder, δ > 0: to starboard, turns to starboard", BLUE, "end"),
        _line(wind, towards(radians(-60.0), 110.0), INK, "arrow" + INK[1:]),
        _label((wind[0] - 8, wind[1]), "wind from 300 deg", INK, "end"),
        _line(beside, towards(radians(90.0), 60.0, beside), INK, "arrow" + INK[1:]),
        _label((beside[0], beside[1] - 12), "current towards 90 deg", INK),
        _text(
            480, 912, "course = ψ - β, with β = atan2(-v, u) positive with the velocity to port", INK, "middle"
        ),
    ])  # fmt: skip


def _arc(at: Point, start: float, end: float, radius: float, colour: str) -> str:
    (x0, y0), (x1, y1) = ((at[0] + radius * sin(a), at[1] - radius * cos(a)) for a in (start, end))
    path = f"M{x0:.1f},{y0:.1f} A{radius:g},{radius:g} 0 0 1 {x1:.1f},{y1:.1f}"
    return f'<path d="{path}" fill="none" stroke="{colour}" marker-end="url(#arrow{colour[1:]})"/>'


def _line(start: Point, end: Point, colour: str, head: str) -> str:
    marker = f' marker-end="url(#{head})"' if head else ""
    (x0, y0), (x1, y1) = start, end
    ends = f'x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}"'
    return f'<line {ends} stroke="{colour}" stroke-width="2.5"{marker}/>'


def _label(at: Point, text: str, colour: str, anchor: str = "start") -> str:
    return _text(at[0], at[1], text, colour, anchor)


def _title(x: float, y: float, text: str) -> str:
    return _text(x, y, text, INK, "start", 'font-size="16"')


def _text(x: float, y: float, text: str, colour: str, anchor: str, more: str = "") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" fill="{colour}" text-anchor="{anchor}" {more}>{text}</text>'


def _arrow_heads() -> str:
    heads = "".join(
        f'<marker id="arrow{colour[1:]}" markerWidth="9" markerHeight="8" refX="7" refY="4" orient="auto" '
        f'markerUnits="userSpaceOnUse"><path d="M0,0 L9,4 L0,8 z" fill="{colour}"/></marker>'
        for colour in (RED, GREEN, BLUE, INK, PALE)
    )
    return f"<defs>{heads}</defs>"


if __name__ == "__main__":
    FIGURE.write_text(svg(), encoding="utf-8")
