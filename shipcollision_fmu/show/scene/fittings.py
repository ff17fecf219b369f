"""Fittings on a ship's deck, by type of ship. Contact ignores them, and they are no ship's real arrangement.

They follow from main dimensions and type, as far as they fit on the deck. Hulls from mesh files, boxes (barges, logs,
buoys) and ships shorter than SHORTEST have none.

    cargo vessel, bulk carrier    hatches, cranes on ships below GEARED, the house aft
    container ship                bays of containers, the house at two thirds aft, a bay behind it
    tanker, gas carrier           pipes, manifold and its cranes, or spherical tanks; the house aft
    ferry, passenger, car carrier decks over most of the length with windows, boats; a bridge forward
    tug, supply, fishing, tender  the house forward, a working deck with winch and gear aft
    naval                         a gun, sloping blocks with masts and funnel, a flight deck aft
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from zlib import crc32

import numpy as np

from .cargo import fit_hatches, fit_tank_deck, stow_containers
from .hull_shell import WeatherDeck
from .lights import Mast, find_least_height
from .outfit import TIER, Fitting, Outfit
from .solids import make_box, make_loft, make_prism, make_rod

__all__ = ["Fitting", "Outfitted", "make_fittings"]

SHORTEST = 15.0
"""[m] Least length over all of a ship with fittings."""
GEARED = 210.0
"""[m] Length from which bulk carriers have no cranes of their own."""


@dataclass(frozen=True, eq=False)
class Outfitted:
    """Fittings, and the mast that bears the light aft or amidships."""

    fittings: tuple[Fitting, ...]
    mast: Mast


def make_fittings(deck: WeatherDeck, type_name: str, name: str) -> Outfitted:
    """The fittings of a ship of a type; cargo is stowed at random, by the ship's name."""
    outfit = Outfit(deck)
    random = np.random.default_rng(crc32(name.encode()))
    mast = Mast(*_ARRANGEMENTS.get(type_name, _arrange_cargo_vessel)(outfit, random))
    return Outfitted(tuple(outfit.fittings), mast)


Random = np.random.Generator


def _arrange_cargo_vessel(outfit: Outfit, random: Random) -> tuple[float, float]:
    deck, L = outfit.deck, outfit.deck.length
    place = _build_house(outfit, deck.aft + 0.045 * L, _tiers(deck, 4, 5))
    fit_hatches(outfit, deck.aft + 0.165 * L, deck.forecastle - 0.03 * L, has_cranes=GEARED > L > 60.0)
    _fit_forecastle(outfit)
    outfit.rails(deck.aft + 0.01 * L, deck.forecastle - 0.02 * L)
    return place


def _arrange_container_ship(outfit: Outfit, random: Random) -> tuple[float, float]:
    deck, L = outfit.deck, outfit.deck.length
    tiers = 3 if deck.breadth < 24.0 else 5 if deck.breadth < 40.0 else 7
    u = min(1.0, deck.breadth / 20.0)
    house = deck.aft + (0.205 if L > 140.0 else 0.05) * L
    place = _build_house(outfit, house, _tiers(deck, tiers + 2, tiers + 2), length=0.42 * deck.breadth)
    fore = house + 0.42 * deck.breadth + 2.5 * u
    stow_containers(outfit, fore, deck.forecastle - 0.012 * L, tiers, random)
    stow_containers(outfit, deck.aft + 0.03 * L, house - 0.26 * deck.breadth - 2.0 * u, tiers - 1, random)
    _fit_forecastle(outfit)
    outfit.rails(deck.aft + 0.01 * L, deck.forecastle - 0.02 * L)
    return place


def _arrange_tanker(outfit: Outfit, random: Random) -> tuple[float, float]:
    deck, L = outfit.deck, outfit.deck.length
    place = _build_house(outfit, deck.aft + 0.05 * L, _tiers(deck, 5, 6))
    fit_tank_deck(outfit, deck.aft + 0.17 * L, deck.fore - 0.11 * L)
    _fit_forecastle(outfit)
    outfit.rails(deck.aft + 0.01 * L, deck.fore - 0.08 * L)
    return place


