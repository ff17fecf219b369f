"""Warm start: the impulses of the substep before, from which Gauss-Seidel starts.

Contacts that last share an impulse much as before. A ship that rests at a quay takes one sweep per substep instead of
five. Four ships abreast at a quay take one instead of 60 and Newton's method. Ships that slide take more sweeps than
without (7 for 5 along a quay), since Aitken's extrapolation then has more than one direction to follow. The guess is
scaled by the solver, and the motion does not depend on it. A contact is recognised by its place on the hull of ship a.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import dist

import numpy as np

from ...ship.frames import Array
from ..dynamics.contact import NO_IMPULSE, Contact, Impulse

__all__ = ["WarmStarts", "guess_impulses", "keep_impulses"]

SAME_PLACE = 2.0
"""Distance [m] on the hull below which two contacts are the same. A contact that slides at 20 m/s moves 0.2 m in a
substep of 0.01 s; a larger distance gives a contact the impulse of its neighbour."""

WarmStarts = dict[tuple[int, int], list[tuple[list[float], list[float]]]]
"""Per pair of ships: places in b of ship a [m], and the impulses in n [N s] there."""


def guess_impulses(contacts: Sequence[Contact], axes: Sequence[Array], warm: WarmStarts) -> Array | None:
    """Impulses (k, 3) [N s] in contact axes to start from; None if no pair has any."""
    if not warm:
        return None
    P = np.zeros((len(contacts), 3))
    for i, (contact, axis) in enumerate(zip(contacts, axes, strict=True)):
        place = contact.r_a.tolist()
        for known, impulse in warm.get((contact.a, contact.b), ()):
            if dist(place, known) < SAME_PLACE:
                P[i] = axis @ impulse
                break
    return P


def keep_impulses(impulses: Sequence[Impulse], warm: WarmStarts) -> None:
    """Replace the impulses of the pairs that have some in this substep; the other pairs keep those they had.

    Two ships that rest against each other are apart in some substeps, by the rounding of their positions.
    """
    latest: WarmStarts = {}
    for impulse in impulses:
        c = impulse.contact
        if impulse.P.tolist() != NO_IMPULSE:
            latest.setdefault((c.a, c.b), []).append((c.r_a.tolist(), impulse.P.tolist()))
    warm.update(latest)
