"""The wind on the ship above the water. Blendermann (1994), J. Wind Eng. Ind. Aerodyn. 51:339-351.

    X = -1/2 rho_a V^2 A_Fw C_Dl cos(gamma)/c         K = kappa s_H Y
    Y = -1/2 rho_a V^2 A_Lw C_Dt sin(gamma)/c         N = (s_L - 0.18 (|gamma| - pi/2) L_oa) Y
    c = 1 - delta/2 (1 - C_Dl A_Fw/(A_Lw C_Dt)) sin^2(2 gamma)

V [m/s] and gamma: speed and direction of the wind relative to the ship; gamma = 0 from ahead, positive from starboard.
C_Dl is that of the wind from ahead or from astern. s_L forward of midship and s_H above the water [m]: centroid of the
lateral area A_Lw. The formulas hold about midship at the waterline, which is CO. Air has the density of 15 degrees
Celsius at sea level.

In a calm, wind speed 0, there is no force at all: the still air's drag, two or three percent of the resistance, is
taken to be in R_0.
"""

from __future__ import annotations

from math import atan2, hypot, pi

from ..ship.windage import Windage

__all__ = ["WindForces"]

RHO_AIR = 1.225
"""[kg/m3]"""


class WindForces:
    """(X, Y, K, N) of one ship."""

    def __init__(self, windage: Windage, L_oa: float) -> None:
        w = windage
        self._X_bow, self._X_stern = 0.5 * RHO_AIR * w.A_Fw * w.C_Dl_bow, 0.5 * RHO_AIR * w.A_Fw * w.C_Dl_stern
        self._Y = 0.5 * RHO_AIR * w.A_Lw * w.C_Dt
        self._delta = w.delta
        self._s_K = w.kappa * w.s_H
        self._s_L, self._L = w.s_L, L_oa

    def __call__(self, u: float, v: float) -> tuple[float, float, float, float]:
        """X, Y [N] and K, N [N m] about CO, at the ship's velocity u, v [m/s] relative to the air."""
        V = hypot(u, v)
        if V == 0.0:
            return 0.0, 0.0, 0.0, 0.0
        along = self._X_bow if u >= 0.0 else self._X_stern
        sin_cos = u / V * (v / V)
        c = 1.0 - 2.0 * self._delta * (1.0 - along / self._Y) * sin_cos * sin_cos
        Y = -self._Y * V * v / c
        gamma = atan2(abs(v), u)
        return -along * V * u / c, Y, self._s_K * Y, (self._s_L - 0.18 * (gamma - 0.5 * pi) * self._L) * Y
