"""Where one stands on the bridge of a ship: in the wheelhouse that the fittings have, or where a ship may have one.

wheelhouse   the highest fitting with windows; the eye is behind its front, half-way up the glass
wings        reach the ship's side, which has to be seen from there (SOLAS V/22.1.6)
without      ships without fittings: a quarter of the length from the stern, EYE above the deck
"""

from __future__ import annotations

import numpy as np

from .scene import Ship

__all__ = ["find_wheelhouse"]

BEHIND = 0.8
"""[m] Distance of the eye from the front of the glass. Nearer, the frames of the windows are cut by the near plane."""
EYE = 2.5
"""[m] Height of the eye above the deck of a ship without wheelhouse."""


def find_wheelhouse(ship: Ship) -> tuple[float, float, float]:
    """The eye on the bridge in the ship's b [m]: (x, distance of a wing's end from the centreline, z)."""
    windows = [fitting.surface.vertices for fitting in ship.fittings if fitting.part == "windows"]
    wing = 0.5 * ship.B
    if not windows:
        hull = ship.hull.vertices
        stern, stem = float(hull[:, 0].min()), float(hull[:, 0].max())
        return stern + 0.25 * (stem - stern), wing, float(hull[:, 2].min()) - EYE
    glass = min(windows, key=lambda vertices: float(vertices[:, 2].min()))
    front, z = float(glass[:, 0].max()), 0.5 * float(np.ptp(glass[:, 2])) + float(glass[:, 2].min())
    depth = float(np.ptp(glass[:, 0]))
    return front - min(BEHIND, 0.5 * depth), wing, z
