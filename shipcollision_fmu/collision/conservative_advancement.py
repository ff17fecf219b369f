"""Conservative advancement: which pair of bodies is examined at which substep.

A pair with the gap g cannot touch before

    m = floor(g / (h V))        substeps of h [s],    V = sum over both of |v| + |omega| reach       [m/s]

where V bounds the approach of any two points of the hulls. The pair is examined again after m substeps, with its gap
measured anew. After an impulse, every near pair is examined at the next substep, since the twists have changed. Pairs
with a fender between them are examined at every substep.

Mirtich (1996), Impulse-based dynamic simulation of rigid body systems, calls the scheme a collision scheduler.
"""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from math import ceil

from ..errors import StepError
from .bodies import Body
from .contact_problem import ContactCaches
from .dynamics.body_state import BodyState
from .geometry.broad_phase import Pair
from .geometry.detection import Detector

__all__ = ["MAXIMUM_SUBSTEPS", "ConservativeAdvancement"]

MAXIMUM_SUBSTEPS = 10_000
"""Substeps of a communication step in which hulls are near each other: 100 s at 0.01 s. More is a mistake in a unit."""

NEVER = 10**9
"""Substeps after which a pair that does not approach is examined: beyond any step."""


class ConservativeAdvancement:
    """Substeps of one communication step of H [s], the pairs due at each, and the motion of the bodies up to it."""

    def __init__(
        self, H: float, substep: float, bodies: Sequence[Body], states: Sequence[BodyState], detector: Detector,
        caches: ContactCaches, near: Mapping[Pair, float], with_fender: Container[Pair],
    ) -> None:  # fmt: skip
        """near: pairs that could touch within the step, and their gaps [m]. Raises StepError for too many substeps."""
        self.count, self.h = divide_into_substeps(H, substep)
        self._H, self._bodies, self._states, self._detector, self._caches = H, bodies, states, detector, caches
        self._moving = [states[i] for i in {i for pair in near for i in pair} if not states[i].fixed]
        self._fenders = any(pair in with_fender for pair in near)
        self._due = {pair: 0 if pair in with_fender else self._free_substeps(pair, gap) for pair, gap in near.items()}
        self._pending_substeps = 0  # by which the predicted poses lag

    def pairs_due(self, substep: int) -> list[Pair]:
        """Pairs to be examined at the end of a substep, counted from 0. Call it for every substep in turn."""
        self._pending_substeps += 1
        return [pair for pair, due in self._due.items() if due <= substep]

    def advance(self) -> None:
        """Move the near bodies to the end of the substep."""
        for state in self._moving:
            state.advance(self.h, self._pending_substeps)
        self._pending_substeps = 0

    def reschedule(self, substep: int, examined: Sequence[Pair], touched: bool) -> None:
        """Set when the pairs examined at a substep are due again. touched: impulses were given."""
        if touched:
            self._due = dict.fromkeys(self._due, substep + 1)
        elif not self._fenders:
            rest = (self.count - 1 - substep) * self.h
            for pair in examined:
                gap = self._detector.clearance(*pair, self._states, rest * self._approach_speed(pair))
                self._due[pair] = substep + 1 + self._free_substeps(pair, gap)

    def finish(self) -> None:
        """Move the near bodies to the end of the communication step."""
        if self._pending_substeps == self.count:
            for state in self._moving:
                state.advance(self._H)
        else:
            self.advance()

    def _free_substeps(self, pair: Pair, gap: float) -> int:
        """Substeps in which a gap [m] cannot close."""
        if gap <= 0.0:
            return 0
        self._caches.last_normals.pop(pair, None)
        approach = self.h * self._approach_speed(pair)
        return int(min(gap / approach, NEVER)) if approach > 0.0 else NEVER

    def _approach_speed(self, pair: Pair) -> float:
        """Bound V [m/s] of the speed at which two hulls come nearer."""
        return sum(self._bodies[i].largest_speed(self._states[i]) for i in pair)


def divide_into_substeps(H: float, substep: float) -> tuple[int, float]:
    """(number, length [s]) of the substeps of H [s]: of `substep` exactly where H is a multiple of it, else of H / n.

    The last bits of a master's step are jitter. They must not reach the contact solver, hence the tolerance. Raises
    StepError for too many substeps.
    """
    if not H / substep <= MAXIMUM_SUBSTEPS:
        raise StepError(
            f"a step of {H:g} s takes {H / substep:.3g} substeps of {substep:g} s, at most {MAXIMUM_SUBSTEPS} where "
            "hulls are near: take shorter steps, or a longer substep"
        )
    n = max(1, round(H / substep))
    if abs(H - n * substep) <= 1e-6 * substep:
        return n, substep
    n = ceil(H / substep)
    return n, H / n
