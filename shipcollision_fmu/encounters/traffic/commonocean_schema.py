"""The members of a CommonOcean scenario in XML that a scenario needs, one class per element.

Format: Krasowski and Althoff (2022), CommonOcean: Composable Benchmarks for Motion Planning on Oceans, Proc. IEEE ITSC,
and its specification, version 2022a. Metres, seconds and radians; x to the east, y to the north; angles from x,
anticlockwise. A time is a whole number of steps of timeStepSize.

The project's own reader, commonocean-io, is not used: it is under the GPL and demands NumPy 1.24 and Matplotlib 3.6.
"""

from __future__ import annotations

from math import inf, isfinite
from typing import Annotated, Any, TypeVar

from pydantic import BeforeValidator, ConfigDict, Field, ValidationError, field_validator

from ...errors import ScenarioError
from ...ship.loading.messages import describe_error
from ...ship.tables.table import Table
from .xml_tree import parse_xml

__all__ = ["Area", "Circle", "CommonOcean", "Obstacle", "PlanningProblem", "Point", "State", "parse_commonocean"]

T = TypeVar("T")


def _take_single(value: Any) -> Any:
    """The content of an element that stands once; every element is read as a list."""
    return value[0] if isinstance(value, list) and len(value) == 1 else value


One = Annotated[T, BeforeValidator(_take_single)]
Size = Annotated[float, BeforeValidator(_take_single), Field(ge=0.01, le=1e5, description="a length in metres")]


class Node(Table):
    """An element: its numbers are text, and it may hold more than is read."""

    model_config = ConfigDict(extra="allow", strict=False)


Coordinate = Annotated[float, BeforeValidator(_take_single), Field(ge=-1e8, le=1e8, description="a place in metres")]
"""Northings of UTM reach 1e7 m."""


DEEPEST = 1e4
"""[m] Limit of the depth of an obstacle; larger ones were meant as infinite."""


class Point(Node):
    x: Coordinate
    y: Coordinate


ORIGIN = Point(x=0.0, y=0.0)


class Value(Node):
    """A number, or an interval, of which the middle is taken."""

    exact: One[float | None] = None
    intervalStart: One[float | None] = None
    intervalEnd: One[float | None] = None

    @property
    def middle(self) -> float | None:
        if self.exact is not None or self.intervalStart is None or self.intervalEnd is None:
            return self.exact
        return 0.5 * (self.intervalStart + self.intervalEnd)


class Rectangle(Node):
    length: Size
    width: Size
    orientation: One[float] = 0.0
    center: One[Point] = ORIGIN


class Circle(Node):
    radius: Size
    center: One[Point] = ORIGIN


class Polygon(Node):
    point: list[Point] = Field(min_length=3, description="the corners of a polygon")


class Area(Node):
    """A shape, or a position: a point, areas, or references to waters (`water`)."""

    point: One[Point | None] = None
    rectangle: list[Rectangle] = Field(default=[])
    circle: list[Circle] = Field(default=[])
    polygon: list[Polygon] = Field(default=[])


class State(Node):
    position: One[Area | None] = None
    orientation: One[Value | None] = None
    velocity: One[Value | None] = None
    velocityY: One[Value | None] = None
    yawRate: One[Value | None] = None
    time: One[Value | None] = None


class Trajectory(Node):
    state: list[State] = Field(default=[])


class Obstacle(Node):
    id: One[str]
    type: One[str] = "unknown"
    depth: One[str | None] = None
    shape: One[Area]
    initialState: One[State]
    trajectory: One[Trajectory | None] = None

    @field_validator("depth")
    @classmethod
    def _check_depth(cls, depth: str | None) -> str | None:
        try:
            valid = depth is None or 0.0 < float(depth) <= DEEPEST or float(depth) == inf
        except ValueError:
            valid = False
        if not valid:
            raise ValueError(f"depth = {depth!r} must be above 0 and at most {DEEPEST:g}, or inf: it is in metres")
        return depth

    @property
    def foot(self) -> float | None:
        """Depth of its foot [m], None where it is infinite or not given."""
        return float(self.depth) if self.depth is not None and isfinite(float(self.depth)) else None


class PlanningProblem(Node):
    id: One[str]
    initialState: One[State]
    goalState: list[State] = Field(default=[])
    waypoint: list[State] = Field(default=[])


class CommonOcean(Node):
    commonOceanVersion: str = "unknown"
    benchmarkID: str = ""
    timeStepSize: float = Field(gt=0, description="the length of a time step in seconds")
    scenarioTags: Any = None
    staticObstacle: list[Obstacle] = Field(default=[])
    dynamicObstacle: list[Obstacle] = Field(default=[])
    planningProblem: list[PlanningProblem] = Field(default=[])


OTHER_FORMATS = {
    "commonRoad": "a CommonRoad scenario, of road vehicles", "route": "a route (RTZ) of one ship",
    "OpenSCENARIO": "an OpenSCENARIO file, of road vehicles", "gpx": "a GPX file: tracks without ships",
}  # fmt: skip
"""Root elements of formats that a user may take for traffic."""


def parse_commonocean(content: bytes, file: str) -> CommonOcean:
    """The CommonOcean scenario in a file of that content; raises ScenarioError, in one line, for another one."""
    root, data = parse_xml(content, file)
    if root != "commonOcean":
        what = OTHER_FORMATS.get(root, f"no traffic, its root element is <{root}>")
        raise ScenarioError(f"{file}: is {what}: give a CommonOcean scenario, or a traffic situation in JSON")
    try:
        return CommonOcean.model_validate(data)
    except ValidationError as error:
        raise ScenarioError(f"{file}: {describe_error(error, CommonOcean)}") from None