def _arrange_gas_carrier(outfit: Outfit, random: Random) -> tuple[float, float]:
    """Spherical tanks, of which the upper halves show, with a trunk between them."""
    deck, L, B = outfit.deck, outfit.deck.length, outfit.deck.breadth
    place = _build_house(outfit, deck.aft + 0.045 * L, _tiers(deck, 6, 7))
    aft, fore, count = deck.aft + 0.17 * L, deck.fore - 0.13 * L, 4
    pitch = (fore - aft) / count
    for i in range(count):
        x = aft + (i + 0.5) * pitch
        radius = min(0.46 * pitch, 0.44 * B, 0.92 * deck.half_breadth(x - 0.4 * pitch, x + 0.4 * pitch))
        angle = 2.0 * np.pi * np.arange(24) / 24
        ring = np.column_stack([np.cos(angle), np.sin(angle)])
        for a, b in zip(np.radians(range(0, 90, 15)), np.radians(range(15, 105, 15)), strict=True):
            lower, upper = (x, 0.0) + radius * np.cos(a) * ring, (x, 0.0) + radius * max(np.cos(b), 0.02) * ring
            outfit.add("house", make_loft(lower, deck.z - radius * np.sin(a), upper, deck.z - radius * np.sin(b)))
    u = outfit.deck.unit
    outfit.box("trim", (aft, fore - 0.5 * pitch), (-1.2 * u, 1.2 * u), (deck.z - 0.44 * B, deck.z - 0.40 * B))
    _fit_forecastle(outfit)
    outfit.rails(deck.aft + 0.01 * L, deck.fore - 0.08 * L)
    return place


def _arrange_ferry(outfit: Outfit, random: Random) -> tuple[float, float]:
    """White decks over most of the length with windows and boats, a bridge forward, a funnel aft."""
    deck, L, B = outfit.deck, outfit.deck.length, outfit.deck.breadth
    u, t = deck.unit, TIER * deck.unit
    z, aft, fore = deck.z, deck.aft + 0.03 * L, deck.fore - 0.13 * L
    count = max(2, min(6 if B > 24.0 else 4, round(0.5 * B / t)))
    for i in range(count):
        plan = deck.plan(aft + 0.018 * i * L, fore - 0.022 * i * L, inset=0.25 * u)
        if i == 1 and B > 9.0:
            plan = deck.plan(aft + 0.018 * L, fore - 0.022 * L, inset=2.6 * u)
        z = outfit.tier(plan, z, t, pitch=2.2)
        if i == 0:
            z_boats = z
    if B > 9.0:
        for x in np.linspace(deck.aft + 0.25 * L, deck.aft + 0.60 * L, max(2, round(0.35 * L / (13.0 * u)))):
            outfit.boat(float(x), deck.half_breadth(float(x), float(x)) - 1.35 * u, z_boats - 0.4 * u, 8.0 * u)
    front = fore - 0.022 * count * L
    wing = (front - 0.045 * L, front - 0.045 * L + 4.0 * u)
    half = deck.half_breadth(*wing)
    outfit.box("house", wing, (-half, half), (z - 0.95 * u, z))
    top = outfit.band(deck.plan(front - 0.10 * L, front, inset=2.2 * u), z, 1.05 * t)
    outfit.pair(
        "windows",
        (wing[0] + 0.3 * u, wing[1] + 0.03 * u),
        (half - 2.4 * u, half - 0.1 * u),
        (z - 2.0 * u, z - 0.95 * u),
    )
    outfit.pair("house", wing, (half - 2.5 * u, half), (z - 2.3 * u, z - 2.0 * u))
    funnel = (aft + 0.16 * L, aft + 0.16 * L + 0.45 * B)
    outfit.box("house", (funnel[0] - 0.04 * L, funnel[1] + 0.10 * L), (-0.26 * B, 0.26 * B), (z - 0.8 * t, z))
    outfit.funnel(funnel, 0.15 * B, z - 0.8 * t, 2.9 * t)
    mast = front - 0.06 * L
    outfit.mast(mast, top, 9.0 * u, is_radar=True)
    outfit.mast(funnel[1] + 0.06 * L, z - 0.8 * t, 12.0 * u)
    _fit_forecastle(outfit)
    return (funnel[1] + 0.06 * L, z - 0.8 * t - 12.0 * u) if L >= 50.0 else (mast, top - 9.0 * u)


