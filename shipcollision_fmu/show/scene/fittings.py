"""Fittings on a ship's deck, which distinguish bow from stern and a tanker from a container ship in pictures.

They follow from main dimensions and type, as far as they fit on the deck. Contact ignores them, and they are no ship's
real arrangement. Hulls from mesh files, boxes (barges, logs, buoys) and ships shorter than SHORTEST have none.

    house      of the crew, with a bridge over the full breadth          funnel    behind it
    mast       on the forecastle and on the house                        hatches   bulk carriers and cargo vessels
    stacks     containers                                                pipes     along a tanker's deck
    decks      of ferries, passenger ships and car carriers              gun       of naval ships
    winch      on the working deck of tugs and supply vessels, whose house stands forward
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...ship.ship_type import find_ship_type
from .run_folder import ShipBody
from .surface import Surface

__all__ = ["Fitting", "make_fittings"]

SHORTEST = 15.0
"""[m] Least length over all of a ship with fittings."""
_BOX = np.array([
    (0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2),
    (1, 3, 7), (1, 7, 5),
])  # fmt: skip


@dataclass(frozen=True, eq=False)
class Fitting:
    """A fitting in the ship's b: the name of its part ("house", "funnel", ...) and its surface."""

    part: str
    surface: Surface


def make_fittings(body: ShipBody, hull: Surface) -> tuple[Fitting, ...]:
    """The fittings of a ship with that hull; none for hulls that are not a ship's."""
    if body.shape != "parametric" or body.L_oa < SHORTEST:
        return ()
    deck = _Deck(hull)
    L, B = deck.fore - deck.aft, body.B
    return tuple(_ARRANGEMENTS.get(find_ship_type(body.kind).name, _arrange_cargo_vessel)(deck, L, B))


def _arrange_cargo_vessel(deck: _Deck, L: float, B: float) -> list[Fitting]:
    return [
        *_make_house(deck, deck.aft + 0.06 * L, L, B),
        *_make_mast(deck, L, B),
        *_make_hatches(deck, *_hold(deck, L), B),
    ]


def _arrange_container_ship(deck: _Deck, L: float, B: float) -> list[Fitting]:
    return [
        *_make_house(deck, deck.aft + 0.06 * L, L, B),
        *_make_mast(deck, L, B),
        *_make_stacks(deck, *_hold(deck, L), B),
    ]


def _arrange_tanker(deck: _Deck, L: float, B: float) -> list[Fitting]:
    return [
        *_make_house(deck, deck.aft + 0.06 * L, L, B),
        *_make_mast(deck, L, B),
        *_make_pipes(deck, *_hold(deck, L), B),
    ]


def _arrange_ferry(deck: _Deck, L: float, B: float) -> list[Fitting]:
    """Decks over most of the length, each shorter than the one below, with windows; a bridge forward, a funnel aft."""
    found, z, height = [], deck.z, 0.11 * B
    aft, fore = deck.aft + 0.05 * L, deck.fore - 0.22 * L
    for tier in range(3):
        x = (aft + 0.03 * tier * L, fore - 0.04 * tier * L)
        half = 0.94 * deck.half_breadth(*x)
        found += [
            _make_box("house", x, (-half, half), (z - 0.45 * height, z)),
            _make_box("windows", x, (-0.99 * half, 0.99 * half), (z - 0.7 * height, z - 0.45 * height)),
            _make_box("house", x, (-half, half), (z - height, z - 0.7 * height)),
        ]
        z -= height
    bridge, wing = (fore - 0.16 * L, fore - 0.09 * L), deck.half_breadth(aft, fore)
    funnel = (aft + 0.10 * L, aft + 0.16 * L)
    return [
        *found,
        _make_box("house", bridge, (-wing, wing), (z - 0.8 * height, z)),
        _make_box("windows", bridge, (-0.99 * wing, 0.99 * wing), (z - 1.1 * height, z - 0.8 * height)),
        _make_box("house", bridge, (-wing, wing), (z - 1.2 * height, z - 1.1 * height)),
        _make_box("funnel", funnel, (-0.14 * B, 0.14 * B), (z - 2.2 * height, z)),
        *_make_mast(deck, L, B),
    ]


