"""The law of contact with Coulomb friction, and by how much impulses miss it.

    0 <= P_n   perpendicular to   v_n >= 0                         no approach left, no pull
    |P_t| <= mu P_n,   and while sliding   P_t = -mu P_n v_t / |v_t|    friction inside the cone, against the slip

It is equation (13) of Guan et al. 2014, the law with bounds, with a cone for their pyramid. Here v = v(0) + W P. The
block of one contact has its tangents turned so that W_tt = diag(a_1, a_2):

    W = [[W_nn, w_1, w_2], [w_1, a_1, 0], [w_2, 0, a_2]]
"""

from __future__ import annotations

from math import hypot, inf, sqrt
from typing import NamedTuple

import numpy as np

from ...ship.frames import Array

__all__ = ["ContactBlock", "law_residual", "solve_friction_in_disc"]


class ContactBlock(NamedTuple):
    """W of one contact in its principal tangents [1/kg]; h_i = 1 / a_i, zero where the ships cannot move."""

    W_nn: float
    w_1: float
    w_2: float
    a_1: float
    a_2: float
    h_1: float
    h_2: float

    @classmethod
    def of(cls, W: Array) -> ContactBlock:
        """From W (3, 3) whose tangents are principal already, with exact zeros where the ships cannot move."""
        W_nn, w_1, w_2, a_1, a_2 = (float(x) for x in (W[0, 0], W[0, 1], W[0, 2], W[1, 1], W[2, 2]))
        return cls(W_nn, w_1, w_2, a_1, a_2, 1.0 / a_1 if a_1 > 0.0 else 0.0, 1.0 / a_2 if a_2 > 0.0 else 0.0)


def solve_friction_in_disc(W: ContactBlock, v_1: float, v_2: float, radius: float) -> tuple[float, float]:
    """Friction (P_1, P_2) in a disc [N s] that holds the slip v if it can, and else takes most energy from it."""
    size = hypot(v_1, v_2)
    if size == 0.0 or radius <= 0.0:
        return 0.0, 0.0
    P_1, P_2 = -v_1 * W.h_1, -v_2 * W.h_2
    held = (W.h_1 > 0.0 or v_1 == 0.0) and (W.h_2 > 0.0 or v_2 == 0.0)
    if held and hypot(P_1, P_2) <= radius:
        return P_1, P_2
    # |P(g)| falls with g; 1/|P(g)| is concave, so Newton's method from the left never overshoots.
    g = max(0.0, size / radius - max(W.a_1, W.a_2), abs(v_1) / radius - W.a_1, abs(v_2) / radius - W.a_2)
    if g > 1e18 * max(W.a_1, W.a_2):  # next to it W_tt is nothing
        return -v_1 / size * radius, -v_2 / size * radius
    for _ in range(60):
        b_1, b_2 = W.a_1 + g, W.a_2 + g
        P_1, P_2 = -v_1 / b_1 if v_1 else 0.0, -v_2 / b_2 if v_2 else 0.0
        square = P_1 * P_1 + P_2 * P_2
        length = sqrt(square)
        bend = (P_1 * P_1 / b_1 if P_1 else 0.0) + (P_2 * P_2 / b_2 if P_2 else 0.0)
        step = (length / radius - 1.0) * square / bend
        g += step
        if abs(step) <= 1e-15 * g:
            break
    share = radius / length
    return P_1 * share, P_2 * share


def law_residual(W: Array, v: Array, mu: float, P: Array) -> float:
    """By how much impulses break the law: the largest velocity [m/s] by which a contact misses complementarity, or its
    friction the projection on the cone. W (3k, 3k), v (3k,) before, P (k, 3), tangents in any axes.

    Zero if and only if the law holds at every contact (the natural map of the complementarity problem).
    """
    after, stiff = (v + W @ P.ravel()).reshape(-1, 3), np.diag(W).reshape(-1, 3).tolist()
    if not np.isfinite(after).all():
        return inf
    worst = 0.0
    for (P_n, P_1, P_2), (v_n, v_1, v_2), (w_n, w_1, w_2) in zip(P.tolist(), after.tolist(), stiff, strict=True):
        rho = max(w_1, w_2) or 1.0
        x, y = P_1 - v_1 / rho, P_2 - v_2 / rho
        size, radius = hypot(x, y), mu * max(P_n, 0.0)
        share = radius / size if size > radius else 1.0
        worst = max(worst, abs(min(P_n * w_n, v_n)), hypot(P_1 - x * share, P_2 - y * share) * rho)
    return worst
