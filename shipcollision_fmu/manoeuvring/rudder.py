"""The rudder behind the propeller, and what it does to the hull.

    X_R = -(1 - t_R) F_N sin(delta)                              Yasukawa & Yoshimura (2015)
    Y_R = -(1 + a_H) F_N cos(delta)
    N_R = -(x_R + a_H x_H) F_N cos(delta)
    F_N = 1/2 rho A_R U_R^2 f_alpha sin(alpha_R),   alpha_R = delta - atan2(v_R, u_R),   U_R = hypot(u_R, v_R)
    v_R = U gamma_R beta_R,   beta_R = beta - l_R' r',   gamma_R by the sign of beta_R
    u_R = epsilon sqrt( eta (u_P + kappa (sqrt(u_P^2 + 8 T/(pi rho D_P^2)) - u_P))^2 + (1 - eta) u_P^2 )
    eta = D_P/H_R,   T = rho n^2 D_P^4 K_T

With sin(alpha_R) written out, F_N = 1/2 rho A_R f_alpha U_R (u_R sin(delta) - v_R cos(delta)): no angle of the inflow
is needed, and with u_R < 0, in flow from astern, the force turns round by itself. The paper's sqrt(1 + 8 K_T/(pi J^2))
is multiplied out in the same way, finite at u = 0. Astern (u_P < 0) the race is added to the flow with its sign.

delta positive to starboard turns the ship to starboard. v_R takes beta = atan2(-v, |u|), as the propeller's wake does.
"""

from __future__ import annotations

from math import copysign, cos, hypot, pi, sin, sqrt

from ..ship.ship import Ship
from ..ship.tables.manoeuvring import PropellerTable, RudderTable

__all__ = ["Rudder"]


class Rudder:
    """(X, Y, N) of one rudder."""

    def __init__(self, ship: Ship, table: RudderTable, propeller: PropellerTable) -> None:
        L = ship.L_pp
        self._normal = 0.5 * ship.rho * table.A_R * table.f_alpha
        self._x = 1.0 - table.t_R
        self._y = 1.0 + table.a_H
        self.a_H = table.a_H
        self._n = (table.x_R + table.a_H * table.x_H) * L
        self._l_R = table.l_R * L
        self._gamma_plus, self._gamma_minus = table.gamma_R_plus, table.gamma_R_minus
        self._epsilon, self._kappa = table.epsilon, table.kappa
        self._eta = min(1.0, propeller.D_p / table.H_R)
        self._race = 8.0 / (pi * ship.rho * propeller.D_p**2)

    def __call__(
        self, U: float, beta: float, r: float, u_P: float, thrust: float, delta: float
    ) -> tuple[float, float, float]:
        """X, Y [N] and N [N m] about midship, in b, at the angle delta [rad] in the race of `thrust` [N]."""
        U_beta_R = U * beta - self._l_R * r
        v_R = U_beta_R * (self._gamma_minus if U_beta_R < 0.0 else self._gamma_plus)
        speed = abs(u_P)
        raced = sqrt(max(0.0, u_P * u_P + self._race * thrust))  # far behind the propeller
        in_race = u_P + self._kappa * (raced - speed)
        squared = self._eta * in_race * abs(in_race) + (1.0 - self._eta) * u_P * speed
        u_R = copysign(self._epsilon * sqrt(abs(squared)), squared)
        sin_delta, cos_delta = sin(delta), cos(delta)
        F_N = self._normal * hypot(u_R, v_R) * (u_R * sin_delta - v_R * cos_delta)
        return -self._x * F_N * sin_delta, -self._y * F_N * cos_delta, -self._n * F_N * cos_delta
