"""Film: pictures of a scene at any time, by the camera of scene/camera.py."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array, rotation, rotation_from_quaternion
from ..scene.camera import ANGLE, place_camera
from ..scene.palette import convert_to_display, find_paint
from ..scene.parts import Part, list_obstacle_parts, list_ship_parts
from ..scene.scene import Scene, Ship
from ..scene.shade import Shade, cast_shade
from ..scene.shaded import find_face_shares, is_shaded
from ..scene.surface import Surface
from .picture import Backdrop, Faces, Line, draw_backdrop, draw_picture
from .puffs import Puffs, make_puffs
from .raster import Eye

__all__ = ["Film"]

Pixels = npt.NDArray[np.uint8]
LINE = 3.0 / 540
"""Width of a scratch as a fraction of the picture's height."""
DISPLAY = 1.0 / 2.2
"""Exponent from a share of light to one of a colour as on the screen."""
LIFT = 0.15
"""[m] Distance of a scratch from the plating, which would otherwise hide it in part."""


class Film:
    """A scene ready to be drawn in pictures of `width` x `height` pixels.

    With `fixed`, a time [s], camera and waves stay as they are at this time. The motion of the ships is then visible,
    and most of a picture equals the picture before it, which makes a small file.
    """

    def __init__(self, scene: Scene, width: int, height: int, fixed: float | None = None) -> None:
        self._scene, self._width, self._height = scene, width, height
        self._camera = place_camera(scene)
        self._behind = None if fixed is None else self._backdrop(fixed)
        self._bodies = [_paint_ship(list_ship_parts(ship, i), ship.B) for i, ship in enumerate(scene.ships)]
        self._fixed = [
            _paint(list_obstacle_parts(obstacle)).place(rotation((0.0, 0.0, obstacle.heading)), obstacle.position)
            for obstacle in scene.obstacles
        ]

    def draw(self, time: float) -> Pixels:
        """The picture at `time` [s], (height, width, 3) of red, green and blue."""
        moved = [
            body.place(*_find_pose(ship, time)) for body, ship in zip(self._bodies, self._scene.ships, strict=True)
        ]
        faces = Faces(
            np.concatenate([faces.corners for faces in (*moved, *self._fixed)]),
            np.concatenate([faces.colours for faces in (*moved, *self._fixed)]),
        )
        behind = self._behind or self._backdrop(time)
        return draw_picture(behind, faces, self._lines(time), self._clouds(time))

    def _backdrop(self, time: float) -> Backdrop:
        return draw_backdrop(Eye(*self._camera.at(time), ANGLE, self._width, self._height), time)

    def _lines(self, time: float) -> list[Line]:
        """Scratches up to a time [s]."""
        colour, width = convert_to_display(find_paint("scratch").colour), max(1.5, LINE * self._height)
        lines = []
        for scratch in self._scene.scratches:
            drawn = int(np.searchsorted(scratch.times, time, side="right"))
            if drawn > 1:
                R, position = _find_pose(self._scene.ship(scratch.ship), time)
                points = (scratch.points + LIFT * scratch.normals)[:drawn]
                lines.append(Line(position + points @ R.T, width, colour))
        return lines

    def _clouds(self, time: float) -> list[tuple[Array, Puffs]]:
        """Origins in n of the effects that have begun, and their puffs."""
        clouds = []
        for effect in self._scene.effects:
            if effect.time <= time:
                R, position = _find_pose(self._scene.ship(effect.ship), time)
                clouds.append((position + R @ effect.point, make_puffs(effect, time)))
        return clouds


@dataclass(frozen=True, eq=False)
class _Body:
    """Corners (m, 3, 3) in its b and colours (m, 3) of the triangles of a body."""

    corners: Array
    colours: Array

    def place(self, R: Array, position: Array) -> Faces:
        """Its triangles in n."""
        return Faces(position + self.corners @ R.T, self.colours)


def _paint(parts: list[Part], shade: Shade | None = None) -> _Body:
    """Parts in their colours, darker where less light reaches them."""
    colours = []
    for paint, surface in parts:
        shares = (
            find_face_shares(surface, shade) if shade and is_shaded(paint.name) else np.ones(len(surface.triangles))
        )
        colours.append(convert_to_display(paint.colour) * shares[:, None] ** DISPLAY)
    return _Body(np.concatenate([_list_corners(surface) for _, surface in parts]), np.concatenate(colours))


def _paint_ship(parts: list[Part], breadth: float) -> _Body:
    return _paint(parts, cast_shade([(paint.name, surface) for paint, surface in parts], breadth))


def _list_corners(surface: Surface) -> Array:
    corners: Array = surface.vertices[surface.triangles]
    return corners


def _find_pose(ship: Ship, time: float) -> tuple[Array, Array]:
    position, quaternion = ship.track.at(time)
    return rotation_from_quaternion(quaternion), position
