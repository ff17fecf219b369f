"""Impulses of the substep before, from which the solver starts: contacts that last share an impulse much as before.

A contact is known again by its place on the hull of ship a.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import dist

import numpy as np

from ...ship.frames import Array
from ..dynamics.contact import Contact, Impulse

__all__ = ["WarmStarts", "guess_impulses", "keep_impulses"]

SAME_PLACE = 2.0
"""Contacts less than this [m] apart on the hull are the same."""

WarmStarts = dict[tuple[int, int], list[tuple[list[float], list[float]]]]
"""Per pair of ships: places in b of ship a [m], and the impulses in n [N s] there."""


def guess_impulses(contacts: Sequence[Contact], axes: Sequence[Array], warm: WarmStarts) -> Array | None:
    """Impulses (k, 3) in contact axes like those expected; None if nothing is known."""
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
    """Keep these impulses for the pairs that they act between. A pair without any keeps those it had.

    Ships that rest against each other are apart in some substeps, by the rounding of their places.
    """
    latest: WarmStarts = {}
    for impulse in impulses:
        c = impulse.contact
        if impulse.P.any():
            latest.setdefault((c.a, c.b), []).append((c.r_a.tolist(), impulse.P.tolist()))
    warm.update(latest)
