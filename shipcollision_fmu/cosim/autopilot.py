"""Heading autopilot.

    delta = K_p e + K_i int e dt - K_d r        limited to +- delta_max

    e      heading ordered - heading, the short way round [rad]
    r      yaw rate [rad/s]
    delta  rudder order [rad]; starboard rudder is positive and turns to starboard

The integral waits while the order is at its limit.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, remainder

from ..ship.ship_state import ShipState

__all__ = ["Autopilot", "steer_heading"]


@dataclass(frozen=True)
class Autopilot:
    """Gains K_p [rad/rad], K_d [s], K_i [1/s], and delta_max, the limit of the order [rad]."""

    gain: float
    rate_gain: float
    integral_gain: float
    rudder_limit: float


def steer_heading(
    autopilot: Autopilot, heading: float, integral: float, own: ShipState, h: float
) -> tuple[float, float]:
    """Rudder order [rad] towards the ordered `heading` [rad], and the integral of the error [rad s] after h [s]."""
    error = remainder(heading - own.heading, 2.0 * pi)
    limit = autopilot.rudder_limit
    order = autopilot.gain * error + autopilot.integral_gain * integral - autopilot.rate_gain * own.yaw_rate
    if abs(order) < limit:  # beyond the limit the integral would only wind up
        integral += error * h
    return min(limit, max(-limit, order)), integral