def _arrange_car_carrier(outfit: Outfit, random: Random) -> tuple[float, float]:
    """A box over the whole length without windows but for a bridge forward, a ramp on the stern."""
    deck, L, B = outfit.deck, outfit.deck.length, outfit.deck.breadth
    u, t = deck.unit, TIER * deck.unit
    aft, fore = deck.aft + 0.004 * L, deck.fore - 0.07 * L
    outfit.add("house", make_prism(deck.plan(aft, fore, inset=0.06 * u), (deck.z - 2.4 * t, deck.z)))
    z = outfit.tier(deck.plan(aft + 0.05 * L, fore - 0.02 * L, inset=2.5 * u), deck.z - 2.4 * t, t)
    half = deck.half_breadth(fore - 0.12 * L, fore - 0.05 * L)
    top = outfit.band(deck.plan(fore - 0.12 * L, fore - 0.04 * L, half=half), z, 1.1 * t)
    for x in np.linspace(aft + 0.1 * L, fore - 0.16 * L, max(3, round(0.6 * L / (16.0 * u)))):
        outfit.pair("trim", (float(x) - 0.8 * u, float(x) + 0.8 * u), (0.30 * B, 0.36 * B), (z - 1.4 * u, z))
    outfit.funnel((aft + 0.10 * L, aft + 0.10 * L + 0.3 * B), 0.12 * B, z, 2.6 * t)
    outfit.mast(fore - 0.09 * L, top, 8.0 * u, is_radar=True)
    outfit.mast(aft + 0.3 * L, z, 12.0 * u)
    _fit_forecastle(outfit)
    return (aft + 0.3 * L, z - 12.0 * u) if L >= 50.0 else (fore - 0.09 * L, top - 8.0 * u)


def _arrange_tug(outfit: Outfit, random: Random) -> tuple[float, float]:
    """The house forward with a wheelhouse that looks all round, two funnels, a winch and a towing gear aft, fenders."""
    deck, L, B = outfit.deck, outfit.deck.length, outfit.deck.breadth
    u, t, z = deck.unit, TIER * deck.unit, deck.z
    aft, fore = deck.fore - 0.60 * L, deck.fore - 0.20 * L
    half = 0.74 * deck.half_breadth(aft, fore)
    low = outfit.tier(deck.plan(aft, fore, half=half), z, t + 0.07 * B, pitch=2.0)
    back, front = fore - 0.25 * L, fore - 0.01 * L
    second = outfit.tier(deck.plan(back, front, half=0.85 * half), low, 0.85 * t, pitch=1.9) if L > 22.0 else low
    bridge = deck.plan(front - 0.15 * L, front - 0.01 * L, half=0.66 * half)
    top = outfit.band(bridge, second, 1.05 * t, glass=(0.28, 0.86))
    for side in (-1.0, 1.0):
        outfit.funnel((aft + 0.02 * L, aft + 0.08 * L), 0.14 * half, low, 1.7 * t, y=side * 0.72 * half)
    mast = front - 0.11 * L
    outfit.mast(mast, top, max(0.55 * B, 4.0 * u), is_radar=True)
    outfit.box("trim", (aft - 0.13 * L, aft - 0.05 * L), (-0.32 * half, 0.32 * half), (z - 0.55 * t, z))
    outfit.add(
        "crane",
        make_rod((aft - 0.09 * L, -0.30 * half, z - 0.5 * t), (aft - 0.09 * L, 0.30 * half, z - 0.5 * t), 0.28 * t, 10),
    )
    gear = aft - 0.22 * L
    for side in (-1.0, 1.0):
        outfit.rod("crane", (gear, side * 0.4 * half, z), (gear, side * 0.3 * half, z - 0.8 * t), 0.10 * t)
    outfit.rod("crane", (gear, -0.33 * half, z - 0.8 * t), (gear, 0.33 * half, z - 0.8 * t), 0.10 * t)
    if L > 40.0:
        outfit.boat(aft + 0.14 * L, half - 0.4 * u, low - 0.5 * u, 5.0 * u)
    return mast, top - max(0.55 * B, 4.0 * u)


