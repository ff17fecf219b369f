"""The contact points of a communication step: those of its substeps, joined where they are the same place."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..ship.frames import Array
from .dynamics.contact import Contact
from .interface import ContactOutput

__all__ = ["SAME_PLACE", "ContactPoint", "fit_contact_points", "merge_contact_point"]

SAME_PLACE = 2.0
"""Contact points of a pair closer than this [m] on ship a, from different substeps, are one point that moves."""


@dataclass(frozen=True)
class ContactPoint:
    """A contact point over a step: its latest geometry, the impulse P (3,) on ship b summed in n and, of that, what was
    along the normal P_n and across it P_t (3,), as the normal was each time; the energy lost [J]. Numbers of collision
    and scratch are 0 where a fender acts and the hulls do not touch."""

    contact: Contact | None
    P: Array
    P_n: float
    P_t: Array
    energy: float
    impact: int
    scratch: int

    @classmethod
    def of(cls, contact: Contact, P: Array, energy: float, impact: int, scratch: int) -> ContactPoint:
        """One impulse at a contact."""
        P_n = float(P @ contact.normal)
        return cls(contact, P, P_n, P - P_n * contact.normal, energy, impact, scratch)

    @classmethod
    def unused(cls) -> ContactPoint:
        """A point in which nothing touched."""
        return cls(None, np.zeros(3), 0.0, np.zeros(3), 0.0, 0, 0)

    def joined(self, other: ContactPoint) -> ContactPoint:
        """Both as one, with the other's geometry and numbers."""
        return replace(
            other, P=self.P + other.P, P_n=self.P_n + other.P_n, P_t=self.P_t + other.P_t,
            energy=self.energy + other.energy,
        )  # fmt: skip

    def fill(self, place: ContactOutput) -> None:
        """Write it where the outputs are."""
        c = self.contact
        if c is None:
            for vector in (place.point, place.normal, place.r_a, place.r_b, place.impulse):
                vector[:] = [0.0, 0.0, 0.0]
            place.gap = place.impulse_normal = place.impulse_tangential = place.energy = 0.0
            place.ship_a = place.ship_b = place.collision = place.scratch = 0
            return
        place.point[:], place.normal[:] = c.point.tolist(), c.normal.tolist()
        place.r_a[:], place.r_b[:], place.impulse[:] = c.r_a.tolist(), c.r_b.tolist(), self.P.tolist()
        place.gap, place.energy = c.gap, self.energy
        place.impulse_normal, place.impulse_tangential = self.P_n, float(np.linalg.norm(self.P_t))
        place.ship_a, place.ship_b, place.collision, place.scratch = c.a + 1, c.b + 1, self.impact, self.scratch


def merge_contact_point(points: list[ContactPoint], new: ContactPoint) -> list[ContactPoint]:
    """The points with one more contact: added to the point at the same place, else as a point of its own."""
    c = new.contact
    assert c is not None
    for k, old in enumerate(points):
        o = old.contact
        alike = o is not None and (o.a, o.b) == (c.a, c.b) and (old.impact > 0) == (new.impact > 0)
        if o is not None and alike and np.linalg.norm(o.r_a - c.r_a) < SAME_PLACE:
            return [*points[:k], old.joined(new), *points[k + 1 :]]
    return [*points, new]


def fit_contact_points(points: list[ContactPoint], most: int) -> list[ContactPoint]:
    """At most so many points: if there are more, the points of a pair become one, at the place of the largest impulse,
    so that impulse and energy of every pair are kept; of more pairs than points those of the largest impulses."""
    if len(points) <= most:
        return points
    pairs: dict[tuple[int, int, bool], ContactPoint] = {}
    for point in sorted(points, key=_size):
        assert point.contact is not None
        pair = (point.contact.a, point.contact.b, point.impact > 0)
        pairs[pair] = pairs[pair].joined(point) if pair in pairs else point
    return sorted(pairs.values(), key=_size, reverse=True)[:most]


def _size(point: ContactPoint) -> float:
    return float(np.linalg.norm(point.P))
