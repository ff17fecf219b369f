"""Identity: who a ship is to others, from the table `ais` of a scenario or, where that is silent, from the ship.

MMSI         of the track, else 200 000 001 and on: no state has the digits 200
name         the ship's name in the scenario, in capitals
ship type    by the words of the ship's kind
dimensions   whole metres from CO, which stands for the antenna: L_oa in halves, B in halves
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from math import ceil
from typing import Any, NamedTuple

from ...ship.ship_type import find_ship_type, names_a_type

__all__ = ["FIRST_MMSI", "Hull", "Identity", "make_identity"]

FIRST_MMSI = 200_000_001
LONGEST, WIDEST = 511, 63
"""Limits of the fields of dimensions, in metres from the antenna."""

_SHIP_TYPES = {
    "car carrier": 70, "cargo vessel, loaded": 70, "cargo vessel, container on deck": 70, "container ship, loaded": 70,
    "bulk carrier": 70, "tanker, loaded": 80, "tanker, in ballast": 80, "liquefied natural gas tanker": 80,
    "ferry": 60, "passenger liner": 60, "drilling vessel": 90, "offshore supply vessel": 90,
    "diving support vessel": 34, "research vessel": 90, "destroyer": 35, "fishing vessel": 30, "tug": 52, "tender": 53,
    "speed boat": 37,
}  # fmt: skip
"""AIS numbers by the names of ship/ship_type.py."""
OTHER_TYPE = 90


class Hull(NamedTuple):
    """What a ship is: words of its kind, L_oa, B, T [m], mass [kg]."""

    kind: str
    length: float
    breadth: float
    draught: float
    mass: float


class Identity(NamedTuple):
    """Who a ship is. Distances of the antenna [m], whole; draught [m]; mass [kg]."""

    mmsi: int
    name: str
    call_sign: str
    ship_type: int
    destination: str
    to_bow: int
    to_stern: int
    to_port: int
    to_starboard: int
    draught: float
    mass: float


def make_identity(number: int, name: str, hull: Hull, ais: Mapping[str, Any], track_mmsi: int | None) -> Identity:
    """The identity of the ship of that number, from 0, and name. ais: keys of the table that were given."""
    shown = re.sub(r"[^A-Z0-9 -]", " ", name.upper())[:20].strip()
    typical = _SHIP_TYPES[find_ship_type(hull.kind).name] if names_a_type(hull.kind) else OTHER_TYPE
    bow, side = min(LONGEST, ceil(0.5 * hull.length)), min(WIDEST, ceil(0.5 * hull.breadth))
    given = {key: value for key, value in ais.items() if value is not None}
    return Identity(
        mmsi=int(given.get("mmsi", track_mmsi if track_mmsi else FIRST_MMSI + number)),
        name=str(given.get("name", shown)),
        call_sign=str(given.get("call_sign", "")),
        ship_type=int(given.get("ship_type", typical)),
        destination=str(given.get("destination", "")),
        to_bow=bow, to_stern=max(0, min(LONGEST, round(hull.length) - bow)),
        to_port=side, to_starboard=max(0, min(WIDEST, round(hull.breadth) - side)),
        draught=hull.draught, mass=hull.mass,
    )  # fmt: skip
