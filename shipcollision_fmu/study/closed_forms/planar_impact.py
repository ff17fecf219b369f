"""PlanarImpacts: impacts of two ships in plan at one point, as all the closed forms take them.

    direction d of a unit impulse, arm r from the ship's axis of sway and yaw, both in the ship's b

    w(d, d') = d_x d'_x / M_x + d_y d'_y / M_y + (r x d) (r x d') / J_z          [1/kg]
    D_xi     = sum of w(n, n)       K_eta = sum of w(t, t)       D_eta = K_xi = sum of w(n, t)      over both ships
    xi_0     = v . n                eta_0 = v . t                v: own against target at the point [m/s]

The tangent t is the normal n turned by 90 degrees to starboard. Names are those of Pedersen and Zhang (1998).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...ship.frames import Array
from ...ship.ship import Ship

__all__ = ["PlanarImpacts", "PlanarShips", "turn"]


@dataclass(frozen=True, eq=False)
class PlanarShips:
    """One ship for each impact: M_x, M_y [kg] and J_z [kg m2] with added mass (n,).

    x: the point on the centre line, forward of CO [m], about which a sway force makes no yaw.
    """

    M_x: Array
    M_y: Array
    J_z: Array
    x: Array

    @classmethod
    def of(cls, ships: list[Ship]) -> PlanarShips:
        """The ships with their own inertia.

        M is symmetric about the centre line, so that sway and yaw are uncoupled about x = M_26/M_22 with
        J_z = M_66 - M_26^2/M_22.
        """
        M = np.array([ship.M for ship in ships])
        M_y, coupling = M[:, 1, 1], M[:, 1, 5]
        return cls(M[:, 0, 0], M_y, M[:, 5, 5] - coupling**2 / M_y, coupling / M_y)

    def mobility(self, arm: Array, d: Array, other: Array) -> Array:
        """w(d, other) [1/kg] (n,), of an arm [m] from `x` and two directions, (n, 2) in b."""
        return (
            d[:, 0] * other[:, 0] / self.M_x + d[:, 1] * other[:, 1] / self.M_y
            + _cross(arm, d) * _cross(arm, other) / self.J_z
        )  # fmt: skip


@dataclass(frozen=True, eq=False)
class PlanarImpacts:
    """Impacts of own ships on targets, n of them.

    angle                     heading of own less that of the target [rad]
    own_point, target_point   the point of contact in each ship's b, from CO [m] (n, 2)
    own_motion, target_motion   surge [m/s], sway [m/s], yaw rate [rad/s] (n, 3) in each ship's b about CO
    normal                    unit normal from own to the target, in the target's b (n, 2)
    friction                  Coulomb's coefficient (n,)
    """

    own: PlanarShips
    target: PlanarShips
    angle: Array
    own_point: Array
    target_point: Array
    own_motion: Array
    target_motion: Array
    normal: Array
    friction: Array

    @property
    def tangent(self) -> Array:
        """t (n, 2), in the target's b."""
        return np.stack([-self.normal[:, 1], self.normal[:, 0]], axis=1)

    @property
    def velocity(self) -> Array:
        """Velocity of own against the target at the point of contact [m/s] (n, 2), in the target's b."""
        own = _velocity_at(self.own_motion, self.own_point)
        return turn(own, self.angle) - _velocity_at(self.target_motion, self.target_point)

    @property
    def closing(self) -> Array:
        """xi_0 [m/s] (n,): positive where the ships close."""
        closing: Array = np.sum(self.velocity * self.normal, axis=1)
        return closing

    @property
    def slip(self) -> Array:
        """eta_0 [m/s] (n,)."""
        slip: Array = np.sum(self.velocity * self.tangent, axis=1)
        return slip

    def mobility(self, d: Array, other: Array) -> Array:
        """w(d, other) of both ships [1/kg] (n,), of two directions (n, 2) in the target's b."""
        own = self.own.mobility(
            _arm(self.own_point, self.own.x), turn(d, -self.angle), turn(other, -self.angle)
        )  # fmt: skip
        return own + self.target.mobility(_arm(self.target_point, self.target.x), d, other)


def turn(d: Array, angle: Array) -> Array:
    """Vectors (n, 2) of one ship's b in that of a ship from which the first is turned by the angle [rad] (n,)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * d[:, 0] - s * d[:, 1], s * d[:, 0] + c * d[:, 1]], axis=1)


def _arm(point: Array, x: Array) -> Array:
    return np.stack([point[:, 0] - x, point[:, 1]], axis=1)


def _cross(a: Array, b: Array) -> Array:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _velocity_at(motion: Array, point: Array) -> Array:
    """Velocity [m/s] (n, 2) of a ship's points, in its b."""
    u, v, r = motion.T
    return np.stack([u - r * point[:, 1], v + r * point[:, 0]], axis=1)
