"""[environment]: current and wind, uniform and constant."""

from __future__ import annotations

from math import cos, isfinite, radians, sin
from typing import Any

from pydantic import Field, field_validator

from ...ship.tables.table import Table

__all__ = ["MAXIMUM_CURRENT", "MAXIMUM_WIND", "CurrentTable", "Environment", "WindTable"]

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

    @field_validator("current", mode="before")
    @classmethod
    def _convert_speed_and_direction(cls, given: Any) -> Any:
        if not isinstance(given, dict):
            return given
        known = set(given) == {"speed", "towards_deg"}
        if not known or not all(type(value) in (int, float) and isfinite(value) for value in given.values()):
            raise ValueError(
                f"[environment] current = {given} must be two finite numbers: {{speed = 1.0, towards_deg = 90.0}}"
            )
        return CurrentTable(speed=float(given["speed"]), towards_deg=float(given["towards_deg"])).velocity

    @field_validator("current")
    @classmethod
    def _check_current(cls, current: list[float]) -> list[float]:
        if max(map(abs, current)) > MAXIMUM_CURRENT:
            raise ValueError(f"{current} runs faster than the limit of {MAXIMUM_CURRENT:g} m/s: give metres per second")
        return current
