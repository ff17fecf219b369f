"""Kinetic energy of a ship and the water it carries, in the motions that may change.

    T     = 1/2 nu' M nu                in 6 degrees of freedom, nu in b
    T     = 1/2 nu_l' M nu_l            in 3 and 4, nu_l of the level axes: nu = L nu_l (degrees_of_freedom.py)

    nu_l  = (R_lb v, phi_dot, theta_dot, psi_dot)          R_lb = Ry(theta) Rx(phi)
            phi_dot = w_x / cos(theta)      theta_dot = w_y      psi_dot = w_z + w_x tan(theta)      w = R_lb omega

M = M_RB + M_A (6, 6) about CO [kg, kg m, kg m2], nu = (v, omega) about CO in b [m/s, rad/s], T [J].
Source of the angle rates: Fossen (2021), section 2.2.1.
"""

from __future__ import annotations

import numpy as np

from .frames import Array

__all__ = ["kinetic_energy", "motion_twist"]

ON_END = 1e-24
"""Least cos(theta)^2 of a heading. A ship on end has none; without the limit its roll rate would be infinite."""


def kinetic_energy(M: Array, attitude: Array, nu: Array, degrees_of_freedom: int) -> Array:
    """T [J] of one state or many: attitude (..., 3) [rad] and nu (..., 6) give (...)."""
    motion = motion_twist(attitude, nu, degrees_of_freedom)
    energy: Array = ((0.5 * motion @ M)[..., None, :] @ motion[..., :, None])[..., 0, 0]
    return energy


def motion_twist(attitude: Array, nu: Array, degrees_of_freedom: int) -> Array:
    """The twists (..., 6) that M is of: nu itself in 6 degrees of freedom, nu_l in 3 and 4."""
    if degrees_of_freedom == 6:
        return nu
    phi, theta = attitude[..., 0], attitude[..., 1]
    sin_theta, cos_theta = np.sin(theta), np.cos(theta)
    v, w = (_level(nu[..., part], phi, sin_theta, cos_theta) for part in (slice(0, 3), slice(3, 6)))
    phi_dot = w[0] * cos_theta / np.maximum(cos_theta * cos_theta, ON_END)
    return np.stack([*v, phi_dot, w[1], w[2] + sin_theta * phi_dot], axis=-1)


def _level(vector: Array, phi: Array, sin_theta: Array, cos_theta: Array) -> tuple[Array, Array, Array]:
    """R_lb vector: components along the heading, across it and down."""
    x, y, z = vector[..., 0], vector[..., 1], vector[..., 2]
    sin_phi, cos_phi = np.sin(phi), np.cos(phi)
    below = sin_phi * y + cos_phi * z
    return cos_theta * x + sin_theta * below, cos_phi * y - sin_phi * z, cos_theta * below - sin_theta * x
