"""The contact points of a communication step: contacts of its substeps, merged where the place is the same."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..ship.frames import Array
from .collisions import Numbers
from .dynamics.contact import Contact, Impulse
from .interface import ContactOutput

__all__ = ["SAME_PLACE", "ContactPoint", "fill_contacts", "fit_contact_points", "merge_contact_point", "merge_impulses"]

SAME_PLACE = 2.0
"""Contacts of a pair closer than this [m] on ship a, from different substeps, are one point that moves. With less, one
sliding contact would fill the outputs; with more, both ends of a short line of contact would be one point."""


@dataclass(frozen=True)
class ContactPoint:
    """A contact point over a step.

    contact: its latest geometry; P (3,): impulse on body b, summed in n [N s]; P_n, P_t (3,): the parts along and
    across the normal, as the normal was each time; energy: lost [J]; collision, scratch: their numbers, 0 where a
    fender acts and the hulls do not touch.
    """

    contact: Contact
    P: Array
    P_n: float
    P_t: Array
    energy: float
    collision: int
    scratch: int

    @classmethod
    def of(cls, contact: Contact, P: Array, energy: float, collision: int, scratch: int) -> ContactPoint:
        """The point of one impulse at a contact."""
        P_n = float(P @ contact.normal)
        return cls(contact, P, P_n, P - P_n * contact.normal, energy, collision, scratch)

    def merge(self, later: ContactPoint) -> ContactPoint:
        """Both as one, with the geometry and the numbers of the later one."""
        return replace(
            later, P=self.P + later.P, P_n=self.P_n + later.P_n, P_t=self.P_t + later.P_t,
            energy=self.energy + later.energy,
        )  # fmt: skip


def merge_impulses(
    points: list[ContactPoint],
    impulses: Sequence[Impulse],
    energies: Sequence[tuple[float, float]],
    numbers: Numbers,
) -> list[ContactPoint]:
    """The points with the impulses of a substep. energies: lost along and across the normal [J]."""
    for impulse, (along, across) in zip(impulses, energies, strict=True):
        c = impulse.contact
        points = merge_contact_point(points, ContactPoint.of(c, impulse.P, along + across, *numbers[c.a, c.b]))
    return points


def merge_contact_point(points: list[ContactPoint], new: ContactPoint) -> list[ContactPoint]:
    """The points with one more: merged with the point at the same place, else added."""
    c = new.contact
    for k, old in enumerate(points):
        o = old.contact
        alike = (o.a, o.b) == (c.a, c.b) and (old.collision > 0) == (new.collision > 0)
        if alike and np.linalg.norm(o.r_a - c.r_a) < SAME_PLACE:
            return [*points[:k], old.merge(new), *points[k + 1 :]]
    return [*points, new]


def fit_contact_points(points: list[ContactPoint], most: int) -> list[ContactPoint]:
    """At most so many points. Where there are more, the points of a pair become one, at the place of the largest
    impulse, which keeps impulse and energy of the pair. Of more pairs than points the largest impulses remain."""
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
    out.point[:], out.normal[:] = c.point.tolist(), c.normal.tolist()
    out.r_a[:], out.r_b[:], out.impulse[:] = c.r_a.tolist(), c.r_b.tolist(), point.P.tolist()
    out.gap, out.energy = c.gap, point.energy
    out.impulse_normal, out.impulse_tangential = point.P_n, float(np.linalg.norm(point.P_t))
    out.ship_a, out.ship_b, out.collision, out.scratch = c.a + 1, c.b + 1, point.collision, point.scratch


def _clear(out: ContactOutput) -> None:
    for vector in (out.point, out.normal, out.r_a, out.r_b, out.impulse):
        vector[:] = [0.0, 0.0, 0.0]
    out.gap = out.impulse_normal = out.impulse_tangential = out.energy = 0.0
    out.ship_a = out.ship_b = out.collision = out.scratch = 0


def _size(point: ContactPoint) -> float:
    return float(np.linalg.norm(point.P))
