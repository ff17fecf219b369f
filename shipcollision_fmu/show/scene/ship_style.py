"""How ships of a type look: sheer, forecastle, bulwark, bulb, propellers. Usual values, of no ship in particular.

The type follows from the words of `[ship] kind` (ship/ship_type.py). A kind without such a word is drawn by its
proportions: a short and broad one as a tug, a long and slender one as a cargo vessel, a high one as a car carrier.
"""

from __future__ import annotations

from typing import NamedTuple

from ...ship.loading.dimensions_estimate import FORMS
from ...ship.ship_type import CARGO_VESSEL, find_ship_type, names_a_type

__all__ = ["GREY", "Ends", "Style", "choose_style", "choose_type"]

GREY = {"topsides": "naval", "stripe": "livery", "boot-top": "livery"}
"""What the paints of a hull become on a grey ship: its colour in plots is on boot topping, stripe and funnel."""


class Ends(NamedTuple):
    """flare, tuck: shares by which the waterline is narrower than the deck at stem and transom; knuckle: depth below
    the deck above which the bow has no flare, over the freeboard; rakes from the vertical."""

    stem_rake_deg: float = 22.0
    flare: float = 0.22
    knuckle: float = 0.0
    transom_rake_deg: float = 8.0
    tuck: float = 0.12


class Style(NamedTuple):
    """forecastle, bulwark [m]; sheer over B; where bulwarks reach, over the length from aft; deck: its paint;
    has_stripe: a white band below the deck; is_grey: naval grey, with stripe and boot topping in the ship's colour."""

    forecastle: float = 2.6
    forecastle_length: float = 0.075
    sheer_fore: float = 0.0
    sheer_aft: float = 0.0
    bulwark: float = 1.3
    bulwark_fore: float = 0.915
    bulwark_aft: float = -0.05
    has_bulb: bool = True
    propellers: int = 1
    deck: str = "deck-red"
    has_stripe: bool = False
    is_grey: bool = False
    depth_over_draught: float = 1.4
    ends: Ends = Ends()


_WORKING = Style(0.0, 0.0, 0.10, 0.02, 1.1, 0.0, 1.05, has_bulb=False, deck="deck",
                 ends=Ends(16.0, 0.12, 0.3, 10.0, 0.08))  # fmt: skip
_BROAD = Ends(11.0, 0.07, tuck=0.15)
_OFFSHORE = Ends(24.0, 0.26, 0.3, 5.0, 0.04)
_PASSENGERS = Ends(30.0, 0.28, 0.22, 5.0, 0.06)

_STYLES = {
    "container ship, loaded": Style(3.0, 0.07, deck="deck", ends=Ends(28.0, 0.32, tuck=0.2)),
    "cargo vessel, container on deck": Style(),
    "tanker, loaded": Style(0.0, 0.0, 0.03, 0.0, 1.4, 0.93, ends=_BROAD),
    "tanker, in ballast": Style(0.0, 0.0, 0.03, 0.0, 1.4, 0.93, ends=_BROAD),
    "liquefied natural gas tanker": Style(0.0, 0.0, 0.03, 0.0, 1.4, 0.92, ends=Ends(15.0, 0.12)),
    "ferry": Style(0.0, 0.0, bulwark_fore=0.80, propellers=2, deck="deck", has_stripe=True, ends=_PASSENGERS),
    "car carrier": Style(0.0, 0.0, bulwark_fore=0.93, deck="deck", ends=Ends(22.0, 0.26, 0.4, 3.0, 0.06)),
    "passenger liner": Style(0.0, 0.0, 0.04, 0.0, bulwark_fore=0.80, propellers=2, deck="deck", has_stripe=True,
                             ends=_PASSENGERS),
    "destroyer": Style(0.0, 0.0, 0.10, 0.0, 0.2, 2.0, has_bulb=False, propellers=2, deck="deck-grey",
                       has_stripe=True, is_grey=True, ends=Ends(38.0, 0.32, 0.2, 12.0, 0.08)),
    "tug": _WORKING._replace(propellers=2),
    "fishing vessel": _WORKING._replace(sheer_fore=0.14, ends=Ends(28.0, 0.26, 0.3, 10.0, 0.08)),
    "offshore supply vessel": Style(0.0, 0.0, 0.08, 0.0, 1.2, 0.6, propellers=2, ends=_OFFSHORE),
    "diving support vessel": Style(0.0, 0.0, 0.06, 0.0, 1.2, 0.6, propellers=2, ends=_OFFSHORE),
    "research vessel": Style(0.0, 0.0, 0.07, 0.01, 1.1, 0.6, ends=_OFFSHORE), "tender": _WORKING,
    "drilling vessel": Style(propellers=2),
    "speed boat": Style(0.0, 0.0, 0.05, 0.0, 0.2, 2.0, has_bulb=False, propellers=2, ends=Ends(40.0, 0.32, 0.35)),
}  # fmt: skip


def choose_type(kind: str, L: float, B: float, depth: float) -> str:
    """The type of ship that is drawn, a name in SHIP_TYPES, for a kind and length, breadth and depth [m]."""
    if names_a_type(kind):
        return find_ship_type(kind).name
    if L < 40.0 and L / B < 4.0:
        return "tug"
    if depth / B > 0.85:
        return "car carrier"
    return CARGO_VESSEL.name


def choose_style(name: str) -> Style:
    """The style of a type of ship."""
    laden = "tanker, loaded" if name == "tanker, in ballast" else name
    return _STYLES.get(name, Style())._replace(depth_over_draught=FORMS[laden].depth)
