"""The members of a traffic situation in JSON that a scenario needs, one class per object.

Schema (MIT): https://github.com/dnv-opensource/maritime-schema, schemas/traffic_situation.json, version 0.2.0. Wind
[m/s, deg] comes from its direction, current flows towards its direction. Files are made by
https://github.com/dnv-opensource/ship-traffic-generator, whose output has changed since:

    0.1 (2023)          own_ship, target_ship, start_pose {speed, course}; waypoints are positions
    0.2 (early 2024)    names in camelCase; targetShip or targetShips; north and east beside latitude and longitude;
                        for some months radians and m/s (angle_units.py)
    0.3 to 0.8          knots and degrees; length and width in static, later in static.dimensions; version
    0.9 (2026)          trafficgenVersion, schemaVersion; position, sog and cog are left to the waypoints
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar

from pydantic import AliasChoices, ConfigDict, Field, ValidationError, model_validator

from ...errors import ScenarioError
from ...ship.loading.messages import describe_error
from ...ship.tables.table import Table
from .ais import drop_unavailable, drop_unavailable_sizes

__all__ = [
    "Dimensions", "Environment", "Initial", "Leg", "LegData", "Part", "Position", "Situation", "Static", "TrafficShip",
    "Waypoint", "parse_situation",
]  # fmt: skip

Knots = Annotated[float | None, Field(ge=0, le=60, description="the speed over ground in knots")]

Course = Annotated[float | None, Field(ge=-360, le=360, description="clockwise from north, in degrees")]
Metres = Annotated[float | None, Field(gt=0, le=500, description="a length in metres")]
Reach = Annotated[float | None, Field(ge=0, le=511, description="a distance from the reference point in metres")]

FORMATS = (
    "give JSON of trafficgen or maritime-schema, or XML of CommonOcean (a scenario in TOML needs no import: "
    "`shipcollision run FILE.toml`)"
)
"""The remedy for a file that is none of these."""


class Part(Table):
    """An object of a situation: strict as a table of ours, but the file is another project's and may say more."""

    model_config = ConfigDict(extra="allow")


class Position(Part):
    lat: float = Field(ge=-85, le=85, validation_alias=AliasChoices("lat", "latitude"), description="in degrees")
    lon: float = Field(ge=-180, le=180, validation_alias=AliasChoices("lon", "longitude"), description="in degrees")
    north: float | None = None
    east: float | None = None


class DataPoint(Part):
    value: float | None = None


class LegData(Part):
    sog: DataPoint | None = None


class Leg(Part):
    sog: Knots = None
    data: LegData | None = None

    @property
    def planned_sog(self) -> float | None:
        """Speed over ground planned for the leg [kn]: leg.data.sog, else leg.sog."""
        point = self.data.sog if self.data is not None else None
        return self.sog if point is None or point.value is None else point.value


class Waypoint(Part):
    position: Position
    turnRadius: float | None = None
    leg: Leg | None = None

    @model_validator(mode="before")
    @classmethod
    def _wrap_position(cls, data: Any) -> Any:
        """A waypoint of 2023 is a position itself."""
        return {"position": data} if isinstance(data, Mapping) and "latitude" in data else data


class Initial(Part):
    position: Position | None = None
    sog: Knots = Field(default=None, validation_alias=AliasChoices("sog", "speed"))
    cog: Course = Field(default=None, validation_alias=AliasChoices("cog", "course"))
    heading: Course = None
    unavailable: list[str] = Field(default=[])

    @model_validator(mode="before")
    @classmethod
    def _read_ais(cls, data: Any) -> Any:
        return drop_unavailable(data)


class Dimensions(Part):
    length: Metres = None
    width: Metres = None
    draught: Metres = None
    a: Reach = None
    b: Reach = None
    c: Reach = None
    d: Reach = None

    @model_validator(mode="before")
    @classmethod
    def _read_ais(cls, data: Any) -> Any:
        return drop_unavailable_sizes(data)


