"""The energy that contact loses, split into a part along the normal and a part by friction.

    lost  = -sum of P.(v- + v+)/2          of all impulses of an instant: the kinetic energy lost, an identity     [J]
    E_n   = -integral of v_n dp >= 0       along the impact process of a contact (impact_process.py)
    E_t   = mu integral of |s| dp >= 0

Where the slip keeps its direction, -P_t.(s- + s+)/2 is E_t. Where it stops or turns within the impact, this sum may be
next to nothing, or negative. There the parts are in the ratio of the impact process, and scaled to what is lost.

All contacts of a pair are one contact: the resultant of their impulses. E_n and E_t are summed over the pairs that act
on each other through ships, since the loss of all of them is certain not to be negative. The energy of heave and pitch
that are held (held_motions.py), P' H_tt P/2, counts as lost to friction.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import reduce
from math import hypot
from operator import add  # sum() rounds otherwise from Python 3.12 on

import numpy as np

from ...ship.frames import Array
from ..dynamics.body_state import BodyState
from ..dynamics.contact import NO_IMPULSE, Booked, Contact
from ..dynamics.contact_frame import contact_axes
from ..dynamics.delassus import held_delassus, mobility
from ..dynamics.passivity import group_impulses
from .impact_process import estimate_losses

__all__ = ["split_losses"]

SAME_DIRECTION = 1e-4
"""1 - cos of the angle between two slips, up to which their direction is the same. The part by friction is accurate to
half of it. With zero, every contact that slides would be followed along its path, which costs a tenth of a step."""

STOPPED = 1e-6
"""The lesser of the slips before and after, as a share of the other, up to which it is none. The solver leaves 1e-11 of
the approach where friction sticks, in a direction of rounding. With zero, that direction would choose between the two
splits, which differ by up to 0.9 %."""

Loss = tuple[float, float]


def split_losses(
    booked: Sequence[Booked], states: Sequence[BodyState], friction: float, restitution: float
) -> list[Loss]:
    """Energy lost at each impulse [J], (along the normal, by friction)."""
    if friction == 0.0 or all(b.impulse.P.tolist() == NO_IMPULSE for b in booked):
        return [(b.lost, 0.0) for b in booked]
    first = booked[0].impulse.contact
    if all((b.impulse.contact.a, b.impulse.contact.b) == (first.a, first.b) for b in booked):
        return _split_straight(booked) or _split_by_process([booked], booked, states, friction, restitution)
    by_impulse = {id(b.impulse): b for b in booked}
    losses = dict[int, Loss]()
    for group in group_impulses([b.impulse for b in booked], states):
        members, pairs = [by_impulse[id(i)] for i in group], dict[tuple[int, int], list[Booked]]()
        for b in members:
            pairs.setdefault((b.impulse.contact.a, b.impulse.contact.b), []).append(b)
        split = _split_by_process(list(pairs.values()), members, states, friction, restitution)
        losses.update((id(b.impulse), loss) for b, loss in zip(members, split, strict=True))
    return [losses[id(b.impulse)] for b in booked]


def _split_straight(booked: Sequence[Booked]) -> list[Loss] | None:
    """The losses of a pair whose slips keep their direction at all contacts; None if one does not."""
    losses, along, across = list[Loss](), 0.0, 0.0
    for b in booked:
        if b.impulse.P.tolist() == NO_IMPULSE:
            losses.append((b.lost, 0.0))
            continue
        (n_x, n_y, n_z), (P_x, P_y, P_z) = b.impulse.contact.normal.tolist(), b.impulse.P.tolist()
        (x, y, z), (u, v, w) = b.before.tolist(), b.after.tolist()
        before, after = n_x * x + n_y * y + n_z * z, n_x * u + n_y * v + n_z * w
        x, y, z, u, v, w = (
            x - before * n_x, y - before * n_y, z - before * n_z, u - after * n_x, v - after * n_y, w - after * n_z,
        )  # fmt: skip
        slip, left = hypot(x, y, z), hypot(u, v, w)
        if min(slip, left) <= STOPPED * max(slip, left) or x * u + y * v + z * w < (1.0 - SAME_DIRECTION) * slip * left:
            return None
        lost = -0.5 * (P_x * (x + u) + P_y * (y + v) + P_z * (z + w))
        losses.append((b.lost - lost, lost))
        along, across = along + b.lost - lost, across + lost
    return losses if along >= 0.0 and across >= 0.0 else None


def _split_by_process(
    pairs: Sequence[Sequence[Booked]], members: Sequence[Booked], states: Sequence[BodyState], friction: float,
    restitution: float,
) -> list[Loss]:  # fmt: skip
    """The losses of a group of pairs, in the ratio of their impact processes."""
    normal = tangential = 0.0
    for pair in pairs:
        E_n, E_t = _estimate_pair(
            [b for b in pair if b.impulse.P.tolist() != NO_IMPULSE], states, friction, restitution
        )
        normal, tangential = normal + E_n, tangential + E_t
    share = tangential / (normal + tangential) if tangential > 0.0 else 0.0
    return [((1.0 - share) * b.lost, share * b.lost) for b in members]


def _estimate_pair(booked: Sequence[Booked], states: Sequence[BodyState], friction: float, restitution: float) -> Loss:
    """(E_n, E_t) [J] of the impulses of a pair."""
    if not booked:
        return 0.0, 0.0
    c, v = _reduce(booked)
    W, H = mobility(c, states), held_delassus([c], states)
    E_n, E_t = estimate_losses(W, c.axes @ v, friction, restitution, H)
    if H is None:
        return E_n, E_t
    P = c.axes @ sum((b.impulse.P for b in booked), np.zeros(3))
    return E_n, E_t + 0.5 * float(P[1:] @ H[1:, 1:] @ P[1:])


def _reduce(booked: Sequence[Booked]) -> tuple[Contact, Array]:
    """The contact of the resultant, and the velocity there before. Both are linear in the place: places and velocities
    are weighted by the normal impulses."""
    first = booked[0].impulse.contact
    weights = [float(b.impulse.P @ b.impulse.contact.normal) for b in booked]
    whole = reduce(add, weights, 0.0)
    if len(booked) == 1 or whole <= 0.0:
        return first, booked[0].before
    at, v, G_a, G_b = np.zeros(3), np.zeros(3), np.zeros((3, 6)), np.zeros((3, 6))
    for weight, b in zip(weights, booked, strict=True):
        c, share = b.impulse.contact, weight / whole
        at, v, G_a, G_b = at + share * c.at, v + share * b.before, G_a + share * c.G_a, G_b + share * c.G_b
    axes = first.axes
    if any(b.impulse.contact.axes is not axes for b in booked):
        normal = sum((w * b.impulse.contact.normal for w, b in zip(weights, booked, strict=True)), np.zeros(3))
        axes = contact_axes(normal / np.linalg.norm(normal))
    return replace(first, normal=axes[0], axes=axes, at=at, G_a=G_a, G_b=G_b), v
