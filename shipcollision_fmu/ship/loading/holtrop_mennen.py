"""Resistance of a ship in calm deep water from L, B, T and C_b: Holtrop and Mennen (1982), Holtrop (1984).

    R   = 1/2 rho U^2 S (C_F (1 + k_1) + C_A) + R_W
    C_F = 0.075/(log10(Re) - 2)^2 (ITTC-57)      C_A = 0.006 (L + 100)^-0.16 - 0.00205 (ship and roughness)
    1 + k_1 = 0.93 + 0.487118 (B/L)^1.06806 (T/L)^0.46106 (L/L_R)^0.121563 (L^3/V)^0.36486 (1 - C_P)^-0.604247
    S   = L (2 T + B) sqrt(C_M) (0.453 + 0.4425 C_b - 0.2862 C_M - 0.003467 B/T + 0.3696 C_W)
          + 2.38 A_BT/C_b
    R_W = c_1 c_2 V rho g exp(m_1 Fn^-0.9 + m_4 cos(lam Fn^-2))

V displaced volume [m3], C_P = C_b/C_M, L_R = L (1 - C_P), Re = U L/nu, Fn = U/sqrt(g L). The centre of buoyancy is
taken amidships, C_W = (1 + 2 C_b)/3, C_M = 1.006 - 0.0056 C_b^-3.56 (Kerlen 1970). Ships of 80 m and more have a bulb
of a tenth of the midship section, c_2 = exp(-1.89 sqrt(c_3)). Transom and appendages are left out.

J. Holtrop and G. G. J. Mennen, An approximate power prediction method, Int. Shipbuilding Progress 29 (1982) 166-170;
J. Holtrop, A statistical re-analysis of resistance and propulsion data, Int. Shipbuilding Progress 31 (1984) 272-276.
Known from public implementations that agree. The regression has hulls of C_P 0.55 to 0.85, L/B 3.9 to 15 and B/T 2.1 to
4; beyond, the values of its edge are taken (in m_1, L/T of both edges), and the wave resistance coefficient of Fn = 0.4
above that speed.
"""

from __future__ import annotations

from math import cos, exp, log10, pow, sqrt
from typing import NamedTuple

from ..hydrostatics import GRAVITY
from .motora_charts import Dimensions

__all__ = [
    "NU_WATER",
    "HullForm",
    "compute_form_factor",
    "compute_resistance",
    "compute_wave_resistance",
    "compute_wetted_surface",
    "estimate_form",
]

NU_WATER = 1.19e-6
"""Kinematic viscosity of sea water at 15 degrees Celsius [m2/s]."""

BULB_LENGTH, BULB = 80.0, 0.1
"""[m], and section of the bulb over B T: without it a container ship needs a tenth more power."""

PRISMATIC = (0.55, 0.85)
LEAST_SLENDERNESS = 3.0
"""L/B, a little below the regression's 3.9: its exponentials run away for tubs."""

MOST_LENGTH = 60.0
"""L/T, that of L/B = 15 with B/T = 4 in the regression: beyond, the waves of a pontoon need any power, or overflow."""

FASTEST = 0.4
"""Fn of the wave resistance coefficient at most: above it a ship planes, or is no ship of this kind."""


class HullForm(NamedTuple):
    """L, B, T [m], V [m3], C_M, C_W, centre of buoyancy forward of midship [% of L]; section [m2] and height [m] of the
    bulb."""

    L: float
    B: float
    T: float
    volume: float
    C_M: float
    C_W: float
    lcb: float = 0.0
    A_BT: float = 0.0
    h_B: float = 0.0

    @property
    def C_P(self) -> float:
        """Prismatic coefficient, within the regression's range."""
        C_P = self.volume / (self.C_M * self.L * self.B * self.T)
        return min(PRISMATIC[1], max(PRISMATIC[0], C_P))

    @property
    def run(self) -> float:
        """Length of the run L_R [m]."""
        C_P = self.C_P
        return self.L * (1.0 - C_P + 0.06 * C_P * self.lcb / (4.0 * C_P - 1.0))