def _arrange_naval_ship(outfit: Outfit, random: Random) -> tuple[float, float, float, float]:
    """Blocks with sloping sides, a gun before them, a pyramid mast, a funnel, a hangar and a flight deck."""
    deck, L, B = outfit.deck, outfit.deck.length, outfit.deck.breadth
    u, t, z = deck.unit, TIER * deck.unit, deck.z

    def block(aft: float, fore: float, half: float, low: float, tiers: float, slope: float = 0.16) -> float:
        high = low - tiers * t
        by = slope * tiers * t
        outfit.add(
            "grey", make_loft(_oblong(aft, fore, half), low, _oblong(aft + 0.6 * by, fore - by, half - by), high)
        )
        return high

    middle = 0.5 * (deck.aft + deck.fore)
    half = 0.9 * deck.half_breadth(middle - 0.25 * L, middle + 0.16 * L)
    first = block(middle - 0.24 * L, middle + 0.16 * L, half, z, 1.0)
    front = block(middle + 0.01 * L, middle + 0.14 * L, 0.84 * half, first, 1.5)
    slope = 0.16 * 1.5 * t
    x = (middle + 0.06 * L, middle + 0.14 * L - 0.75 * slope)
    outfit.add("windows", make_prism(_oblong(*x, 0.84 * half - 0.72 * slope), (front + 0.25 * t, front + 0.6 * t)))
    top = block(middle + 0.045 * L, middle + 0.085 * L, 0.34 * half, front, 3.2, slope=0.08)
    back = block(middle - 0.235 * L, middle - 0.10 * L, 0.86 * half, first, 1.3)
    outfit.box(
        "trim", (middle - 0.237 * L, middle - 0.233 * L), (-0.4 * half, 0.4 * half), (first - 1.0 * t, z - 0.1 * t)
    )
    funnel = (middle - 0.07 * L, middle - 0.015 * L)
    high, run = first - 2.6 * t, funnel[1] - funnel[0]
    foot, head = _oblong(*funnel, 0.5 * half), _oblong(funnel[0] + 0.10 * run, funnel[1] - 0.28 * run, 0.32 * half)
    for part, low, up in (("grey", 0.0, 0.5), ("livery", 0.5, 0.8), ("grey", 0.8, 1.0)):
        plans = [foot + share * (head - foot) for share in (low, up)]
        outfit.add(part, make_loft(plans[0], first + low * (high - first), plans[1], first + up * (high - first)))
    outfit.box(
        "funnel-top",
        (funnel[0] + 0.18 * run, funnel[1] - 0.36 * run),
        (-0.26 * half, 0.26 * half),
        (high - 0.4 * t, high),
    )
    higher = z - find_least_height(L, B) - 3.5  # than the fore light, which stands on the front of the pyramid
    mast_top = min(back - 2.4 * t, higher) if L >= 50.0 else back - 2.4 * t
    for x0, low, high in ((middle + 0.065 * L, top, top - 2.4 * t), (middle - 0.16 * L, back, mast_top)):
        outfit.rod("mast", (x0, 0.0, low), (x0, 0.0, high), 0.22 * u)
        outfit.box("mast", (x0 - 0.1 * u, x0 + 0.1 * u), (-2.0 * u, 2.0 * u), (low - 1.3 * t, low - 1.2 * t))
    outfit.box("trim", (middle + 0.05 * L, middle + 0.055 * L), (-1.8 * u, 1.8 * u), (front - 2.2 * t, front - 1.9 * t))
    gun = middle + 0.27 * L
    mount = min(0.11 * B, 0.7 * deck.half_breadth(gun, gun + 0.05 * L))
    outfit.add(
        "grey",
        make_loft(
            _oblong(gun - 0.02 * L, gun + 0.018 * L, mount),
            z,
            _oblong(gun - 0.014 * L, gun + 0.002 * L, 0.6 * mount),
            z - 0.95 * t,
        ),
    )
    outfit.rod("grey", (gun + 0.005 * L, 0.0, z - 0.55 * t), (gun + 0.055 * L, 0.0, z - 0.78 * t), 0.10 * t)
    outfit.rails(deck.aft + 0.01 * L, deck.aft + 0.22 * L)
    return middle - 0.16 * L, mast_top, middle + 0.088 * L, middle + 0.04 * L


def _leave_bare(outfit: Outfit, random: Random) -> tuple[float, float]:
    deck = outfit.deck
    return deck.aft + 0.4 * deck.length, deck.z - 0.5 * deck.breadth


def _tiers(deck: WeatherDeck, least: int, most: int) -> int:
    """Tiers of a house: `most` on a ship of full size, fewer on a small one."""
    return int(np.clip(round(deck.breadth / (4.4 * deck.unit)), 2, least if deck.breadth < 28.0 else most))


def _oblong(aft: float, fore: float, half: float) -> np.ndarray:
    return np.array([(fore, half), (aft, half), (aft, -half), (fore, -half)])


