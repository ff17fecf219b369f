"""Under water the ends of the drawn hull are finer still: bulb, run, skeg and counter.

All of it lies within the hull that touches. Both are the same surface along the midbody. The lines start from the rings
of hull_ends.py and leave them at the depth FROM T. With x the station, y the half breadth, v from 0 there to 1 at the
keel:

    run      y = y(z) (1 - (1 - s(u)) v^(0.7 + 2.3 u)),   u = 0 at the transom, 1 at the run's end; s from SKEG to 1
    counter  abaft the stern post the hull ends at the depth T (0.16 + 0.26 u/u_post)
    stem     goes back by BULB L_oa g(v) (1 - b(v)),  g from 0 at the waterline to 1 at v = 0.3
    bulb     b(v) = sqrt(1 - ((v - 0.68)/0.27)^2), half as broad as BULB_BREADTH B, up to the stem that touches
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...ship.frames import Array
from .hull_rings import HullRings

__all__ = ["UnderwaterLines"]

FROM = 0.12
"""Depth over T from which the hulls differ: with less, waves show it, and scratches lie beside their contacts."""
RUN = 0.20
POST = 0.045
"""Lengths of the run and of the counter over L_oa."""
SKEG = 0.035
BULB = 0.022
BULB_BREADTH = 0.115
LONGEST_BULB = 0.045
"""Distance of the bulb's tip before the stem above it, over L_oa."""
ENTRANCE = 0.30
"""Share by which the entrance above the bulb is narrower than the hull that touches."""


@dataclass(frozen=True, eq=False)
class UnderwaterLines:
    """The form under water of a hull; `has_bulb` or a stem that cuts away below.

    rings     the drawn hull's, with its ends by hull_ends.py
    touching  those of the hull that touches, beyond which nothing goes
    """

    rings: HullRings
    touching: HullRings
    has_bulb: bool

    @cached_property
    def aft(self) -> float:
        """Station of the transom [m]."""
        return float(self.rings.edge[-1, 0])

    @cached_property
    def length(self) -> float:
        """Length of the deck [m]."""
        return float(self.rings.edge[0, 0]) - self.aft

    @cached_property
    def breadth(self) -> float:
        """Greatest breadth of the deck [m]."""
        return 2.0 * float(self.rings.edge[:, 1].max())

    @cached_property
    def post(self) -> float:
        """Station of the stern post [m]."""
        return self.aft + POST * self.length

    def point(self, place: float, share: float, before_post: bool) -> tuple[float, float, float]:
        """The point at a `place` along the deck's edge (corner number and fraction) and a share of the depth there."""
        T = self.rings.z_keel
        start = self._wall(place, 0.0)[0]
        u = (start - self.aft) / (RUN * self.length)
        if not before_post:
            depth = T * (0.16 + 0.26 * (start - self.aft) / (self.post - self.aft))
            x, y = self._wall(place, share * depth)
            v = max(0.0, (share * depth - FROM * T) / (depth - FROM * T))
            return x, y * (1.0 - v**2.5), share * depth
        z = share * T
        x, y = self._wall(place, z)
        v = max(0.0, (share - FROM) / (1.0 - FROM))
        if u < 1.0:
            s = SKEG + (1.0 - SKEG) * _ease(u)
            y *= 1.0 - (1.0 - s) * v ** (0.7 + 2.3 * u)
        if x > 0.0 and v > 0.0:
            x, y = self._shape_entrance(x, y, z, v)
        return x, y, z

    def _wall(self, place: float, z: float) -> tuple[float, float]:
        corners = self.rings.at(z)
        numbers = np.arange(len(corners))
        return float(np.interp(place, numbers, corners[:, 0])), float(np.interp(place, numbers, corners[:, 1]))

    def _shape_entrance(self, x: float, y: float, z: float, v: float) -> tuple[float, float]:
        """Moves a point of the bow aft and inwards, and out again onto the bulb."""
        corners = self.rings.at(z)
        stem, shoulder = float(corners[0, 0]), max(0.0, float(corners[-1, 0]) + 0.65 * self.length)
        if x <= shoulder:
            return x, y
        back = BULB * self.length
        g = _ease(v / 0.3) if self.has_bulb else 0.8 * v**1.5
        b = float(np.sqrt(max(0.0, 1.0 - ((v - 0.68) / 0.27) ** 2))) if self.has_bulb else 0.0
        line = stem - back * g
        front = line + b * (min(float(self.touching.at(z)[0, 0]), line + LONGEST_BULB * self.length) - line)
        s = (stem - x) / (stem - shoulder)
        x = front - (front - shoulder) * s
        s = max(0.0, (line - x) / (line - shoulder))
        y = self._breadth(corners, stem - (stem - shoulder) * s) * (1.0 - ENTRANCE * g * (1.0 - s) ** 2)
        if b > 0.0:
            centre = line - 0.2 * back
            ahead = min(1.0, max(0.0, (x - centre) / (front - centre)))
            bulb = 0.5 * BULB_BREADTH * self.breadth * b * float(np.sqrt(1.0 - ahead**2))
            y = min(max(y, bulb), self._breadth(self.touching.at(z), x))
        return x, y

    @staticmethod
    def _breadth(corners: Array, x: float) -> float:
        return float(np.interp(x, corners[::-1, 0], corners[::-1, 1], left=0.0, right=0.0))


def _ease(t: float) -> float:
    """From 0 at t = 0 to 1 at t = 1 without a corner."""
    t = min(1.0, max(0.0, t))
    return t * t * (3.0 - 2.0 * t)
