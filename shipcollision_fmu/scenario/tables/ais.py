"""track and ais of a ship: the recording that it follows, and what it tells others by AIS."""

from __future__ import annotations

import re

from pydantic import Field, field_validator

from ...ship.tables.table import Table

__all__ = ["AisTable", "TrackTable"]

LARGEST_MMSI = 999_999_999
_TEXT = re.compile(r"[A-Z0-9 @\[\\\]^_!\"#$%&'()*+,\-./:;<=>?]*")
"""The 64 characters of AIS, ITU-R M.1371-5 table 47."""


class TrackTable(Table):
    """track: recorded AIS that the ship follows, whatever hits it."""

    file: str = Field(min_length=1, description="a CSV file or an NMEA log of AIS, beside the scenario file")
    mmsi: int | None = Field(
        default=None, ge=0, le=LARGEST_MMSI, description="the MMSI of the ship; needed where the file has several"
    )
    until: float | None = Field(
        default=None, gt=0, description="the time [s] to which the file is read; default: the duration of the scenario"
    )


class AisTable(Table):
    """ais: identity of the ship in AIS messages; what is left out follows from the ship and its name."""

    mmsi: int | None = Field(default=None, ge=1, le=LARGEST_MMSI, description="the MMSI, nine digits, e.g. 211234560")
    name: str | None = Field(default=None, max_length=20, description="the name, up to 20 capital letters and digits")
    call_sign: str = Field(default="", max_length=7, description="the call sign, up to 7 capital letters and digits")
    ship_type: int | None = Field(
        default=None, ge=0, le=99, description="the AIS number of the type of ship, e.g. 70 for cargo, 80 for tanker"
    )
    destination: str = Field(default="", max_length=20, description="the destination, up to 20 capital letters")

    @field_validator("name", "call_sign", "destination")
    @classmethod
    def _check_letters(cls, text: str | None) -> str | None:
        if text is not None and not _TEXT.fullmatch(text):
            raise ValueError(f"{text!r} has letters that AIS has not: take capital letters, digits and spaces")
        return text
