"""What is typical of a type of ship: stability, service speed and machinery, found by the words of `[ship] kind`.

    GM_over_B    metacentric height of the loaded ship over its breadth
    least_GM     and not less than this [m]
    highest_KG   KG over depth at most, for shallow and wide hulls
    speed        service speed of the large ships of the type [m/s]
    machinery    key of MACHINERY in loading/engine_estimate.py, at 100 m and more
    tow          power installed for towing and work over what the service speed needs

GM: typical working values of loaded ships in Barrass and Derrett, Ship Stability for Masters and Mates, known from
secondary sources: general cargo 0.3 to 0.5 m, double-hull supertankers 2 to 5 m, container ships 1.5 to 2.5 m, ro-ro
ships about 1.5 m, ore and bulk carriers 2 to 3 m. They are taken over the usual breadth of the type. Guides for ships'
officers recommend 4 to 8 % of the breadth. For the other types no published list was found: values within 6 to 15 %,
the higher the smaller the ship. The least values are those of the International Code on Intact Stability 2008: 0.15 m
(part A, 2.2.4), fishing vessels 0.35 m (part B, 2.1.3.1).

Speed: Barrass, Ship Design and Performance for Masters and Mates, general characteristics of ship types: VLCC 13 to
15 3/4 kn, ore carriers 14.5 to 15.5, general cargo 14 to 16, gas carriers 16 to 20 3/4, passenger liners 24 to 30,
container ships 20 to 28, ro-ro ships 18 to 24. Values for working craft are usual, not published.
"""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["CARGO_VESSEL", "KNOT", "SHIP_TYPES", "ShipType", "find_ship_type", "list_type_words", "names_a_type"]

KNOT = 1852.0 / 3600.0
"""[m/s]"""


class ShipType(NamedTuple):
    """Typical values of a type; see the module."""

    name: str
    GM_over_B: float
    speed: float
    machinery: str
    least_GM: float = 0.15
    highest_KG: float = 1.0
    tow: float = 1.0


_SLOW, _CPP, _TURBINE, _JET, _AZIMUTH = "slow diesel", "diesel with CPP", "gas turbine with CPP", "waterjet", "azimuth"

SHIP_TYPES = {
    of.name: of
    for of in (
        ShipType("car carrier", 0.05, 19.5 * KNOT, _SLOW, highest_KG=1.6),
        ShipType("cargo vessel, loaded", 0.03, 15.0 * KNOT, _SLOW),
        ShipType("cargo vessel, container on deck", 0.03, 15.0 * KNOT, _SLOW, highest_KG=1.2),
        ShipType("container ship, loaded", 0.05, 24.0 * KNOT, _SLOW, highest_KG=1.2),
        ShipType("bulk carrier", 0.065, 14.5 * KNOT, _SLOW),
        ShipType("tanker, loaded", 0.08, 15.5 * KNOT, _SLOW),
        ShipType("tanker, in ballast", 0.12, 16.0 * KNOT, _SLOW),
        ShipType("liquefied natural gas tanker", 0.07, 19.0 * KNOT, _SLOW, highest_KG=1.2),
        ShipType("ferry", 0.07, 21.0 * KNOT, _CPP, highest_KG=1.6),
        ShipType("passenger liner", 0.06, 22.0 * KNOT, _CPP, highest_KG=2.0),
        ShipType("drilling vessel", 0.08, 12.0 * KNOT, _AZIMUTH, highest_KG=1.2),
        ShipType("offshore supply vessel", 0.08, 14.0 * KNOT, _CPP, tow=1.5),
        ShipType("diving support vessel", 0.08, 14.0 * KNOT, _CPP, highest_KG=1.2, tow=1.3),
        ShipType("research vessel", 0.07, 14.0 * KNOT, _CPP, highest_KG=1.2),
        ShipType("destroyer", 0.08, 30.0 * KNOT, _TURBINE),
        ShipType("fishing vessel", 0.09, 12.0 * KNOT, _CPP, least_GM=0.35, tow=1.5),
        ShipType("tug", 0.12, 12.5 * KNOT, _AZIMUTH, tow=4.0),
        ShipType("tender", 0.10, 14.0 * KNOT, _CPP, highest_KG=1.2),
        ShipType("speed boat", 0.15, 35.0 * KNOT, _JET),
    )
}  # fmt: skip
"""By name: the ships of Blendermann (1994), and with them bulk carriers and tugs."""

CARGO_VESSEL = SHIP_TYPES["cargo vessel, loaded"]
"""The type of a ship whose kind names none."""

_TYPE_BY_WORD = {
    "ferry": "ferry", "ro-pax": "ferry", "ropax": "ferry",
    "car carrier": "car carrier", "vehicle": "car carrier", "ro-ro": "car carrier",
    "container on deck": "cargo vessel, container on deck", "container": "container ship, loaded",
    "natural gas": "liquefied natural gas tanker", "lng": "liquefied natural gas tanker",
    "ballast": "tanker, in ballast", "tanker": "tanker, loaded", "vlcc": "tanker, loaded", "bulk": "bulk carrier",
    "ore carrier": "bulk carrier", "passenger": "passenger liner",
    "cruise": "passenger liner", "fishing": "fishing vessel", "trawler": "fishing vessel", "tug": "tug",
    "drill": "drilling vessel", "diving": "diving support vessel", "supply": "offshore supply vessel",
    "research": "research vessel", "destroyer": "destroyer", "frigate": "destroyer", "corvette": "destroyer",
    "warship": "destroyer", "naval": "destroyer", "navy": "destroyer", "cruiser": "destroyer",
    "battleship": "destroyer", "offshore": "offshore supply vessel", "tender": "tender", "pilot": "tender",
    "launch": "tender", "patrol": "tender",
    "pleasure": "speed boat", "high speed": "speed boat", "speed boat": "speed boat",
    "speedboat": "speed boat", "motor boat": "speed boat", "yacht": "speed boat", "high-speed": "speed boat",
    "cargo": "cargo vessel, loaded", "coaster": "cargo vessel, loaded", "freighter": "cargo vessel, loaded",
    "reefer": "cargo vessel, loaded", "multi-purpose": "cargo vessel, loaded", "barge": "cargo vessel, loaded",
}  # fmt: skip
"""The type for a word in [ship] kind; the first that is found counts."""


def find_ship_type(kind: str) -> ShipType:
    """The type that a ship's kind names; a loaded cargo vessel where no word is found."""
    lower = kind.lower()
    if lower in SHIP_TYPES:
        return SHIP_TYPES[lower]
    return next((SHIP_TYPES[name] for word, name in _TYPE_BY_WORD.items() if word in lower), CARGO_VESSEL)


def names_a_type(kind: str) -> bool:
    """Whether a ship's kind has a word for a type."""
    lower = kind.lower()
    return lower in SHIP_TYPES or any(word in lower for word in _TYPE_BY_WORD)


def list_type_words() -> list[str]:
    """The words for types, in the order in which they count."""
    return list(_TYPE_BY_WORD)
