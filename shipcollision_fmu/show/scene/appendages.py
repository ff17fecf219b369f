"""Rudders and propellers under the counter, within the hull that touches; anchors in their pockets at the bow."""

from __future__ import annotations

import itertools

import numpy as np

from .hull_lines import UnderwaterLines
from .solids import join_surfaces, make_box, make_faces, make_loft, make_rod
from .surface import Surface

__all__ = ["make_anchors", "make_propellers", "make_rudders"]

BLADES = 4
SPREAD = 0.17
"""Distance of the outer propellers of a pair from the centre plane, over B."""


def make_rudders(lines: UnderwaterLines, breadth: float, count: int) -> Surface:
    """A rudder behind each propeller, from below the counter almost to the keel."""
    T, L = lines.rings.z_keel, lines.length
    chord = min(0.022 * L, 0.6 * T)
    fore = lines.aft + 0.005 * L + chord
    thick = 0.09 * chord
    rudders = []
    for y in _list_shafts(breadth, count):
        plan = np.array([
            (fore, 0.5 * thick), (fore - 0.25 * chord, thick), (fore - chord, 0.1 * thick),
            (fore - chord, -0.1 * thick), (fore - 0.25 * chord, -thick), (fore, -0.5 * thick),
        ]) + [0.0, y]  # fmt: skip
        rudders.append(make_loft(plan, 0.95 * T if count == 1 else 0.86 * T, plan, 0.16 * T))
    return join_surfaces(rudders)


def make_propellers(lines: UnderwaterLines, breadth: float, count: int) -> Surface:
    """Propellers with blades turned by 35 deg, hubs, and the shafts of a pair."""
    T, L = lines.rings.z_keel, lines.length
    radius = 0.5 * min(0.62 * T, 0.055 * L) if count == 1 else 0.22 * T
    x, z = lines.post - 0.004 * L, 0.60 * T if count == 1 else 0.66 * T
    x = max(x, lines.aft + 0.005 * L + min(0.022 * L, 0.6 * T) + 0.25 * radius)
    found = []
    for y in _list_shafts(breadth, count):
        found.append(make_rod((x - 0.28 * radius, y, z), (x + 0.30 * radius, y, z), 0.18 * radius, 8))
        if count > 1:
            found.append(make_rod((x, y, z), (lines.aft + 0.17 * L, y, 0.60 * T), 0.09 * radius))
        for blade in range(BLADES):
            angle = 2.0 * np.pi * blade / BLADES + 0.4
            out = np.array([0.0, np.cos(angle), np.sin(angle)])
            across = np.array([0.0, -np.sin(angle), np.cos(angle)])
            ahead = np.array([1.0, 0.0, 0.0])
            corners = []
            for reach, chord, pitch in ((0.15, 0.16, 60.0), (0.62, 0.34, 38.0), (0.97, 0.20, 26.0)):
                along = np.cos(np.radians(pitch)) * across + np.sin(np.radians(pitch)) * ahead
                middle = np.array([x, y, z]) + reach * radius * out
                corners.append((middle - chord * radius * along, middle + chord * radius * along))
            faces = np.array([[a[0], a[1], b[1], b[0]] for a, b in itertools.pairwise(corners)])
            found.append(make_faces(np.concatenate([faces, faces[:, ::-1]])))
    return join_surfaces(found)


def _list_shafts(breadth: float, count: int) -> list[float]:
    return [0.0] if count == 1 else [-SPREAD * breadth, SPREAD * breadth]


def make_anchors(lines: UnderwaterLines, z: float, size: float) -> Surface:
    """A dark pocket on both bows at a height z [m]."""
    x = float(lines.rings.at(z)[0, 0]) - 0.028 * lines.length
    y = float(lines.rings.half_breadth(x, z))
    one = make_box((x - 0.4 * size, x + 0.4 * size), (y - 0.5 * size, y + 0.03), (z - 0.5 * size, z + 0.5 * size))
    return join_surfaces(
        [one, make_box((x - 0.4 * size, x + 0.4 * size), (-y - 0.03, 0.5 * size - y), (z - 0.5 * size, z + 0.5 * size))]
    )
