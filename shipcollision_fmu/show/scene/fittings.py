"""Fittings on a ship's deck, which distinguish bow from stern and a tanker from a container ship in pictures.

They follow from main dimensions and kind, as far as they fit on the deck. Contact ignores them, and they are no ship's
real arrangement. Hulls from mesh files, boxes (barges, logs, buoys) and ships shorter than SHORTEST have none.

    house      of the crew, aft, with a bridge over the full breadth     funnel    behind it
    mast       on the forecastle and on the house                        hatches   bulk carriers and others
    stacks     containers                                                pipes     along a tanker's deck
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .run_folder import ShipBody
from .surface import Surface

__all__ = ["Fitting", "make_fittings"]

SHORTEST = 30.0
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
    aft = deck.aft + 0.06 * L
    fittings = [*_make_house(deck, aft, L, B), *_make_mast(deck, L, B)]
    hold_aft, hold_fore = aft + 0.10 * L, deck.fore - 0.13 * L
    kind = body.kind.lower()
    if "container" in kind:
        return (*fittings, *_make_stacks(deck, hold_aft, hold_fore, B))
    if "tanker" in kind:
        return (*fittings, *_make_pipes(deck, hold_aft, hold_fore, B))
    return (*fittings, *_make_hatches(deck, hold_aft, hold_fore, B))


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
