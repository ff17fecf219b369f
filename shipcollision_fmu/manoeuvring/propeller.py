"""The propeller: inflow through the hull's wake, and thrust.

    beta_P    = beta - x_P' r'                                             Yasukawa & Yoshimura (2015)
    1 - w_P   = (1 - w_P0) (1 + (1 - exp(-C_1 |beta_P|)) (C_2 - 1))        C_2 by the sign of beta_P
    u_P       = u (1 - w_P),   J = u_P / (n D_P)
    thrust    = rho n^2 D_P^4 (k_0 + k_1 J + k_2 J^2),   X_P = (1 - t_P) thrust

Multiplied out, thrust = rho D_P^2 (k_0 (n D_P)^2 + k_1 n D_P u_P + k_2 u_P^2): no J is needed. That is the ship's own
curve, and it holds where the propeller pulls ahead in a flow from ahead. No polynomial in J describes how a propeller
stalls that turns astern while the ship still runs ahead. Where the ship's curve does not hold, the thrust is that of
the Wageningen B4-70 propeller with the same pull on the spot (ship/b_series.py), measured in all four quadrants:

    n > 0, u_P > 0, curve above 0    the ship's own curve
    n > 0, u_P > 0, below            the series between its own zero of thrust and the stopped propeller, the angle
                                     stretched so that the zeros fall together
    n < 0 or u_P < 0                 the series, times k_0 over the series' where k_0 is beyond its pitches

Thrust is continuous everywhere. Turning astern, the series pulls 0.74 of its thrust ahead on the spot, and half of the
mirrored curve at J = -0.5. `astern_factor` scales what turning astern adds to the stopped propeller's drag: take it
from the ship's own crash stop. With its default 1, full astern from service speed stops KVLCC2 within 16.8 L, the bulk
carrier within 12.3 L, the container ships within 8.8 and 7.5 L; no crash stop of these ships was found to compare with.
Not modelled: air drawn to the propeller, the side force of its wash on the stern (a ship keeps its heading in a crash
stop), and the change of the thrust deduction astern. The torque of an engine of known power limits the revolutions
(torque_limit.py).

The wake takes beta = atan2(-v, |u|): a ship that moves astern has the wake of one that moves ahead.
u, v [m/s] relative to the water, r [rad/s], n [1/s], thrust [N].
"""

from __future__ import annotations

from functools import lru_cache
from math import atan2, degrees, exp, floor, hypot, pi

from ..errors import ShipError
from ..ship.b_series import ROTATION, compute_bollard_pull, compute_coefficient, find_pitch
from ..ship.propeller_torque import find_idle_advance, make_torque_law
from ..ship.ship import Ship
from ..ship.tables.manoeuvring import EngineTable, PropellerTable
from .torque_limit import TorqueLimit

__all__ = ["Propeller", "speed_and_drift_angle"]

PER_DEGREE = 4
"""Entries of the table of the series per degree of beta: linear between them, within 1e-3 of its largest."""


def speed_and_drift_angle(u: float, v: float) -> tuple[float, float]:
    """U [m/s] and beta = atan2(-v, |u|) [rad], which propeller and rudder take."""
    return hypot(u, v), atan2(-v, abs(u))


