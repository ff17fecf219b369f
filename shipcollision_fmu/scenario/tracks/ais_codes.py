"""Numbers of AIS that stand for something else: "not available", and types of ship.

    heading 511 deg      sog 102.3 kn      cog 360 deg      lat 91, lon 181 deg

Recommendation ITU-R M.1371-5 (2014), annex 8, tables 48 and 51 to 53.
"""

from __future__ import annotations

__all__ = ["COG", "HEADING", "LATITUDE", "LONGITUDE", "SOG", "describe_ship_type"]

HEADING, SOG, COG, LATITUDE, LONGITUDE = 511.0, 102.3, 360.0, 91.0, 181.0
"""Values that mean "not available" [deg, kn, deg, deg, deg]."""

SHIP_TYPES = {
    2: "wing in ground", 4: "high-speed craft", 6: "passenger", 7: "cargo", 8: "tanker",
    30: "fishing", 31: "towing, tug", 32: "towing, tug", 33: "dredging, offshore supply", 34: "diving", 35: "naval",
    36: "sailing, yacht", 37: "pleasure craft", 50: "pilot", 51: "search and rescue, patrol", 52: "tug",
    53: "port tender", 54: "anti-pollution, offshore supply", 55: "law enforcement, patrol",
}  # fmt: skip
"""Types by their number, or by its first digit for those that have a second one for the cargo."""


def describe_ship_type(code: int) -> str | None:
    """Words for an AIS number of a type of ship; None for those that name no type (0 is "not available")."""
    return SHIP_TYPES.get(code, SHIP_TYPES.get(code // 10) if 20 <= code <= 89 else None)
