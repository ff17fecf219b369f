"""The collision model's own copy of a ship, for the length of one communication step.

A state has two poses. The pose of *application* is where the ship model will apply the impulse, so there it is booked,
and momentum balances to rounding: the pose received at the start of the communication step, or for a ship that is late
(under a parallel master, impulse_ledger.py) that which she will have one step on. The *predicted* pose moves on with
the substeps and is where contact is looked for.

    nu      twist about CO in b of the pose of application, changed by impulses only
    drift   what other forces are expected to add to it, in the mean over the step; scheme_error: what it lacks to the
            twist by which energy is reckoned (other_forces.py); None: nothing
    G       = [R, -R skew(r)]              velocity of the point r (in b) in n is G nu;  (3, 6)
    J       = G^T P                        impulse P (in n) at that point, as the ship books it, in b about CO
    nu     += M^-1 J

Guan et al. 2014, equations (5)-(8), the motion of the bodies under impulses: here nu += M^-1 J.

Between impulses the velocity of CG and the angular velocity stay constant in n, as a coasting ship's do: twists turn
with the hull, seen in b.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...ship.coasting import coast_pose
from ...ship.frames import Array, rotation, skew

__all__ = ["BodyState", "point_jacobian"]


def point_jacobian(R_nb: Array, r_b: Array) -> Array:
    """G (3, 6): velocity in n of the point r_b [m] (in b from CO) is G nu; the impulse P in n is G' P in b about CO."""
    G = np.empty((3, 6))
    G[:, :3] = R_nb
    G[:, 3:] = R_nb @ skew(-r_b)
    return G


@dataclass
class BodyState:
    """A ship during a communication step. Arrays: x (3,) in n [m], R (3, 3) = R_nb, nu (6,) in b about CO, r_bg (3,)
    CG in b [m].

    M_inverse (6, 6): of the free degrees of freedom, at the pose of application.
    """

    x_applied: Array
    R_applied: Array
    x: Array
    R: Array
    nu: Array
    nu_received: Array  # (6,) the twist at the start, what was pending taken in
    M_inverse: Array
    r_bg: Array
    issued: Array  # (6,) impulse booked in this communication step, in b about CO at the pose of application
    drift: Array | None = None  # (6,)
    scheme_error: Array | None = None  # (6,)
    fixed: bool = False  # an obstacle: M_inverse is zero, and it never moves

    @classmethod
    def at(cls, position: Array, attitude: Array, nu: Array, M_inverse: Array, r_bg: Array | None = None) -> BodyState:
        """BodyState at a pose (n [m], rad) with the twist nu (b about CO); CG is CO unless r_bg tells."""
        R = rotation(attitude)
        return cls(position, R, position, R, nu, nu, M_inverse, np.zeros(3) if r_bg is None else r_bg, np.zeros(6))

    @classmethod
    def wall(cls, position: Array, heading: float) -> BodyState:
        """BodyState of an obstacle: it has no twist and takes none."""
        state = cls.at(position, np.array([0.0, 0.0, heading]), np.zeros(6), np.zeros((6, 6)))
        state.fixed = True
        return state

    def advance(self, h: float) -> None:
        """Move the predicted pose on by h [s] with the twist expected over the step."""
        self.x, self.R = self._moved(self.x, self.R, self.expected, h)

    def _moved(self, x: Array, R: Array, nu: Array, h: float) -> tuple[Array, Array]:
        v, omega = nu[:3], nu[3:]
        v_g = self.R_applied @ (v + skew(omega) @ self.r_bg) if omega.any() else self.R_applied @ v
        return coast_pose(x, R, v_g, self.R_applied @ omega, self.r_bg, h)

    def coast(self, nu: Array, h: float) -> tuple[Array, Array]:
        """Pose (x, R) h [s] after that of application, with the twist nu (6,) there."""
        return self._moved(self.x_applied, self.R_applied, nu if self.drift is None else nu + self.drift, h)

    @property
    def predicted_twist(self) -> Array:
        """The twist (6,) in b of the predicted pose."""
        return self._seen_from(self.R, self.nu)

    def apply_at(self, x: Array, R: Array, M_inverse: Array) -> None:
        """Let the ship take impulses at the pose x, R to which her motion leads, with M_inverse (6, 6) in b there."""
        self.nu = self._seen_from(R, self.nu)
        self.drift = None if self.drift is None else self._seen_from(R, self.drift)
        self.scheme_error = None if self.scheme_error is None else self._seen_from(R, self.scheme_error)
        self.x_applied, self.R_applied, self.M_inverse = x, R, M_inverse

    def _seen_from(self, R: Array, nu: Array) -> Array:
        """The twist nu (6,), in b of the pose of application, in b of a pose with R to which the motion leads."""
        if R is self.R_applied:
            return nu
        v, omega = nu[:3], nu[3:]
        back = R.T @ self.R_applied
        omega_now = back @ omega
        return np.concatenate([back @ (v + skew(omega) @ self.r_bg) - skew(omega_now) @ self.r_bg, omega_now])

    @property
    def expected(self) -> Array:
        """Mean twist (6,) over the step, other forces taken in."""
        return self.nu if self.drift is None else self.nu + self.drift

    @property
    def nu_energy(self) -> Array:
        """The twist (6,) by which energy is reckoned."""
        return self.nu if self.scheme_error is None else self.nu + self.scheme_error

    def point(self, r_b: Array) -> Array:
        """Where the point r_b [m] (in b) is at the predicted pose, in n; (3,)."""
        return self.x + self.R @ r_b

    def body(self, p_n: Array) -> Array:
        """Body coordinates [m] of the point p_n at the predicted pose; (3,)."""
        r_b: Array = self.R.T @ (p_n - self.x)
        return r_b

    def point_applied(self, r_b: Array) -> Array:
        """Where the point r_b [m] (in b) is at the pose of application, in n; (3,)."""
        return self.x_applied + self.R_applied @ r_b

    def jacobian(self, p_n: Array) -> Array:
        """G (3, 6) of the point p_n [m] (in n) at the pose of application."""
        return point_jacobian(self.R_applied, self.R_applied.T @ (p_n - self.x_applied))

    def book(self, J: Array) -> None:
        """Take the impulse J (6,) [N s, N m s] (in b about CO, pose of application): into twist and ledger."""
        self.nu = self.nu + self.M_inverse @ J
        self.issued = self.issued + J
