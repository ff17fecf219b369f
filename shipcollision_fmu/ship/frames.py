"""Frames and the conversions between them.

    n   NED at the scenario's origin: north, east, down
    b   body: forward, starboard, down; origin CO at midship (L_pp/2), centreline, design waterline
    w   Bullet's world, z up: east, north, up, with the body axes starboard, forward, up

    eta = (N, E, D, phi, theta, psi)     nu = (u, v, w, p, q, r)
    R_nb = Rz(psi) Ry(theta) Rx(phi)     v_n = R_nb v_b          Fossen (2021), section 2.2.1: zyx Euler angles

n and w differ by a matrix S, and so do their body axes. S is its own inverse and a proper rotation:

    S = [[0 1 0] [1 0 0] [0 0 -1]]       v_w = S v_n             R_w = S R_nb S

Both sides need the swap. With only the world side swapped headings come out mirrored.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import asin, atan2, cos, hypot, pi, sin, sqrt

import numpy as np
import numpy.typing as npt

__all__ = [
    "SWAP",
    "Array",
    "attitude_from_quaternion",
    "attitude_from_rotation",
    "pose_w",
    "poses_w",
    "quaternion",
    "quaternion_w",
    "rotation",
    "rotation_from_quaternion",
    "rotation_rows",
    "rotation_vector",
    "skew",
    "swap_axes",
    "swapped_rows",
    "unwrap_attitude",
]

Array = npt.NDArray[np.float64]

Three = tuple[float, float, float]
Rows = tuple[Three, Three, Three]

SWAP: Array = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
"""S: from n to w and back, for the world and for the body axes; with one of them alone, headings are mirrored."""


def skew(r: Sequence[float] | Array) -> Array:
    """Matrix of the cross product, skew(r) @ x = r x x; (3, 3)."""
    x, y, z = _as_floats(r)
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def _as_floats(v: Sequence[float] | Array) -> Sequence[float]:
    """The entries of a vector in plain floats, with which Python reckons three times as fast as with those of NumPy."""
    floats: Sequence[float] = v.tolist() if isinstance(v, np.ndarray) else v
    return floats


def rotation(attitude: Sequence[float] | Array) -> Array:
    """R_nb of the attitude (phi, theta, psi) [rad]; (3, 3). v_n = R_nb v_b. Fossen (2021), eq. 2.31."""
    return np.array(rotation_rows(*_as_floats(attitude)))


def rotation_rows(phi: float, theta: float, psi: float) -> Rows:
    """The rows of R_nb, in plain floats."""
    cphi, sphi, cth, sth, cpsi, spsi = cos(phi), sin(phi), cos(theta), sin(theta), cos(psi), sin(psi)
    return (
        (cpsi * cth, cpsi * sth * sphi - spsi * cphi, spsi * sphi + cpsi * cphi * sth),
        (spsi * cth, cpsi * cphi + sphi * sth * spsi, sth * spsi * cphi - cpsi * sphi),
        (-sth, cth * sphi, cth * cphi),
    )


def attitude_from_rotation(R_nb: Array) -> Array:
    """Attitude (phi, theta, psi) [rad] of R_nb, psi in (-pi, pi], theta in [-pi/2, pi/2]; (3,)."""
    (a, b, _), (d, e, _), (g, i, j) = R_nb.tolist()
    theta = asin(min(1.0, max(-1.0, -g)))
    if hypot(i, j) < 1e-12:  # bow straight up or down: roll and yaw are one angle; call it yaw
        return np.array([0.0, theta, atan2(-b, e)])
    return np.array([atan2(i, j), theta, atan2(d, a)])


def unwrap_attitude(attitude: Array, psi_near: float) -> Array:
    """The same attitude with psi within half a turn of `psi_near` [rad]: the heading that has no jump."""
    phi, theta, psi = attitude.tolist()
    return np.array([phi, theta, psi + 2 * pi * round((psi_near - psi) / (2 * pi))])


def rotation_vector(w: Sequence[float] | Array) -> Array:
    """exp(skew(w)): the rotation by |w| [rad] about w; (3, 3). Rodrigues' formula."""
    x, y, z = float(w[0]), float(w[1]), float(w[2])
    angle = sqrt(x * x + y * y + z * z)
    if angle < 1e-8:  # the series is exact to rounding here, and 0/0 is avoided
        a, b = 1.0, 0.5
    else:
        a, b = sin(angle) / angle, 2.0 * (sin(0.5 * angle) / angle) ** 2
    return np.array([
        [1.0 - b * (y * y + z * z), b * x * y - a * z, b * x * z + a * y],
        [b * x * y + a * z, 1.0 - b * (x * x + z * z), b * y * z - a * x],
        [b * x * z - a * y, b * y * z + a * x, 1.0 - b * (x * x + y * y)],
    ])  # fmt: skip


