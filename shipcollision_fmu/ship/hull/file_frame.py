"""Where a mesh file's coordinates lie in the ship: p_b = metres [forward, starboard, down]' (p_file - origin)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...errors import ShipError
from ..frames import Array
from ..tables.hull import HullTable

__all__ = ["UNITS", "UNIT_NAMES", "FileFrame", "read_frame"]

UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "ft": 0.3048, "in": 0.0254}
"""Metres per unit of a file."""
UNIT_NAMES = {"m": "metres", "cm": "centimetres", "mm": "millimetres", "ft": "feet", "in": "inches"}


@dataclass(frozen=True)
class FileFrame:
    """Metres per unit, and the file's axes that point forward and up; starboard is forward x up."""

    metres: float
    forward: str
    up: str
    origin: tuple[float, ...]

    @property
    def axes(self) -> Array:
        """(3, 3), rows: forward, starboard and down in the file's axes."""
        forward, up = _parse_axis(self.forward), _parse_axis(self.up)
        return np.array([forward, np.cross(forward, up), -up])

    def to_ship(self, points: Array) -> Array:
        """Points (n, 3) of the file in b [m]."""
        placed: Array = (points - np.array(self.origin)) @ self.axes.T * self.metres
        return placed

    def to_file(self, point: Array) -> Array:
        """A point (3,) of b [m] in the file's coordinates."""
        place: Array = np.array(self.origin) + (point / self.metres) @ self.axes
        return place

    def describe_unit(self) -> str:
        """The key of [hull] that gives these metres."""
        unit = next((unit for unit, metres in UNITS.items() if metres == self.metres), None)
        return f'unit = "{unit}"' if unit else f"scale = {self.metres:g}"


def read_frame(name: str, table: HullTable, metres: float, up: str) -> FileFrame:
    """The frame that a ship file states; the unit and the upward axis that it leaves out are those of the mesh file."""
    given = table.scale or (UNITS[table.unit] if table.unit else metres)
    frame = FileFrame(given, table.forward, table.up or up, tuple(table.origin))
    if frame.forward[1] == frame.up[1]:
        raise ShipError(
            f'{name}: up is "{frame.up}" in this file, and forward = "{frame.forward}" lies along the same axis: set '
            "forward to the file's axis that points to the bow"
        )
    return frame


def _parse_axis(axis: str) -> Array:
    direction = np.zeros(3)
    direction["xyz".index(axis[1])] = -1.0 if axis[0] == "-" else 1.0
    return direction
