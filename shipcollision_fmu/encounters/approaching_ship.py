"""How each ship comes to the impact: its file, its speed through the water, its helm orders, current and wind.

A coasting ship has no orders. A sailed ship keeps its revolutions; own's rudder may be put over before the impact.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin
from typing import NamedTuple

from ..manoeuvring.trials.steady_course import find_self_propulsion
from ..scenario.tables.environment import CurrentTable, Environment, WindTable
from ..ship.coasting_law import COASTING
from .request import Kind, Request, value_or_default
from .ship_table import require_manoeuvring

__all__ = ["ApproachingShip", "HelmOrder", "plan_approaching_ships"]


class HelmOrder(NamedTuple):
    """Rudder [deg] and revolutions [1/s], ordered at the communication point k."""

    k: int
    rudder_deg: float
    rev_per_s: float


@dataclass(frozen=True)
class ApproachingShip:
    """A ship on its way to the impact.

    file                 ship file, a name or a path
    surge, sway          speed ahead and to starboard through the water at the start [m/s]
    orders               helm orders by time; None for a coasting ship
    degrees_of_freedom   3, 4 or 6
    """

    file: str
    surge: float
    sway: float
    orders: tuple[HelmOrder, ...] | None
    degrees_of_freedom: int

    @property
    def coasting(self) -> str | None:
        """The key of its table: a coasting ship that drifts is carried by the water, and keeps its heading."""
        return "straight" if self.orders is None and self.sway else None

    @property
    def predicted_law(self) -> str:
        """What the collision model expects of it between impulses."""
        return "straight" if self.orders is not None or self.sway else COASTING[0]


def plan_approaching_ships(
    request: Request, kind: Kind, sailed: bool, steps: int
) -> tuple[Environment, ApproachingShip, ApproachingShip]:
    """Current and wind, own and target; the impact is at the communication point `steps`.

    A sailed target drifts with a current, in which both ships sail. A coasting target has the drift as its own velocity
    and there is no current. Raises ScenarioError for a ship that has to be sailed and can only coast.
    """
    own_speed = value_or_default(request.own_speed, kind.own_speed)
    target_speed = value_or_default(request.target_speed, kind.target_speed)
    drift_speed, drift_angle = value_or_default(request.drift_speed, kind.drift_speed), radians(request.drift_deg)
    free = request.degrees_of_freedom or 3
    if not sailed:
        return (
            Environment(),
            ApproachingShip(request.own, own_speed, 0.0, None, free),
            ApproachingShip(
                request.target,
                target_speed + drift_speed * cos(drift_angle),
                drift_speed * sin(drift_angle),
                None,
                free,
            ),
        )
    towards = radians(request.heading_deg) + drift_angle
    velocity = [drift_speed * cos(towards), drift_speed * sin(towards)]
    if request.current_speed is not None:
        velocity = CurrentTable(
            speed=request.current_speed, towards_deg=value_or_default(request.current_towards_deg, 0.0)
        ).velocity
    wind = None
    if request.wind_speed:
        wind = WindTable(speed=request.wind_speed, from_deg=value_or_default(request.wind_from_deg, 0.0))
    own, target = (
        ApproachingShip(file, speed, 0.0, (_order_straight_course(file, speed),), free)
        for file, speed in ((request.own, own_speed), (request.target, target_speed))
    )
    if kind.helm:
        k = steps - round(value_or_default(request.before, kind.before) / request.step)
        rudder_deg = value_or_default(request.rudder_deg, kind.rudder_deg)
        own = ApproachingShip(own.file, own.surge, 0.0, _insert_rudder_order(own.orders, max(0, k), rudder_deg), free)
    return Environment(current=[round(component, 9) for component in velocity], wind=wind), own, target


def _order_straight_course(ship: str, speed: float) -> HelmOrder:
    """Rudder amidships and the revolutions that keep the speed [m/s]."""
    require_manoeuvring(ship, "take --coasting, or another ship")
    return HelmOrder(0, 0.0, find_self_propulsion(ship, speed) if speed > 0.0 else 0.0)


def _insert_rudder_order(orders: tuple[HelmOrder, ...] | None, k: int, rudder_deg: float) -> tuple[HelmOrder, ...]:
    """The first order followed by the rudder angle at the communication point k, at the same revolutions."""
    (first, *_) = orders or ()
    rudder = HelmOrder(k, rudder_deg, first.rev_per_s)
    return (rudder,) if k == 0 else (first, rudder)
