"""Natural period of roll: of the Intact Stability Code, and of a ship's own inertia and stiffness.

    T = 2 C B/sqrt(GM)    C = 0.373 + 0.023 B/T - 0.043 L/100      IMO, International Code on Intact Stability 2008
                                                                   (resolution MSC.267(85)), part A, 2.3.4
    T = 2 pi sqrt((M_44 - M_24^2/M_22)/(m g GM))                   the ship's own M, free to sway

L, B, T waterline length, breadth, draught [m]; GM metacentric height [m]; M_ij about CO [kg, kg m, kg m2]. A ship that
rolls in the water also sways, about an axis that carries no sway momentum; hence the second term.
"""

from __future__ import annotations

from math import inf, pi, sqrt

from .frames import Array
from .hydrostatics import GRAVITY

__all__ = ["compute_is_code_period", "compute_natural_period", "compute_roll_inertia"]


def compute_is_code_period(L: float, B: float, T: float, GM: float) -> float:
    """Period of roll [s] of the Intact Stability Code 2008."""
    C = 0.373 + 0.023 * B / T - 0.043 * L / 100.0
    return 2.0 * C * B / sqrt(GM)


def compute_roll_inertia(M: Array) -> float:
    """Roll inertia of a ship that is free to sway [kg m2]; M (6, 6) about CO."""
    return float(M[3, 3] - M[1, 3] ** 2 / M[1, 1])


def compute_natural_period(M: Array, mass: float, GM: float) -> float:
    """Period of small rolling [s]; infinite without stability."""
    return 2.0 * pi * sqrt(compute_roll_inertia(M) / (mass * GRAVITY * GM)) if GM > 0.0 else inf
