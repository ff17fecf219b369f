"""ACLM: all contacts at once, as a sequence of convex problems (fixed point on the sliding speeds).

The law of contact (contact_law.py) is not the optimality condition of any problem, since friction is not normal to its
cone. Adding mu s to the normal velocity of a contact that slides at speed s makes it so. If the sliding speeds s_i were
known, the impulses would solve a convex problem:

    P = argmin 1/2 P' W P + P . (v + mu s n)         over the cones |P_t| <= mu P_n;  s [m/s], n the normals
    s_i = |v_t,i(P)|                                 fixed point: solve, measure the sliding speeds, solve again

The convex problem is solved by Nesterov's accelerated gradient method, projected on the cones, with a restart where the
step points uphill. It converges slowly, but from any start and for any W, also where Newton's method
(alart_curnier.py) cycles.

References: Acary, Cadoux, Lemarechal and Malick (2011), ZAMM 91:155-175 (the sequence, and that a solution exists);
De Saxce and Feng (1998), Math. Comput. Modelling 28:225-245 (the term mu s); Mazhar, Heyn, Negrut and Tasora (2015),
ACM Trans. Graphics 34(3) (the gradient method for contact). Siconos: ACLMFixedPoint.
"""

from __future__ import annotations

import numpy as np

from ...ship.frames import Array
from ..dynamics.small_blocks import MOST_ROWS, multiply
from .contact_law import law_residual
from .work_limit import WorkLimit

__all__ = ["solve_aclm"]

MAX_FIXED_POINTS = 10
"""Bound on the updates of the sliding speeds in one call; gauss_seidel.py tries Newton's method from the result. With
3, one of 24 patches that need this method is left unsolved."""

MAX_GRADIENT_STEPS = 1000
"""Bound on the gradient steps of one convex problem. With 30, one of the 24 patches is left unsolved."""

CLOSER = 1e-3
"""Share of the present residual at which a convex problem counts as solved. From 0.1 to 1e-5 all patches are solved; a
smaller share costs gradient steps."""


def solve_aclm(W: Array, v: Array, mu: float, P: Array, tolerance: float, work: WorkLimit | None = None) -> Array:
    """Impulses (k, 3) [N s] after some updates from P (k, 3): mostly with a smaller residual (law_residual) than P.

    W (3k, 3k) [1/kg], v (3k,) [m/s] in contact axes; tolerance [m/s]: the residual at which the updates end;
    work: the bound on what the solver may do.
    """
    work = work or WorkLimit()
    steepest = _largest_eigenvalue(W)
    for _ in range(MAX_FIXED_POINTS):
        residual = law_residual(W, v, mu, P)
        if residual <= tolerance or work.is_spent:
            break
        after = (v + multiply(W, P.ravel())).reshape(-1, 3)
        sliding_speed = np.hypot(after[:, 1], after[:, 2])
        P = _solve_convex(W, v, mu, sliding_speed, P, steepest, max(CLOSER * residual, 0.1 * tolerance), work)
    return P


def _largest_eigenvalue(W: Array) -> float:
    """The largest eigenvalue of W [1/kg], or a bound of it where its system is large."""
    if len(W) <= MOST_ROWS:
        return float(np.linalg.eigvalsh(W)[-1])
    return float(np.abs(W).sum(axis=1).max())


def _solve_convex(
    W: Array, v: Array, mu: float, s: Array, P: Array, steepest: float, tolerance: float, work: WorkLimit
) -> Array:
    """Impulses (k, 3) of the convex problem with sliding speeds s (k,) [m/s].

    steepest: largest eigenvalue of W [1/kg]; tolerance [m/s]: change of velocity in a step at which the steps end.
    """
    shifted = v.copy()
    shifted[0::3] += mu * s
    ahead, t = P, 1.0
    for _ in range(MAX_GRADIENT_STEPS):
        gradient = (multiply(W, ahead.ravel()) + shifted).reshape(-1, 3)
        new = _project_on_cones(ahead - gradient / steepest, mu)
        step = new - P
        if float((gradient * step).sum()) > 0.0:
            t = 1.0
        t_new = 0.5 * (1.0 + (1.0 + 4.0 * t * t) ** 0.5)
        ahead = new + (t - 1.0) / t_new * step
        P, t = new, t_new
        work.spend_gradient_step(len(P))
        if float(np.abs(step).max()) * steepest <= tolerance or work.is_spent:
            break
    return P


def _project_on_cones(P: Array, mu: float) -> Array:
    """The nearest impulses (k, 3) within the cones |P_t| <= mu P_n."""
    P_n, size = P[:, 0], np.hypot(P[:, 1], P[:, 2])
    nearest = np.maximum((P_n + mu * size) / (1.0 + mu * mu), 0.0)
    normal = np.where(size <= mu * P_n, P_n, nearest)
    share = np.where(size <= mu * P_n, 1.0, mu * nearest / np.where(size > 0.0, size, 1.0))
    return np.column_stack([normal, P[:, 1:] * share[:, None]])
