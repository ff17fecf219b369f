"""Velocity that other forces add to a ship within a step, estimated from the step before.

A ship model applies an impulse at the start of its step. Thrust, rudder and current then act on the ship until the end
of the step. A ship that is pressed against a quay and merely stopped at every start would creep through it, by a H/2 H
per step of H. Therefore the *mean* velocity over the step is stopped:

    nu_start      = nu received + M^-1 (impulse applied in the step)         after the step has begun
    velocity_bias = mean velocity over the step - that of coasting           from the two poses received
    velocity_gain = velocity at the end - that of coasting                   all in b at the start of the step

Coasting is the motion by the ship's own law (ship/coasting_law.py): what the law knows is no other force. Contact is
detected and solved with nu + velocity_bias; where other forces act, the mean of the law is added to it. With a one-step
delay (impulse_ledger.py) an impulse meets a ship that has already gained velocity_gain: it is solved with nu +
velocity_gain.

Only ships in an open collision have a bias. The first impact is solved with the velocities as received. The bias may
reverse an approach, from -a H/2 to +a H/2, and the other forces reverse it again. passivity.py ensures that no energy
is gained.

Ship models differ in the velocity by which they move under a constant force: the mean of start and end (exact), the
start (explicit Euler) or the end (semi-implicit Euler). Energy is reckoned with the velocity of an exact model with the
same motion:

    nu_energy = nu + scheme_error,    scheme_error = velocity_bias - velocity_gain/2
    exact: 0      explicit: -a H/2      semi-implicit: +a H/2      n inner steps: 1/n of these

For an exact model the difference is a twelfth of the growth of the force in the step. It moves no ship, and an impact
would gain energy by it. Below EXACT of the gain it counts as zero.

Cost: two poses per ship in contact, and a lag of one step. A growing force lets the ship in by H^2/2 of its growth in a
step; a falling force lets it out by almost as much. Example: the force swings between zero and twice its mean in 3 s,
with H = 0.1 s. After a minute the ship is 6 mm in the quay (tests/collision/test_quay.py).
"""

from __future__ import annotations

from math import hypot, isclose
from typing import NamedTuple

import numpy as np

from ...ship.coasting_law import CoastingLaw
from ...ship.frames import Array, rotation, rotation_vector
from .chord import rotation_vector_of

__all__ = ["OtherForces", "ReceivedState", "estimate_other_forces"]

MAX_ACCELERATION = 2.0
"""Acceleration [m/s2] above which the motion between two steps is no ship's: the host has moved the ship. With a lower
limit a hard manoeuvre would be ignored, and a pressed ship would creep through a quay."""

ROUNDING = 1e-9
"""Speed [m/s] of the bias and the gain that is rounding of the poses. With zero, coasting ships would have forces."""

EXACT = 0.005
"""Share of the gain up to which bias - gain/2 is not the mark of an Euler scheme: 1/2, or 1/(2 n) of n inner steps.
With zero, an impact would gain energy by the growth of a force within the step."""


class ReceivedState(NamedTuple):
    """A ship as received at the start t [s] of a step of H [s]: pose, twist (6), impulse_applied (6); plain lists."""

    t: float
    H: float
    position: list[float]
    attitude: list[float]
    nu: list[float]
    applied: list[float]


class OtherForces(NamedTuple):
    """What other forces did to a ship in a step; (6,) each, in b at the start of the step.

    velocity_bias: mean velocity over the step less that of coasting; velocity_gain: velocity at the end less that of
    coasting; scheme_error: velocity_bias - velocity_gain/2, None for a ship model that integrates exactly.
    """

    velocity_bias: Array
    velocity_gain: Array
    scheme_error: Array | None


def estimate_other_forces(
    before: ReceivedState,
    now: ReceivedState,
    M_inverse: Array,
    r_bg: Array,
    reach: float,
    coasting: CoastingLaw | None = None,
) -> OtherForces | None:
    """Other forces in the step that `before` began and `now` ended; None where there are none to be measured.

    M_inverse (6, 6): at the attitude before; r_bg: CG in b [m]; reach: of the hull from CO [m]; coasting: the
    law of the ship, None for the straight one.
    """
    H = before.H
    if not isclose(before.t + H, now.t, rel_tol=1e-9, abs_tol=1e-6 * H):
        return None  # the host went elsewhere in time
    start = np.array(before.nu) + M_inverse @ (np.array(now.applied) - np.array(before.applied))
    R = rotation(before.attitude)
    turn = R.T @ rotation(now.attitude)
    way = R.T @ (np.array(now.position) - np.array(before.position))
    nu = np.array(now.nu)
    mean, omega_mean, v_end, omega_end = (
        _coast_straight(start, r_bg, H) if coasting is None else _coast(coasting, before, start, R, H)
    )
    bias = np.concatenate([way / H - mean, np.array(rotation_vector_of(turn.tolist())) / H - omega_mean])
    gain = np.concatenate([turn @ nu[:3] - v_end, turn @ nu[3:] - omega_end])
    bias_speed, gain_speed = _largest_speed(bias, reach), _largest_speed(gain, reach)
    if not ROUNDING < max(bias_speed, gain_speed) <= MAX_ACCELERATION * H:
        return None
    error = bias - 0.5 * gain
    return OtherForces(bias, gain, error if _largest_speed(error, reach) > EXACT * gain_speed else None)


def _coast_straight(start: Array, r_bg: Array, H: float) -> tuple[Array, Array, Array, Array]:
    """Mean velocity of CO and mean angular velocity over H [s], and both at the end, in b at the start."""
    v, omega = start[:3], start[3:]
    v_bg, E = np.cross(omega, r_bg), rotation_vector(omega * H)
    return v + v_bg + (r_bg - E @ r_bg) / H, omega, v + v_bg - E @ v_bg, omega


def _coast(
    law: CoastingLaw, before: ReceivedState, start: Array, R: Array, H: float
) -> tuple[Array, Array, Array, Array]:
    """The same for a ship's law. R (3, 3): R_nb before."""
    nu = start.tolist()
    position, attitude, velocity, rate = law.coast(before.position, before.attitude, nu[:3], nu[3:], H)
    turn = R.T @ rotation(attitude)
    way = R.T @ (np.array(position) - np.array(before.position))
    return way / H, np.array(rotation_vector_of(turn.tolist())) / H, turn @ velocity, turn @ rate


def _largest_speed(nu: Array, reach: float) -> float:
    """No point of the hull moves faster [m/s]."""
    return hypot(*nu[:3].tolist()) + reach * hypot(*nu[3:].tolist())
