"""Added masses in surge, sway and yaw of any hull, from L, B, T and C_b: Zhou's regressions of the Motora charts.

    100 m_x/m   = 0.398 + 11.97 C_b (1 + 3.73 T/B) - 2.89 C_b L/B (1 + 1.13 T/B)
                  + 0.175 C_b (L/B)^2 (1 + 0.541 T/B) - 1.107 L T/B^2
    m_y/m       = 0.882 - 0.54 C_b (1 - 1.6 T/B) - 0.156 L/B (1 - 0.673 C_b)
                  + 0.826 L T/B^2 (1 - 0.678 T/B) - 0.638 C_b L T/B^2 (1 - 0.669 T/B)
    100 k_J/L   = 33 - 76.85 C_b (1 - 0.784 C_b) + 3.43 L/B (1 - 0.63 C_b)          J_z = m k_J^2, about midship

Motora (1959, 1960), measured on models without forward speed; Zhou, Sheng & Feng (1983), the regressions. A hull
outside the range of the charts gets the fractions of the nearest hull inside: far outside, the regressions turn
negative.
"""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["Dimensions", "estimate_added_mass"]

RANGE = {"L/B": (2.0, 10.0), "T/B": (0.1, 0.6), "C_b": (0.4, 0.9)}
"""Hulls for which the regressions give plausible values. Beyond it m_x and m_y fall below zero."""

LEAST_m_x = 0.01
"""Least m_x/m. The regression falls through zero for fine, slender hulls; a spheroid of L/B 10 has 0.02 (Lamb 1932)."""


class Dimensions(NamedTuple):
    """L_pp, B, T [m], C_b, CG forward of midship [m], water density [kg/m3]."""

    L: float
    B: float
    T: float
    C_b: float
    x_G: float
    rho: float


def estimate_added_mass(d: Dimensions) -> tuple[float, float, float]:
    """m_x/m, m_y/m, and J_z/(m L^2)."""
    LB, TB, C_b = _limit("L/B", d.L / d.B), _limit("T/B", d.T / d.B), _limit("C_b", d.C_b)
    s = TB * LB
    m_x = 0.01 * (
        0.398
        + 11.97 * C_b * (1.0 + 3.73 * TB)
        - 2.89 * C_b * LB * (1.0 + 1.13 * TB)
        + 0.175 * C_b * LB**2 * (1.0 + 0.541 * TB)
        - 1.107 * LB * TB
    )
    m_y = (
        0.882
        - 0.54 * C_b * (1.0 - 1.6 * TB)
        - 0.156 * LB * (1.0 - 0.673 * C_b)
        + 0.826 * s * (1.0 - 0.678 * TB)
        - 0.638 * C_b * s * (1.0 - 0.669 * TB)
    )
    k_J = 0.01 * (33.0 - 76.85 * C_b * (1.0 - 0.784 * C_b) + 3.43 * LB * (1.0 - 0.63 * C_b))
    return max(m_x, LEAST_m_x), m_y, k_J**2


def _limit(name: str, value: float) -> float:
    least, most = RANGE[name]
    return min(most, max(least, value))
