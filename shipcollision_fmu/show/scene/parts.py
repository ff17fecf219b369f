"""Hull and fittings of a ship as surfaces by paint, the same for glTF, OpenSceneGraph and films."""

from __future__ import annotations

from collections.abc import Iterable

from .fittings import Fitting
from .palette import LIVERIES, Paint, choose_topsides, find_paint
from .scene import Obstacle, Ship
from .solids import Shape, join_shapes
from .surface import Surface

__all__ = ["Part", "Shape", "join_fittings", "join_shapes", "list_obstacle_parts", "list_ship_parts"]

Part = tuple[Paint, Surface]
"""A part in its paint."""


def list_ship_parts(ship: Ship, index: int) -> list[Part]:
    """Hull and fittings of ship number `index` in b, without empty surfaces."""
    shapes = [*join_shapes(ship.shell), *join_fittings(ship.fittings)]
    paints = [choose_topsides(index) if name in LIVERIES else find_paint(name) for name, _ in shapes]
    return [(paint, surface) for paint, (_, surface) in zip(paints, shapes, strict=True) if len(surface.triangles)]


def list_obstacle_parts(obstacle: Obstacle) -> list[Part]:
    """An obstacle in its b."""
    return [(find_paint("concrete"), obstacle.surface)]


def join_fittings(fittings: Iterable[Fitting]) -> list[Shape]:
    """Fittings of the same part joined to one surface."""
    return join_shapes((fitting.part, fitting.surface) for fitting in fittings)
