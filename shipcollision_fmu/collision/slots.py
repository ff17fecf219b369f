"""The contact points of a communication step: those of its substeps, joined where they are the same place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..ship.frames import Array
from .contact import Contact
from .ports import ContactSlot

__all__ = ["SAME_PLACE", "Slot", "merged"]

SAME_PLACE = 2.0
"""Contact points of a pair closer than this [m] on ship a, from different substeps, are one point that moves."""


@dataclass(frozen=True)
class Slot:
    """A contact point over a step: its latest geometry, the impulse P (3,) on ship b summed in n, the energy lost
    [J]. Numbers of collision and scratch are 0 where a fender acts and the hulls do not touch."""

    contact: Contact | None
    P: Array
    energy: float
    impact: int
    scratch: int

    @classmethod
    def unused(cls) -> Slot:
        """A slot in which nothing touched."""
        return cls(None, np.zeros(3), 0.0, 0, 0)

    def fill(self, place: ContactSlot) -> None:
        """Write it where the outputs are."""
        c = self.contact
        if c is None:
            for values in (place.point, place.normal, place.r_a, place.r_b, place.impulse, place.values):
                values[:] = [0.0] * len(values)
            place.ship_a = place.ship_b = place.impact = place.scratch = 0
            return
        place.point[:], place.normal[:] = c.point.tolist(), c.normal.tolist()
        place.r_a[:], place.r_b[:], place.impulse[:] = c.r_a.tolist(), c.r_b.tolist(), self.P.tolist()
        P_n = float(self.P @ c.normal)
        place.values[:] = [c.gap, P_n, float(np.linalg.norm(self.P - P_n * c.normal)), self.energy]
        place.ship_a, place.ship_b, place.impact, place.scratch = c.a + 1, c.b + 1, self.impact, self.scratch


def merged(slots: list[Slot], new: Slot) -> list[Slot]:
    """The slots with one more contact: added to the slot at the same place, else as a slot of its own."""
    c = new.contact
    assert c is not None
    for k, old in enumerate(slots):
        o = old.contact
        alike = o is not None and (o.a, o.b) == (c.a, c.b) and (old.impact > 0) == (new.impact > 0)
        if o is not None and alike and np.linalg.norm(o.r_a - c.r_a) < SAME_PLACE:
            joined = Slot(c, old.P + new.P, old.energy + new.energy, new.impact, new.scratch)
            return [*slots[:k], joined, *slots[k + 1 :]]
    return [*slots, new]
