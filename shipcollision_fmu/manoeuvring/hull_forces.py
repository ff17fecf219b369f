"""Forces of the water on the bare hull in surge, sway and yaw.

At moderate drift, the polynomials of the MMG standard model (Yasukawa & Yoshimura 2015), about midship:

    X_H = 1/2 rho L d   U^2 ( -R_0 + X_vv v'^2 + X_vr v' r' + X_rr r'^2 + X_vvvv v'^4 )
    Y_H = 1/2 rho L d   U^2 ( Y_v v' + Y_r r' + Y_vvv v'^3 + Y_vvr v'^2 r' + Y_vrr v' r'^2 + Y_rrr r'^3 )
    N_H = 1/2 rho L^2 d U^2 ( N_v v' + N_r r' + N_vvv v'^3 + N_vvr v'^2 r' + N_vrr v' r'^2 + N_rrr r'^3 )

    v' = v/U    r' = r L/U    U = hypot(u, v)    beta = atan2(-v, u)    u, v relative to the water [m/s], r [rad/s]

After an impact a ship may move sideways, astern, or spin on the spot. The polynomials were fitted to |beta| <= 20 deg
or so and mean nothing there (X_vvvv would push the ship ahead). Beyond, the forces are those of the unified model for
ocean and harbour manoeuvring (Yoshimura, Nakao & Ishibashi 2009, MARSIM): the linear terms, with u in the place of U so
that they turn round when the ship moves astern, and the drag of the cross flow on each section:

    X = 1/2 rho L d   ( -R_0 u |u| + min(X_vr, -m_y/2) v r L )
    Y = 1/2 rho L d   ( Y_v |u| v + Y_r u r L - C_D <w |w|> )            w = v + x r, mean over the length
    N = 1/2 rho L^2 d ( N_v u v + N_r |u| r L - C_D C_N <(x/L) w |w|> )

The limit of X_vr is that of the early MMG models, X_vr = (C_m - 1) m_y with C_m 0.5 to 0.75 (Hasegawa 1980): where
the flow has left the hull, half of the sway added mass m_y at most keeps up with the turn. C_N is a number of the ship,
as C_rN is in the unified model: with it, both sets damp yawing alike in the middle of the hand-over. With C_N = 1, a
ship whose N_vvr is large loses half of its damping as its drift grows, and winds itself up into a spin:

    C_N = ( N_r (cos(beta) - 1) - N_vvr sin^2(beta) ) / ( C_D sin(beta)/6 )          beta = 35 deg, 1 <= C_N <= 2.5

The share of the second set rises smoothly from 0 to 1 over |beta| = 25 to 45 deg, or over 40 to 60 deg of
gamma = atan2(|r| L/2, |u|), the angle of the flow at the ship's ends, whichever is more. An ordinary turn stays below.
Both sets are bounded multiples of the squared velocities, so nothing grows as U goes to 0. Neither gives the ship
energy: with the rate (m_y - m_x) u v r that the equations of motion leave to N_v, X u + Y v + N r is never above zero.
"""

from __future__ import annotations

from math import atan2, cos, hypot, radians, sin, tan

from ..ship.ship import Ship
from ..ship.tables.manoeuvring import ManoeuvringTable

__all__ = ["HullForces", "integrate_cross_flow"]

C_D = 1.0
"""Drag coefficient of a full section in cross flow, related to L d. KVLCC2's polynomial of Y gives 0.89 at 30 deg of
drift and 1.02 at 35 deg; a value far from it makes the sway force fall as the drift grows through the hand-over."""

BETA = (radians(25.0), radians(45.0))
"""Drift angle at which the cross flow begins to count, and beyond which it alone does [rad]. Steady turns must stay
below: with R/L = 0.9 the rule beta = 22.5 L/R + 1.45 deg (Principles of Naval Architecture III, 1989) gives 26 deg.
From 20 deg on, as once, full ships were half handed over in an ordinary turn."""

GAMMA = (radians(40.0), radians(60.0))
"""The same for the angle of the flow at the ship's ends; a 35 deg rudder turn of a full ship reaches about 30 deg."""

C_N = (1.0, 2.5)
"""Bounds of C_N: the pure cross flow, and somewhat above the 2.2 of KCS, the largest of a measured set. More would
damp a spin on the spot beyond any measurement."""

C_M = 0.5
"""C_m, see above: with 1, ships of very low resistance lose their way in a hard turn and end in a spin."""


_STEEPEST, _QUICKEST = tan(BETA[0]) * (1.0 - 1e-9), tan(GAMMA[0]) * (1.0 - 1e-9)
"""|v|/u and |r| L/(2 u) below which the cross flow does not count: says the same as the angles, and sooner."""


