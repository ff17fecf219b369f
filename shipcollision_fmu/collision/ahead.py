"""Where a ship will be when nothing touches her, in plain numbers: most steps are that, and arrays would cost more.

    v_g = v + omega x r_bg        velocity of CG, constant in n, as is omega        E = exp(h skew(omega))

    position + R_nb (h v_g + r_bg - E r_bg)         R_nb E          velocity E' v_g - omega x r_bg

The same as body_state.py's advance, of which it is the short way.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import asin, atan2, cos, hypot, pi, sin, sqrt

__all__ = ["state_ahead"]

Three = tuple[float, float, float]


def state_ahead(
    position: Sequence[float],
    attitude: Sequence[float],
    velocity: Sequence[float],
    rate: Sequence[float],
    r_bg: Sequence[float],
    h: float,
) -> tuple[Sequence[float], Sequence[float], Sequence[float]]:
    """(position [m] in n, attitude [rad], heading without jumps, velocity [m/s] in b) after h [s]; the rate stays.

    velocity and rate in b about CO; r_bg: CG in b [m].
    """
    x, y, z = position
    phi, theta, psi = attitude
    u, v, w = velocity
    p, q, r = rate
    cphi, sphi, cth, sth, cpsi, spsi = cos(phi), sin(phi), cos(theta), sin(theta), cos(psi), sin(psi)
    row_n = (cpsi * cth, cpsi * sth * sphi - spsi * cphi, spsi * sphi + cpsi * cphi * sth)
    row_e = (spsi * cth, cpsi * cphi + sphi * sth * spsi, sth * spsi * cphi - cpsi * sphi)
    row_d = (-sth, cth * sphi, cth * cphi)
    if p == 0.0 and q == 0.0 and r == 0.0:
        moved = (h * u, h * v, h * w)
        return (x + _dot(row_n, moved), y + _dot(row_e, moved), z + _dot(row_d, moved)), attitude, velocity
    g_x, g_y, g_z = r_bg
    s_x, s_y, s_z = q * g_z - r * g_y, r * g_x - p * g_z, p * g_y - q * g_x  # omega x r_bg
    v_g = (u + s_x, v + s_y, w + s_z)
    forward, starboard, down = _turn(h * p, h * q, h * r)  # columns of E
    moved = (
        h * v_g[0] + g_x - (forward[0] * g_x + starboard[0] * g_y + down[0] * g_z),
        h * v_g[1] + g_y - (forward[1] * g_x + starboard[1] * g_y + down[1] * g_z),
        h * v_g[2] + g_z - (forward[2] * g_x + starboard[2] * g_y + down[2] * g_z),
    )
    place = (x + _dot(row_n, moved), y + _dot(row_e, moved), z + _dot(row_d, moved))
    after = (_dot(forward, v_g) - s_x, _dot(starboard, v_g) - s_y, _dot(down, v_g) - s_z)
    if p == 0.0 and q == 0.0 and phi == 0.0 and theta == 0.0:
        return place, (phi, theta, psi + h * r), after
    r_20, r_21, r_22 = _dot(row_d, forward), _dot(row_d, starboard), _dot(row_d, down)
    pitch = asin(min(1.0, max(-1.0, -r_20)))
    if hypot(r_21, r_22) < 1e-12:  # bow straight up or down: roll and yaw are one angle; call it yaw
        roll, yaw = 0.0, atan2(-_dot(row_n, starboard), _dot(row_e, starboard))
    else:
        roll, yaw = atan2(r_21, r_22), atan2(_dot(row_e, forward), _dot(row_n, forward))
    return place, (roll, pitch, yaw + 2 * pi * round((psi - yaw) / (2 * pi))), after


def _turn(a: float, b: float, c: float) -> tuple[Three, Three, Three]:
    """Columns of the rotation by the vector (a, b, c) [rad]."""
    angle = sqrt(a * a + b * b + c * c)
    f = 1.0 if angle < 1e-8 else sin(angle) / angle
    g = 0.5 if angle < 1e-8 else 2.0 * (sin(0.5 * angle) / angle) ** 2
    return (
        (1.0 - g * (b * b + c * c), g * a * b + f * c, g * a * c - f * b),
        (g * a * b - f * c, 1.0 - g * (a * a + c * c), g * b * c + f * a),
        (g * a * c + f * b, g * b * c - f * a, 1.0 - g * (a * a + b * b)),
    )


def _dot(p: Sequence[float], q: Sequence[float]) -> float:
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
