"""Energy in the fenders of a run, pair by pair, and one substep of the compressed ones.

fender.py has the law of a fender. Here it acts between two bodies: normal, mobility and speed where they face each
other, and friction of the pair. The ledger of energy ensures that a fender returns no more than was put in.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce
from operator import add  # sum() rounds otherwise from Python 3.12 on
from typing import Any

from .bodies import Body
from .contact_points import ContactPoint, merge_contact_point
from .contact_problem import ContactCaches
from .dynamics.body_state import BodyState
from .dynamics.contact import Contact, Impulse, book_impulses, energy_velocities
from .dynamics.delassus import mobility
from .fender import Fender, combine_in_series, compress_fender, solve_friction
from .geometry.broad_phase import Pair
from .geometry.detection import Detector

__all__ = ["FenderLedger", "select_fenders"]


def select_fenders(bodies: Sequence[Body], pairs: Sequence[Pair]) -> dict[Pair, Fender]:
    """The pairs with a fender between them, and that fender."""
    with_fender = [(a, b) for a, b in pairs if bodies[a].fender or bodies[b].fender]
    fenders = {(a, b): combine_in_series(bodies[a].fender, bodies[b].fender) for a, b in with_fender}
    return {pair: fender for pair, fender in fenders.items() if fender is not None}


class FenderLedger:
    """Energy in fenders: stored now, by pair of bodies, and dissipated so far [J]."""

    def __init__(self) -> None:
        self._stored: dict[Pair, float] = {}
        self._dissipated = 0.0

    @property
    def energy(self) -> tuple[float, float]:
        """(stored now, dissipated so far) in all of them [J]."""
        return float(reduce(add, self._stored.values(), 0.0)), self._dissipated

    def press(
        self, fenders: Mapping[Pair, Fender], detector: Detector, caches: ContactCaches, states: Sequence[BodyState],
        friction: float, h: float, points: list[ContactPoint],
    ) -> list[ContactPoint]:  # fmt: skip
        """One substep of h [s] of these fenders, one after the other. Returns the points with those of the fenders."""
        for (a, b), fender in fenders.items():
            contact = detector.facing(a, b, fender.thickness, states, caches.last_normals)
            if contact is None or fender.thickness - contact.gap <= 0.0:
                self._release((a, b))
            else:
                points = merge_contact_point(points, self._press_one(fender, contact, states, friction, h))
        return points

    def _release(self, pair: Pair) -> None:
        """End of compression: what the spring still holds is dissipated."""
        self._dissipated += self._stored.pop(pair, 0.0)

    def _press_one(
        self, fender: Fender, contact: Contact, states: Sequence[BodyState], friction: float, h: float
    ) -> ContactPoint:
        """Book the impulse of a compressed fender, and its energy. contact: its gap is that of the hulls."""
        pair, compression, axes = (contact.a, contact.b), fender.thickness - contact.gap, contact.axes
        W = mobility(contact, states)
        (before,) = energy_velocities([contact], states)
        v, stored = axes @ before, self._stored.get(pair, 0.0)
        compressed = compress_fender(fender, compression, -float(v[0]), float(W[0, 0]), stored, h)
        rubbing = solve_friction(W[1:, 1:], v[1:] + compressed.P * W[1:, 0], friction, compressed.P)
        P = compressed.P * contact.normal + rubbing @ axes[1:]
        lost = book_impulses([Impulse(contact, P)], states)[0].lost
        self._stored[pair] = compressed.stored
        self._dissipated += lost - (compressed.stored - stored)
        return ContactPoint.of(contact, P, lost, 0, 0)

    def get_state(self) -> dict[str, Any]:
        """All of it as plain data."""
        return {"stored": [[a, b, stored] for (a, b), stored in self._stored.items()], "dissipated": self._dissipated}

    def set_state(self, state: dict[str, Any]) -> None:
        """Back to a state of get_state, exact to the bit."""
        self._stored = {(a, b): stored for a, b, stored in state["stored"]}
        self._dissipated = state["dissipated"]