class HullForces:
    """(X, Y, N) of one hull."""

    def __init__(self, ship: Ship, table: ManoeuvringTable) -> None:
        self._L, self._half_L = ship.L_pp, 0.5 * ship.L_pp
        self._force = 0.5 * ship.rho * ship.L_pp * ship.T  # times velocity^2 is a force [N]
        self._moment = self._force * ship.L_pp
        self._X = (table.R_0, table.X_vv, table.X_vr, table.X_rr, table.X_vvvv)
        self._Y = (table.Y_v, table.Y_r, table.Y_vvv, table.Y_vvr, table.Y_vrr, table.Y_rrr)
        self._N = (table.N_v, table.N_r, table.N_vvv, table.N_vvr, table.N_vrr, table.N_rrr)
        m_y = float(ship.M_A[1, 1]) / (self._force * ship.L_pp)
        self._X_vr_beyond = min(table.X_vr, (C_M - 1.0) * m_y)
        self._yaw_drag = C_D * _match_yaw_damping(table.N_r, table.N_vvr)

    def __call__(self, u: float, v: float, r: float) -> tuple[float, float, float]:
        """X, Y [N] and N [N m] about midship, in b, at velocities relative to the water."""
        share = 0.0
        s = self._half_L * r
        if not (abs(v) < _STEEPEST * u and abs(s) < _QUICKEST * u):
            share = _find_cross_flow_share(u, v, s)
            if share == 1.0:
                return self._compute_cross_flow(u, v, r)
        U = hypot(u, v)  # with a share below 1, U > 0 and |r'| < 3.5, or all is at rest
        if U == 0.0:
            return 0.0, 0.0, 0.0
        v_1, r_1 = v / U, r * self._L / U
        vv, vr, rr = v_1 * v_1, v_1 * r_1, r_1 * r_1
        R_0, X_vv, X_vr, X_rr, X_vvvv = self._X
        Y_v, Y_r, Y_vvv, Y_vvr, Y_vrr, Y_rrr = self._Y
        N_v, N_r, N_vvv, N_vvr, N_vrr, N_rrr = self._N
        X = -R_0 + X_vv * vv + X_vr * vr + X_rr * rr + X_vvvv * vv * vv
        Y = Y_v * v_1 + Y_r * r_1 + Y_vvv * vv * v_1 + Y_vvr * vv * r_1 + Y_vrr * v_1 * rr + Y_rrr * rr * r_1
        N = N_v * v_1 + N_r * r_1 + N_vvv * vv * v_1 + N_vvr * vv * r_1 + N_vrr * v_1 * rr + N_rrr * rr * r_1
        UU = U * U
        X, Y, N = self._force * UU * X, self._force * UU * Y, self._moment * UU * N
        if share == 0.0:
            return X, Y, N
        X_b, Y_b, N_b = self._compute_cross_flow(u, v, r)
        return X + share * (X_b - X), Y + share * (Y_b - Y), N + share * (N_b - N)

    def _compute_cross_flow(self, u: float, v: float, r: float) -> tuple[float, float, float]:
        """Linear terms and cross-flow drag."""
        rL = r * self._L
        drag, drag_moment = integrate_cross_flow(v, 0.5 * rL)
        X = -self._X[0] * u * abs(u) + self._X_vr_beyond * v * rL
        Y = self._Y[0] * abs(u) * v + self._Y[1] * u * rL - C_D * drag
        N = self._N[0] * u * v + self._N[1] * abs(u) * rL - self._yaw_drag * drag_moment
        return self._force * X, self._force * Y, self._moment * N


def integrate_cross_flow(v: float, s: float) -> tuple[float, float]:
    """Means of w|w| and of (x/L) w|w| over the length, w = v + s xi, xi = 2x/L from -1 to 1 [m2/s2].

    Exact integrals; s = r L/2 is the sway speed that yawing gives the ship's ends.
    """
    a, b = abs(v), abs(s)
    if a >= b:  # the flow comes from one side all along the ship
        one = 1.0 if v > 0.0 else -1.0
        return one * (v * v + s * s / 3.0), a * s / 3.0
    one = 1.0 if s > 0.0 else -1.0
    return v * (b + v * v / (3.0 * b)), one * (s * s / 8.0 + v * v / 4.0 - v * v * (v / s) * (v / s) / 24.0)


def _match_yaw_damping(N_r: float, N_vvr: float) -> float:
    """C_N: the yaw damping of the polynomials over that of the cross flow, in the middle of the hand-over."""
    beta = 0.5 * (BETA[0] + BETA[1])
    matched = (N_r * (cos(beta) - 1.0) - N_vvr * sin(beta) ** 2) / (C_D * sin(beta) / 6.0)
    return min(max(matched, C_N[0]), C_N[1])


def _find_cross_flow_share(u: float, v: float, s: float) -> float:
    """0: the polynomials hold; 1: cross flow alone; smooth between."""
    beta = abs(atan2(v, u))
    gamma = atan2(abs(s), abs(u))
    if beta <= BETA[0] and gamma <= GAMMA[0]:
        return 0.0
    x = max((beta - BETA[0]) / (BETA[1] - BETA[0]), (gamma - GAMMA[0]) / (GAMMA[1] - GAMMA[0]))
    return 1.0 if x >= 1.0 else x * x * (3.0 - 2.0 * x)
