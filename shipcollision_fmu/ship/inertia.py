"""Inertia of a ship in water: rigid body plus added mass.

    M    = M_RB + M_A                                  (6, 6), about CO, in b; kinetic energy = 1/2 nu' M nu
    M_RB = H' diag(m, m, m, I_xx, I_yy, I_zz) H        H = H(r_bg): nu_g = H nu, velocity of CG from that of CO
    M_A  = diag(m_x, m_y, m_z, j_x, j_y, j_z)          and, with the sway added mass at depth z_y below CO,
           + m_y (z_y^2 e_4 e_4' - z_y (e_2 e_4' + e_4 e_2'))

    m    mass [kg]           r_bg  CG from CO [m]       I_xx = m k_xx^2 ... about CG [kg m2]
    m_x, m_y, m_z            added mass [kg], positive  (Fossen's -X_udot, -Y_vdot, -Z_wdot)
    j_x, j_y, j_z            added inertia [kg m2], positive

Sources: Fossen (2021), chapter 3 (M_RB, H) and chapter 6 (M_A). The sway-roll terms are the same H, applied to m_y at
(0, 0, z_y): what a sway impulse at the waterline needs in order to roll the ship by the right amount.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .frames import Array, skew

__all__ = ["H", "added_mass_matrix", "is_positive_definite", "rigid_body_inertia"]

_LEAST_EIGENVALUE = 1e-12
"""Of the matrix scaled to a unit diagonal. Below it, rounding alone could make an impulse add energy."""


def H(r: Sequence[float] | Array) -> Array:
    """Twist at the point r [m] from the twist at CO, nu_at_r = H(r) nu; (6, 6). H(r)^-1 = H(-r)."""
    transform = np.eye(6)
    transform[:3, 3:] = skew(r).T
    return transform


def rigid_body_inertia(mass: float, r_bg: Sequence[float] | Array, radii: Sequence[float] | Array) -> Array:
    """M_RB about CO in b, (6, 6), of mass [kg] with radii of gyration (k_xx, k_yy, k_zz) [m] about CG."""
    M_g = mass * np.diag(np.concatenate([np.ones(3), np.square(np.asarray(radii, dtype=float))]))
    return _symmetric(H(r_bg).T @ M_g @ H(r_bg))


def added_mass_matrix(
    m_x: float, m_y: float, m_z: float, j_x: float, j_y: float, j_z: float, *, z_y: float = 0.0
) -> Array:
    """M_A about CO in b, (6, 6), from added masses [kg] and added inertias about CO [kg m2].

    z_y [m]: depth below CO at which the sway added mass acts. Its default 0 keeps M_A diagonal, which is what the
    published fractions for impacts (0.05, 0.85, 0.21) go with; about T/2 is the physical value.
    """
    M_A = np.diag(np.array([m_x, m_y, m_z, j_x, j_y, j_z], dtype=float))
    M_A[1, 3] = M_A[3, 1] = -m_y * z_y
    M_A[3, 3] += m_y * z_y**2
    return M_A


def is_positive_definite(M: Array) -> bool:
    """Whether M is symmetric and safely positive definite, judged on M scaled to a unit diagonal."""
    diagonal = np.diag(M)
    if not np.all(np.isfinite(M)) or np.any(diagonal <= 0.0):
        return False
    scale = 1.0 / np.sqrt(diagonal)
    scaled = M * np.outer(scale, scale)
    symmetric = np.allclose(scaled, scaled.T, rtol=0.0, atol=1e-9)
    return bool(symmetric and np.linalg.eigvalsh(scaled)[0] > _LEAST_EIGENVALUE)


def _symmetric(M: Array) -> Array:
    """M without the rounding that makes it differ from its transpose."""
    symmetric: Array = 0.5 * (M + M.T)
    return symmetric
