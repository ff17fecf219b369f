"""Who steers: a heading autopilot, a follower of waypoints, and a helmsman who evades too late.

    autopilot     delta = K_p e + K_i int e dt - K_d r,   e = heading ordered - heading, the short way round
                  limited; the integral waits while the order is at its limit
    route         heading = bearing of the leg - atan(cross-track distance / lookahead)      (line of sight)
                  the next leg from `acceptance` before its waypoint; the last leg is sailed on beyond its end
    evasion       hard over, and the engine as ordered, once the other ship is near: by distance, or by the time to the
                  closest approach

Starboard rudder is positive and turns to starboard. Pure functions: what is remembered from one communication point to
the next is the HelmState that goes in and comes out, so that a run can be repeated to the bit. Line of sight: Fossen
(2021), Handbook of Marine Craft Hydrodynamics and Motion Control, section 12.3; SI units, radians, n is north, east.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, pi, remainder, sin
from typing import NamedTuple

from ..ship.ship_state import ShipState

__all__ = [
    "Autopilot", "Evasion", "HelmState", "Route", "Steering", "closest_approach", "helmed", "line_of_sight",
    "steered",
]  # fmt: skip


@dataclass(frozen=True)
class Autopilot:
    """Gains: K_p [rad/rad], K_d [s], K_i [1/s]; the largest order [rad]."""

    gain: float
    rate_gain: float
    integral_gain: float
    rudder_limit: float


@dataclass(frozen=True)
class Route:
    """Where the legs end, north and east [m]; the first begins at `start`. Lookahead and acceptance [m]."""

    start: tuple[float, float]
    waypoints: tuple[tuple[float, float], ...]
    lookahead: float
    acceptance: float


@dataclass(frozen=True)
class Evasion:
    """From which ship, how late (one of distance [m] and time [s], the other 0), and what is ordered then.

    The distance is between the midships, the time that to the closest approach on present courses.
    """

    of: str
    distance: float
    time_to_closest: float
    rudder: float
    revolutions: float | None


@dataclass(frozen=True)
class Steering:
    """How a ship is steered besides its timed orders."""

    autopilot: Autopilot
    route: Route | None = None
    evasion: Evasion | None = None


class HelmState(NamedTuple):
    """What a helm remembers: heading ordered [rad] or None, on the route or not, its leg, integral [rad s], evading."""

    heading: float | None = None
    on_route: bool = False
    leg: int = 0
    integral: float = 0.0
    evading: bool = False


def helmed(
    steering: Steering, state: HelmState, orders: tuple[float, float], own: ShipState, other: ShipState | None, h: float
) -> tuple[tuple[float, float], HelmState]:
    """(rudder_order [rad], propeller_order [1/s]) for the next h [s], and the helm's new state.

    `orders` are those given by hand so far; `other` is the ship to evade, None when there is none.
    """
    rudder, revolutions = orders
    evasion = steering.evasion
    if evasion is not None and other is not None:
        if not state.evading and _too_near(evasion, own, other):
            state = state._replace(evading=True)
        if state.evading:
            return (evasion.rudder, revolutions if evasion.revolutions is None else evasion.revolutions), state
    wanted = state.heading
    if state.on_route and steering.route is not None:
        wanted, leg = line_of_sight(steering.route, state.leg, own)
        state = state._replace(leg=leg)
    if wanted is not None:
        rudder, integral = steered(steering.autopilot, wanted, state.integral, own, h)
        state = state._replace(integral=integral)
    return (rudder, revolutions), state


def steered(autopilot: Autopilot, wanted: float, integral: float, own: ShipState, h: float) -> tuple[float, float]:
    """Rudder order [rad] towards the heading `wanted` [rad], and the integral of the error [rad s] after h [s]."""
    error = remainder(wanted - own.heading, 2.0 * pi)
    limit = autopilot.rudder_limit
    order = autopilot.gain * error + autopilot.integral_gain * integral - autopilot.rate_gain * own.yaw_rate
    if abs(order) < limit:  # beyond, the integral would only wind up
        integral += error * h
    return min(limit, max(-limit, order)), integral


def line_of_sight(route: Route, leg: int, own: ShipState) -> tuple[float, int]:
    """Heading to steer [rad] and the leg that it is for, counted from 0."""
    while True:
        (north, east), (end_north, end_east) = (route.start, *route.waypoints)[leg : leg + 2]
        bearing = atan2(end_east - east, end_north - north)
        c, s = cos(bearing), sin(bearing)
        to_go = (end_north - own.north) * c + (end_east - own.east) * s
        if to_go >= route.acceptance or leg + 1 == len(route.waypoints):
            break
        leg += 1
    cross_track = (own.east - east) * c - (own.north - north) * s  # positive to starboard of the leg
    return bearing - atan2(cross_track, route.lookahead), leg


def closest_approach(own: ShipState, other: ShipState) -> tuple[float, float]:
    """Time to and distance at the closest approach of two midships on present courses [s, m]; negative: it is over."""
    x, y = other.north - own.north, other.east - own.east
    (own_n, own_e), (other_n, other_e) = own.plan_velocity, other.plan_velocity
    u, v = other_n - own_n, other_e - own_e
    square = u * u + v * v
    time = -(x * u + y * v) / square if square > 0.0 else 0.0
    return time, hypot(x + u * time, y + v * time)


def _too_near(evasion: Evasion, own: ShipState, other: ShipState) -> bool:
    if evasion.distance > 0.0:
        return hypot(other.north - own.north, other.east - own.east) <= evasion.distance
    time, _ = closest_approach(own, other)
    return 0.0 <= time <= evasion.time_to_closest
