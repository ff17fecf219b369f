"""The law of contact: non-penetration with Coulomb friction in a plastic impact.

    0 <= P_n   perpendicular to   v_n >= 0                         no approach left, no pull
    |P_t| <= mu P_n,   and while sliding   P_t = -mu P_n v_t / |v_t|    friction inside the cone, against the slip

    v = v(0) + W P        velocity at the contacts after the impulses P [N s]; v(0) before; W: Delassus operator [1/kg]

It is equation (13) of Guan et al. (2014), the law with bounds, with a round cone in place of their pyramid. The
tangents of each contact are turned to the principal axes of its W_tt, so that the block of the contact is

    W = [[W_nn, w_1, w_2], [w_1, a_1, 0], [w_2, 0, a_2]]

Reference for friction in a disc: More and Sorensen (1983), SIAM J. Sci. Stat. Comput. 4:553-572.
"""

from __future__ import annotations

from math import hypot, inf, sqrt
from typing import NamedTuple

import numpy as np

from ...ship.frames import Array
from ..dynamics.small_blocks import multiply

__all__ = ["MANY_CONTACTS", "ContactBlock", "law_residual", "solve_friction_in_disc"]

MANY_CONTACTS = 7
"""Contacts from which arrays are faster than loops over plain floats."""


class ContactBlock(NamedTuple):
    """W of one contact in its principal tangents [1/kg]; h_i = 1 / a_i, zero along a tangent in which no ship moves."""

    W_nn: float
    w_1: float
    w_2: float
    a_1: float
    a_2: float
    h_1: float
    h_2: float

    @classmethod
    def of_all(cls, W: Array) -> list[ContactBlock]:
        """The blocks on the diagonal of W (3k, 3k), in principal tangents, with exact zeros along a tangent in which no
        ship moves."""
        on, beside, further = (W.diagonal(offset).tolist() for offset in (0, 1, 2))
        return [
            cls(W_nn, w_1, w_2, a_1, a_2, 1.0 / a_1 if a_1 > 0.0 else 0.0, 1.0 / a_2 if a_2 > 0.0 else 0.0)
            for W_nn, a_1, a_2, w_1, w_2 in zip(on[0::3], on[1::3], on[2::3], beside[0::3], further[0::3], strict=True)
        ]


def solve_friction_in_disc(W: ContactBlock, v_1: float, v_2: float, radius: float) -> tuple[float, float]:
    """Friction (P_1, P_2) [N s] of maximum dissipation in a disc: it stops the slip v [m/s] if the disc holds it.

    Otherwise P = -(W_tt + g)^-1 v on the rim, with one g > 0. radius [N s].
    """
    size = hypot(v_1, v_2)
    if size == 0.0 or radius <= 0.0:
        return 0.0, 0.0
    P_1, P_2 = -v_1 * W.h_1, -v_2 * W.h_2
    can_stick = (W.h_1 > 0.0 or v_1 == 0.0) and (W.h_2 > 0.0 or v_2 == 0.0)
    if can_stick and hypot(P_1, P_2) <= radius:
        return P_1, P_2
    # |P(g)| falls with g; 1/|P(g)| is concave, so Newton's method from the left never overshoots.
    g = max(0.0, size / radius - max(W.a_1, W.a_2), abs(v_1) / radius - W.a_1, abs(v_2) / radius - W.a_2)
    if g > 1e18 * max(W.a_1, W.a_2):  # W_tt is lost to rounding beside g
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
    """Velocity [m/s] by which impulses miss the law of contact: the largest of all contacts, zero if the law holds.

    Of a contact it is the larger of |min(W_nn P_n, v_n)| and of what friction misses its projection on the disc by (the
    natural map of the complementarity problem). W (3k, 3k) [1/kg], v (3k,) [m/s] before, P (k, 3) [N s], any tangents.
    """
    after = (v + multiply(W, P.ravel())).reshape(-1, 3)
    if not np.isfinite(after).all():
        return inf
    stiff = W.diagonal().reshape(-1, 3)
    if len(P) >= MANY_CONTACTS:
        return _residual_of_many(stiff, after, mu, P)
    worst = 0.0
    for (P_n, P_1, P_2), (v_n, v_1, v_2), (w_n, w_1, w_2) in zip(
        P.tolist(), after.tolist(), stiff.tolist(), strict=True
    ):
        rho = max(w_1, w_2) or 1.0
        x, y = P_1 - v_1 / rho, P_2 - v_2 / rho
        size, radius = hypot(x, y), mu * max(P_n, 0.0)
        share = radius / size if size > radius else 1.0
        worst = max(worst, abs(min(P_n * w_n, v_n)), hypot(P_1 - x * share, P_2 - y * share) * rho)
    return worst


def _residual_of_many(stiff: Array, after: Array, mu: float, P: Array) -> float:
    """The same of many contacts, as arrays: stiff (k, 3) [1/kg], the diagonal of W; after (k, 3) [m/s]."""
    rho = stiff[:, 1:].max(axis=1)
    rho[rho == 0.0] = 1.0
    P_n, P_t = P[:, 0], P[:, 1:]
    t = P_t - after[:, 1:] / rho[:, None]
    size, radius = np.hypot(t[:, 0], t[:, 1]), mu * np.maximum(P_n, 0.0)
    share = np.divide(radius, size, out=np.ones_like(size), where=size > radius)
    missed = P_t - share[:, None] * t
    along = np.abs(np.minimum(P_n * stiff[:, 0], after[:, 0])).max()
    return float(max(along, (np.hypot(missed[:, 0], missed[:, 1]) * rho).max()))
