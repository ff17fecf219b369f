"""Torque of a propeller from its thrust and pitch.

    Q = P/(2 pi) T + rho D^3 (a x^2 + b x u_P)      x = n D, T thrust [N], P pitch [m]; a, b only for x > 0

P/(2 pi) T is the torque of a screw that turns without slip, and of one whose blades bear a pressure normal to their
faces, as stalled blades do. What is missing ahead is the friction of the blades and the slip: a and b make Q that of
the Wageningen B4-70 propeller of the same pitch on the spot and where it has no thrust left. Between them it is within
6 % of the regression of Oosterveld and van Oossanen (1975), Int. Shipbuilding Progress 22 (tests). Turning astern the
first term stands alone: no torque of the series in that quadrant was found.
"""

from __future__ import annotations

from bisect import bisect_left
from functools import lru_cache
from math import pi
from typing import NamedTuple

__all__ = ["TorqueLaw", "find_idle_advance", "make_torque_law"]

SPOT = (
    (0.6, 0.2500, 0.02481), (0.7, 0.3021, 0.03333), (0.8, 0.3542, 0.04336), (0.9, 0.4054, 0.05480),
    (1.0, 0.4547, 0.06754), (1.1, 0.5016, 0.08143), (1.2, 0.5455, 0.09631),
)  # fmt: skip
"""P/D, K_T and K_Q of B4-70 on the spot, from the regression of Oosterveld and van Oossanen (1975)."""

K_Q_IDLE = (0.00472, 0.0011)
"""K_Q of B4-70 without thrust, at P/D = 0.6 and its rise with P/D; from the same regression."""


class TorqueLaw(NamedTuple):
    """P/(2 pi D), a and b of a propeller."""

    arm: float
    a: float
    b: float

    def compute(self, thrust: float, u_P: float, x: float) -> float:
        """Q/(rho D^3) [m2/s2] from T/(rho D^2) [m2/s2], u_P and x = n D [m/s]."""
        loss = (self.a * x + self.b * max(0.0, u_P)) * x if x > 0.0 else 0.0
        return self.arm * thrust + loss


@lru_cache(maxsize=64)
def make_torque_law(k_0: float, k_1: float, k_2: float) -> TorqueLaw:
    """The law of a propeller with K_T = k_0 + k_1 J + k_2 J^2; its pitch is that of the series with the same k_0."""
    k = max(1, min(len(SPOT) - 1, bisect_left([row[1] for row in SPOT], k_0)))
    (low, T_low, Q_low), (high, T_high, Q_high) = SPOT[k - 1], SPOT[k]
    share = (k_0 - T_low) / (T_high - T_low)
    pitch, within = low + share * (high - low), min(1.0, max(0.0, share))
    pitch = min(SPOT[-1][0], max(SPOT[0][0], pitch))
    spot = (Q_low + within * (Q_high - Q_low)) * k_0 / (T_low + within * (T_high - T_low))
    arm = pitch / (2.0 * pi)
    a = spot - arm * k_0
    idle = K_Q_IDLE[0] + K_Q_IDLE[1] * (pitch - 0.6)
    advance = find_idle_advance(k_0, k_1, k_2)
    return TorqueLaw(arm, a, (idle - a) / advance if advance else 0.0)


def find_idle_advance(k_0: float, k_1: float, k_2: float) -> float:
    """The least J above 0 at which K_T comes to zero; 0 when it never does."""
    root = k_1 * k_1 - 4.0 * k_0 * k_2
    falls = -k_1 + root**0.5 if root >= 0.0 else 0.0
    return 2.0 * k_0 / falls if falls > 0.0 else 0.0
