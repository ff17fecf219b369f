"""Which motions of a ship are free, and the change of its twist by an impulse in them.

    6 degrees of freedom    all, in b
    4                       level surge and sway, along and across the heading; yaw about the vertical; roll about x
    3                       the same without roll

In 3 and 4 degrees of freedom heave and pitch are held. The free motions are *level*, as in the models of the MMG
literature: a heeled ship sways horizontally, not down along its deck. With nu_l = (u, v, w, phi_dot, theta_dot,
psi_dot) of the level axes that turn with the heading,

    nu = L nu_l        L = [[R_bl, 0], [0, (e_x, R_bl e_y, R_bl e_z)]]        R_bl = (Ry(theta) Rx(phi))^T

    M_free     = M without the rows and columns that are held, constant in the level axes
    d(nu)      = L M_free^-1 L^T impulse              impulse (6,) and nu (6,) in b about CO
    T          = 1/2 nu_l' M nu_l                      kinetic energy

The level part of an impulse alone changes the level momentum, at any heel. L of an upright ship is the identity.

The water holds heave and pitch in the course of a roll period, not within an impact. Friction along the vertical acts
within the impact and meets the inertia of all motions (collision/solvers/held_motions.py). With the velocity down
g . nu_l of a point of the hull, g = (0, 0, 1, dz/dphi, dz/dtheta, 0), the held motions add to its mobility

    g' (M^-1 - M_free^-1) g                            [1/kg]

Source: Fossen (2021), section 2.2.1 (zyx Euler angles: the last three columns of L are those of the angle rates).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, sin

import numpy as np

from ..errors import ShipError
from .frames import Array, rotation

__all__ = ["FREE", "Six", "free_inverse", "from_level", "held_mobility", "level_axes", "tilted_inverse", "to_level"]

FREE: dict[int, tuple[int, ...]] = {3: (0, 1, 5), 4: (0, 1, 3, 5), 6: (0, 1, 2, 3, 4, 5)}
"""Indices into nu (6: of b; 3 and 4: of the level axes) that may change, by number of degrees of freedom."""

Six = tuple[float, float, float, float, float, float]


def free_inverse(M: Array, degrees_of_freedom: int) -> Array:
    """Inverse of the free block of M, zeros elsewhere, (6, 6): d(nu) = free_inverse @ impulse for an upright ship.

    The rows and columns of held motions are deleted before the inversion. M is scaled to a unit
    diagonal first: mass and inertia differ by four orders of magnitude.
    Raises ShipError when degrees_of_freedom is not 3, 4 or 6.
    """
    if degrees_of_freedom not in FREE:
        raise ShipError(
            f"degrees_of_freedom = {degrees_of_freedom} must be 3 (surge, sway, yaw), 4 (and roll) or 6 (all)"
        )
    free = np.ix_(FREE[degrees_of_freedom], FREE[degrees_of_freedom])
    block = M[free]
    scale = 1.0 / np.sqrt(np.diag(block))
    scaling = np.outer(scale, scale)
    inverse = np.zeros((6, 6))
    inverse[free] = _symmetric(np.linalg.inv(block * scaling) * scaling)
    return inverse


def held_mobility(M: Array, degrees_of_freedom: int) -> Array | None:
    """M^-1 - M_free^-1 in heave, roll and pitch (3, 3): what the held motions would add; None if none is held."""
    if degrees_of_freedom == 6:
        return None
    return (free_inverse(M, 6) - free_inverse(M, degrees_of_freedom))[2:5, 2:5]


def tilted_inverse(upright: Array, degrees_of_freedom: int, attitude: Sequence[float] | Array) -> Array:
    """L free_inverse L^T of a ship at an attitude (phi, theta, psi) [rad]: d(nu) = it @ impulse, both in b; (6, 6).

    upright: free_inverse of the ship, which is returned itself in 6 degrees of freedom and for an upright ship.
    """
    if degrees_of_freedom == 6 or not (attitude[0] or attitude[1]):
        return upright
    L = level_axes(attitude)
    return _symmetric(L @ upright @ L.T)


def level_axes(attitude: Sequence[float] | Array) -> Array:
    """L (6, 6) of an attitude (phi, theta, psi) [rad]: nu = L nu_l; psi does not matter."""
    R_bl = rotation([attitude[0], attitude[1], 0.0]).T
    L = np.zeros((6, 6))
    L[:3, :3] = L[3:, 3:] = R_bl
    L[3:, 3] = [1.0, 0.0, 0.0]
    return L


def to_level(nu: Six, phi: float) -> Six:
    """nu_l of nu for a ship that heels by phi [rad] and does not trim. Also L^T tau of a wrench tau."""
    u, v, w, p, q, r = nu
    c, s = cos(phi), sin(phi)
    return u, c * v - s * w, s * v + c * w, p, c * q - s * r, s * q + c * r


def from_level(nu_l: Six, phi: float) -> Six:
    """nu of nu_l: the inverse of to_level."""
    return to_level(nu_l, -phi)


def _symmetric(M: Array) -> Array:
    symmetric: Array = 0.5 * (M + M.T)
    return symmetric
