"""The MMG model with roll (4 degrees of freedom) and with heave, roll and pitch (6): equations of motion.

    M nu_dot + C(nu_r) nu_r = tau + M d/dt(nu_c)      nu_r = nu - nu_c       tau = hull + propeller + rudder + wind
                                                                                   + restoring + damping + external
    C(nu) nu = ( omega x P,  omega x L + v x P ),   (P, L) = M nu            Fossen (2021), chapters 3 and 6

M is the ship's whole (6, 6), about CO, in b: rigid body and added mass, with the sway added mass at its depth z_y,
which couples sway and roll. It is the M that answers an impulse.

Nothing counts twice. With heave, roll and pitch at rest these are the equations of mmg_3dof.py, term by term: of C the
Munk moment in yaw, u (m_y (v - z_y p) - m_x v), is left out, because N_v' has it. The MMG polynomials, propeller and
rudder are evaluated for the velocity of the point H = (0, 0, z_H) of the ship and act at their own depths z_H, z_P,
z_R:

    u_H = u_r + z_H q      v_H = v_r - z_H p      K = -z Y      M = z X

so a rolling ship is braked by the sway force it calls up, and no motion gains from it. The part a_H of the rudder's
force that acts on the hull acts at z_H. Signs in a steady turn to starboard: Y_H > 0 holds the ship in the turn from
below CG, so K < 0: the ship heels outwards, to port; the rudder's Y_R < 0 alone, at first, heels it inwards.

4 degrees of freedom: heave and pitch are held, and what is integrated, u, v, p, r and the wrenches on them, is that of
the level axes that turn with the heading (phi_dot = p, psi_dot = r), as in the 4-DOF models of the MMG literature. What
comes in and goes out is in b, like everywhere else; between the two ship/degrees_of_freedom.py turns by the heel.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, cos, hypot, sin, sqrt

import numpy as np

from ..errors import ShipError
from ..ship.damping import Damping
from ..ship.degrees_of_freedom import free_inverse, from_level, to_level
from ..ship.restoring import Restoring
from ..ship.seakeeping import compute_seakeeping
from ..ship.ship import Ship
from .mmg import Forces, Machines, Mmg, Six, Surroundings

__all__ = ["Mmg6Dof"]

Three = tuple[float, float, float]
ZERO: Six = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class Mmg6Dof(Mmg):
    """One ship in 4 or 6 degrees of freedom. What is integrated: eta and nu.

    Raises ShipError when it does not float upright.
    """

    _surge = 6

    def __init__(self, ship: Ship, degrees_of_freedom: int) -> None:
        super().__init__(ship)
        sea = compute_seakeeping(ship)
        self._level = degrees_of_freedom == 4
        self.restoring = Restoring(sea)
        self._damping = Damping(sea)
        self._z_H, self._z_P, self._z_R = sea.z_H, sea.z_P, sea.z_R
        a_H = ship.rudder.a_H if ship.rudder is not None else 0.0
        if 1.0 + a_H == 0.0:
            raise ShipError(f"ship {ship.name!r}: [rudder] a_H = {a_H} leaves the rudder no sway force")
        self._z_RY = (sea.z_R + a_H * sea.z_H) / (1.0 + a_H)  # where rudder and the force it calls up on the hull act

        M, inverse = ship.M, free_inverse(ship.M, degrees_of_freedom)
        even, odd = np.ix_((0, 2, 4), (0, 2, 4)), np.ix_((1, 3, 5), (1, 3, 5))
        self._M_even, self._M_odd = _upper(M[even].tolist()), _upper(M[odd].tolist())
        self._even: tuple[Three, ...] = tuple(tuple(row) for row in inverse[even].tolist())
        self._odd: tuple[Three, ...] = tuple(tuple(row) for row in inverse[odd].tolist())
        self._munk = float(ship.M_A[1, 1] - ship.M_A[0, 0]), float(ship.M_A[1, 3])
        stiffness = ((2, sea.K_33), (3, sea.K_44), (4, sea.K_55))
        self.shortest_time = 1.0 / sqrt(max(K * float(inverse[i, i]) for i, K in stiffness))

    def compute_forces(self, eta: Six, nu: Six, machines: Machines, around: Surroundings) -> Forces:
        """Wrenches by origin; that of the hull has buoyancy, weight and damping in it."""
        _N, _E, D, phi, theta, psi = eta
        s_phi, c_phi, s_theta, c_theta = sin(phi), cos(phi), sin(theta), cos(theta)
        if self._level:
            s_theta, c_theta = 0.0, 1.0
        current = self._current(s_phi, c_phi, s_theta, c_theta, sin(psi), cos(psi), around)
        u, v, w, p, q, r = to_level(nu, phi) if self._level else nu
        u_r, v_r, w_r = u - current[0], v - current[1], w - current[2]
        delta, n, _gear = machines
        hull, propeller, rudder = self._compute_wrenches(u_r, v_r, p, q, r, delta, n)
        Z_D, K_D, M_D = self._damping(w_r, p, q)
        if self._level:
            X_G, Y_G, Z_G, K_G, M_G, N_G = 0.0, 0.0, 0.0, self.restoring.compute_roll_moment(s_phi, c_phi), 0.0, 0.0
        else:
            X_G, Y_G, Z_G, K_G, M_G, N_G = self.restoring(D, s_phi, c_phi, s_theta, c_theta)
        X, Y, Z, K, M, N = hull
        X_W, Y_W, K_W, N_W = self._compute_wind(u, v, psi, around)
        forces = Forces(
            (X + X_G, Y + Y_G, Z + Z_G + Z_D, K + K_G + K_D, M + M_G + M_D, N + N_G),
            propeller,
            rudder,
            (X_W, Y_W, 0.0, K_W, 0.0, N_W),
        )
        return Forces(*(from_level(wrench, phi) for wrench in forces)) if self._level else forces

    def _pack(self, eta: Six, nu: Six) -> tuple[float, ...]:
        return (*eta, *(to_level(nu, eta[3]) if self._level else nu))

    def _unpack(self, x: tuple[float, ...], eta: Six, nu: Six) -> tuple[Six, Six]:
        N, E, D, phi, theta, psi, u, v, w, p, q, r = x
        nu = (u, v, w, p, q, r)
        return (N, E, D, phi, theta, psi), from_level(nu, phi) if self._level else nu

    def _find_inflow(self, x: tuple[float, ...], around: Surroundings) -> float:
        _N, _E, _D, phi, theta, psi, u, v, _w, p, q, r = x
        s_theta, c_theta = (0.0, 1.0) if self._level else (sin(theta), cos(theta))
        u_c, v_c, _w_c = self._current(sin(phi), cos(phi), s_theta, c_theta, sin(psi), cos(psi), around)
        u_H, v_H = u - u_c + self._z_H * q, v - v_c - self._z_H * p
        assert self._propeller is not None
        return self._propeller.compute_inflow(u_H, hypot(u_H, v_H), atan2(-v_H, abs(u_H)), r)

    @staticmethod
    def _add_scaled(x: tuple[float, ...], k: Sequence[float], dt: float) -> tuple[float, ...]:
        return (
            x[0] + dt * k[0], x[1] + dt * k[1], x[2] + dt * k[2], x[3] + dt * k[3], x[4] + dt * k[4],
            x[5] + dt * k[5], x[6] + dt * k[6], x[7] + dt * k[7], x[8] + dt * k[8], x[9] + dt * k[9],
            x[10] + dt * k[10], x[11] + dt * k[11],
        )  # fmt: skip

    def _derivative(self, x: tuple[float, ...], delta: float, n: float, around: Surroundings) -> tuple[float, ...]:
        _N, _E, D, phi, theta, psi, u, v, w, p, q, r = x
        s_phi, c_phi, s_psi, c_psi = sin(phi), cos(phi), sin(psi), cos(psi)
        s_theta, c_theta = (0.0, 1.0) if self._level else (sin(theta), cos(theta))
        u_c, v_c, w_c = self._current(s_phi, c_phi, s_theta, c_theta, s_psi, c_psi, around)
        u_r, v_r, w_r = u - u_c, v - v_c, w - w_c

        # Forces.
        hull, propeller, rudder = self._compute_wrenches(u_r, v_r, p, q, r, delta, n)
        (X_H, Y_H, _, K_H, M_H, N_H), (X_P, _, _, _, M_P, _), (X_R, Y_R, _, K_R, M_R, N_R) = hull, propeller, rudder
        Z_D, K_D, M_D = self._damping(w_r, p, q)
        external = (around.X, around.Y, around.Z, around.K, around.M, around.N)
        X_E, Y_E, Z_E, K_E, M_E, N_E = to_level(external, phi) if self._level else external
        X = X_H + X_P + X_R + X_E
        Y = Y_H + Y_R + Y_E
        Z = Z_D + Z_E
        K = K_H + K_R + K_D + K_E
        M = M_H + M_P + M_R + M_D + M_E
        N = N_H + N_R + N_E
        if around.wind_north or around.wind_east:
            X_W, Y_W, K_W, N_W = self._compute_wind(u, v, psi, around)
            X, Y, K, N = X + X_W, Y + Y_W, K + K_W, N + N_W

        # - C(nu_r) nu_r, with the Munk moment in yaw put back.
        m_11, m_13, m_15, m_33, m_35, m_55 = self._M_even
        m_22, m_24, m_26, m_44, m_46, m_66 = self._M_odd
        P_x, P_y = m_11 * u_r + m_13 * w_r + m_15 * q, m_22 * v_r + m_24 * p + m_26 * r
        P_z, L_x = m_13 * u_r + m_33 * w_r + m_35 * q, m_24 * v_r + m_44 * p + m_46 * r
        L_y, L_z = m_15 * u_r + m_35 * w_r + m_55 * q, m_26 * v_r + m_46 * p + m_66 * r
        X += r * P_y - q * P_z
        Y += p * P_z - r * P_x
        Z += q * P_x - p * P_y
        K += r * L_y - q * L_z + w_r * P_y - v_r * P_z
        M += p * L_z - r * L_x + u_r * P_z - w_r * P_x
        N += q * L_x - p * L_y + v_r * P_x - u_r * P_y + u_r * (self._munk[0] * v_r + self._munk[1] * p)

        if self._level:
            K += self.restoring.compute_roll_moment(s_phi, c_phi)
            (b_1, b_2, b_3), (b_4, b_5, b_6), (b_7, b_8, b_9) = self._odd
            return (
                u * c_psi - v * s_psi, u * s_psi + v * c_psi, 0.0, p, 0.0, r,
                self._even[0][0] * X + r * v_c, b_1 * Y + b_2 * K + b_3 * N - r * u_c, 0.0,
                b_4 * Y + b_5 * K + b_6 * N, 0.0, b_7 * Y + b_8 * K + b_9 * N,
            )  # fmt: skip

        X_G, Y_G, Z_G, K_G, M_G, N_G = self.restoring(D, s_phi, c_phi, s_theta, c_theta)
        X, Y, Z, K, M, N = X + X_G, Y + Y_G, Z + Z_G, K + K_G, M + M_G, N + N_G
        (a_1, a_2, a_3), (a_4, a_5, a_6), (a_7, a_8, a_9) = self._even
        (b_1, b_2, b_3), (b_4, b_5, b_6), (b_7, b_8, b_9) = self._odd
        turning = (q * s_phi + r * c_phi) / c_theta  # psi_dot
        ahead = u * c_theta + (v * s_phi + w * c_phi) * s_theta  # in the vertical plane of the heading
        abeam = v * c_phi - w * s_phi
        return (
            ahead * c_psi - abeam * s_psi, ahead * s_psi + abeam * c_psi,
            (v * s_phi + w * c_phi) * c_theta - u * s_theta,
            p + turning * s_theta, q * c_phi - r * s_phi, turning,
            a_1 * X + a_2 * Z + a_3 * M + r * v_c - q * w_c, b_1 * Y + b_2 * K + b_3 * N + p * w_c - r * u_c,
            a_4 * X + a_5 * Z + a_6 * M + q * u_c - p * v_c, b_4 * Y + b_5 * K + b_6 * N,
            a_7 * X + a_8 * Z + a_9 * M, b_7 * Y + b_8 * K + b_9 * N,
        )  # fmt: skip

    def _current(
        self, s_phi: float, c_phi: float, s_theta: float, c_theta: float, s_psi: float, c_psi: float,
        around: Surroundings,
    ) -> Three:  # fmt: skip
        """Velocity of the water in b [m/s]."""
        north, east = around.current_north, around.current_east
        if north == 0.0 == east:
            return 0.0, 0.0, 0.0
        ahead, abeam = north * c_psi + east * s_psi, east * c_psi - north * s_psi
        if self._level:
            return ahead, abeam, 0.0
        return ahead * c_theta, ahead * s_theta * s_phi + abeam * c_phi, ahead * s_theta * c_phi - abeam * s_phi

    def _compute_wrenches(
        self, u: float, v: float, p: float, q: float, r: float, delta: float, n: float
    ) -> tuple[Six, Six, Six]:
        """Wrenches of hull, propeller and rudder, at velocities of CO relative to the water."""
        z_H = self._z_H
        u_H, v_H = u + z_H * q, v - z_H * p
        X, Y, N = self._hull(u_H, v_H, r)
        hull = (X, Y, 0.0, -z_H * Y, z_H * X, N)
        if self._propeller is None or self._rudder is None:
            return hull, ZERO, ZERO
        U, beta = hypot(u_H, v_H), atan2(-v_H, abs(u_H))
        u_P = self._propeller.compute_inflow(u_H, U, beta, r)
        thrust = self._propeller.compute_thrust(u_P, n)
        X_P = self._propeller.remaining * thrust
        X_R, Y_R, N_R = self._rudder(U, beta, r, u_P, thrust, delta)
        rudder = (X_R, Y_R, 0.0, -self._z_RY * Y_R, self._z_R * X_R, N_R)
        return hull, (X_P, 0.0, 0.0, 0.0, self._z_P * X_P, 0.0), rudder


def _upper(block: list[list[float]]) -> Six:
    """The upper triangle of a symmetric (3, 3) block, row by row."""
    (a, b, c), (_b, d, e), (_c, _e, f) = block
    return a, b, c, d, e, f
