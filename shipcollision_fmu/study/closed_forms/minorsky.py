"""Energy of a collision after Minorsky (1959): a right-angled central impact, whose oblique speed is V sin(theta).

    E = M_A M_B (V sin theta)^2 / (2 M_B + 1.43 M_A)     A strikes, B is struck; sway added mass of B 0.4 M_B

There is no friction, no turning of the ships, no place, and no added mass of the striking ship. The speed of the struck
ship ahead is without effect.

Source: Minorsky (1959), J. Ship Research 3. Secondary source: the formula is quoted as the literature on collisions has
it; the paper itself was not at hand.
"""

from __future__ import annotations

import numpy as np

from ...ship.frames import Array

__all__ = ["minorsky_energy"]

OF_TARGET, OF_OWN = 2.0, 1.43
"""As printed. 2/1.43 = 1.40 is the struck ship's mass with its sway added mass; another one moves the energy."""


def minorsky_energy(own_mass: Array, target_mass: Array, own_speed: Array, angle: Array) -> Array:
    """E [J] of displacements [kg], speed of own, which strikes [m/s], and angle between the headings [rad]."""
    across = own_speed * np.sin(angle)
    energy: Array = own_mass * target_mass * across**2 / (OF_TARGET * target_mass + OF_OWN * own_mass)
    return energy
