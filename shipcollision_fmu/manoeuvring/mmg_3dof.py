"""The MMG standard model in surge, sway and yaw: equations of motion.

    (m + m_x) u_dot - (m + m_y) v r - x_G m r^2                = X        Yasukawa & Yoshimura (2015)
    (m + m_y) v_dot + (m + m_x) u r + x_G m r_dot              = Y
    (I_zG + x_G^2 m + J_z) r_dot + x_G m (v_dot + u r)         = N        X, Y, N = hull + propeller + rudder + wind
                                                                                    + external
about midship (CO). The masses are entries of the ship's M, so an impulse and these equations feel the same inertia.
The hull's Munk moment is in N_v', hence no (m_y - m_x) u v here.

A uniform current v_c (n, towards) carries the water: the equations hold for the velocity relative to the water, and the
velocity over ground follows from d/dt(v_c in b) = (r v_c, -r u_c). Heave, roll and pitch stay as they are; where forces
act in height does not matter.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, cos, hypot, sin

from ..ship.ship import Ship
from .mmg import Forces, Machines, Mmg, Six, Surroundings
from .propeller import speed_and_drift_angle

__all__ = ["Mmg3Dof"]

Planar = tuple[float, float, float]
"""X, Y [N] and N [N m]."""

ZERO: Planar = (0.0, 0.0, 0.0)


class Mmg3Dof(Mmg):
    """One ship in three degrees of freedom. What is integrated: x, y, psi, u, v, r."""

    _surge = 3

    def __init__(self, ship: Ship) -> None:
        super().__init__(ship)
        self._m_u = float(ship.M[0, 0])  # m + m_x
        self._m_v = float(ship.M[1, 1])  # m + m_y
        self._m_vr = float(ship.M[1, 5])  # x_G m
        self._m_r = float(ship.M[5, 5])  # I_zG + x_G^2 m + J_z
        self._determinant = self._m_v * self._m_r - self._m_vr**2

    def compute_forces(self, eta: Six, nu: Six, machines: Machines, around: Surroundings) -> Forces:
        """X, Y, N by origin, the other components 0."""
        psi, (u, v, _w, _p, _q, r) = eta[5], nu
        X, Y, _K, N = self._compute_wind(u, v, psi, around)
        c, s = cos(psi), sin(psi)
        north, east = around.current_north, around.current_east
        u_r, v_r = u - (north * c + east * s), v - (east * c - north * s)
        hull, X_P, rudder = self._hull(u_r, v_r, r), 0.0, ZERO
        if self._propeller is not None and self._rudder is not None:
            U, beta = speed_and_drift_angle(u_r, v_r)
            u_P = self._propeller.compute_inflow(u_r, U, beta, r)
            thrust = self._propeller.compute_thrust(u_P, machines.propeller_speed)
            X_P = self._propeller.remaining * thrust
            rudder = self._rudder(U, beta, r, u_P, thrust, machines.rudder_angle)
        return Forces(_wrench(hull), _wrench((X_P, 0.0, 0.0)), _wrench(rudder), _wrench((X, Y, N)))

    def _pack(self, eta: Six, nu: Six) -> tuple[float, ...]:
        return eta[0], eta[1], eta[5], nu[0], nu[1], nu[5]

    def _unpack(self, x: tuple[float, ...], eta: Six, nu: Six) -> tuple[Six, Six]:
        north, east, psi, u, v, r = x
        return (north, east, *eta[2:5], psi), (u, v, *nu[2:5], r)

    def _find_inflow(self, x: tuple[float, ...], around: Surroundings) -> float:
        _x, _y, psi, u, v, r = x
        north, east = around.current_north, around.current_east
        if north or east:
            c, s = cos(psi), sin(psi)
            u, v = u - (north * c + east * s), v - (east * c - north * s)
        assert self._propeller is not None
        return self._propeller.compute_inflow(u, hypot(u, v), atan2(-v, abs(u)), r)

    @staticmethod
    def _add_scaled(x: tuple[float, ...], k: Sequence[float], dt: float) -> tuple[float, ...]:
        return (
            x[0] + dt * k[0], x[1] + dt * k[1], x[2] + dt * k[2],
            x[3] + dt * k[3], x[4] + dt * k[4], x[5] + dt * k[5],
        )  # fmt: skip

    def _derivative(self, x: tuple[float, ...], delta: float, n: float, around: Surroundings) -> tuple[float, ...]:
        _x, _y, psi, u, v, r = x
        c, s = cos(psi), sin(psi)
        north, east, wind_north, wind_east, X_E, Y_E, _Z, _K, _M, N_E = around
        u_r, v_r, u_c, v_c = u, v, 0.0, 0.0
        if north or east:
            u_c, v_c = north * c + east * s, east * c - north * s
            u_r, v_r = u - u_c, v - v_c

        X, Y, N = self._hull(u_r, v_r, r)  # written out, not called: this is where the time goes
        propeller, rudder = self._propeller, self._rudder
        if propeller is not None and rudder is not None:
            U, beta = hypot(u_r, v_r), atan2(-v_r, abs(u_r))
            u_P = propeller.compute_inflow(u_r, U, beta, r)
            thrust = propeller.compute_thrust(u_P, n)
            X_R, Y_R, N_R = rudder(U, beta, r, u_P, thrust, delta)
            X, Y, N = X + propeller.remaining * thrust + X_R, Y + Y_R, N + N_R
        X, Y, N = X + X_E, Y + Y_E, N + N_E
        if wind_north or wind_east:
            X_W, Y_W, _K, N_W = self._compute_wind(u, v, psi, around)
            X, Y, N = X + X_W, Y + Y_W, N + N_W

        X += self._m_v * v_r * r + self._m_vr * r * r
        Y -= self._m_u * u_r * r
        N -= self._m_vr * u_r * r
        u_dot = X / self._m_u
        v_dot = (self._m_r * Y - self._m_vr * N) / self._determinant
        r_dot = (self._m_v * N - self._m_vr * Y) / self._determinant
        return u * c - v * s, u * s + v * c, r, u_dot + r * v_c, v_dot - r * u_c, r_dot


def _wrench(planar: Planar) -> Six:
    """X, Y, N as a wrench about CO."""
    X, Y, N = planar
    return X, Y, 0.0, 0.0, 0.0, N
