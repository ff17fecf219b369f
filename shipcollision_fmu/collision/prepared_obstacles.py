"""Prepared obstacles: what native code, which reads no TOML, needs of a file of obstacles.

    shipcollision prepared obstacles 1
    count 2                           number of obstacles; then for each
    name "pier"
    place 0x0.0p+0 ...                position in n [m] and heading [rad]
    fender 0x1.4p+8 ...               stiffness [N/m], damping [N s/m], thickness [m], or `none`
    hull 1 0x1.5p+7 0x1.4p+4          its solid (ship/prepared_lines.py)

native/collision/prepared_obstacles.cpp reads such files.
"""

from __future__ import annotations

from pathlib import Path

from ..errors import InputError
from ..ship.loading.obstacle_tables import are_obstacles
from ..ship.loading.toml import read_toml
from ..ship.prepared_lines import describe_hull, quote, reals, seal
from .obstacles import Obstacle, read_obstacles

__all__ = ["FORMAT", "SUFFIX", "VERSION", "is_obstacle_file", "prepare_obstacles"]

FORMAT = "shipcollision prepared obstacles"
"""Begin of the first line."""
VERSION = 1
"""Version of the format. A reader refuses every other, so it rises with each change of a line or of an order."""

SUFFIX = ".obstacles"
"""Suffix of the files."""


def is_obstacle_file(path: str) -> bool:
    """Whether a path is that of a TOML file of obstacles, and not of a ship. Faults are then said of obstacles."""
    return path.endswith(".toml") and Path(path).is_file() and are_obstacles(read_toml(Path(path), InputError))


def prepare_obstacles(text: str) -> bytes:
    """The content of the prepared file of obstacles: TOML text, or the path of a TOML file. Raises InputError."""
    obstacles = read_obstacles(text)
    return seal([f"{FORMAT} {VERSION}", f"count {len(obstacles)}", *(_describe(each) for each in obstacles)])


def _describe(obstacle: Obstacle) -> str:
    fender = obstacle.fender
    lines = [
        f"name {quote(obstacle.name)}",
        reals("place", (*obstacle.position.tolist(), obstacle.heading)),
        "fender none" if fender is None else reals("fender", (fender.stiffness, fender.damping, fender.thickness)),
        *describe_hull(obstacle.solid),
    ]
    return "\n".join(lines)
