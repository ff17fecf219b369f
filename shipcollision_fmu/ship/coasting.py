"""The motion of a ship on which nothing acts: the velocity of CG and the angular velocity stay constant in n.

    s   = omega x r_bg       v_g = v + s       velocity of CG relative to CO, and over ground [m/s], in b
    E   = exp(h skew(omega))                   rotation of the hull in h [s] about omega, constant in b as well
    x'  = x + R (h v_g + r_bg - E r_bg)        place of CO [m], in n
    R'  = R E                                  R = R_nb
    v'  = E^T v_g - s                          velocity of CO, in b

Exact for any h. This is the world of Guan et al. (2014): added mass counts when an impulse is taken, and nothing acts
on the ship afterwards.

`coast` serves the ship model and the far step of the collision model, `coast_pose` a body of the collision model among
its substeps. Both rest on `_displace`. All are in plain numbers: arrays of three cost five times as much, and the last
bit of a matrix product depends on the machine's linear algebra library.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import asin, atan2, cos, hypot, pi, sin, sqrt

import numpy as np

from .frames import Array

__all__ = ["coast", "coast_pose"]

Three = tuple[float, float, float]


def coast(
    position: Sequence[float],
    attitude: Sequence[float],
    velocity: Sequence[float],
    rate: Sequence[float],
    r_bg: Sequence[float],
    h: float,
) -> tuple[Sequence[float], Sequence[float], Sequence[float]]:
    """(position [m] in n, attitude [rad], velocity [m/s] in b) of CO after h [s]; the rate in b stays as it is.

    velocity, rate: in b about CO. r_bg: CG in b [m]. The heading has no jumps, and counts whole turns.
    """
    x, y, z = position
    phi, theta, psi = attitude
    p, q, r = rate
    is_straight = p == 0.0 == q and r == 0.0
    if is_straight and phi == 0.0 == theta:  # most ships in most steps
        u, v, w = velocity
        c, s = cos(psi), sin(psi)
        return (x + (c * (h * u) - s * (h * v)), y + (s * (h * u) + c * (h * v)), z + h * w), attitude, velocity
    cphi, sphi, cth, sth, cpsi, spsi = cos(phi), sin(phi), cos(theta), sin(theta), cos(psi), sin(psi)
    row_n = (cpsi * cth, cpsi * sth * sphi - spsi * cphi, spsi * sphi + cpsi * cphi * sth)
    row_e = (spsi * cth, cpsi * cphi + sphi * sth * spsi, sth * spsi * cphi - cpsi * sphi)
    row_d = (-sth, cth * sphi, cth * cphi)
    if is_straight:  # attitude and velocity of a straight course stay to the bit
        u, v, w = velocity
        shift = (h * u, h * v, h * w)
        return (x + _dot(row_n, shift), y + _dot(row_e, shift), z + _dot(row_d, shift)), attitude, velocity
    arm = _cross(rate, r_bg)
    v_g = (velocity[0] + arm[0], velocity[1] + arm[1], velocity[2] + arm[2])
    shift, (forward, starboard, down) = _displace(v_g, rate, r_bg, h)
    place = (x + _dot(row_n, shift), y + _dot(row_e, shift), z + _dot(row_d, shift))
    after = (_dot(forward, v_g) - arm[0], _dot(starboard, v_g) - arm[1], _dot(down, v_g) - arm[2])
    if p == 0.0 and q == 0.0 and phi == 0.0 and theta == 0.0:
        return place, (phi, theta, psi + h * r), after
    r_20, r_21, r_22 = _dot(row_d, forward), _dot(row_d, starboard), _dot(row_d, down)
    pitch = asin(min(1.0, max(-1.0, -r_20)))
    if hypot(r_21, r_22) < 1e-12:  # bow straight up or down: roll and yaw are one angle; call it yaw
        roll, yaw = 0.0, atan2(-_dot(row_n, starboard), _dot(row_e, starboard))
    else:
        roll, yaw = atan2(r_21, r_22), atan2(_dot(row_e, forward), _dot(row_n, forward))
    expected = psi + h * _dot(row_d, rate)  # turn about the vertical: more than half a turn in h is counted
    return place, (roll, pitch, yaw + 2 * pi * round((expected - yaw) / (2 * pi))), after


def coast_pose(x: Array, R: Array, v_g_n: Array, omega_n: Array | None, r_bg: Array, h: float) -> tuple[Array, Array]:
    """Place of CO [m] (3,) and R_nb (3, 3) after h [s], from x (3,) and R (3, 3).

    v_g_n, omega_n: velocity of CG [m/s] and angular velocity [rad/s] in n, None for zero. r_bg: CG in b [m].
    """
    if omega_n is None:
        return x + h * v_g_n, R
    shift, columns = _displace((v_g_n @ R).tolist(), (omega_n @ R).tolist(), r_bg.tolist(), h)
    return x + R @ np.array(shift), R @ np.array(columns).T


def _displace(
    v_g: Sequence[float], omega: Sequence[float], r_bg: Sequence[float], h: float
) -> tuple[Three, tuple[Three, Three, Three]]:
    """(h v_g + r_bg - E r_bg [m], columns of E), all in b at the start. E by Rodrigues' formula, as rotation_vector."""
    a, b, c = h * omega[0], h * omega[1], h * omega[2]
    angle = sqrt(a * a + b * b + c * c)
    f = 1.0 if angle < 1e-8 else sin(angle) / angle  # below 1e-8 rad the series is exact to rounding
    g = 0.5 if angle < 1e-8 else 2.0 * (sin(0.5 * angle) / angle) ** 2
    forward = (1.0 - g * (b * b + c * c), g * a * b + f * c, g * a * c - f * b)
    starboard = (g * a * b - f * c, 1.0 - g * (a * a + c * c), g * b * c + f * a)
    down = (g * a * c + f * b, g * b * c - f * a, 1.0 - g * (a * a + b * b))
    x, y, z = r_bg
    shift = (
        h * v_g[0] + x - (forward[0] * x + starboard[0] * y + down[0] * z),
        h * v_g[1] + y - (forward[1] * x + starboard[1] * y + down[1] * z),
        h * v_g[2] + z - (forward[2] * x + starboard[2] * y + down[2] * z),
    )
    return shift, (forward, starboard, down)


def _cross(p: Sequence[float], q: Sequence[float]) -> Three:
    return p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]


def _dot(p: Sequence[float], q: Sequence[float]) -> float:
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
