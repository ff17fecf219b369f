"""A ship without hydrodynamics: between impulses the velocity of CG and the angular velocity stay constant in n.

    p_g(t + h) = p_g + h R_nb (v + omega x r_bg)         R_nb(t + h) = R_nb exp(h skew(omega))

omega is the rotation's own axis, so it is constant in b as well. Exact for any h. This is the world of Guan et al.
2014: added mass counts when an impulse is taken, and nothing acts on the ship afterwards.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..ship.frames import Array, attitude_from_rotation, attitude_unwrapped, rotation, rotation_vector, skew

__all__ = ["coasted"]


def coasted(eta: Sequence[float], nu: Sequence[float], r_bg: Array, h: float) -> tuple[list[float], list[float]]:
    """(eta, nu) after h [s]: pose of CO in n, twist about CO in b, heading without jumps."""
    position, v, omega = np.array(eta[:3]), np.array(nu[:3]), np.array(nu[3:])
    R_nb = rotation(eta[3:])
    if not omega.any():  # keeps a straight course straight to the bit
        return [*(position + h * (R_nb @ v)).tolist(), *eta[3:]], list(nu)
    v_bg = skew(omega) @ r_bg  # velocity of CG relative to CO
    v_g_n = R_nb @ (v + v_bg)
    R_after = R_nb @ rotation_vector(h * omega)
    position_after = position + h * v_g_n + (R_nb - R_after) @ r_bg
    turned = h * float(R_nb[2] @ omega)  # about the vertical: more than half a turn in a step is still counted
    attitude_after = attitude_unwrapped(attitude_from_rotation(R_after), eta[5] + turned)
    v_after = R_after.T @ v_g_n - v_bg
    return [*position_after.tolist(), *attitude_after.tolist()], [*v_after.tolist(), *nu[3:]]
