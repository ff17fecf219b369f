"""Navigation lights of a power-driven vessel under way: COLREG rules 21 to 23 and annex I.

    masthead    white, 225 deg, ahead to 22.5 deg abaft the beam on both sides; a second one from 50 m length
    side        green on starboard, red on port, 112.5 deg each, from ahead to 22.5 deg abaft the beam
    stern       white, 135 deg, from astern to 67.5 deg on each side

Heights, annex I 2: the fore masthead light is 6 m above the hull, or the breadth where this is more, at most 12 m; the
after one 4.5 m higher. Sidelights are lower than three quarters of the fore one. Distance of the masthead lights, annex
I 3: half the length, at most 100 m needed; the fore one is within a quarter of the length from the stem. Ships shorter
than 12 m have lower ones. Warships carry them where their masts are, as nearly as possible: rule 1(e).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...ship.frames import Array

__all__ = ["Light", "Mast", "find_least_height", "place_lights"]

WHITE, GREEN, RED = "#fff4dc", "#21ff5f", "#ff2a1f"
"""Colours (sRGB) within the boundaries of annex I 7, as bright as a screen can."""
ABAFT_BEAM = 112.5
"""[deg] Bearing at which sidelights and masthead lights end: 22.5 deg abaft the beam. Rule 21."""


@dataclass(frozen=True, eq=False)
class Light:
    """A light: kind, colour (sRGB), place in b (3,) [m], sector [deg] clockwise from ahead, range [nautical miles]."""

    kind: str
    colour: str
    point: Array
    start: float
    end: float
    range: float

    @property
    def arc(self) -> float:
        """Breadth of the sector [deg]."""
        return self.end - self.start

    @property
    def direction(self) -> Array:
        """Middle of the sector, a unit vector in b (3,)."""
        middle = np.radians(0.5 * (self.start + self.end))
        return np.array([np.cos(middle), np.sin(middle), 0.0])

    def is_seen_from(self, point: Array) -> bool:
        """Whether a point in b (3,) lies in the sector."""
        north, east = (point - self.point)[:2]
        bearing = float(np.degrees(np.arctan2(east, north)))
        return (bearing - self.start) % 360.0 <= self.arc


class Mast(NamedTuple):
    """What bears the light aft or amidships: station and z of its top [m]; a warship's foremast, and the station of its
    sidelights."""

    x: float
    top: float
    foremast: float | None = None
    side: float | None = None


def find_least_height(L: float, B: float) -> float:
    """Least height of the fore masthead light above the hull [m]. Annex I 2(a)."""
    return float(np.clip(B, 6.0, 12.0)) if L >= 20.0 else max(1.5, 0.6 * B) if L >= 5.0 else 0.6 * B


def place_lights(L: float, fore: float, aft: float, B: float, z_deck: float, mast: Mast) -> list[Light]:
    """The lights of a ship of length L [m] between the stations aft and fore, with its deck at z_deck."""
    height, z_house = find_least_height(L, B), mast.top
    masthead, other = (6.0, 3.0) if L >= 50.0 else (5.0 if L >= 20.0 else 3.0, 2.0)
    lights = []
    if L >= 50.0:
        front = fore - 0.06 * L if mast.foremast is None else mast.foremast
        z_front = z_deck - height
        back = min(mast.x, front - min(0.5 * L, 100.0)) if mast.foremast is None else mast.x
        lights.append(_masthead("masthead fore", front, z_front, masthead))
        lights.append(_masthead("masthead aft", back, min(z_front - 4.5, z_house - 1.0), masthead))
        side = min(mast.x, front)
    else:
        side = min(mast.x, fore - 0.1 * L)
        z_front = min(z_deck - height, z_house - 0.5)
        lights.append(_masthead("masthead", side, z_front, masthead))
    z_side = z_deck + max(0.72 * (z_front - z_deck), -0.9 * abs(z_house - z_deck) if z_house < z_deck else -1.0)
    if mast.side is not None:
        side, z_side = mast.side, z_deck - 0.55 * height
    half = 0.5 * B
    lights += [
        Light("starboard", GREEN, np.array([side, half, z_side]), 0.0, ABAFT_BEAM, other),
        Light("port", RED, np.array([side, -half, z_side]), -ABAFT_BEAM, 0.0, other),
        Light("stern", WHITE, np.array([aft, 0.0, z_deck - 0.25 * height]), ABAFT_BEAM, 360.0 - ABAFT_BEAM, other),
    ]
    return lights


def _masthead(kind: str, x: float, z: float, range_: float) -> Light:
    return Light(kind, WHITE, np.array([x, 0.0, z]), -ABAFT_BEAM, ABAFT_BEAM, range_)
