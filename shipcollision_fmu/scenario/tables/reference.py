"""[reference]: published results of the scenario's ships, with which a run is compared."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from ...ship.tables.table import Table

__all__ = ["Published", "Quantity", "Reference", "Tolerance"]

Quantity = Literal["x", "y", "z", "h", "p", "r", "v_x", "v_y", "v_z", "w_x", "w_y", "w_z"]


class Tolerance(Table):
    """tolerance: largest differences between computed and published numbers."""

    horizontal: float = Field(gt=0, description="the tolerance of x and y [m]")
    vertical: float = Field(gt=0, description="the tolerance of z [m]")
    quaternion: float = Field(gt=0, description="the tolerance of h, p and r [1]")
    velocity: float = Field(gt=0, description="the tolerance of v_x, v_y and v_z [m/s]")
    rate: float = Field(gt=0, description="the tolerance of w_x, w_y and w_z [rad/s]")


class Published(Table):
    """[reference.ships.NAME]: a ship's published state as printed, and corrections of it."""

    printed: dict[Quantity, float] = Field(
        min_length=1, description="{x = ..., h = ..., v_x = ...} as printed [m, 1, m/s, rad/s]"
    )
    corrected: dict[Quantity, float] = Field(
        default={}, description="the numbers that differ from print, in the same units"
    )
    tolerance: Tolerance = Field(description="{horizontal, vertical, quaternion, velocity, rate} [m, m, 1, m/s, rad/s]")

    @model_validator(mode="after")
    def _check_corrections(self) -> Published:
        for quantity in self.corrected:
            if quantity not in self.printed:
                raise ValueError(f"corrects {quantity}, which is not printed: printed are {', '.join(self.printed)}")
        return self


class Reference(Table):
    """[reference]: published results at one time, in the frame of Guan et al. 2014 (see results/published.py)."""

    source: str = Field(min_length=1, description="the publication: author, year, table")
    time: float = Field(gt=0, description="the time of the published state from the start of the scenario [s]")
    note: str = Field(default="", description="text for people; no effect")
    ships: dict[str, Published] = Field(min_length=1, description="a table [reference.ships.NAME] per ship")
