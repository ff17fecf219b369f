"""evasion of a ship: the order that a late evasive manoeuvre gives once another ship is near."""

from __future__ import annotations

from pydantic import Field, model_validator

from ...ship.tables.table import Table
from .orders import revolutions

__all__ = ["EvasionTable"]


class EvasionTable(Table):
    """evasion: an order that replaces autopilot, route and orders once another ship is near, until the end."""

    of: str = Field(min_length=1, description="the name of the ship to evade")
    distance: float | None = Field(
        default=None, gt=0, description="the distance between the midships at which it is ordered [m], e.g. 900.0"
    )
    time_to_closest: float | None = Field(
        default=None, gt=0, description="the time to the closest approach at which it is ordered [s], e.g. 60.0"
    )
    rudder_deg: float = Field(
        ge=-90, le=90, description="the ordered rudder angle, positive to starboard [deg], e.g. 35.0"
    )
    rev_per_s: float | None = revolutions()
    until: float | None = Field(
        default=None,
        ge=0,
        description="the time [s] at which it ends, or from which it no longer begins; default never",
    )

    @model_validator(mode="after")
    def _check_trigger(self) -> EvasionTable:
        if (self.distance is None) == (self.time_to_closest is None):
            raise ValueError("evasion needs one trigger: give distance or time_to_closest, one of them")
        return self
