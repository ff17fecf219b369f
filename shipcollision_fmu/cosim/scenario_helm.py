"""The helm of a ship from its table in a scenario; gains and distances that the table leaves out follow the ship."""

from __future__ import annotations

from math import hypot, radians

from ..fmi.names import ORDERS
from ..scenario.order_schedule import find_point, schedule_headings, schedule_orders
from ..scenario.tables.autopilot import AutopilotTable, RouteTable
from ..scenario.tables.evasion import EvasionTable
from ..scenario.tables.ship_start import ShipStart
from .autopilot import Autopilot
from .component import Component
from .evasion import Evasion
from .helm import Helm, HelmState, Steering
from .route import Route

__all__ = ["build_autopilot", "build_helm", "build_steering"]

RATE_GAIN = 2.0
"""Default K_d / K_p, in lengths sailed: about what a tanker takes to answer its helm. Less, and it overshoots."""
LOOKAHEAD, ACCEPTANCE = 2.5, 2.0
"""Defaults of a route, in lengths L_pp. With less a tanker snakes about its track."""
SLOWEST_STEERAGE = 0.1
"""[m^(1/2)/s] Speed / sqrt(L_pp) below which the default rate gain no longer grows: some 2 m/s for a tanker. Without it
the gain of a ship that starts at rest would be infinite."""


def build_helm(start: ShipStart, L_pp: float, ship: Component, step: float) -> Helm:
    """The helm of a ship of length L_pp [m], for a communication step [s]; with a steering if the table asks for it."""
    helm = Helm(ship.reals(ORDERS), dict(schedule_orders(start, step)), step=step)
    steering = build_steering(start, L_pp)
    if steering is None:
        return helm
    if start.evasion is not None and start.evasion.until is not None:
        helm.evades_until = find_point(start.evasion.until, step)
    helm.headings = dict(schedule_headings(start, step))
    helm.state, helm.steering = HelmState(on_route=steering.route is not None), steering
    return helm


def build_steering(start: ShipStart, L_pp: float) -> Steering | None:
    """The steering of a ship of length L_pp [m] besides its timed orders; None if the table asks for none."""
    if start.route is None and start.evasion is None and all(order.heading_deg is None for order in start.orders):
        return None
    route = None if start.route is None else _route(start.route, start, L_pp)
    return Steering(build_autopilot(start, L_pp), route, None if start.evasion is None else _evasion(start.evasion))


def build_autopilot(start: ShipStart, L_pp: float) -> Autopilot:
    """The autopilot of a ship of length L_pp [m]; gains that its table leaves out follow from length and speed."""
    table = start.autopilot or AutopilotTable()
    rate_gain = table.rate_gain
    if rate_gain is None:
        rate_gain = table.gain * RATE_GAIN * L_pp / max(hypot(*start.start.velocity[:2]), SLOWEST_STEERAGE * L_pp**0.5)
    return Autopilot(table.gain, rate_gain, table.integral_gain, radians(table.rudder_limit_deg))


def _route(table: RouteTable, start: ShipStart, L_pp: float) -> Route:
    north, east = start.start.position[:2]
    return Route(
        (north, east),
        tuple((float(n), float(e)) for n, e in table.waypoints),
        table.lookahead or LOOKAHEAD * L_pp,
        table.acceptance or ACCEPTANCE * L_pp,
    )


def _evasion(table: EvasionTable) -> Evasion:
    return Evasion(
        table.of, table.distance or 0.0, table.time_to_closest or 0.0, radians(table.rudder_deg), table.rev_per_s
    )
