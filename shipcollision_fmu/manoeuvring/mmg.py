"""The base of the MMG model in any number of degrees of freedom: force groups, machines, integration.

The classical Runge-Kutta method of order 4 integrates the motion; rudder and propeller follow their orders between its
stages. All numbers are plain floats: small numpy arrays are ten times slower.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from math import cos, sin
from typing import NamedTuple

from ..errors import ShipError
from ..ship.degrees_of_freedom import Six
from ..ship.ship import Ship
from ..ship.windage import compute_windage
from .actuators import Actuator, Engine, Gear, make_engine, make_steering_gear
from .hull_forces import HullForces
from .propeller import Propeller
from .rudder import Rudder
from .wind import WindForces

__all__ = ["CALM", "Forces", "Machines", "Mmg", "Orders", "Six", "Surroundings"]


class Surroundings(NamedTuple):
    """Values held over a step: velocities of water and air, towards north and east [m/s]; external force (X, Y, Z)
    [N] and moment (K, M, N) [N m] about CO in b."""

    current_north: float
    current_east: float
    wind_north: float
    wind_east: float
    X: float
    Y: float
    Z: float
    K: float
    M: float
    N: float


CALM = Surroundings(*[0.0] * 10)


class Orders(NamedTuple):
    """Ordered rudder angle [rad] and propeller speed [1/s], held over a step."""

    rudder_angle: float
    propeller_speed: float


class Machines(NamedTuple):
    """Rudder angle [rad], propeller speed [1/s], and the gear of the engine."""

    rudder_angle: float
    propeller_speed: float
    gear: Gear


class Forces(NamedTuple):
    """Wrenches about CO in b by origin [N, N m]."""

    hull: Six
    propeller: Six
    rudder: Six
    wind: Six


class Mmg(ABC):
    """One ship's equations of motion: what is common to 3, 4 and 6 degrees of freedom.

    Raises ShipError when the ship has no MMG set or is not symmetric to its centreline. A ship without propeller,
    rudder and engine drifts.
    """

    shortest_time: float = float("inf")
    """1/w of the fastest free oscillation [s]: substeps must be shorter."""

    _surge: int
    """Place of u among the integrated quantities."""

    def __init__(self, ship: Ship) -> None:
        if ship.manoeuvring is None:
            raise ShipError(
                f"ship {ship.name!r} has no [manoeuvring], so it can only coast: set hydrodynamics = false or add it"
            )
        M = ship.M
        odd = max(
            ((abs(M[i, j]) / (M[i, i] * M[j, j]) ** 0.5, i, j) for i in (0, 2, 4) for j in (1, 3, 5)), default=None
        )
        if odd is not None and odd[0] > 0.0:
            _, i, j = odd
            raise ShipError(
                f"ship {ship.name!r} is not symmetric to its centreline (M[{i}][{j}] = {M[i, j]:g}, must be 0 with "
                "hydrodynamics = true): put CG on the centreline, r_bg = [x, 0, z]"
            )
        self.steering: Actuator = make_steering_gear(ship.rudder)
        self.engine: Engine = make_engine(ship.engine)
        self.propelled = ship.propeller is not None
        self._hull = HullForces(ship, ship.manoeuvring)
        self._wind = WindForces(compute_windage(ship), ship.L_oa)
        self._propeller = Propeller(ship, ship.propeller) if ship.propeller is not None else None
        self._torque_limit = (
            self._propeller.limit_torque(ship.engine)
            if self._propeller is not None and ship.engine is not None
            else None
        )
        self._rudder = (
            Rudder(ship, ship.rudder, ship.propeller)
            if ship.rudder is not None and ship.propeller is not None
            else None
        )

    @abstractmethod
    def compute_forces(self, eta: Six, nu: Six, machines: Machines, around: Surroundings) -> Forces:
        """The forces at a pose and a velocity over ground."""

    @abstractmethod
    def _pack(self, eta: Six, nu: Six) -> tuple[float, ...]:
        """The integrated quantities, from eta and nu."""

    @abstractmethod
    def _unpack(self, x: tuple[float, ...], eta: Six, nu: Six) -> tuple[Six, Six]:
        """eta and nu with the integrated quantities put in."""

    @abstractmethod
    def _derivative(self, x: tuple[float, ...], delta: float, n: float, around: Surroundings) -> tuple[float, ...]:
        """d/dt of the integrated quantities, at the rudder angle delta [rad] and the propeller speed n [1/s]."""

    @abstractmethod
    def _find_inflow(self, x: tuple[float, ...], around: Surroundings) -> float:
        """u_P [m/s] of a ship with a propeller."""

    def limit_revolutions(self, eta: Six, nu: Six, n: float, around: Surroundings) -> float:
        """The propeller speed [1/s] as the engine's torque allows it at a pose and a velocity over ground."""
        if self._torque_limit is None:
            return n
        least, most = self._torque_limit.find_range(self._find_inflow(self._pack(eta, nu), around))
        return min(most, max(least, n))

    @staticmethod
    @abstractmethod
    def _add_scaled(x: tuple[float, ...], k: Sequence[float], dt: float) -> tuple[float, ...]:
        """x + dt k."""

    def advance(
        self, eta: Six, nu: Six, machines: Machines, orders: Orders, around: Surroundings, h: float,
        substeps: int,
    ) -> tuple[Six, Six, Machines]:  # fmt: skip
        """(eta, nu, machines) after h [s] in equal substeps; nu over ground in b about CO."""
        dt = h / substeps
        delta, n, gear = machines
        rudder_order, propeller_order = orders
        still, surge = around.current_north == 0.0 == around.current_east, self._surge
        x, moved, derivative, limit = self._pack(eta, nu), self._add_scaled, self._derivative, self._torque_limit
        for _ in range(substeps):
            delta_mid = self.steering.follow(delta, rudder_order, 0.5 * dt)
            delta_end = self.steering.follow(delta, rudder_order, dt)
            n_mid, _half = self.engine.follow(n, gear, propeller_order, 0.5 * dt)
            n_end, gear = self.engine.follow(n, gear, propeller_order, dt)
            if limit is not None and not (
                still and n >= 0.0 <= n_end and limit.is_surely_free(x[surge], max(n, n_end))
            ):
                least, most = limit.find_range(self._find_inflow(x, around))
                n, n_mid, n_end = (min(most, max(least, speed)) for speed in (n, n_mid, n_end))
            a = derivative(x, delta, n, around)
            b = derivative(moved(x, a, 0.5 * dt), delta_mid, n_mid, around)
            c = derivative(moved(x, b, 0.5 * dt), delta_mid, n_mid, around)
            d = derivative(moved(x, c, dt), delta_end, n_end, around)
            mean = [(ka + 2.0 * (kb + kc) + kd) / 6.0 for ka, kb, kc, kd in zip(a, b, c, d, strict=True)]
            x = moved(x, mean, dt)
            delta, n = delta_end, n_end
        eta, nu = self._unpack(x, eta, nu)
        return eta, nu, Machines(delta, n, gear)

    def _compute_wind(self, u: float, v: float, psi: float, around: Surroundings) -> tuple[float, float, float, float]:
        """X, Y, K, N of the wind at the velocity u, v over ground; zero in a calm."""
        north, east = around.wind_north, around.wind_east
        if north == 0.0 == east:
            return 0.0, 0.0, 0.0, 0.0
        c, s = cos(psi), sin(psi)
        return self._wind(u - (north * c + east * s), v - (east * c - north * s))