def _arrange_tug(deck: _Deck, L: float, B: float) -> list[Fitting]:
    """A house forward with the bridge on it, a funnel behind it, a working deck with a winch aft."""
    aft, fore, z = deck.fore - 0.55 * L, deck.fore - 0.22 * L, deck.z
    half = 0.7 * deck.half_breadth(aft, fore)
    bridge, funnel, winch = (fore - 0.16 * L, fore - 0.02 * L), (aft, aft + 0.05 * L), (aft - 0.14 * L, aft - 0.05 * L)
    return [
        _make_box("house", (aft, fore), (-half, half), (z - 0.28 * B, z)),
        _make_box("windows", bridge, (-0.7 * half, 0.7 * half), (z - 0.44 * B, z - 0.36 * B)),
        _make_box("house", bridge, (-0.72 * half, 0.72 * half), (z - 0.46 * B, z - 0.44 * B)),
        _make_box("house", bridge, (-0.7 * half, 0.7 * half), (z - 0.36 * B, z - 0.28 * B)),
        _make_box("funnel", funnel, (-0.5 * half, -0.2 * half), (z - 0.50 * B, z - 0.28 * B)),
        _make_box("funnel", funnel, (0.2 * half, 0.5 * half), (z - 0.50 * B, z - 0.28 * B)),
        _make_box("mast", (fore - 0.10 * L, fore - 0.08 * L), (-0.02 * B, 0.02 * B), (z - 0.80 * B, z - 0.46 * B)),
        _make_box("pipe", winch, (-0.3 * half, 0.3 * half), (z - 0.12 * B, z)),
    ]


def _arrange_naval_ship(deck: _Deck, L: float, B: float) -> list[Fitting]:
    """A gun, two blocks amidships with masts and funnel, and a free deck aft."""
    z, middle = deck.z, 0.5 * (deck.aft + deck.fore)
    front, back = (middle + 0.02 * L, middle + 0.20 * L), (middle - 0.24 * L, middle - 0.04 * L)
    half = 0.75 * min(deck.half_breadth(*front), deck.half_breadth(*back))
    gun = middle + 0.28 * L
    mount = min(0.14 * B, 0.8 * deck.half_breadth(gun, gun + 0.06 * L))
    return [
        _make_box("house", (gun, gun + 0.03 * L), (-mount, mount), (z - 0.16 * B, z)),
        _make_box("mast", (gun + 0.03 * L, gun + 0.07 * L), (-0.012 * B, 0.012 * B), (z - 0.13 * B, z - 0.10 * B)),
        _make_box("house", front, (-half, half), (z - 0.35 * B, z)),
        _make_box("windows", (middle + 0.12 * L, front[1] - 0.005 * L), (-half, half), (z - 0.43 * B, z - 0.35 * B)),
        _make_box("mast", (middle + 0.07 * L, middle + 0.09 * L), (-0.05 * B, 0.05 * B), (z - 1.15 * B, z - 0.35 * B)),
        _make_box("house", back, (-half, half), (z - 0.30 * B, z)),
        _make_box(
            "funnel", (middle - 0.14 * L, middle - 0.08 * L), (-0.16 * B, 0.16 * B), (z - 0.65 * B, z - 0.30 * B)
        ),
    ]


def _hold(deck: _Deck, L: float) -> tuple[float, float]:
    """After and fore end of the cargo deck [m], with the house aft."""
    return deck.aft + 0.16 * L, deck.fore - 0.13 * L


class _Deck:
    """The deck: its height z [m] and its breadth."""

    def __init__(self, hull: Surface) -> None:
        self.z = float(hull.vertices[:, 2].min())
        self._edge = hull.vertices[hull.vertices[:, 2] < self.z + 0.01, :2]
        self._edge = self._edge[self._edge[:, 1] > -1e-9]
        self._edge = self._edge[np.argsort(self._edge[:, 0])]
        self.aft, self.fore = float(self._edge[0, 0]), float(self._edge[-1, 0])

    def half_breadth(self, x0: float, x1: float) -> float:
        """Least half breadth between x0 and x1 [m]: at the ends, for the deck is convex."""
        return min(float(np.interp(x, *self._edge.T)) for x in (x0, x1))


def _make_box(part: str, x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]) -> Fitting:
    """A box from (x0, y0, z0) to (x1, y1, z1), z0 < z1."""
    corners = np.array([(a, b, c) for c in z for b in y for a in x])
    return Fitting(part, Surface(corners, _BOX))


