"""Above water the ends of the drawn hull are finer than the hull that touches: stem, flare, knuckle, transom.

All of it lies within the hull that touches. The deck's edge is the same, and so are the sides between the ends. With h
from 0 at the deck to 1 at the waterline, k the knuckle, and s from 0 where an end begins to 1 at the stem or transom:

    stem      goes back by rake r(h) s^2,  r = 1.5 h - 0.5 h^2
    flare     y = y_deck (1 - FLARE (1 - (1 - q)^2) w(s)),  q = (h - k)/(1 - k), w smooth from 0 to 1; none above k
    transom   goes forward by rake h s^2,  y = y_deck (1 - TUCK h^2 s^2)

A hull that touches with more rake or flare than this keeps its own. Below the waterline the ends go straight down,
from where hull_lines.py shapes them.
"""

from __future__ import annotations

import numpy as np

from ...ship.frames import Array
from .hull_rings import HullRings
from .ship_style import Ends

__all__ = ["BOW", "STERN", "shape_ends"]

BOW = 0.30
STERN = 0.12
"""Greatest lengths of the ends that are shaped, over the length of the deck."""
NEAR_STEM = (0.01, 0.025, 0.05, 0.08, 0.12, 0.17, 0.23, 0.35, 0.5, 0.7, 0.85, 1.0)
"""Shares of the bow's length at which it has corners beside its own: flare and bulb need them."""
LONGEST_RAKE = 0.035
"""Greatest rake of stem and transom, over the length of the deck: high sides would draw short waterlines."""
HEIGHTS = (0.0, 0.12, 0.25, 0.4, 0.6, 0.8, 1.0)
"""Levels between knuckle and waterline, over their distance."""


def shape_ends(touching: HullRings, ends: Ends) -> HullRings:
    """The rings of the drawn hull, with more levels and corners than those of the hull that touches."""
    corners = touching.edge
    L, aft, fore = float(np.ptp(corners[:, 0])), float(corners[-1, 0]), float(corners[0, 0])
    bow = fore - max(fore - BOW * L, _find_shoulder(corners))
    numbers = np.arange(len(corners), dtype=float)
    stations = [
        *(fore - share * (0.35 * L) for share in NEAR_STEM),
        *(aft + share * STERN * L for share in (0.0, 0.15, 0.3, 0.45, 0.6, 0.8, 1.0)),
    ]
    places = np.unique(np.round(np.concatenate([numbers, np.interp(-np.array(stations), -corners[:, 0], numbers)]), 9))
    z_deck = touching.z_deck
    above = z_deck * (1.0 - ends.knuckle) * (1.0 - np.array(HEIGHTS))
    heights = np.unique(np.round(np.concatenate([[z_deck], above, touching.corners[:, 0, 2]]), 9))
    deck = _pick(touching, z_deck, places)
    ahead = np.clip((deck[:, 0] - (fore - bow)) / bow, 0.0, 1.0)
    astern = np.clip((aft + STERN * L - deck[:, 0]) / (STERN * L), 0.0, 1.0)
    stem_rake, transom_rake = (
        min(-z_deck * float(np.tan(np.radians(angle))), LONGEST_RAKE * L)
        for angle in (ends.stem_rake_deg, ends.transom_rake_deg)
    )
    rings = []
    for z in heights:
        h = min(1.0, 1.0 - z / z_deck)
        q = float(np.clip((h - ends.knuckle) / (1.0 - ends.knuckle), 0.0, 1.0))
        flare = ends.flare * (1.0 - (1.0 - q) ** 2)
        x, y = _pick(touching, z, places).T
        x = np.where(ahead > 0.0, np.minimum(x, deck[:, 0] - stem_rake * (1.5 * h - 0.5 * h * h) * ahead**2), x)
        x = np.where(astern > 0.0, np.maximum(x, deck[:, 0] + transom_rake * h * astern**2), x)
        y = np.minimum(y, deck[:, 1] * (1.0 - flare * ahead**2 * (3.0 - 2.0 * ahead)))
        y = np.minimum(y, deck[:, 1] * (1.0 - ends.tuck * h * h * astern**2))
        rings.append(np.column_stack([x, y, np.full(len(x), z)]))
    return HullRings(np.array(rings))


def _find_shoulder(corners: Array) -> float:
    """Station from which the deck narrows towards the stem."""
    return float(corners[corners[:, 1] >= 0.99 * corners[:, 1].max(), 0].max())


def _pick(rings: HullRings, z: float, places: Array) -> Array:
    """Points (k, 2) of the section at a height, at places (corner number and fraction)."""
    corners = rings.at(z)
    numbers = np.arange(len(corners))
    return np.column_stack([np.interp(places, numbers, corners[:, axis]) for axis in (0, 1)])