class Propeller:
    """Inflow and thrust of one propeller. series: T over rho D^2 (u_P^2 + (0.7 pi n D)^2), PER_DEGREE from -180 deg."""

    def __init__(self, ship: Ship, table: PropellerTable) -> None:
        self.D_P = table.D_p
        self.remaining = 1.0 - table.t_P  # of the thrust, after the suction on the stern
        self._x_P = table.x_P * ship.L_pp
        self._through = 1.0 - table.w_P0
        self._C_1, self._plus, self._minus = table.C_1, table.C_2_plus - 1.0, table.C_2_minus - 1.0
        self._k_0, self._k_1, self._k_2 = table.k_0, table.k_1, table.k_2
        self._astern = table.astern_factor
        self.unit = ship.rho * table.D_p**2  # times velocity^2 is a thrust [N]
        self.series = _tabulate_series(self._k_0, _find_own_zero(ship.name, self._k_0, self._k_1, self._k_2))

    def compute_inflow(self, u: float, U: float, beta: float, r: float) -> float:
        """u_P [m/s]."""
        if U == 0.0:
            return 0.0
        beta_P = beta - self._x_P * r / U
        if beta_P > 0.0:
            return u * self._through * (1.0 + (1.0 - exp(-self._C_1 * beta_P)) * self._plus)
        return u * self._through * (1.0 + (1.0 - exp(self._C_1 * beta_P)) * self._minus)

    def compute_thrust(self, u_P: float, n: float) -> float:
        """Open-water thrust [N] at n [1/s] in the inflow u_P."""
        nD = n * self.D_P
        if nD >= 0.0 and u_P >= 0.0:
            own = (self._k_0 * nD + self._k_1 * u_P) * nD + self._k_2 * u_P * u_P
            if own >= 0.0:
                return self.unit * own
        if n < 0.0 and self._astern != 1.0:
            drag = self._measured(u_P, 0.0)
            return drag + self._astern * (self._measured(u_P, nD) - drag)
        return self._measured(u_P, nD)

    def limit_torque(self, table: EngineTable) -> TorqueLimit | None:
        """The revolutions that an engine reaches; None where its power is not known, and no torque limits it."""
        if table.power is None:
            return None
        law = make_torque_law(self._k_0, self._k_1, self._k_2)
        rated = table.max_rev_per_s if table.rated_rev_per_s is None else table.rated_rev_per_s
        most_torque = table.power / (2.0 * pi * rated)

        def compute_torque(u_P: float, x: float) -> float:
            return law.compute(self.compute_thrust(u_P, x / self.D_P) / self.unit, u_P, x)

        least_wake = self._through * min(1.0, 1.0 + self._plus, 1.0 + self._minus)
        return TorqueLimit(compute_torque, self.D_P, self.unit / self.D_P**2, most_torque, least_wake)

    def _measured(self, u_P: float, nD: float) -> float:
        """That of the series [N]."""
        blade = ROTATION * nD
        place = (degrees(atan2(u_P, blade)) + 180.0) * PER_DEGREE
        k = min(floor(place), len(self.series) - 2)
        low, high = self.series[k], self.series[k + 1]
        return self.unit * (u_P * u_P + blade * blade) * (low + (place - k) * (high - low))


@lru_cache(maxsize=64)
def _tabulate_series(k_0: float, own_zero: float) -> tuple[float, ...]:
    """T over rho D^2 (u_P^2 + (0.7 pi n D)^2) at the angles beta from -180 to 180 deg, PER_DEGREE.

    own_zero [deg]: where the ship's own curve comes to zero thrust.
    """
    pitch = find_pitch(k_0)
    scale = k_0 / compute_bollard_pull(pitch)
    zero = _find_series_zero(pitch)
    values = []
    for i in range(360 * PER_DEGREE + 1):
        beta = i / PER_DEGREE - 180.0
        times, at = scale, beta
        if beta > 90.0:  # towards the stopped propeller that of the series itself
            times = 1.0 + (scale - 1.0) * (beta - 90.0) / 90.0
        elif beta > 0.0:
            times, at = 1.0, 90.0 - (90.0 - beta) * (90.0 - zero) / (90.0 - own_zero)
        values.append(pi / 8.0 * times * compute_coefficient(pitch, at))
    return tuple(values)


def _find_own_zero(name: str, k_0: float, k_1: float, k_2: float) -> float:
    """beta [deg] at which the ship's own curve comes to zero thrust. Raises ShipError when it never does."""
    idle = find_idle_advance(k_0, k_1, k_2)
    if idle == 0.0:
        raise ShipError(
            f"ship {name!r}: [propeller] k_0 = {k_0:g}, k_1 = {k_1:g}, k_2 = {k_2:g} never come to zero thrust with "
            "rising J: k_1 and k_2 are usually negative, e.g. -0.28 and -0.14"
        )
    return degrees(atan2(idle, ROTATION))


def _find_series_zero(pitch: float) -> float:
    """beta [deg] of the series' zero of thrust ahead."""
    low, high = 0.0, 90.0
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if compute_coefficient(pitch, middle) > 0.0 else (low, middle)
    return low
