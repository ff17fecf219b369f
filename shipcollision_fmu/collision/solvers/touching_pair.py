"""A pair of bodies that touch, while the impacts of one instant are answered one after the other.

The first impact of a pair reduces its contacts to one (resultant_contact.py). Later ones in the same instant, after
impacts of other pairs, act at that contact as well: point and normal of a pair are one for the instant.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...ship.frames import Array
from ..dynamics.body_state import BodyState
from ..dynamics.contact import Contact, Impulse
from ..dynamics.delassus import approach_velocities
from .resultant_contact import reduce_to_resultant
from .work_limit import WorkLimit

__all__ = ["TouchingPair"]


class TouchingPair:
    """Contacts of one pair; approach: closing speed [m/s] when it was last measured, 0 for a pair that is answered."""

    def __init__(self, contacts: list[Contact]) -> None:
        self._contacts, self._P = contacts, np.zeros(3)
        self._resultant: Contact | None = None
        self.approach = 0.0
        self._middle = [round(x, 3) for x in np.mean([c.point for c in contacts], axis=0).tolist()]

    def measure_approach(self, states: Sequence[BodyState]) -> float:
        """The largest closing speed [m/s] of its contacts, or after its first impact that of their resultant."""
        contacts = self._contacts if self._resultant is None else [self._resultant]
        self.approach = max(0.0, -float(approach_velocities(contacts, states)[0::3].min()))
        return self.approach

    def urgency(self) -> tuple[float, list[float]]:
        """Key by which the next pair is chosen. Equal approaches, to nine figures, are ordered by place: nothing in it
        depends on names."""
        return float(f"{self.approach:.8e}"), self._middle

    def reduce(self, states: Sequence[BodyState], work: WorkLimit) -> Contact:
        """The one contact at which it is answered."""
        if self._resultant is None:
            self._resultant = reduce_to_resultant(self._contacts, states, work)
        assert self._resultant is not None  # only a pair that approaches is answered
        return self._resultant

    def take(self, P: Array) -> None:
        """Add an impulse P (3,) in n on body b at the resultant contact."""
        self._P, self.approach = self._P + P, 0.0

    def shares_ship(self, other: TouchingPair, states: Sequence[BodyState]) -> bool:
        """Whether an impact of the other pair has moved one of its bodies."""
        one, two = self._contacts[0], other._contacts[0]
        return any(not states[body].fixed for body in {one.a, one.b} & {two.a, two.b})

    def impulses(self) -> list[Impulse]:
        """Its impulse, or zeros at all contacts of a pair that was not answered."""
        if self._resultant is None:
            return [Impulse(c, np.zeros(3)) for c in self._contacts]
        return [Impulse(self._resultant, self._P)]
