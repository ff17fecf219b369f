"""orders of a ship: rudder, heading or revolutions from a time on."""

from __future__ import annotations

from typing import Any

from pydantic import Field, model_validator

from ...ship.tables.table import Table

__all__ = ["Order", "revolutions"]

MAXIMUM_REVOLUTIONS = 20.0
"""[rev/s] Of a model in a tank. A larger value was meant in revolutions per minute."""


def revolutions() -> Any:
    """The optional field rev_per_s of an order."""
    return Field(
        default=None, ge=-MAXIMUM_REVOLUTIONS, le=MAXIMUM_REVOLUTIONS, description="the ordered propeller speed [rev/s]"
    )


class Order(Table):
    """An order of the bridge; a key that is left out keeps the order before it.

    heading_deg gives the rudder to the autopilot, rudder_deg takes it back; both end a route.
    """

    time: float = Field(
        ge=0, description="the time [s]; the order is given at the first communication point at or after it"
    )
    rudder_deg: float | None = Field(
        default=None, ge=-90, le=90, description="the ordered rudder angle, positive to starboard [deg]"
    )
    heading_deg: float | None = Field(
        default=None, ge=-360, le=720, description="the heading for the autopilot, clockwise from north [deg]"
    )
    rev_per_s: float | None = revolutions()

    @model_validator(mode="after")
    def _check_content(self) -> Order:
        if self.rudder_deg is None and self.heading_deg is None and self.rev_per_s is None:
            raise ValueError("orders nothing: give rudder_deg or rev_per_s")
        if self.rudder_deg is not None and self.heading_deg is not None:
            raise ValueError("gives both rudder_deg and heading_deg: keep one of them")
        return self