class Static(Dimensions):
    dimensions: Dimensions | None = None
    name: str | None = None
    shipType: str | int | None = None
    initDelay: float | None = None
    sogMax: Knots = Field(default=None, validation_alias=AliasChoices("sogMax", "speedMax"))


class TrafficShip(Part):
    static: Static | None = None
    initial: Initial | None = Field(default=None, validation_alias=AliasChoices("initial", "startPose"))
    waypoints: list[Waypoint] | None = None

    @property
    def fix(self) -> Position | None:
        """Position at the start: that of `initial`, else the first waypoint's."""
        if self.initial is not None and self.initial.position is not None:
            return self.initial.position
        return self.waypoints[0].position if self.waypoints else None

    @property
    def dimensions(self) -> Dimensions:
        static = self.static or Static()
        return static.dimensions or static


class Environment(Part):
    ALL_COUNT: ClassVar[bool] = True

    currentSpeed: float | None = Field(default=None, ge=0, le=10, description="the speed of the current [m/s]")
    currentDirection: Course = None
    windSpeed: float | None = Field(default=None, ge=0, le=100, description="the speed of the wind [m/s]")
    windDirection: Course = None
    significantWaveHeight: float | None = None


class Situation(Part):
    version: str | None = None
    schemaVersion: str | None = None
    trafficgenVersion: str | None = None
    title: str | None = None
    description: str | None = None
    ownShip: TrafficShip = Field(description="the own ship")
    targetShips: list[TrafficShip] | None = Field(
        default=None, validation_alias=AliasChoices("targetShips", "targetShip"), description="a list of target ships"
    )
    environment: Environment | None = None

    @property
    def roles(self) -> dict[str, TrafficShip]:
        """The ships by role, which is the name in the scenario."""
        ships = self.targetShips or []
        targets = {f"target_{i}" if len(ships) > 1 else "target": ship for i, ship in enumerate(ships, start=1)}
        return {"own": self.ownShip, **targets}


def parse_situation(content: bytes, name: str) -> Situation:
    """The traffic situation in a file of that content, or in the member trafficSituation of a larger document.

    Raises ScenarioError, in one line, for content that is no traffic situation.
    """
    try:
        data = _rename(json.loads(content.decode("utf-8")))
    except UnicodeDecodeError as error:
        raise ScenarioError(f"{name}: is not UTF-8 text (byte {error.start}): save it as UTF-8") from None
    except (ValueError, RecursionError) as error:
        raise ScenarioError(f"{name}: is not valid JSON: {error}; {FORMATS}") from None
    if isinstance(data, dict) and isinstance(data.get("trafficSituation"), dict):
        data = data["trafficSituation"]
    _refuse_input_of_trafficgen(data, name)
    if not isinstance(data, dict) or "ownShip" not in data:
        raise ScenarioError(
            f"{name}: is no traffic situation, it has no ownShip: give a file of trafficgen or maritime-schema"
        )
    try:
        return Situation.model_validate(data)
    except ValidationError as error:
        raise ScenarioError(f"{name}: {describe_error(error, Situation)}") from None


def _rename(data: Any) -> Any:
    """The same with names in camelCase; files of 2023 have underscores."""
    if isinstance(data, dict):
        return {re.sub(r"_([a-z0-9])", lambda m: m[1].upper(), key): _rename(value) for key, value in data.items()}
    return [_rename(value) for value in data] if isinstance(data, list) else data


def _refuse_input_of_trafficgen(data: Any, name: str) -> None:
    """Raise ScenarioError for what trafficgen reads: it describes encounters, and its targets are yet to be made."""
    document = data[0] if isinstance(data, list) and data else data
    if not isinstance(document, dict) or document.get("targetShips") or document.get("targetShip"):
        return
    if any(key in document for key in ("encounters", "encounter", "trafficSituations")):
        raise ScenarioError(
            f"{name}: is an input of trafficgen, it has encounters and no targetShips: run `trafficgen gen-situation "
            f"-s {name} -os OWN.json -t TARGETS -o FOLDER`, and import a file of that FOLDER"
        )
