"""[environment]: current and wind, uniform, from the start and as they change at given times."""

from __future__ import annotations

from itertools import pairwise
from math import cos, isfinite, radians, sin
from typing import Any

from pydantic import Field, field_validator, model_validator

from ...ship.tables.table import Table

__all__ = ["MAXIMUM_CURRENT", "MAXIMUM_WIND", "CurrentTable", "Environment", "EnvironmentChange", "WindTable"]

MAXIMUM_CURRENT = 10.0
"""[m/s] Limit of each component. The strongest tidal streams run 8 m/s; a larger value was meant in another unit."""
MAXIMUM_WIND = 60.0
"""[m/s] Limit of the wind. Hurricanes of the strongest category begin at 70; a larger value was meant in knots."""


class CurrentTable(Table):
    """current: its speed over ground and the direction to which it flows."""

    speed: float = Field(description="the speed of the water [m/s]")
    towards_deg: float = Field(description="the direction to which the water flows, clockwise from north [deg]")

    @property
    def velocity(self) -> list[float]:
        """[north, east] [m/s]."""
        towards = radians(self.towards_deg)
        return [self.speed * cos(towards), self.speed * sin(towards)]


def _describe_both_forms(schema: dict[str, Any]) -> None:
    """Extend the JSON schema of the velocity by the table that may stand in its place."""
    velocity = {key: schema.pop(key) for key in ("type", "items", "minItems", "maxItems")}
    schema["anyOf"] = [velocity, CurrentTable.model_json_schema()]


class WindTable(Table):
    """wind: its speed over ground and the direction from which it comes."""

    speed: float = Field(ge=0.0, le=MAXIMUM_WIND, description="the wind's speed [m/s]")
    from_deg: float = Field(
        ge=-360, le=720, description="the direction from which the wind comes, clockwise from north [deg]"
    )


def _convert_speed_and_direction(given: Any) -> Any:
    if not isinstance(given, dict):
        return given
    known = set(given) == {"speed", "towards_deg"}
    if not known or not all(type(value) in (int, float) and isfinite(value) for value in given.values()):
        raise ValueError(
            f"[environment] current = {given} must be two finite numbers: {{speed = 1.0, towards_deg = 90.0}}"
        )
    return CurrentTable(speed=float(given["speed"]), towards_deg=float(given["towards_deg"])).velocity


def _check_current(current: list[float] | None) -> list[float] | None:
    if current is not None and max(map(abs, current)) > MAXIMUM_CURRENT:
        raise ValueError(f"{current} runs faster than the limit of {MAXIMUM_CURRENT:g} m/s: give metres per second")
    return current


class EnvironmentChange(Table):
    """A change of current, wind or both at a time; a key that is left out stays as it was."""

    time: float = Field(ge=0, description="the time [s]; it acts from the first communication point at or after it")
    current: list[float] | None = Field(
        default=None,
        min_length=2,
        max_length=2,
        description="the velocity of the water, [north, east] or {speed = 1.0, towards_deg = 90.0} [m/s, deg]",
    )
    wind: WindTable | None = Field(default=None, description="the wind, {speed = 10.0, from_deg = 270.0} [m/s, deg]")

    _convert_current = field_validator("current", mode="before")(_convert_speed_and_direction)
    _check_current = field_validator("current")(_check_current)

    @model_validator(mode="after")
    def _check_content(self) -> EnvironmentChange:
        if self.current is None and self.wind is None:
            raise ValueError("changes nothing: give current or wind")
        return self


class Environment(Table):
    """[environment]: current and wind, which act on every ship that has hydrodynamics."""

    current: list[float] = Field(
        default=[0.0, 0.0],
        min_length=2,
        max_length=2,
        description="the velocity of the water, [north, east] or {speed = 1.0, towards_deg = 90.0} [m/s, deg]",
        json_schema_extra=_describe_both_forms,
    )
    wind: WindTable | None = Field(default=None, description="the wind, {speed = 10.0, from_deg = 270.0} [m/s, deg]")
    changes: list[EnvironmentChange] = Field(
        default=[], description="[{time = 60.0, wind = {speed = 15.0, from_deg = 300.0}}, ...]"
    )

    _convert_current = field_validator("current", mode="before")(_convert_speed_and_direction)
    _check_current = field_validator("current")(_check_current)

    @model_validator(mode="after")
    def _check_order(self) -> Environment:
        for earlier, later in pairwise(change.time for change in self.changes):
            if later <= earlier:
                raise ValueError(f"changes: time {later:g} s comes after {earlier:g} s: put them in order of time")
        return self
