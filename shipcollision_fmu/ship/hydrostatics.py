"""Hydrostatics of a hull of which L, B, T and C_b are given.

    C_w  = (1 + 2 C_b)/3                      A_wp = C_w L B            V = C_b L B T
    KB   = T/3 (5/2 - C_b/C_w)                KG   = T - z_g            z_g: CG below the waterline
    BM_T = I_T/V,  I_T = k B^3 L/12,  k = 6 C_w^3/((1 + C_w)(1 + 2 C_w))
    BM_L = I_L/V,  I_L = C_w^2 B L^3/12
    GM   = KB + BM - KG

C_w waterplane coefficient, A_wp waterplane area [m2], V displaced volume [m3], KB and KG centres of buoyancy and
gravity above the keel [m], I second moments of the waterplane area [m4], GM metacentric heights [m].

The formulas are those of the vessel osv in Fossen's Marine Systems Simulator; I_L has C_w^2 in the place of its
constant 0.7, which is the same for C_w = 0.84. A given GM replaces the estimate: KG is rarely published, and GM_T is
the small difference of two large numbers.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["GRAVITY", "Hydrostatics", "compute_hydrostatics"]

GRAVITY = 9.80665
"""Standard gravity [m/s2]."""


@dataclass(frozen=True)
class Hydrostatics:
    """Waterplane area [m2], displaced volume [m3], metacentric radii and heights [m]."""

    A_wp: float
    volume: float
    BM_T: float
    BM_L: float
    GM_T: float
    GM_L: float


def compute_hydrostatics(
    L: float, B: float, T: float, C_b: float, z_g: float, *, GM_T: float | None = None, GM_L: float | None = None
) -> Hydrostatics:
    """Hydrostatics of a hull [m] with CG z_g below the waterline; a GM that is given is kept."""
    C_w = (1.0 + 2.0 * C_b) / 3.0
    volume = C_b * L * B * T
    k = 6.0 * C_w**3 / ((1.0 + C_w) * (1.0 + 2.0 * C_w))
    BM_T = k * B**3 * L / 12.0 / volume
    BM_L = C_w**2 * B * L**3 / 12.0 / volume
    KB = T / 3.0 * (2.5 - C_b / C_w)
    KG = T - z_g
    return Hydrostatics(
        A_wp=C_w * L * B, volume=volume, BM_T=BM_T, BM_L=BM_L,
        GM_T=KB + BM_T - KG if GM_T is None else GM_T, GM_L=KB + BM_L - KG if GM_L is None else GM_L,
    )  # fmt: skip
