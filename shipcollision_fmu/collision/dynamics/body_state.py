"""The collision model's own copy of a ship or an obstacle, for the length of one communication step.

A body has two poses in a step:

    pose of application    where the ship model will apply the impulse. Impulses are solved and booked there, so that
                           momentum balances to rounding. It is the pose received at the start of the step. For a ship
                           with a one-step delay (impulse_ledger.py) it is the expected pose one step later.
    predicted pose         moves on with the substeps. Contact is detected there.

Symbols:

    nu              twist about CO in b of the pose of application; changed by impulses only
    velocity_bias   what other forces are expected to add to nu, in the mean over the step (other_forces.py)
    path_bias       what the mean motion over the step has beside, by the law of the ship (ship/coasting_law.py)
    scheme_error    what nu lacks to the twist of an exact integration, with which energy is reckoned (other_forces.py)
    J               impulse (6,) in b about CO at the pose of application [N s, N m s];    nu += M^-1 J

Guan et al. 2014, equations (5)-(8), the motion of the bodies under impulses: here nu += M^-1 J.

Between impulses a body moves by its law of coasting (ship/coasting_law.py). Within a communication step the predicted
pose follows the chord of that motion: the constant twist in n (ship/coasting.py) that ends in the same pose. Impacts
are solved with nu, so that their energy is right. A ship on which other forces act is solved with the mean over the
step, in which the law takes part.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from ...ship.coasting import coast_pose
from ...ship.frames import Array, rotation, skew
from .chord import find_chord
from .other_forces import OtherForces

__all__ = ["NOTHING", "BodyState", "advance_bodies"]

Seq = Sequence[float]

Motion = tuple[Array, Array | None]
"""Velocity of CG [m/s] and angular velocity [rad/s] (3,), both in n; None for a body that does not turn."""

NOTHING: Array = np.zeros(6)
"""No impulse. It is told by its identity: to look for a number that is not zero costs more."""
NOTHING.flags.writeable = False

_NO_TURN = [0.0, 0.0, 0.0]


@dataclass
class BodyState:
    """A body during a communication step. Arrays: x (3,) in n [m], R (3, 3) = R_nb, nu (6,) in b about CO, r_bg (3,)
    CG in b [m].

    M_inverse (6, 6): of the free degrees of freedom, at the pose of application. nu_received: the twist at the start of
    the step, with pending impulses. nu_mean: nu + velocity_bias, with which contact is solved. nu_path: nu_mean +
    path_bias, which moves the predicted pose. nu_energy: nu + scheme_error. Call `set_twist` to change nu: it keeps the
    sums in step.
    """

    x_applied: Array
    R_applied: Array
    x: Array
    R: Array
    nu: Array
    nu_received: Array
    M_inverse: Array
    r_bg: Array
    issued: Array  # (6,) impulse booked in this communication step, in b about CO at the pose of application
    velocity_bias: Array | None = None  # (6,)
    scheme_error: Array | None = None  # (6,)
    path_bias: Array | None = None  # (6,)
    end_gain: Array | None = None  # (6,) in b at the end of the step: what the law adds to nu by then
    fixed: bool = False  # an obstacle: M_inverse is zero, and the pose never changes
    held: Array | None = None  # (3, 3) degrees_of_freedom.held_mobility; None where no motion is held
    pose_before: tuple[Array, Array] = field(init=False)  # the predicted pose before it was last advanced
    nu_mean: Array = field(init=False)
    nu_path: Array = field(init=False)
    nu_energy: Array = field(init=False)

    def __post_init__(self) -> None:
        self.pose_before = self.x, self.R
        self.set_twist(self.nu)

    @classmethod
    def at(
        cls, position: Array, attitude: Seq | Array, nu: Array, M_inverse: Array, r_bg: Array | None = None,
        held: Array | None = None,
    ) -> BodyState:  # fmt: skip
        """State at a pose (n [m], rad) with the twist nu (b about CO). Without r_bg, CG is CO."""
        R, centre = rotation(attitude), np.zeros(3) if r_bg is None else r_bg
        return cls(position, R, position, R, nu, nu, M_inverse, centre, NOTHING, held=held)

    @classmethod
    def wall(cls, position: Array, heading: float) -> BodyState:
        """State of an obstacle: the twist is zero, and M^-1 = 0 keeps it so."""
        state = cls.at(position, np.array([0.0, 0.0, heading]), np.zeros(6), np.zeros((6, 6)))
        state.fixed = True
        return state

    # -- twist ----------------------------------------------------------------------------------------

    def set_twist(self, nu: Array) -> None:
        """Set nu (6,), and the twists that follow from it."""
        self.nu = nu
        self.nu_mean = nu if self.velocity_bias is None else nu + self.velocity_bias
        self.nu_path = self.nu_mean if self.path_bias is None else self.nu_mean + self.path_bias
        self.nu_energy = nu if self.scheme_error is None else nu + self.scheme_error
        self._motion: Motion | None = None

    def expect(self, forces: OtherForces) -> None:
        """Take in what other forces are expected to do in the step."""
        self.velocity_bias, self.scheme_error = forces.velocity_bias, forces.scheme_error
        self.set_twist(self.nu)

    def follow(self, end: tuple[Seq, Seq, Seq, Seq], start: Seq, H: float) -> None:
        """Take in where the law leads in a step of H [s]: position [m], attitude [rad], velocity and rate in b there.

        start: the twist (6,) at the pose of application from which it leads there. Take in other forces before.
        """
        position, attitude, velocity, rate = end
        pose = self.x_applied.tolist(), self.R_applied.tolist()
        chord, carried = find_chord(pose, position, attitude, self.r_bg.tolist(), start, H)
        bias = np.array(chord) - start
        if self.velocity_bias is None:
            self.path_bias = bias
        else:
            self.velocity_bias = self.velocity_bias + bias
        self.end_gain = np.array((*velocity, *rate)) - carried
        self.set_twist(self.nu)

    def book(self, impulses: Sequence[Array]) -> None:
        """Add impulses J (6,) to the twist, and to what is issued in this step."""
        nu, issued = self.nu, self.issued
        for J in impulses:
            nu = nu + self.M_inverse @ J
            issued = issued + J
        self.set_twist(nu)
        self.issued = issued

    def twist_at_predicted_pose(self) -> Array:
        """nu (6,) in b of the predicted pose, at the end of the step."""
        nu = self._carry_twist(self.R, self.nu)
        return nu if self.end_gain is None else nu + self.end_gain

    # -- pose -----------------------------------------------------------------------------------------

    def advance(self, h: float, substeps: int = 1) -> None:
        """Move the predicted pose on by so many substeps of h [s], along the chord of the step."""
        for _ in range(substeps):
            self.pose_before = self.x, self.R
            self.x, self.R = self.predict_pose(h)

    def predict_pose(self, h: float) -> tuple[Array, Array]:
        """Pose (x, R) h [s] after the predicted pose, along the chord of the step."""
        return coast_pose(self.x, self.R, *self.predicted_motion(), self.r_bg, h)

    def predicted_motion(self) -> Motion:
        """Velocity of CG [m/s] and angular velocity [rad/s] of the predicted pose, in n."""
        if self._motion is None:
            self._motion = self._motion_of(self.nu_path)
        return self._motion

    def pose_after(self, nu: Array, h: float) -> tuple[Array, Array]:
        """Pose (x, R) h [s] after the pose of application, with the twist nu (6,) there and the expected bias."""
        for bias in (self.velocity_bias, self.path_bias):
            nu = nu if bias is None else nu + bias
        return coast_pose(self.x_applied, self.R_applied, *self._motion_of(nu), self.r_bg, h)

    def apply_at(self, x: Array, R: Array, M_inverse: Array) -> None:
        """Move the pose of application to x, R, to which the motion leads. M_inverse (6, 6): in b there."""
        nu = self._carry_twist(R, self.nu)
        if self.velocity_bias is not None:
            self.velocity_bias = self._carry_twist(R, self.velocity_bias)
        if self.scheme_error is not None:
            self.scheme_error = self._carry_twist(R, self.scheme_error)
        if self.end_gain is not None:
            nu = nu + self.end_gain
            path = np.zeros(6) if self.path_bias is None else self._carry_twist(R, self.path_bias)
            self.path_bias, self.end_gain = path - self.end_gain, None
        self.x_applied, self.R_applied, self.M_inverse = x, R, M_inverse
        self.set_twist(nu)

    def _motion_of(self, nu: Array) -> Motion:
        """Velocity of CG [m/s] and angular velocity [rad/s] in n of a twist nu (6,) at the pose of application."""
        v, omega = nu[:3], nu[3:]
        if omega.tolist() == _NO_TURN:
            return self.R_applied @ v, None
        return self.R_applied @ (v + skew(omega) @ self.r_bg), self.R_applied @ omega

    def _carry_twist(self, R: Array, nu: Array) -> Array:
        """The twist nu (6,), in b of the pose of application, in b of a pose with R to which the motion leads."""
        if R is self.R_applied:
            return nu
        v, omega = nu[:3], nu[3:]
        back = R.T @ self.R_applied
        omega_now = back @ omega
        return np.concatenate([back @ (v + skew(omega) @ self.r_bg) - skew(omega_now) @ self.r_bg, omega_now])

    def in_body(self, p_n: Array) -> Array:
        """Body coordinates [m] of the point p_n (in n) at the predicted pose; (3,)."""
        r_b: Array = self.R.T @ (p_n - self.x)
        return r_b


def advance_bodies(states: Iterable[BodyState], h: float, substeps: int = 1) -> None:
    """Move the predicted poses of several bodies on by so many substeps of h [s]."""
    for state in states:
        state.advance(h, substeps)
