"""Fixed obstacles: quay walls, bridge piers, lock chambers, breakwaters.

An obstacle is a prism: a convex plan, a horizontal top and foot. In contact it is a body like a ship, with zero inverse
mass and a pose that never changes: M^-1 = 0 is the limit of infinite mass. A lock chamber is several obstacles, one per
wall.

    [NAME]                      or [obstacles.NAME] in a scenario file
    kind = "quay"               what it is, in words
    shape = "box"               length (along its heading), breadth        [m]
          | "cylinder"          diameter [m]; a polygon of CYLINDER_SIDES sides with its corners on the circle
          | "polygon"           points = [[forward, starboard], ...] [m], convex, from position, in either sense
    position = [north, east]    middle of the box or cylinder, origin of the polygon's points [m]
    heading_deg                 clockwise from north, default 0
    top                         height of the top above the waterline [m], default 5
    bottom                      depth of the foot below the waterline [m], default 30; negative for what hangs over
                                the water, as a bridge's deck does; or height = top + bottom
    fender = {...}              fender.py

Body frame b of an obstacle: forward along its heading, starboard, down from the waterline at its position.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos, pi, radians, sin
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, ValidationError, model_validator

from ..errors import InputError
from ..files import is_file
from ..ship.frames import Array
from ..ship.hull.solid import HullMesh
from ..ship.loading.messages import describe_error, suggest
from ..ship.loading.obstacle_tables import is_obstacle
from ..ship.loading.toml import parse_toml, read_toml
from ..ship.tables.table import Pair, Positive, Table
from .fender import Fender
from .geometry.clipping import convex_polygon

__all__ = [
    "CYLINDER_SIDES", "FenderTable", "Obstacle", "ObstacleTable", "build_obstacle", "format_obstacles",
    "read_obstacles",
]  # fmt: skip

CYLINDER_SIDES = 32
"""Sides of the polygon that stands for a circle: 5 cm inside it on a pier of 20 m."""

TOP, BOTTOM = 5.0, 30.0
"""Heights [m] where the table is silent: above any deck edge that matters, below any keel."""


LARGEST, FARTHEST = 1e6, 1e9
"""[m] Limits of sizes, and of positions as of ships. The squares of much larger numbers overflow."""


class FenderTable(Table):
    """fender = {stiffness, damping, thickness} of an obstacle or a ship."""

    stiffness: Positive = Field(description="force over compression [N/m]")
    damping: float = Field(default=0.0, ge=0.0, description="force over speed of compression [N s/m]")
    thickness: Positive = Field(description="how far before the hull or wall it acts [m]")

    @property
    def fender(self) -> Fender:
        """As the collision model uses it."""
        return Fender(self.stiffness, self.damping, self.thickness)


class ObstacleTable(Table):
    """An obstacle as its table says it."""

    kind: str = Field(min_length=1, description='what it is, e.g. "quay"')
    shape: Literal["box", "cylinder", "polygon"] = Field(description='"box", "cylinder" or "polygon"')
    position: Pair = Field(description="[north, east] [m]")
    heading_deg: float = Field(default=0.0, ge=-360.0, le=720.0, description="clockwise from north [deg]")
    length: Positive | None = Field(default=None, description="the box's length along its heading [m]")
    breadth: Positive | None = Field(default=None, description="the box's breadth [m]")
    diameter: Positive | None = Field(default=None, description="the cylinder's diameter [m]")
    points: Annotated[list[Pair], Field(min_length=3)] | None = Field(
        default=None, description="the polygon's corners [[forward, starboard], ...] [m]"
    )
    top: float = Field(default=TOP, description="the height of the top above the waterline [m]")
    bottom: float | None = Field(default=None, description="the depth of the foot below the waterline [m]")
    height: Positive | None = Field(default=None, description="top + bottom [m]")
    fender: FenderTable | None = Field(
        default=None, description="{stiffness = 1e6, damping = 1e5, thickness = 1.0} [N/m], [N s/m], [m]"
    )

    @property
    def plan(self) -> Array:
        """Corners (n, 2) of the plan in b [m], in turn."""
        if self.shape == "box":
            assert self.length is not None
            assert self.breadth is not None
            x, y = 0.5 * self.length, 0.5 * self.breadth
            return np.array([[x, -y], [x, y], [-x, y], [-x, -y]])
        if self.shape == "cylinder":
            assert self.diameter is not None
            turns = [2 * pi * (k + 0.5) / CYLINDER_SIDES for k in range(CYLINDER_SIDES)]
            return np.array([[0.5 * self.diameter * cos(a), 0.5 * self.diameter * sin(a)] for a in turns])
        assert self.points is not None
        return np.array(convex_polygon([(float(x), float(y)) for x, y in self.points]))

    @property
    def depth(self) -> float:
        """Depth of the foot below the waterline [m]."""
        if self.height is not None:
            return self.height - self.top
        return BOTTOM if self.bottom is None else self.bottom

    @model_validator(mode="after")
    def _fits_its_shape(self) -> ObstacleTable:
        required = {"box": ("length", "breadth"), "cylinder": ("diameter",), "polygon": ("points",)}
        for shape, keys in required.items():
            for key in keys:
                given = getattr(self, key) is not None
                if given != (shape == self.shape):
                    said = f"shape = {self.shape!r} takes {' and '.join(required[self.shape])}"
                    raise ValueError(f"{said}: {'remove' if given else 'give'} {key}")
        return self

    @model_validator(mode="after")
    def _has_a_height(self) -> ObstacleTable:
        if self.bottom is not None and self.height is not None:
            raise ValueError("gives both bottom and height: keep one of them")
        if not self.top > -self.depth:
            raise ValueError(
                f"bottom = {self.depth:g} m below the waterline is not below top = {self.top:g} m above it: both count "
                "away from the waterline"
            )
        return self

    @model_validator(mode="after")
    def _is_in_metres(self) -> ObstacleTable:
        corners = [x for corner in self.points or [] for x in corner]
        sizes = (self.length, self.breadth, self.diameter, self.top, self.bottom, self.height, *corners)
        for limit, values in ((LARGEST, sizes), (FARTHEST, self.position)):
            largest = max((abs(x) for x in values if x is not None), default=0.0)
            if largest > limit:
                raise ValueError(f"has a length or place of {largest:g} m, the limit is {limit:g}: give metres")
        return self

    @model_validator(mode="after")
    def _is_convex(self) -> ObstacleTable:
        if self.points is not None:
            corners = self.plan
            if len(corners) < 3:
                raise ValueError("points lie on one line: give the corners of an area")
            if len(corners) < len(self.points):
                raise ValueError(
                    f"points are not the corners of a convex polygon: {len(corners)} of {len(self.points)} are on its "
                    "outside; make several obstacles of it"
                )
        return self


class _Obstacles(Table):
    obstacles: dict[str, ObstacleTable]


@dataclass(frozen=True, eq=False)
class Obstacle:
    """An obstacle in the world: solid in its b, place of b in n (3,) [m], heading [rad], its fender if it has one."""

    name: str
    kind: str
    solid: HullMesh
    position: Array
    heading: float
    fender: Fender | None


def build_obstacle(name: str, table: ObstacleTable) -> Obstacle:
    """The obstacle that a table describes."""
    north, east = table.position
    return Obstacle(
        name, table.kind, _prism(table.plan, table.depth, -table.top), np.array([north, east, 0.0], dtype=float),
        radians(table.heading_deg), None if table.fender is None else table.fender.fender,
    )  # fmt: skip


def read_obstacles(text: str) -> list[Obstacle]:
    """Obstacles in the order of `text`: TOML text, one table per obstacle, or the path of such a file; empty: none.

    One line that ends in .toml is a path. Raises InputError, in one line.
    """
    if not text.strip():
        return []
    if "\n" not in text.strip() and text.strip().endswith(".toml"):
        path = Path(text.strip())
        if not is_file(path):
            raise InputError(f"obstacles: file {path} does not exist: give TOML text, or the path of a TOML file")
        content, source = read_toml(path, InputError), f"obstacles in {path.name}"
    else:
        content, source = parse_toml(text, "obstacles", InputError), "obstacles"
    if set(content) == {"obstacles"} and isinstance(content["obstacles"], dict):  # as in a scenario file
        content = content["obstacles"]
    _refuse_other_tables(content, source)
    try:
        tables = _Obstacles.model_validate({"obstacles": content}).obstacles
    except ValidationError as error:
        raise InputError(f"{source}: {describe_error(error, _Obstacles)}") from None
    return [build_obstacle(name, table) for name, table in tables.items()]


def _refuse_other_tables(content: Mapping[str, Any], source: str) -> None:
    """Raise InputError for obstacles in a table of another name than [obstacles], and for one in no table."""
    if is_obstacle(content):
        raise InputError(
            f"{source}: {next(iter(content))} stands in no table: begin the obstacle with its name, [NAME]"
        )
    for name, table in content.items():
        if isinstance(table, Mapping) and not is_obstacle(table) and any(map(is_obstacle, table.values())):
            remedy = suggest(name, ["obstacles"]) or " call it obstacles, or leave it out"
            raise InputError(f"{source}: [{name}] holds tables:{remedy}")


def format_obstacles(tables: Mapping[str, ObstacleTable]) -> str:
    """TOML text from which read_obstacles makes the same obstacles, to the bit."""
    lines = []
    for name, table in tables.items():
        lines.append(f"[{name}]")
        lines += [f"{key} = {_toml(value)}" for key, value in table.model_dump(exclude_none=True).items()]
    return "".join(f"{line}\n" for line in lines)


def _toml(value: Any) -> str:
    if isinstance(value, str):
        escaped = "".join(f"\\u{ord(c):04x}" if c < " " or c in '"\\\x7f' else c for c in value)
        return f'"{escaped}"'
    if isinstance(value, list):
        return f"[{', '.join(map(_toml, value))}]"
    if isinstance(value, dict):
        return f"{{{', '.join(f'{key} = {_toml(inner)}' for key, inner in value.items())}}}"
    return repr(float(value))


def _prism(plan: Array, z_bottom: float, z_top: float) -> HullMesh:
    """Prism over a convex plan (n, 2) between two depths (z down) [m]; outward normals."""
    if _area(plan) < 0.0:
        plan = plan[::-1]
    n = len(plan)
    rings = [np.column_stack([plan, np.full(n, z)]) for z in (z_bottom, z_top)]
    vertices = np.vstack(rings)
    shell = [t for i in range(n) for t in ((i, n + (i + 1) % n, (i + 1) % n), (i, n + i, n + (i + 1) % n))]
    foot, top = [(0, i, i + 1) for i in range(1, n - 1)], [(n, n + i + 1, n + i) for i in range(1, n - 1)]
    return HullMesh(vertices, np.array(shell + foot + top, dtype=np.int64), (vertices,))


def _area(plan: Array) -> float:
    x, y = plan.T
    return float(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)))