def estimate_form(d: Dimensions) -> HullForm:
    """The form of a ship of which only the main dimensions are known."""
    C_M = 1.006 - 0.0056 * d.C_b**-3.56
    C_W = (1.0 + 2.0 * d.C_b) / 3.0
    A_BT = BULB * d.B * d.T if d.L >= BULB_LENGTH else 0.0
    return HullForm(d.L, d.B, d.T, d.C_b * d.L * d.B * d.T, C_M, C_W, A_BT=A_BT, h_B=0.5 * d.T)


def compute_resistance(form: HullForm, speed: float, rho: float) -> float:
    """Resistance [N] at a speed [m/s] above 0."""
    C_F = 0.075 / (log10(speed * form.L / NU_WATER) - 2.0) ** 2
    C_A = 0.006 * pow(form.L + 100.0, -0.16) - 0.00205
    viscous = 0.5 * rho * speed**2 * compute_wetted_surface(form) * (C_F * compute_form_factor(form) + C_A)
    return viscous + rho * GRAVITY * form.volume * compute_wave_resistance(form, speed)


def compute_wetted_surface(form: HullForm) -> float:
    """S [m2]."""
    L, B, T, volume, C_M, C_W, _lcb, A_BT, _h_B = form
    C_b = volume / (L * B * T)
    section = 0.453 + 0.4425 * C_b - 0.2862 * C_M - 0.003467 * B / T + 0.3696 * C_W
    surface: float = L * (2.0 * T + B) * sqrt(C_M) * section + 2.38 * A_BT / C_b
    return surface


def compute_form_factor(form: HullForm) -> float:
    """1 + k_1 of a normal stern."""
    BL = min(form.B / form.L, 1.0 / LEAST_SLENDERNESS)
    return 0.93 + (
        0.487118 * pow(BL, 1.06806) * pow(form.T / form.L, 0.46106) * pow(form.L / form.run, 0.121563)
        * pow(form.L**3 / form.volume, 0.36486) * pow(1.0 - form.C_P, -0.604247)
    )  # fmt: skip


def compute_wave_resistance(form: HullForm, speed: float) -> float:
    """R_W over the weight of the ship."""
    L, T, C_P, volume = form.L, form.T, form.C_P, form.volume
    B = min(form.B, L / LEAST_SLENDERNESS)
    BL, LB = B / L, L / B
    Fn = speed / sqrt(GRAVITY * L)
    F = min(Fn, FASTEST)
    c_7 = 0.229577 * pow(BL, 1.0 / 3.0) if BL < 0.11 else BL if BL < 0.25 else 0.5 - 0.0625 * LB
    c_1 = 2223105.0 * pow(c_7, 3.78613) * pow(T / B, 1.07961) * pow(90.0 - _estimate_entrance(form, B), -1.37565)
    c_16 = 8.07981 * C_P - 13.8673 * C_P**2 + 6.984388 * C_P**3 if C_P < 0.8 else 1.73014 - 0.7067 * C_P
    m_1 = 0.0140407 * min(L / T, MOST_LENGTH) - 1.75254 * pow(volume, 1.0 / 3.0) / L - 4.79323 * BL - c_16
    c_15 = min(0.0, max(-1.69385, -1.69385 + (L / pow(volume, 1.0 / 3.0) - 8.0) / 2.36))
    lam = 1.446 * C_P - 0.03 * LB if LB < 12.0 else 1.446 * C_P - 0.36
    m_4 = 0.4 * c_15 * exp(-0.034 * pow(F, -3.29))
    c_2 = 1.0
    if form.A_BT > 0.0:
        side = sqrt(form.A_BT)
        c_2 = exp(-1.89 * sqrt(0.56 * side**3 / (B * T * (0.31 * side + T - form.h_B))))
    return c_1 * c_2 * exp(m_1 * pow(F, -0.9) + m_4 * cos(lam / F**2)) * (Fn / F) ** 2


def _estimate_entrance(form: HullForm, B: float) -> float:
    """Half the angle of the waterline's entrance [deg]; B [m] within the regression's range."""
    L, C_P = form.L, form.C_P
    return 1.0 + 89.0 * exp(
        -pow(L / B, 0.80856) * pow(1.0 - min(form.C_W, 0.99), 0.30484) * pow(1.0 - C_P - 0.0225 * form.lcb, 0.6367)
        * pow(form.run / B, 0.34574) * pow(100.0 * form.volume / L**3, 0.16302)
    )  # fmt: skip
