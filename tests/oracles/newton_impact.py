"""Newton's impact of one contact, algebraic: stick, or slide in the direction of the first slip. An oracle.

    v      = G_b nu_b - G_a nu_a             relative velocity, (n, t1[, t2]);  v_n < 0 on approach      [m/s]
    v+     = v + W P                         W from delassus.py, P on ship b, -P on ship a               [N s]

    stick    P = -W^-1 (v_n (1 + e), v_t)                      if |P_t| <= mu P_n
    slide    P = P_n (1, -mu D),   D = v_t/|v_t|               otherwise
             P_n = -(1 + e) v_n / (W_nn - mu W_nt.D)

    E_n = -P_n (v_n + v_n+)/2       E_t = -P_t.(v_t + v_t+)/2       E_n + E_t = energy lost            [J]

Guan et al. (2014) apply the impulse to the ships in equations (3)-(4) and print no equation for the impulse itself. The
equations above complete theirs, with the 6 x 6 mass and added mass of each ship, and any contact height and rates.
Their four degrees of freedom, angles and symbols, and the corrections, are in guan2014.py. With e = 0 and in the plane
the impulse is that of Pedersen and Zhang (1998): their impulse ratio mu* is |P_t|/P_n at stick.

Limits, known and tested:

- For e > 0 with friction Newton's restitution can create energy (some geometries at e = 0.5).
- "Slide in the direction of the first slip" may end in slip the other way.
- The split E_n, E_t holds for a constant P_t/P_n; at stick E_t may be slightly negative. Only the sum is invariant.

collision/solvers/impact_process.py has none of these limits and answers contact. The algebraic form is the reference of
the literature.

Sources: Guan et al. (2014); Pedersen and Zhang (1998), Marine Structures 11:429-449; Brach (1991), Mechanical Impact
Dynamics.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from shipcollision_fmu.errors import StepError
from shipcollision_fmu.ship.frames import Array

__all__ = ["NewtonImpact", "solve_newton_impact", "stick_energy"]

STILL = 1e-12
"""Slip, as a share of the approach speed, that counts as none: the direction of a smaller slip is rounding."""


@dataclass(frozen=True, eq=False)
class NewtonImpact:
    """An impact. P (d,) [N s] on ship b in contact axes (normal first); after (d,): relative velocity [m/s].

    Energy lost along the normal and across it [J]; whether the contact stuck, slid, or was not approaching.
    """

    P: Array
    after: Array
    energy_normal: float
    energy_tangential: float
    mode: Literal["apart", "stick", "slide"]


def solve_newton_impact(W: Array, v: Array, mu: float, e: float) -> NewtonImpact:
    """The impact of one contact. W (d, d) [1/kg] and v (d,) [m/s] in contact axes, normal first, d = 2 or 3.

    Raises StepError where the formula for sliding has no solution: friction would press the hulls together.
    """
    W, v = np.asarray(W, dtype=float), np.asarray(v, dtype=float)
    if v[0] >= 0.0:
        return NewtonImpact(np.zeros(len(v)), v.copy(), 0.0, 0.0, "apart")
    target = v.copy()
    target[0] *= 1.0 + e
    P: Array = -np.linalg.pinv(W, 1e-12, hermitian=True) @ target
    mode: Literal["stick", "slide"] = "stick"
    if np.linalg.norm(P[1:]) > mu * P[0]:
        mode = "slide"
        D = _slip_direction(W, v)
        felt = float(W[0, 0] - mu * W[0, 1:] @ D)
        if felt <= 0.0:
            raise StepError(
                f"sliding has no solution: W_nn - mu W_nt.D = {felt:g} 1/kg at mu = {mu:g} must be "
                "> 0: take less friction, or follow the slip (solve_impact_process)"
            )
        P = -float(target[0]) / felt * np.concatenate([[1.0], -mu * D])
    after = v + W @ P
    mean = 0.5 * (v + after)
    return NewtonImpact(P, after, -float(P[0] * mean[0]), -float(P[1:] @ mean[1:]), mode)


def _slip_direction(W: Array, v: Array) -> Array:
    """Unit vector along the slip, or along the slip that the normal impulse is about to make where there is none."""
    slip = v[1:] if np.linalg.norm(v[1:]) > STILL * abs(v[0]) else W[1:, 0]
    size = float(np.linalg.norm(slip))
    return slip / size if size > 0.0 else np.zeros(len(v) - 1)


def stick_energy(W: Array, v: Array) -> float:
    """1/2 v' W^-1 v [J]: the energy of the relative motion at the contact, all of which a plastic stick takes."""
    return float(0.5 * v @ np.linalg.pinv(W, 1e-12, hermitian=True) @ v)
