"""Kinetic energy lost to contact, split along and across the normal.

With v- and v+ the relative velocities at a contact before and after all impulses of an instant,

    lost = -sum over contacts of P . (v- + v+)/2 = T(nu-) - T(nu+),        T of ship/kinetic_energy.py [J]

an identity for any impulses, so the split into the normal and the tangential part adds up to the whole.
"""

from __future__ import annotations

import numpy as np

from ...ship.frames import Array

__all__ = ["energy_lost"]


def energy_lost(P: Array, normal: Array, before: Array, after: Array) -> tuple[float, float]:
    """Energy [J] lost at one contact, (along the normal, across it); before, after: relative velocity (3,) in n."""
    mean = 0.5 * (before + after)
    P_n, v_n = float(P @ normal), float(mean @ normal)
    along = -P_n * v_n
    return along, -float(np.dot(P, mean)) - along