def _build_house(outfit: Outfit, aft: float, tiers: int, length: float = 0.0) -> tuple[float, float]:
    """The house of a cargo ship: tiers, bridge with wings, funnel behind it, boats, radar mast; mast and its top."""
    deck, u, t = outfit.deck, outfit.deck.unit, TIER * outfit.deck.unit
    B, z = deck.breadth, deck.z
    length = length or max(0.045 * deck.length, 0.36 * B)
    casing = aft + 0.24 * B
    aft, fore = (casing, casing + length) if length < 0.42 * B else (aft, aft + length)
    half = min(0.43 * B, 0.88 * deck.half_breadth(aft, fore))
    widths = [half if i < 2 else 0.86 * half for i in range(tiers)]
    top = z
    for i, width in enumerate(widths):
        back = aft + (0.0 if i < 2 else 0.10 * length)
        top = outfit.tier(_oblong(back, fore, width), top, t)
    wing, inner = deck.half_breadth(aft, fore), 0.62 * half
    wings = (fore - 4.2 * u, fore - 0.2 * u)
    outfit.box("house", wings, (-wing, wing), (top - 0.22 * u, top))
    outfit.box("house", (wings[1] - 0.15 * u, wings[1]), (-wing, wing), (top - 1.25 * u, top - 0.2 * u))
    outfit.pair("house", wings, (wing - 0.15 * u, wing), (top - 1.25 * u, top - 0.2 * u))
    outfit.box("house", (wings[0], wings[0] + 0.15 * u), (-wing, wing), (top - 1.25 * u, top - 0.2 * u))
    house = outfit.band(_oblong(max(aft, fore - 0.75 * length), fore + 0.3 * u, inner), top, 1.08 * t)
    outfit.mast(fore - 0.35 * length, house, 8.5 * u, is_radar=True)
    funnel = (aft - 0.23 * B, aft - 0.02 * B)
    outfit.box("house", (funnel[0] - 0.01 * B, aft), (-0.24 * B, 0.24 * B), (z - 0.42 * tiers * t, z))
    outfit.funnel(funnel, 0.11 * B, z - 0.42 * tiers * t, (0.62 * tiers + 0.9) * t)
    if B > 9.0:
        outfit.boat(
            aft + 0.35 * length, min(half + 0.9 * u, deck.half_breadth(aft, fore) - 1.4 * u), z - 1.6 * t, 7.5 * u
        )
    return fore - 0.35 * length, house - 8.5 * u


def _fit_forecastle(outfit: Outfit) -> None:
    """A foremast, windlasses, a breakwater."""
    deck, L, u = outfit.deck, outfit.deck.length, outfit.deck.unit
    x = deck.fore - 0.06 * L
    z = max(deck.height(x), deck.height(x - 0.03 * L))
    height = float(np.clip(deck.breadth, 6.0, 12.0)) * u if L >= 20.0 else 0.6 * deck.breadth
    if L >= 50.0:
        outfit.mast(x, min(z, deck.z), height - (deck.z - z) + 0.3)
    half = 0.55 * deck.half_breadth(x - 0.02 * L, x - 0.01 * L)
    for y in (-0.5, 0.5):
        outfit.box(
            "trim", (x - 2.4 * u, x - 1.0 * u), (y * half - 0.35 * half, y * half + 0.35 * half), (z - 1.1 * u, z)
        )
    outfit.add("trim", make_box((x + 0.018 * L, x + 0.018 * L + 0.8 * u), (-0.3 * u, 0.3 * u), (z - 0.7 * u, z)))


_ARRANGEMENTS: dict[str, Callable[[Outfit, Random], tuple[float, ...]]] = {
    "container ship, loaded": _arrange_container_ship, "cargo vessel, container on deck": _arrange_container_ship,
    "tanker, loaded": _arrange_tanker, "tanker, in ballast": _arrange_tanker,
    "liquefied natural gas tanker": _arrange_gas_carrier, "ferry": _arrange_ferry, "passenger liner": _arrange_ferry,
    "car carrier": _arrange_car_carrier, "tug": _arrange_tug, "offshore supply vessel": _arrange_tug,
    "diving support vessel": _arrange_tug, "fishing vessel": _arrange_tug, "research vessel": _arrange_tug,
    "tender": _arrange_tug, "destroyer": _arrange_naval_ship, "speed boat": _leave_bare,
}  # fmt: skip
"""By type of ship (ship/ship_type.py); bulk carriers and cargo vessels have hatches."""
