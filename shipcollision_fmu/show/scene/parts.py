"""Hull and fittings of a ship, cut into surfaces by their paint; glTF, OpenSceneGraph and films draw the same ones."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .fittings import Fitting
from .palette import Paint, paint_of, topsides
from .scene import Obstacle, Ship
from .surface import Surface, bands

__all__ = ["Part", "Shape", "fitting_shapes", "hull_shapes", "obstacle_parts", "ship_parts"]

Shape = tuple[str, Surface]
"""A part of a mesh: the name of its paint, and its surface."""
Part = tuple[Paint, Surface]
"""A part in its paint."""


def ship_parts(ship: Ship, index: int) -> list[Part]:
    """Hull and fittings of ship number `index` in b, without what has no triangle."""
    shapes = [*hull_shapes(ship), *fitting_shapes(ship.fittings)]
    paints = [topsides(index) if name == "topsides" else paint_of(name) for name, _ in shapes]
    return [(paint, surface) for paint, (_, surface) in zip(paints, shapes, strict=True) if len(surface.triangles)]


def obstacle_parts(obstacle: Obstacle) -> list[Part]:
    """An obstacle in its b."""
    return [(paint_of("concrete"), obstacle.surface)]


def hull_shapes(ship: Ship) -> list[Shape]:
    """The hull by paint: bands of height, and a deck where the top is level."""
    top, boot, bottom = bands(ship.hull, [-0.10 * ship.T, 0.02 * ship.T])
    z = ship.hull.vertices[:, 2].min()
    level = (top.vertices[top.triangles][..., 2] < z + 0.01).all(axis=1)
    deck, sides = Surface(top.vertices, top.triangles[level]), Surface(top.vertices, top.triangles[~level])
    return [("topsides", sides), ("deck", deck), ("boot-top", boot), ("antifouling", bottom)]


def fitting_shapes(fittings: Sequence[Fitting]) -> list[Shape]:
    """Fittings joined by what they are."""
    shapes = []
    for part in dict.fromkeys(fitting.part for fitting in fittings):
        surfaces = [fitting.surface for fitting in fittings if fitting.part == part]
        offsets = np.cumsum([0, *(len(surface.vertices) for surface in surfaces[:-1])])
        triangles = [surface.triangles + offset for surface, offset in zip(surfaces, offsets, strict=True)]
        shapes.append((part, Surface(np.vstack([s.vertices for s in surfaces]), np.vstack(triangles))))
    return shapes
