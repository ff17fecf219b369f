"""Hull and fittings of a ship as surfaces by paint, the same for glTF, OpenSceneGraph and films."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .fittings import Fitting
from .palette import Paint, choose_topsides, find_paint
from .scene import Obstacle, Ship
from .surface import Surface, cut_into_bands

__all__ = ["Part", "Shape", "cut_hull", "join_fittings", "list_obstacle_parts", "list_ship_parts"]

Shape = tuple[str, Surface]
"""A part of a mesh: the name of its paint, and its surface."""
Part = tuple[Paint, Surface]
"""A part in its paint."""


def list_ship_parts(ship: Ship, index: int) -> list[Part]:
    """Hull and fittings of ship number `index` in b, without empty surfaces."""
    shapes = [*cut_hull(ship), *join_fittings(ship.fittings)]
    paints = [choose_topsides(index) if name == "topsides" else find_paint(name) for name, _ in shapes]
    return [(paint, surface) for paint, (_, surface) in zip(paints, shapes, strict=True) if len(surface.triangles)]


def list_obstacle_parts(obstacle: Obstacle) -> list[Part]:
    """An obstacle in its b."""
    return [(find_paint("concrete"), obstacle.surface)]


def cut_hull(ship: Ship) -> list[Shape]:
    """The hull by paint: bands of height, and a deck where the top is level."""
    top, boot, bottom = cut_into_bands(ship.hull, [-0.10 * ship.T, 0.02 * ship.T])
    z = ship.hull.vertices[:, 2].min()
    level = (top.vertices[top.triangles][..., 2] < z + 0.01).all(axis=1)
    deck, sides = Surface(top.vertices, top.triangles[level]), Surface(top.vertices, top.triangles[~level])
    return [("topsides", sides), ("deck", deck), ("boot-top", boot), ("antifouling", bottom)]


def join_fittings(fittings: Sequence[Fitting]) -> list[Shape]:
    """Fittings of the same part joined to one surface."""
    shapes = []
    for part in dict.fromkeys(fitting.part for fitting in fittings):
        surfaces = [fitting.surface for fitting in fittings if fitting.part == part]
        offsets = np.cumsum([0, *(len(surface.vertices) for surface in surfaces[:-1])])
        triangles = [surface.triangles + offset for surface, offset in zip(surfaces, offsets, strict=True)]
        shapes.append((part, Surface(np.vstack([s.vertices for s in surfaces]), np.vstack(triangles))))
    return shapes
