"""[place]: where on earth and when a scenario takes place, for recorded tracks, NMEA, AIS and DIS."""

from __future__ import annotations

from datetime import datetime, timezone

from pydantic import Field, field_validator

from ...ship.tables.table import Table

__all__ = ["EVERYWHERE", "Place"]


class Place(Table):
    """[place]: latitude and longitude of n's origin, and the time of day at time 0."""

    latitude: float = Field(ge=-85, le=85, description="the latitude of n's origin, north positive [deg], e.g. 54.0")
    longitude: float = Field(ge=-180, le=180, description="the longitude of n's origin, east positive [deg], e.g. 8.0")
    start: datetime = Field(
        default=datetime(2026, 1, 1, tzinfo=timezone.utc),
        description="the date and time at time 0, such as 2026-01-01T12:00:00Z; UTC, unless another zone is given",
    )

    @field_validator("start")
    @classmethod
    def _take_utc(cls, start: datetime) -> datetime:
        return start.replace(tzinfo=timezone.utc) if start.tzinfo is None else start.astimezone(timezone.utc)


EVERYWHERE = Place(latitude=54.0, longitude=7.0)
"""Of scenarios without [place]: the German Bight, open water for tens of kilometres."""
