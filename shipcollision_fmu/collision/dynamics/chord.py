"""The chord of a motion: the straight way of CG and the even turn that lead from one pose to another.

    E     = R_0' R_1                               rotation of the hull, in b at the start
    omega = log(E) / H                             angular velocity
    v_g   = (R_0' (x_1 - x_0) + E r_bg - r_bg) / H  velocity of CG
    v     = v_g - omega x r_bg                     velocity of CO, all in b at the start

A body that keeps this twist in n for H [s] (ship/coasting.py) is then at the second pose. In plain floats: arrays of
three cost five times as much.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import asin, hypot, pi

from ...ship.degrees_of_freedom import Six
from ...ship.frames import Rows, Three, rotation_rows

__all__ = ["find_chord", "rotation_vector_of"]

Seq = Sequence[float]


def find_chord(
    pose: tuple[Seq, Sequence[Seq]], position: Seq, attitude: Seq, r_bg: Seq, nu: Seq, H: float
) -> tuple[Six, Six]:
    """(twist of the chord about CO in b at the start; the twist nu (6,) at the start, in b at the end).

    pose: x (3,) [m] and rows of R_nb at the start; position [m], attitude [rad]: at the end; r_bg: CG in b [m]. nu is
    carried as by a body on which nothing acts: CG and the angular velocity go on.
    """
    (x_0, y_0, z_0), (R_n, R_e, R_d) = pose
    turn = _columns_times(R_n, R_e, R_d, rotation_rows(*attitude))
    p, q, r = (angle / H for angle in rotation_vector_of(turn))
    north, east, down = position[0] - x_0, position[1] - y_0, position[2] - z_0
    x, y, z = r_bg
    (a, b, c), (d, e, f), (g, h, i) = turn
    u = (R_n[0] * north + R_e[0] * east + R_d[0] * down + (a * x + b * y + c * z) - x) / H
    v = (R_n[1] * north + R_e[1] * east + R_d[1] * down + (d * x + e * y + f * z) - y) / H
    w = (R_n[2] * north + R_e[2] * east + R_d[2] * down + (g * x + h * y + i * z) - z) / H
    chord = u - (q * z - r * y), v - (r * x - p * z), w - (p * y - q * x), p, q, r
    u, v, w, p, q, r = nu
    u, v, w = u + (q * z - r * y), v + (r * x - p * z), w + (p * y - q * x)
    p, q, r = a * p + d * q + g * r, b * p + e * q + h * r, c * p + f * q + i * r
    u, v, w = a * u + d * v + g * w, b * u + e * v + h * w, c * u + f * v + i * w
    return chord, (u - (q * z - r * y), v - (r * x - p * z), w - (p * y - q * x), p, q, r)


def rotation_vector_of(R: Sequence[Seq]) -> Three:
    """Rotation vector [rad] of a rotation (rows) by less than half a turn."""
    (a, b, c), (d, e, f), (g, h, i) = R
    x, y, z = h - f, c - g, d - b
    s = 0.5 * hypot(x, y, z)
    if a + e + i < 1.0:  # more than a quarter turn; about half a turn the axis is lost
        factor = 0.5 * (pi - asin(min(1.0, s))) / max(s, 1e-9)
    else:
        factor = 0.5 if s < 1e-9 else 0.5 * asin(min(1.0, s)) / s
    return factor * x, factor * y, factor * z


def _columns_times(R_n: Seq, R_e: Seq, R_d: Seq, rows: Rows) -> Rows:
    """Rows of R' Q, for R and Q given by their rows."""
    (a, b, c), (d, e, f), (g, h, i) = rows
    return (
        (
            R_n[0] * a + R_e[0] * d + R_d[0] * g,
            R_n[0] * b + R_e[0] * e + R_d[0] * h,
            R_n[0] * c + R_e[0] * f + R_d[0] * i,
        ),
        (
            R_n[1] * a + R_e[1] * d + R_d[1] * g,
            R_n[1] * b + R_e[1] * e + R_d[1] * h,
            R_n[1] * c + R_e[1] * f + R_d[1] * i,
        ),
        (
            R_n[2] * a + R_e[2] * d + R_d[2] * g,
            R_n[2] * b + R_e[2] * e + R_d[2] * h,
            R_n[2] * c + R_e[2] * f + R_d[2] * i,
        ),
    )
