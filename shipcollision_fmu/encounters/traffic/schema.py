"""The members of a traffic situation in JSON that a scenario needs, one class per object.

Schema (MIT): https://github.com/dnv-opensource/maritime-schema, schemas/traffic_situation.json, version 0.2.0. Wind
[m/s, deg] comes from its direction, current flows towards its direction. Files are made by
https://github.com/dnv-opensource/ship-traffic-generator. Version 0.1 gives `initial`, and length and width in `static`;
version 0.2 puts them in `static.dimensions`, and `initial`, or position, sog and cog in it, may be missing.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

from pydantic import AliasChoices, ConfigDict, Field, ValidationError

from ...errors import ScenarioError
from ...ship.loading.messages import describe_error
from ...ship.tables.table import Table

__all__ = [
    "Dimensions", "Environment", "Initial", "Leg", "Position", "Situation", "Static", "TrafficShip", "Waypoint",
    "read_situation",
]  # fmt: skip

Knots = Annotated[float | None, Field(ge=0, le=60, description="the speed over ground in knots")]
Course = Annotated[float | None, Field(ge=-360, le=360, description="clockwise from north, in degrees")]
Metres = Annotated[float | None, Field(gt=0, le=500, description="a length in metres")]


class Part(Table):
    """An object of a situation: strict as a table of ours, but the file is another project's and may say more."""

    model_config = ConfigDict(extra="ignore")


class Position(Part):
    lat: float = Field(ge=-85, le=85, validation_alias=AliasChoices("lat", "latitude"))
    lon: float = Field(ge=-180, le=180, validation_alias=AliasChoices("lon", "longitude"))


class DataPoint(Part):
    value: float | None = None


class Leg(Part):
    sog: Knots = None
    data: dict[str, DataPoint | None] | None = None

    @property
    def planned_sog(self) -> float | None:
        """Speed over ground planned for the leg [kn]: leg.data.sog, else leg.sog."""
        point = (self.data or {}).get("sog")
        return self.sog if point is None or point.value is None else point.value


class Waypoint(Part):
    position: Position
    turnRadius: float | None = None
    leg: Leg | None = None


class Initial(Part):
    position: Position | None = None
    sog: Knots = None
    cog: Course = None
    heading: Course = None


class Dimensions(Part):
    length: Metres = None
    width: Metres = None
    draught: Metres = None
    a: Metres = None
    b: Metres = None
    c: Metres = None
    d: Metres = None


class Static(Dimensions):
    dimensions: Dimensions | None = None
    name: str | None = None
    shipType: str | int | None = None
    initDelay: float | None = None


class TrafficShip(Part):
    static: Static | None = None
    initial: Initial | None = None
    waypoints: list[Waypoint] | None = None


class Environment(Part):
    currentSpeed: float | None = Field(default=None, ge=0, le=10, description="the speed of the current [m/s]")
    currentDirection: Course = None
    windSpeed: float | None = Field(default=None, ge=0, le=100, description="the speed of the wind [m/s]")
    windDirection: Course = None
    significantWaveHeight: float | None = None


class Situation(Part):
    version: str | None = None
    title: str | None = None
    description: str | None = None
    ownShip: TrafficShip = Field(description="the own ship")
    targetShips: list[TrafficShip] | None = Field(default=None, description="a list of the target ships")
    environment: Environment | None = None


def read_situation(path: Path) -> Situation:
    """The traffic situation in a file, or in the member trafficSituation of a larger document.

    Raises ScenarioError, in one line, for a file that cannot be read, or that is no traffic situation.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ScenarioError(f"{path} cannot be read: {error.strerror}: give the path of a JSON file") from None
    except UnicodeDecodeError as error:
        raise ScenarioError(f"{path.name}: is not UTF-8 text (byte {error.start}): save it as UTF-8") from None
    except (ValueError, RecursionError) as error:
        raise ScenarioError(f"{path.name}: is not valid JSON: {error}") from None
    if isinstance(content, dict) and isinstance(content.get("trafficSituation"), dict):
        content = content["trafficSituation"]
    if not isinstance(content, dict) or "ownShip" not in content:
        raise ScenarioError(
            f"{path.name}: is no traffic situation, it has no ownShip: give a file of trafficgen or maritime-schema"
        )
    try:
        return Situation.model_validate(content)
    except ValidationError as error:
        raise ScenarioError(f"{path.name}: {describe_error(error, Situation)}") from None
