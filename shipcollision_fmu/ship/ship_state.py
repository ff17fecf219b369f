"""The pose and the twist of a ship, in one value."""

from __future__ import annotations

from math import cos, sin
from typing import NamedTuple

import numpy as np

from .frames import Array, rotation

__all__ = ["ShipState"]

Three = tuple[float, float, float]


class ShipState(NamedTuple):
    """eta and nu of a ship, as twelve numbers in the order of states.csv; frames.py has the frames.

    north, east, down                  CO in n [m]
    roll, pitch, heading               zyx Euler angles [rad]; the heading is not wrapped
    surge, sway, heave                 velocity of CO over ground, in b [m/s]
    roll_rate, pitch_rate, yaw_rate    angular velocity, in b [rad/s]
    """

    north: float
    east: float
    down: float
    roll: float
    pitch: float
    heading: float
    surge: float
    sway: float
    heave: float
    roll_rate: float
    pitch_rate: float
    yaw_rate: float

    @classmethod
    def upright(
        cls, north: float, east: float, heading: float, surge: float = 0.0, sway: float = 0.0, yaw_rate: float = 0.0
    ) -> ShipState:
        """State of a ship that floats upright and moves in the plane."""
        return cls(north, east, 0.0, 0.0, 0.0, heading, surge, sway, 0.0, 0.0, 0.0, yaw_rate)

    @property
    def position(self) -> Three:
        """CO in n [m]."""
        return self[:3]

    @property
    def attitude(self) -> Three:
        """(phi, theta, psi) [rad]."""
        return self[3:6]

    @property
    def velocity(self) -> Three:
        """(u, v, w) of CO over ground, in b [m/s]."""
        return self[6:9]

    @property
    def rate(self) -> Three:
        """(p, q, r), in b [rad/s]."""
        return self[9:]

    @property
    def R_nb(self) -> Array:
        """Rotation matrix (3, 3) from b to n."""
        return rotation(self.attitude)

    @property
    def plan_velocity(self) -> tuple[float, float]:
        """(north, east) [m/s] of CO, from surge and sway; heel, trim and heave are left out."""
        c, s = cos(self.heading), sin(self.heading)
        return self.surge * c - self.sway * s, self.surge * s + self.sway * c

    def velocity_at(self, r_b: Array) -> Array:
        """Velocity R_nb (v + omega x r_b) [m/s] of the point r_b [m] (in b), in n; (3,)."""
        v: Array = self.R_nb @ (np.array(self.velocity) + np.cross(self.rate, r_b))
        return v
