"""The contact points of a communication step: contacts of its substeps, merged where the place is the same.

A point stands for all impulses P_k that were merged into it, each booked at its place `at`_k (dynamics/contact.py):

    impulse   P = sum P_k                                              on body b, in n                      [N s]
    place     p = sum(N_k p_k) / sum N_k                               centre of pressure, N_k = P_k,n >= 0 [m]
    couple    C = sum (at_k - p) x P_k                                 about the place, in n                [N m s]

The place lies within the hull of the merged places. p x P + C summed over the points is the moment of all impulses on
body b about the origin of n, which the impulse ledger books. For impulses in one direction C is the rounding, but for
the way that the hulls move between `at`, at the poses of application, and the shown place, at the predicted poses.

Contacts of one instant are different points, and are never merged with each other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import reduce
from math import dist
from operator import add  # sum() rounds otherwise from Python 3.12 on

import numpy as np

from ..ship.frames import Array
from .collisions import Numbers
from .dynamics.contact import Contact, Impulse
from .interface import NO_IMPACT, ContactOutput, Impact

__all__ = ["SAME_PLACE", "ContactPoint", "fill_contacts", "fit_contact_points", "merge_contact_point", "merge_impulses"]

SAME_PLACE = 2.0
"""Contacts of a pair closer than this [m] on ship a, from different substeps, are one point that moves. With less, one
sliding contact would fill the outputs; with more, a contact that has gone would be shown with one that is elsewhere."""


@dataclass(frozen=True)
class ContactPoint:
    """A contact point over a step.

    parts: what was merged, the latest last; P (3,): impulse on body b, summed in n [N s]; P_n, P_t (3,): the parts
    along and across the normal, as the normal was each time; energy: lost [J]; collision, scratch: their numbers, 0
    where a fender acts and the hulls do not touch; impact: with which the collision began.
    """

    parts: tuple[Impulse, ...]
    P: Array
    P_n: float
    P_t: Array
    energy: float
    collision: int
    scratch: int
    impact: Impact

    @classmethod
    def of(
        cls, contact: Contact, P: Array, energy: float, collision: int, scratch: int, impact: Impact = NO_IMPACT
    ) -> ContactPoint:
        """The point of one impulse at a contact."""
        P_n = float(P @ contact.normal)
        return cls((Impulse(contact, P),), P, P_n, P - P_n * contact.normal, energy, collision, scratch, impact)

    @property
    def contact(self) -> Contact:
        """Its latest geometry."""
        return self.parts[-1].contact

    def merge(self, later: ContactPoint) -> ContactPoint:
        """Both as one, with the normal, the gap and the numbers of the later one."""
        return replace(
            later, parts=self.parts + later.parts, P=self.P + later.P, P_n=self.P_n + later.P_n,
            P_t=self.P_t + later.P_t, energy=self.energy + later.energy,
        )  # fmt: skip

    def locate(self) -> tuple[Array, Array, Array]:
        """The place in n, in b of body a and in b of body b (3,): the centre of pressure, without pressure the latest
        place."""
        if len(self.parts) > 1:
            shares = [max(float(part.P @ part.contact.normal), 0.0) for part in self.parts]
            if (total := reduce(add, shares, 0.0)) > 0.0:
                weights = np.array(shares) / total
                pressed = [part.contact for part in self.parts]
                return (
                    weights @ np.array([c.point for c in pressed]),
                    weights @ np.array([c.r_a for c in pressed]),
                    weights @ np.array([c.r_b for c in pressed]),
                )
        return self.contact.point, self.contact.r_a, self.contact.r_b

    def measure_couple(self, place: Array) -> list[float]:
        """Moment of its impulses on body b about a place (3,) in n, in n [N m s]."""
        x, y, z = place.tolist()
        along = across = down = 0.0
        for part in self.parts:
            u, v, w = part.contact.at.tolist()
            u, v, w = u - x, v - y, w - z
            P_x, P_y, P_z = part.P.tolist()
            along, across, down = along + v * P_z - w * P_y, across + w * P_x - u * P_z, down + u * P_y - v * P_x
        return [along, across, down]


def merge_impulses(
    points: list[ContactPoint],
    impulses: Sequence[Impulse],
    energies: Sequence[tuple[float, float]],
    numbers: Numbers,
) -> list[ContactPoint]:
    """The points with the impulses of a substep. energies: lost along and across the normal [J].

    Every contact is merged with the nearest point of earlier substeps at the same place. Two never share a point.
    """
    merged, free = list(points), list(range(len(points)))
    for impulse, (along, across) in zip(impulses, energies, strict=True):
        c = impulse.contact
        new = ContactPoint.of(c, impulse.P, along + across, *numbers[c.a, c.b])
        k = _find_same_place(merged, free, new)
        if k is None:
            merged.append(new)
        else:
            merged[k] = merged[k].merge(new)
            free.remove(k)
    return merged


def merge_contact_point(points: list[ContactPoint], new: ContactPoint) -> list[ContactPoint]:
    """The points with one more: merged with the nearest point at the same place, else added."""
    k = _find_same_place(points, range(len(points)), new)
    return [*points, new] if k is None else [*points[:k], points[k].merge(new), *points[k + 1 :]]


def _find_same_place(points: Sequence[ContactPoint], among: Sequence[int], new: ContactPoint) -> int | None:
    """Index of the nearest point, of those `among`, that the new one is merged with; None if none is at its place."""
    c, nearest, least = new.contact, None, SAME_PLACE
    for k in among:
        o = points[k].contact
        alike = (o.a, o.b) == (c.a, c.b) and (points[k].collision > 0) == (new.collision > 0)
        if alike and (apart := dist(o.r_a, c.r_a)) < least:
            nearest, least = k, apart
    return nearest


def fit_contact_points(points: list[ContactPoint], most: int) -> list[ContactPoint]:
    """At most so many points. Where there are more, the points of a pair become one, which keeps impulse, moment and
    energy of the pair. Of more pairs than points the largest impulses remain."""
    if len(points) <= most:
        return points
    pairs: dict[tuple[int, int, bool], ContactPoint] = {}
    for point in sorted(points, key=_size):
        pair = (point.contact.a, point.contact.b, point.collision > 0)
        pairs[pair] = pairs[pair].merge(point) if pair in pairs else point
    return sorted(pairs.values(), key=_size, reverse=True)[:most]


def fill_contacts(points: list[ContactPoint], outputs: Sequence[ContactOutput]) -> None:
    """Write the points to the outputs, and zeros to the outputs that are left."""
    for k, out in enumerate(outputs):
        if k < len(points):
            _fill(out, points[k])
        elif out.ship_a:
            _clear(out)


def _fill(out: ContactOutput, point: ContactPoint) -> None:
    c = point.contact
    place, r_a, r_b = point.locate()
    out.point[:], out.normal[:] = place.tolist(), c.normal.tolist()
    out.r_a[:], out.r_b[:], out.impulse[:] = r_a.tolist(), r_b.tolist(), point.P.tolist()
    out.couple[:] = point.measure_couple(place)
    out.gap, out.energy = c.gap, point.energy
    out.impulse_normal, out.impulse_tangential = point.P_n, float(np.linalg.norm(point.P_t))
    out.ship_a, out.ship_b, out.collision, out.scratch = c.a + 1, c.b + 1, point.collision, point.scratch
    _fill_start(out, point.impact)


def _fill_start(out: ContactOutput, impact: Impact) -> None:
    out.start, out.first[:], out.closing_speed, out.angle = (
        impact.time, impact.point, impact.closing_speed, impact.angle
    )  # fmt: skip


def _clear(out: ContactOutput) -> None:
    for vector in (out.point, out.normal, out.r_a, out.r_b, out.impulse, out.couple):
        vector[:] = [0.0, 0.0, 0.0]
    out.gap = out.impulse_normal = out.impulse_tangential = out.energy = 0.0
    out.ship_a = out.ship_b = out.collision = out.scratch = 0
    _fill_start(out, NO_IMPACT)


def _size(point: ContactPoint) -> float:
    return float(np.linalg.norm(point.P))
