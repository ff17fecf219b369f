"""What the fenders of a run hold and have dissipated, pair by pair; one substep of a compressed one, booked.

Which impulse a fender gives is in fender.py. Here it meets two bodies: normal, mobility and speed where they face each
other, friction of the pair, and the books of energy that see to it that nothing comes back which was not put in.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .contact_points import ContactPoint
from .dynamics.body_state import BodyState
from .dynamics.contact import Contact, Impulse, actual_velocity, book
from .dynamics.contact_frame import contact_axes
from .dynamics.delassus import mobility
from .fender import Fender, compress_fender, solve_friction

__all__ = ["FenderLedger"]


class FenderLedger:
    """Energy in fenders: stored now, by pair of bodies, and dissipated so far [J]."""

    def __init__(self) -> None:
        self._stored: dict[tuple[int, int], float] = {}
        self._dissipated = 0.0

    @property
    def energy(self) -> tuple[float, float]:
        """(stored now, dissipated so far) in all of them [J]."""
        return float(sum(self._stored.values())), self._dissipated

    def release(self, pair: tuple[int, int]) -> None:
        """A fender that nothing compresses any more: what its spring still holds is lost."""
        self._dissipated += self._stored.pop(pair, 0.0)

    def press(
        self, fender: Fender, contact: Contact, states: Sequence[BodyState], friction: float, h: float
    ) -> ContactPoint | None:
        """One substep of h [s] of the fender that acts at a contact, whose gap is that of the hulls: its impulse booked
        with both bodies, its energy kept. None, and released, where it is not compressed."""
        pair, compression = (contact.a, contact.b), fender.thickness - contact.gap
        if compression <= 0.0:
            self.release(pair)
            return None
        axes = contact_axes(contact.normal)
        W = axes @ mobility(contact, states) @ axes.T
        before = actual_velocity(contact, states)
        v, stored = axes @ before, self._stored.get(pair, 0.0)
        compressed = compress_fender(fender, compression, -float(v[0]), float(W[0, 0]), stored, h)
        P = compressed.P * contact.normal
        rubbed = solve_friction(W[1:, 1:], v[1:] + compressed.P * W[1:, 0], friction, compressed.P)
        P = P + rubbed @ axes[1:]
        book(Impulse(contact, P), states)
        lost = float(-P @ (before + actual_velocity(contact, states)) * 0.5)
        self._stored[pair] = compressed.stored
        self._dissipated += lost - (compressed.stored - stored)
        return ContactPoint.of(contact, P, lost, 0, 0)

    def get_state(self) -> dict[str, Any]:
        """All of it as plain data."""
        return {"stored": [[a, b, stored] for (a, b), stored in self._stored.items()], "dissipated": self._dissipated}

    def set_state(self, state: dict[str, Any]) -> None:
        """Back to a state that get_state returned."""
        self._stored = {(a, b): stored for a, b, stored in state["stored"]}
        self._dissipated = state["dissipated"]
