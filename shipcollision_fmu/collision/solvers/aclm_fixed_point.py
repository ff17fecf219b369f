"""All contacts at once by a sequence of convex problems: where neither sweeps nor Newton's method get there.

The law of contact says that the impulses solve a convex problem if only the speeds of sliding s_i were known:

    P = argmin 1/2 P' W P + P . (v + mu s)          over the cones |P_t| <= mu P_n,  mu s along the normals
    s_i = |v_t,i(P)|

for a contact that slides at s is told to part at mu s by friction that is normal to the cone, which is then the very
friction against the slip. So s is found by trying: solve, see how fast the contacts slide, solve again. The convex
problem is solved by Nesterov's accelerated gradient, projected on the cones and begun anew where it overshoots.

References: Acary, Cadoux, Lemarechal and Malick (2011), ZAMM 91:155-175 (the sequence, and that a solution exists);
De Saxce and Feng (1998), Math. Comput. Modelling 28:225-245 (the shift mu s); Mazhar, Heyn, Negrut and Tasora (2015),
ACM Trans. Graphics 34(3) (the gradient method for contact).
"""

from __future__ import annotations

import numpy as np

from ...ship.frames import Array
from .contact_law import law_residual

__all__ = ["solve_aclm"]

TRIALS = 10
"""Sliding speeds tried."""

STEPS = 1000
"""Steps of the gradient method for each, at most."""

CLOSER = 1e-3
"""A step that changes velocities by less than this share of what the law was missed by before ends a trial."""


def solve_aclm(W: Array, v: Array, mu: float, P: Array, wanted: float) -> Array:
    """Impulses (k, 3) after some trials from P (k, 3), that miss the law by less, mostly: by `wanted` [m/s] if they
    can. W (3k, 3k), v (3k,)."""
    steepest = float(np.linalg.eigvalsh(W)[-1])
    for _ in range(TRIALS):
        missed = law_residual(W, v, mu, P)
        if missed <= wanted:
            break
        after = (v + W @ P.ravel()).reshape(-1, 3)
        s = np.hypot(after[:, 1], after[:, 2])
        P = _convex(W, v, mu, s, P, steepest, max(CLOSER * missed, 0.1 * wanted))
    return P


def _convex(W: Array, v: Array, mu: float, s: Array, P: Array, steepest: float, enough: float) -> Array:
    """The convex problem for sliding speeds s (k,): impulses (k, 3), until a step changes less than `enough` [m/s]."""
    told = v.copy()
    told[0::3] += mu * s
    ahead, t = P, 1.0
    for _ in range(STEPS):
        slope = (W @ ahead.ravel() + told).reshape(-1, 3)
        new = _on_cone(ahead - slope / steepest, mu)
        moved = new - P
        if float((slope * moved).sum()) > 0.0:
            t = 1.0
        t_new = 0.5 * (1.0 + (1.0 + 4.0 * t * t) ** 0.5)
        ahead = new + (t - 1.0) / t_new * moved
        P, t = new, t_new
        if float(np.abs(moved).max()) * steepest <= enough:
            break
    return P


def _on_cone(P: Array, mu: float) -> Array:
    """The nearest points of the cones."""
    P_n, size = P[:, 0], np.hypot(P[:, 1], P[:, 2])
    nearest = np.maximum((P_n + mu * size) / (1.0 + mu * mu), 0.0)
    normal = np.where(size <= mu * P_n, P_n, nearest)
    share = np.where(size <= mu * P_n, 1.0, mu * nearest / np.where(size > 0.0, size, 1.0))
    return np.column_stack([normal, P[:, 1:] * share[:, None]])
