"""An impulse that is applied later than it is solved: what it will do then, as felt at the pose where it is solved.

A parallel master hands impulses over one step late. By then a ship has moved on from the pose (x, R) to (x', R'), and
her inertia has turned with her. The same wrench in n, in b at either pose:

    J' = T J,    T = [[Q, 0], [R'^T skew(x - x') R, Q]],    Q = R'^T R

does d(nu') = M'^-1 J', and work J'.(nu' + d(nu')/2), with nu' her twist by then. As power does not depend on where it
is reckoned, the same work comes of J with

    M^-1 := T^T M'^-1 T        and        nu := T^T nu'

so a contact solved with these keeps the law of contact, and loses energy, as the ship will. Where the books do not
carry a wrench over (ledger.py: a body that goes far in a step), the numbers in b are applied as they are: T = 1.
"""

from __future__ import annotations

import numpy as np

from ..ship.frames import Array, skew
from .shadow import Shadow

__all__ = ["apply_late"]


def apply_late(shadow: Shadow, x: Array, R: Array, M_inverse: Array, *, carried_over: bool) -> None:
    """Let the shadow's inertia, and the twist that a contact meets, be those of a ship that takes impulses at the pose
    x (3,) [m] in n, R (3, 3) = R_nb, with the inverse inertia M_inverse (6, 6) in b there."""
    T = np.eye(6)
    if carried_over:
        T[:3, :3] = T[3:, 3:] = R.T @ shadow.R_received
        T[3:, :3] = R.T @ skew(shadow.x_received - x) @ shadow.R_received
    shadow.later = T.T @ shadow.seen_from(R, shadow.nu) - shadow.nu
    felt = T.T @ M_inverse @ T
    shadow.M_inverse = 0.5 * (felt + felt.T)