def _make_house(deck: _Deck, aft: float, L: float, B: float) -> list[Fitting]:
    """Deckhouse, bridge, funnel and a mast, on [aft, aft + 0.09 L]."""
    fore = aft + 0.075 * L
    half, height, z = 0.82 * deck.half_breadth(aft, fore), 0.42 * B, deck.z
    wing, inner = min(0.5 * B, 1.15 * half), 0.8 * half
    bridge, top = (fore - 0.035 * L, fore + 0.005 * L), [z - share * height for share in (1.0, 1.07, 1.13, 1.18)]
    funnel, mast = (aft + 0.004 * L, aft + 0.02 * L), (fore - 0.02 * L, fore - 0.017 * L)
    return [
        _make_box("house", (aft + 0.025 * L, fore), (-half, half), (top[0], z)),
        _make_box("house", (aft, aft + 0.025 * L), (-0.6 * half, 0.6 * half), (z - 0.5 * height, z)),
        _make_box("house", bridge, (-wing, wing), (top[1], top[0])),
        _make_box("windows", bridge, (-inner, inner), (top[2], top[1])),
        _make_box("house", bridge, (-inner, inner), (top[3], top[2])),
        _make_box("funnel", funnel, (-0.22 * half, 0.22 * half), (z - 1.2 * height, z - 0.5 * height)),
        _make_box("mast", mast, (-0.012 * B, 0.012 * B), (z - 1.55 * height, top[3])),
    ]


def _make_mast(deck: _Deck, L: float, B: float) -> list[Fitting]:
    x, thick = deck.fore - 0.05 * L, 0.012 * B
    return [_make_box("mast", (x - thick, x + thick), (-thick, thick), (deck.z - 0.35 * B, deck.z))]


def _make_hatches(deck: _Deck, aft: float, fore: float, B: float) -> list[Fitting]:
    count = max(3, round((fore - aft) / B))
    pitch = (fore - aft) / count
    found = []
    for i in range(count):
        x = (aft + (i + 0.14) * pitch, aft + (i + 0.86) * pitch)
        half = min(0.32 * B, 0.8 * deck.half_breadth(*x))
        found.append(_make_box("hatch", x, (-half, half), (deck.z - 0.045 * B, deck.z)))
    return found


def _make_stacks(deck: _Deck, aft: float, fore: float, B: float) -> list[Fitting]:
    """Bays of blocks of containers, of uneven height."""
    bay, row, tier = max(0.055 * (fore - aft), 0.4 * B), 0.19 * B, 0.075 * B
    count = int((fore - aft) / bay)
    found = []
    for i in range(count):
        x = (aft + i * bay, aft + (i + 0.92) * bay)
        half = min(0.48 * B, 0.95 * deck.half_breadth(*x))
        rows = int(2 * half / row)
        for j in range(rows):
            y = (-0.5 * rows + j) * row
            tiers = 2 + (3 * i + 5 * j + i * j) % 3 - (i == count - 1)
            for k in range(tiers):
                z = deck.z - k * tier
                colour = "abcd"[(7 * i + 3 * j + 5 * k + i * k) % 4]
                found.append(_make_box(f"container-{colour}", x, (y, y + 0.97 * row), (z - 0.97 * tier, z)))
    return found


def _make_pipes(deck: _Deck, aft: float, fore: float, B: float) -> list[Fitting]:
    """Pipes along the middle, the manifold across it, and the edge of the tank deck."""
    thick, z, middle = 0.02 * B, deck.z, 0.5 * (aft + fore)
    along = [
        _make_box("pipe", (aft, fore), (y * B - 0.5 * thick, y * B + 0.5 * thick), (z - 3 * thick, z - 2 * thick))
        for y in (-0.07, -0.035, 0.0, 0.035, 0.07)
    ]
    across = [
        _make_box("pipe", (x, x + thick), (-0.4 * B, 0.4 * B), (z - 2 * thick, z - thick))
        for x in (middle - 0.15 * B, middle, middle + 0.15 * B)
    ]
    crane = _make_box("mast", (middle - 0.5 * thick, middle + 0.5 * thick), (0.16 * B, 0.18 * B), (z - 0.4 * B, z))
    return [*along, *across, crane]


def _leave_bare(deck: _Deck, L: float, B: float) -> list[Fitting]:
    return []


_ARRANGEMENTS: dict[str, Callable[[_Deck, float, float], list[Fitting]]] = {
    "container ship, loaded": _arrange_container_ship, "cargo vessel, container on deck": _arrange_container_ship,
    "tanker, loaded": _arrange_tanker, "tanker, in ballast": _arrange_tanker,
    "liquefied natural gas tanker": _arrange_tanker, "ferry": _arrange_ferry, "passenger liner": _arrange_ferry,
    "car carrier": _arrange_ferry, "tug": _arrange_tug, "offshore supply vessel": _arrange_tug,
    "diving support vessel": _arrange_tug, "fishing vessel": _arrange_tug, "research vessel": _arrange_tug,
    "tender": _arrange_tug, "destroyer": _arrange_naval_ship, "speed boat": _leave_bare,
}  # fmt: skip
"""By type of ship (ship/ship_type.py); bulk carriers and cargo vessels have hatches."""
