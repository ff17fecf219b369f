"""The MMG standard model in surge, sway and yaw: equations of motion and their integration.

    (m + m_x) u_dot - (m + m_y) v r - x_G m r^2                = X        Yasukawa & Yoshimura (2015)
    (m + m_y) v_dot + (m + m_x) u r + x_G m r_dot              = Y
    (I_zG + x_G^2 m + J_z) r_dot + x_G m (v_dot + u r)         = N        X, Y, N = hull + propeller + rudder + external

about midship (CO). The masses are entries of the ship's M, so an impulse and these equations feel the same inertia.
The hull's Munk moment is in N_v', hence no (m_y - m_x) u v here.

A uniform current v_c (n, towards) carries the water: the equations hold for the velocity relative to the water, and the
velocity over ground follows from d/dt(v_c in b) = (r v_c, -r u_c).

Integrated by the classical Runge-Kutta method of order 4. All in plain floats: small numpy arrays are ten times slower.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, sin
from typing import NamedTuple

from ..errors import ShipError
from ..ship.ship import Ship
from .actuators import Actuator, engine, steering_gear
from .hull_forces import HullForces
from .propeller import Propeller
from .rudder import Rudder

__all__ = ["Mmg", "Surroundings"]

Planar = tuple[float, float, float]
"""North, east, heading [m, m, rad]; or u, v, r; or X, Y, N."""


class Surroundings(NamedTuple):
    """What is held over a step: current towards north, east [m/s]; external X, Y [N], N [N m] about CO in b."""

    current_north: float
    current_east: float
    X: float
    Y: float
    N: float


class Mmg:
    """One ship's MMG model. Raises ShipError when the ship has no MMG set or is not symmetric to its centreline."""

    def __init__(self, ship: Ship) -> None:
        tables = (ship.manoeuvring, ship.propeller, ship.rudder, ship.engine)
        if ship.manoeuvring is None or ship.propeller is None or ship.rudder is None or ship.engine is None:
            named = zip(("[manoeuvring]", "[propeller]", "[rudder]", "[engine]"), tables, strict=True)
            lacking = ", ".join(name for name, table in named if table is None)
            raise ShipError(
                f"ship {ship.name!r} has no {lacking}, so it can only coast: set hydrodynamics = false or add them"
            )
        if abs(ship.M[0, 1]) > 0.0 or abs(ship.M[0, 5]) > 0.0:
            raise ShipError(
                f"ship {ship.name!r} is not symmetric to its centreline (M[0][1] = {ship.M[0, 1]:g}, M[0][5] = "
                f"{ship.M[0, 5]:g}, must be 0 with hydrodynamics = true): put CG on the centreline, r_bg = [x, 0, z]"
            )
        self.steering: Actuator = steering_gear(ship.rudder)
        self.engine: Actuator = engine(ship.engine)
        self._hull = HullForces(ship, ship.manoeuvring)
        self._propeller = Propeller(ship, ship.propeller)
        self._rudder = Rudder(ship, ship.rudder, ship.propeller)
        self._m_u = float(ship.M[0, 0])  # m + m_x
        self._m_v = float(ship.M[1, 1])  # m + m_y
        self._m_vr = float(ship.M[1, 5])  # x_G m
        self._m_r = float(ship.M[5, 5])  # I_zG + x_G^2 m + J_z
        self._determinant = self._m_v * self._m_r - self._m_vr**2

    def forces(
        self, psi: float, nu: Planar, rudder_angle: float, propeller_speed: float, around: Surroundings
    ) -> tuple[Planar, Planar, Planar]:
        """(X, Y, N) of hull, propeller and rudder, at the velocity nu over ground."""
        u_c, v_c = _current_in_b(around, cos(psi), sin(psi))
        return self._forces(nu[0] - u_c, nu[1] - v_c, nu[2], rudder_angle, propeller_speed)

    def sailed(
        self, eta: Planar, nu: Planar, rudder_angle: float, propeller_speed: float, orders: Sequence[float],
        around: Surroundings, h: float, substeps: int,
    ) -> tuple[Planar, Planar, float, float]:  # fmt: skip
        """(eta, nu, rudder_angle, propeller_speed) after h [s] in equal substeps; nu over ground in b about CO."""
        dt = h / substeps
        for _ in range(substeps):
            delta_mid = self.steering.followed(rudder_angle, orders[0], 0.5 * dt)
            delta_end = self.steering.followed(rudder_angle, orders[0], dt)
            n_mid = self.engine.followed(propeller_speed, orders[1], 0.5 * dt)
            n_end = self.engine.followed(propeller_speed, orders[1], dt)
            a = self._derivative(*eta, *nu, rudder_angle, propeller_speed, around)
            b = self._derivative(*_moved(eta, nu, a, 0.5 * dt), delta_mid, n_mid, around)
            c = self._derivative(*_moved(eta, nu, b, 0.5 * dt), delta_mid, n_mid, around)
            d = self._derivative(*_moved(eta, nu, c, dt), delta_end, n_end, around)
            mean = [(ka + 2.0 * (kb + kc) + kd) / 6.0 for ka, kb, kc, kd in zip(a, b, c, d, strict=True)]
            x, y, psi, u, v, r = _moved(eta, nu, mean, dt)
            eta, nu = (x, y, psi), (u, v, r)
            rudder_angle, propeller_speed = delta_end, n_end
        return eta, nu, rudder_angle, propeller_speed

    def _derivative(
        self, _x: float, _y: float, psi: float, u: float, v: float, r: float,
        rudder_angle: float, propeller_speed: float, around: Surroundings,
    ) -> tuple[float, float, float, float, float, float]:  # fmt: skip
        """d/dt of (x, y, psi, u, v, r)."""
        c, s = cos(psi), sin(psi)
        u_c, v_c = _current_in_b(around, c, s)
        u_r, v_r = u - u_c, v - v_c

        (X_H, Y_H, N_H), (X_P, Y_P, N_P), (X_R, Y_R, N_R) = self._forces(u_r, v_r, r, rudder_angle, propeller_speed)
        X = X_H + X_P + X_R + around.X
        Y = Y_H + Y_P + Y_R + around.Y
        N = N_H + N_P + N_R + around.N

        X += self._m_v * v_r * r + self._m_vr * r * r
        Y -= self._m_u * u_r * r
        N -= self._m_vr * u_r * r
        u_dot = X / self._m_u
        v_dot = (self._m_r * Y - self._m_vr * N) / self._determinant
        r_dot = (self._m_v * N - self._m_vr * Y) / self._determinant
        return u * c - v * s, u * s + v * c, r, u_dot + r * v_c, v_dot - r * u_c, r_dot

    def _forces(
        self, u: float, v: float, r: float, rudder_angle: float, propeller_speed: float
    ) -> tuple[Planar, Planar, Planar]:
        """(X, Y, N) of hull, propeller and rudder, at velocities relative to the water."""
        u_P = self._propeller.inflow(u, v, r)
        thrust = self._propeller.thrust(u_P, propeller_speed)
        hull = self._hull(u, v, r)
        propeller = (self._propeller.remaining * thrust, 0.0, 0.0)
        rudder = self._rudder(u, v, r, u_P, thrust, rudder_angle)
        return hull, propeller, rudder


def _current_in_b(around: Surroundings, cos_psi: float, sin_psi: float) -> tuple[float, float]:
    """u_c, v_c [m/s]."""
    north, east = around.current_north, around.current_east
    return north * cos_psi + east * sin_psi, east * cos_psi - north * sin_psi


def _moved(eta: Planar, nu: Planar, k: Sequence[float], dt: float) -> tuple[float, float, float, float, float, float]:
    return (
        eta[0] + dt * k[0], eta[1] + dt * k[1], eta[2] + dt * k[2],
        nu[0] + dt * k[3], nu[1] + dt * k[4], nu[2] + dt * k[5],
    )  # fmt: skip
