"""A scene as a film: its picture at any time, seen by the camera of camera.py."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array, rotation, rotation_from_quaternion
from ..scene.camera import ANGLE, camera_of
from ..scene.palette import display, paint_of
from ..scene.parts import Part, obstacle_parts, ship_parts
from ..scene.scene import Scene, Ship
from ..scene.surface import Surface
from .picture import Backdrop, Faces, Line, backdrop, picture
from .puffs import Puffs, puffs
from .raster import Eye

__all__ = ["Film"]

Pixels = npt.NDArray[np.uint8]
LINE = 3.0 / 540
"""Width of a scratch, in heights of the picture."""
LIFT = 0.15
"""Of a scratch off the plating [m]."""


class Film:
    """A scene ready to be drawn in pictures of `width` x `height` pixels.

    With `fixed`, a time [s], the camera stays where it is then and the waves stand still: one sees who moves, and most
    of a picture is that before it, which makes a small file.
    """

    def __init__(self, scene: Scene, width: int, height: int, fixed: float | None = None) -> None:
        self._scene, self._width, self._height = scene, width, height
        self._camera = camera_of(scene)
        self._behind = None if fixed is None else self._backdrop(fixed)
        self._bodies = [_Body(ship_parts(ship, i)) for i, ship in enumerate(scene.ships)]
        self._fixed = [
            _Body(obstacle_parts(obstacle)).placed(rotation((0.0, 0.0, obstacle.heading)), obstacle.position)
            for obstacle in scene.obstacles
        ]

    def frame(self, time: float) -> Pixels:
        """The picture at `time` [s], (height, width, 3) of red, green and blue."""
        moved = [body.placed(*_pose(ship, time)) for body, ship in zip(self._bodies, self._scene.ships, strict=True)]
        faces = Faces(
            np.concatenate([faces.corners for faces in (*moved, *self._fixed)]),
            np.concatenate([faces.colours for faces in (*moved, *self._fixed)]),
        )
        behind = self._behind or self._backdrop(time)
        return picture(behind, faces, self._lines(time), self._clouds(time))

    def _backdrop(self, time: float) -> Backdrop:
        return backdrop(Eye(*self._camera.at(time), ANGLE, self._width, self._height), time)

    def _lines(self, time: float) -> list[Line]:
        """Scratches as far as they are drawn by then."""
        colour, width = display(paint_of("scratch").colour), max(1.5, LINE * self._height)
        lines = []
        for scratch in self._scene.scratches:
            drawn = int(np.searchsorted(scratch.times, time, side="right"))
            if drawn > 1:
                R, position = _pose(self._scene.ship(scratch.ship), time)
                points = (scratch.points + LIFT * scratch.normals)[:drawn]
                lines.append(Line(position + points @ R.T, width, colour))
        return lines

    def _clouds(self, time: float) -> list[tuple[Array, Puffs]]:
        """Origins in n of the effects that have begun, and their puffs."""
        clouds = []
        for effect in self._scene.effects:
            if effect.time <= time:
                R, position = _pose(self._scene.ship(effect.ship), time)
                clouds.append((position + R @ effect.point, puffs(effect, time)))
        return clouds


@dataclass(frozen=True, eq=False)
class _Body:
    """Triangles of a body in its b."""

    parts: list[Part]

    def placed(self, R: Array, position: Array) -> Faces:
        """Its triangles in n."""
        corners = [_corners(surface) for _, surface in self.parts]
        colours = [np.broadcast_to(display(paint.colour), (len(surface.triangles), 3)) for paint, surface in self.parts]
        return Faces(position + np.concatenate(corners) @ R.T, np.concatenate(colours))


def _corners(surface: Surface) -> Array:
    corners: Array = surface.vertices[surface.triangles]
    return corners


def _pose(ship: Ship, time: float) -> tuple[Array, Array]:
    position, quaternion = ship.track.at(time)
    return rotation_from_quaternion(quaternion), position