def quaternion(R: Array) -> Array:
    """Unit quaternion (x, y, z, w), w >= 0, of a rotation matrix; (4,). Shepperd's choice of the largest pivot."""
    return np.array(_quaternion(R))


def _quaternion(R: Array) -> tuple[float, float, float, float]:
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = R.tolist()
    trace = xx + yy + zz
    if trace >= max(xx, yy, zz):
        q = (zy - yz, xz - zx, yx - xy, 1.0 + trace)
    elif xx >= max(yy, zz):
        q = (1.0 - trace + 2.0 * xx, yx + xy, zx + xz, zy - yz)
    elif yy >= zz:
        q = (xy + yx, 1.0 - trace + 2.0 * yy, zy + yz, xz - zx)
    else:
        q = (xz + zx, yz + zy, 1.0 - trace + 2.0 * zz, yx - xy)
    x, y, z, w = q
    size = sqrt(x * x + y * y + z * z + w * w)
    if w < 0.0:
        size = -size
    return (x / size, y / size, z / size, w / size)


def rotation_from_quaternion(q: Sequence[float] | Array) -> Array:
    """Rotation matrix of a quaternion (x, y, z, w), normalised here; (3, 3)."""
    x, y, z, w = np.asarray(q, dtype=float) / np.linalg.norm(q)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip


def attitude_from_quaternion(q: Sequence[float] | Array) -> Array:
    """Attitude (phi, theta, psi) [rad] of a quaternion n from b, (x, y, z, w); (3,)."""
    return attitude_from_rotation(rotation_from_quaternion(q))


def swap_axes(v: Sequence[float] | Array) -> tuple[float, float, float]:
    """The same vector in the other convention, n <-> w or b <-> Bullet's body axes: (y, x, -z)."""
    x, y, z = _as_floats(v)
    return (float(y), float(x), -float(z))


def swapped_rows(vectors: Sequence[Sequence[float]]) -> Array:
    """Several vectors in the other convention, as the rows of an array (k, 3)."""
    return np.array([(y, x, -z) for x, y, z in vectors])


def pose_w(x: Array, R_nb: Array) -> tuple[tuple[float, float, float], tuple[float, float, float, float]]:
    """Bullet's pose of a body at x (3,) in n with R_nb: (position in w, quaternion of quaternion_w)."""
    return swap_axes(x), quaternion_w(R_nb)


def poses_w(
    poses: Sequence[tuple[Array, Array]],
) -> list[tuple[tuple[float, float, float], tuple[float, float, float, float]]]:
    """Bullet's poses of bodies at (x, R_nb), each as pose_w gives it."""
    return [pose_w(x, R_nb) for x, R_nb in poses]


def quaternion_w(R_nb: Array) -> tuple[float, float, float, float]:
    """Bullet's quaternion (x, y, z, w) of a ship's attitude R_nb.

    Guan et al. 2014, Table 2, print its x, y, z as p, r, h.
    """
    x, y, z, w = _quaternion(R_nb)
    return (y, x, -z, w)
