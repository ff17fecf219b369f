"""Where a ship will be when nothing touches her, in plain numbers: most steps are that, and arrays would cost more.

    x + h R_nb v,      R_nb exp(h skew(omega))          v, omega constant in b over the step

The same as shadow.py's advance, of which it is the short way.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import asin, atan2, cos, hypot, pi, sin, sqrt

__all__ = ["pose_ahead"]

Three = tuple[float, float, float]


def pose_ahead(
    position: Sequence[float], attitude: Sequence[float], velocity: Sequence[float], rate: Sequence[float], h: float
) -> tuple[Three, Three]:
    """(position [m] in n, attitude [rad], heading without jumps) after h [s]; velocity and rate in b."""
    x, y, z = position
    phi, theta, psi = attitude
    u, v, w = velocity
    a, b, c = h * rate[0], h * rate[1], h * rate[2]
    cphi, sphi, cth, sth, cpsi, spsi = cos(phi), sin(phi), cos(theta), sin(theta), cos(psi), sin(psi)
    row_n = (cpsi * cth, cpsi * sth * sphi - spsi * cphi, spsi * sphi + cpsi * cphi * sth)
    row_e = (spsi * cth, cpsi * cphi + sphi * sth * spsi, sth * spsi * cphi - cpsi * sphi)
    row_d = (-sth, cth * sphi, cth * cphi)
    place = (
        x + h * (row_n[0] * u + row_n[1] * v + row_n[2] * w),
        y + h * (row_e[0] * u + row_e[1] * v + row_e[2] * w),
        z + h * (row_d[0] * u + row_d[1] * v + row_d[2] * w),
    )
    if a == 0.0 and b == 0.0 and c == 0.0:
        return place, (phi, theta, psi)
    if a == 0.0 and b == 0.0 and phi == 0.0 and theta == 0.0:
        return place, (phi, theta, psi + c)
    angle = sqrt(a * a + b * b + c * c)
    f = 1.0 if angle < 1e-8 else sin(angle) / angle
    g = 0.5 if angle < 1e-8 else 2.0 * (sin(0.5 * angle) / angle) ** 2
    forward = (1.0 - g * (b * b + c * c), g * a * b + f * c, g * a * c - f * b)  # columns of exp(skew)
    starboard = (g * a * b - f * c, 1.0 - g * (a * a + c * c), g * b * c + f * a)
    down = (g * a * c + f * b, g * b * c - f * a, 1.0 - g * (a * a + b * b))
    r_20, r_21, r_22 = _dot(row_d, forward), _dot(row_d, starboard), _dot(row_d, down)
    pitch = asin(min(1.0, max(-1.0, -r_20)))
    if hypot(r_21, r_22) < 1e-12:  # bow straight up or down: roll and yaw are one angle; call it yaw
        roll, yaw = 0.0, atan2(-_dot(row_n, starboard), _dot(row_e, starboard))
    else:
        roll, yaw = atan2(r_21, r_22), atan2(_dot(row_e, forward), _dot(row_n, forward))
    return place, (roll, pitch, yaw + 2 * pi * round((psi - yaw) / (2 * pi)))


def _dot(p: Three, q: Three) -> float:
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
