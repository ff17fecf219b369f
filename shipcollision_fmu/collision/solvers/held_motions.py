"""Friction of ships whose heave and pitch are held, as in 3 and 4 degrees of freedom.

Within an impact only inertia holds heave and pitch; the water does so in the course of a roll period. Friction notices
within the impact. Against hulls that cannot heave it would pin the struck side of a ship that rolls: no roll at all,
and a tenth more energy lost. Along a sloping stem it would act the wrong way. Hence the slip is that of hulls that give
way along the vertical with the inertia of all motions. The approach is that of the free motions:

    v_n = v_n(0) + W_nn P_n + W_nt P_t
    v_t = v_t(0) + (W_tn + H_tn) P_n + (W_tt + H_tt) P_t          H: what held motions would add, delassus.py

H_tt makes W_tt + H_tt definite: of the many impulses that would stop held ships alike, one is left. H_tn is zero where
all normals are level. The solvers need a symmetric operator, so H_tn P_n is added to the slip before the impact. P_n is
then that of an impact solved before, without friction at first.

With H_tn = 0 no impulse of the law gains energy: with W + H_tt it gains none, and with W it loses P'H_tt P/2 more. With
H_tn it may, where friction is strong and the normal steep; passivity.py scales it back. Without friction it is the
impact of the free motions. Heave and pitch after an impact are forgotten: the water takes their energy.

Compared with 6 degrees of freedom: tests/collision/test_held_motions.py.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...ship.frames import Array
from .gauss_seidel import SWEEP_TOLERANCE, solve_gauss_seidel
from .poisson_restitution import LEAST_REBOUNDING_APPROACH
from .work_limit import WorkLimit

__all__ = ["HeldFriction", "yield_to_friction"]


ROUNDS = 2
"""Impacts solved for P_n in the slip: without friction, then with. With one, strong friction that raises P_n is missed:
the roll of a struck ship is off by a third."""


SLIP_TOLERANCE = 1e-9
"""Error of H_tn P_n, as a share of the approach, that is allowed. Hulls that heel by a milliradian have a small H_tn,
so P_n may be less exact. With 1e-11, the tolerance of the impact itself, jammed rafts spend two thirds of their work on
P_n. Larger: the order in which ships are named would be seen in their motion."""


class HeldFriction(NamedTuple):
    """W + H_tt (3k, 3k) [1/kg], the slip H_tn P_n (3k,) [m/s], and impulses (k, 3) [N s] to start from, or None."""

    W: Array
    slip: Array
    start: Array | None


def yield_to_friction(
    W: Array, v: Array, mu: float, H: Array, start: Array | None = None, work: WorkLimit | None = None
) -> HeldFriction:
    """The operator and the slip that friction meets. W, H (3k, 3k) [1/kg] and v (3k,) [m/s] before, in contact axes;
    start, work: as in solve_gauss_seidel."""
    H_n, W_t = H[:, 0::3].copy(), H.copy()
    H_n[0::3] = 0.0
    W_t[0::3], W_t[:, 0::3] = 0.0, 0.0
    W_t += W
    slip = np.zeros(len(v))
    share = float(np.abs(H_n).max() / W.diagonal().max())
    if mu > 0.0 and share > SLIP_TOLERANCE:
        friction = 0.0
        approach = max(-float(v[0::3].min()), LEAST_REBOUNDING_APPROACH)
        scale = approach * max(1.0, SLIP_TOLERANCE / (share * SWEEP_TOLERANCE))
        for _ in range(ROUNDS):
            if work is None or not work.is_spent or start is None:
                start = solve_gauss_seidel(W_t, v + slip, friction, start, scale, work).P
            slip, friction = H_n @ start[:, 0], mu
    return HeldFriction(W_t, slip, start)
