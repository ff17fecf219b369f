"""The propeller: inflow through the hull's wake, and thrust.

    beta_P    = beta - x_P' r'                                             Yasukawa & Yoshimura (2015)
    1 - w_P   = (1 - w_P0) (1 + (1 - exp(-C_1 |beta_P|)) (C_2 - 1))        C_2 by the sign of beta_P
    u_P       = u (1 - w_P),   J = u_P / (n D_P)
    thrust    = rho n^2 D_P^4 (k_0 + k_1 J + k_2 J^2),   X_P = (1 - t_P) thrust

Multiplied out, thrust = rho D_P^2 (k_0 (n D_P)^2 + k_1 n D_P u_P + k_2 u_P^2), so a stopped propeller (n = 0) needs no
J. Astern, the curve is mirrored, thrust(-u_P, -n) = -thrust(u_P, n), and its other terms always oppose the motion; that
is continuous in all four quadrants. It is also the limit of this model: no polynomial in J tells how a propeller that
turns astern stalls and draws air while the ship still runs ahead. With mirrored curves the ships of this project stop
within 6 to 11 lengths, where 8 to 15 are usual. `astern_factor` scales the terms with n when n < 0: take it from the
ship's own crash stop. Its default 1 is the mirrored curve.

The wake takes beta = atan2(-v, |u|): a ship that moves astern has the wake of one that moves ahead.
u, v [m/s] relative to the water, r [rad/s], n [1/s], thrust [N].
"""

from __future__ import annotations

from math import atan2, exp, hypot

from ..ship.particulars import PropellerTable
from ..ship.ship import Ship

__all__ = ["Propeller", "drift"]


def drift(u: float, v: float) -> tuple[float, float]:
    """U [m/s] and beta = atan2(-v, |u|) [rad], which propeller and rudder take."""
    return hypot(u, v), atan2(-v, abs(u))


class Propeller:
    """Inflow and thrust of one propeller."""

    def __init__(self, ship: Ship, table: PropellerTable) -> None:
        self.D_P = table.D_p
        self.remaining = 1.0 - table.t_P  # of the thrust, after the suction on the stern
        self._x_P = table.x_P * ship.L_pp
        self._through = 1.0 - table.w_P0
        self._C_1, self._plus, self._minus = table.C_1, table.C_2_plus - 1.0, table.C_2_minus - 1.0
        self._k_0, self._k_1, self._k_2 = table.k_0, table.k_1, table.k_2
        self._astern = table.astern_factor
        self.unit = ship.rho * table.D_p**2  # times velocity^2 is a thrust [N]

    def inflow(self, u: float, U: float, beta: float, r: float) -> float:
        """u_P [m/s]."""
        if U == 0.0:
            return 0.0
        beta_P = beta - self._x_P * r / U
        if beta_P > 0.0:
            return u * self._through * (1.0 + (1.0 - exp(-self._C_1 * beta_P)) * self._plus)
        return u * self._through * (1.0 + (1.0 - exp(self._C_1 * beta_P)) * self._minus)

    def thrust(self, u_P: float, n: float) -> float:
        """Open-water thrust [N] at n [1/s] in the inflow u_P."""
        nD = n * self.D_P
        if n < 0.0:
            turning = self._astern * (self._k_1 * -nD * u_P - self._k_0 * nD * nD)
            return self.unit * (turning + self._k_2 * u_P * abs(u_P))
        return self.unit * (self._k_0 * nD * abs(nD) + self._k_1 * abs(nD) * u_P + self._k_2 * u_P * abs(u_P))
