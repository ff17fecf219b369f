"""How a ship's other forces move it within a step: seen in the last one, expected of the next.

A ship applies an impulse at the start of its step; thrust, rudder and current then push it on. Held against a quay, a
ship that is merely stopped at every start creeps through it, by 1/2 a H in every step of H. So what is stopped is the
*mean* velocity over the step:

    nu_start = nu received + M^-1 (impulse applied in the step)            after the step has begun
    drift    = mean velocity over the step - that of coasting on           from the two poses received
    gain     = velocity at its end - that of coasting on                   all in b at the step's start

Coasting on: CG straight ahead and CO round it. What is left is the work of forces.

and contact is looked for, and solved, with nu + drift. Under a parallel master an impulse is applied one step after it
was issued, to a ship that has gained speed by then: nu + gain is the velocity that it will meet. The drift is measured
where it acts, from poses. It is looked at only for ships that are in a collision: a first impact is solved with the
velocities as they are. An answer with drift may turn an approach round (from -a H/2 to +a H/2, which the other forces
turn back); that it never adds energy is seen to where it is booked (passivity.py).

Ships' models differ in what they move by under a constant force: the mean of the velocities at both ends of a step
(exact), the one at its start (explicit Euler) or at its end (semi-implicit). Energy is reckoned with the velocity that
an exact model would have, moving alike:

    nu nu_energy = nu + mean - gain/2                        exact: nu; explicit: nu - a H/2; semi-implicit: nu + a H/2

A scheme of n inner steps is 1/n as far off. Of an exact model mean - gain/2 is not nil either, but a twelfth of what
the force grew by in the step: that moves no ship, and in an impact energy would be gained by it. Below EXACT of the
gain it counts as nil: all that coasting ships have of it, and no scheme of less than a hundred inner steps.

What it costs: two poses per ship in contact, and one step of lag. A force that grows in a step lets the ship in by
1/2 H^2 of its growth; when it falls the ship comes out by almost as much: under one that swings between nothing and
twice its mean, in 3 s, a ship at the quay is 6 mm in after a minute of H = 0.1 s (tests/collision/test_quay.py).
"""

from __future__ import annotations

from math import asin, hypot, isclose
from typing import NamedTuple

import numpy as np

from ...ship.frames import Array, rotation, rotation_vector

__all__ = ["Drift", "ReceivedState", "drift"]

MOST = 2.0
"""Acceleration [m/s2] above which the motion between two steps is not a ship's (it was put elsewhere): no drift."""

LEAST = 1e-9
"""Drift [m/s] below which there is none: rounding of the poses."""


EXACT = 0.005
"""Share of the gain below which mean - gain/2 is not the mark of an Euler scheme (1/2, of n inner steps 1/(2 n))."""


class ReceivedState(NamedTuple):
    """A ship as received at the start t [s] of a step of H [s]: pose, twist (6), impulse_applied (6); plain lists."""

    t: float
    H: float
    position: list[float]
    attitude: list[float]
    nu: list[float]
    applied: list[float]


class Drift(NamedTuple):
    """What other forces did to a ship in a step, in the mean and by its end; (6,) each, in b at the step's start.

    scheme_error: by how much the received twist (6,) falls short of that of a model that moves alike and is exact; None
    for one that is.
    """

    mean: Array
    gain: Array
    scheme_error: Array | None


def drift(before: ReceivedState, now: ReceivedState, M_inverse: Array, r_bg: Array, reach: float) -> Drift | None:
    """Of the step that `before` began and `now` ended, M_inverse at the attitude before; None where there is nothing to
    be seen."""
    H = before.H
    if not isclose(before.t + H, now.t, rel_tol=1e-9, abs_tol=1e-6 * H):
        return None  # the host went elsewhere in time
    start = np.array(before.nu) + M_inverse @ (np.array(now.applied) - np.array(before.applied))
    R = rotation(before.attitude)
    turn = R.T @ rotation(now.attitude)
    v, omega = start[:3], start[3:]
    v_bg, coasted = np.cross(omega, r_bg), rotation_vector(omega * H)
    mean_v = v + v_bg + (r_bg - coasted @ r_bg) / H  # of CO, coasting
    moved = R.T @ (np.array(now.position) - np.array(before.position))
    mean = np.concatenate([moved / H - mean_v, _turned(turn) / H - omega])
    nu = np.array(now.nu)
    gain = np.concatenate([turn @ nu[:3] - (v + v_bg - coasted @ v_bg), turn @ nu[3:] - omega])
    moved_on, sped_up = _speed(mean, reach), _speed(gain, reach)
    if moved_on > MOST * H or sped_up > MOST * H or max(moved_on, sped_up) <= LEAST:
        return None
    scheme_error = mean - 0.5 * gain
    return Drift(mean, gain, scheme_error if _speed(scheme_error, reach) > EXACT * sped_up else None)


def _speed(nu: Array, reach: float) -> float:
    """No point of the hull moves faster [m/s]."""
    return hypot(*nu[:3].tolist()) + reach * hypot(*nu[3:].tolist())


def _turned(R: Array) -> Array:
    """Rotation vector [rad] of a rotation by less than a quarter turn."""
    x, y, z = R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]
    s = 0.5 * hypot(x, y, z)
    factor = 0.5 if s < 1e-9 else 0.5 * asin(min(1.0, s)) / s
    return factor * np.array([x, y, z])
