"""Conservative advancement: which pair of bodies is examined at which substep.

A pair with the gap g cannot touch before

    m = floor(g / (h V))        substeps of h [s],    V = sum over both of |v| + |omega| reach       [m/s]

where V bounds the approach of any two points of the hulls. The pair is examined again after m substeps, with its gap
measured anew. After an impulse, every near pair is examined at the next substep, since the twists have changed. Pairs
with a fender between them are examined at every substep.

A pair is *fast* at a substep in which it may come nearer by more than a share of its thinner hull. Its first touch is
then searched within the substep (geometry/first_touch.py), and the near bodies stop there to be examined. So is the
first touch of a slow pair whose normal cannot be that of the touch: hulls of any size that overlap in height, or in
breadth, by less than they moved.

Mirtich (1996), Impulse-based dynamic simulation of rigid body systems, calls the scheme a collision scheduler.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence
from math import ceil, hypot

import numpy as np

from ..errors import StepError
from .bodies import Body
from .contact_problem import ContactCaches
from .dynamics.body_state import BodyState, advance_bodies
from .geometry.broad_phase import Pair
from .geometry.detection import FAST, Detector
from .proximity import NearPair
from .solvers.work_limit import STEP

__all__ = ["MAXIMUM_SUBSTEPS", "ConservativeAdvancement", "limit_substeps"]

MAXIMUM_SUBSTEPS = 10_000
"""Substeps of a communication step in which hulls are near each other: 100 s at 0.01 s. More is a mistake in a unit."""

MOST_PAIR_SUBSTEPS = 10_000
"""Substeps of a communication step of 0.1 s, times the pairs near each other in it; a longer step has as many more.
Larger: native steps of more than 0.2 s, where 12 jammed ships are examined in each substep."""

USUAL_SUBSTEP = 0.01
"""[s] Substeps of this length or a larger one are taken however many pairs are near each other."""

LEAST_TOUCHES = 4
"""First touches of a communication step however many pairs are near each other: a boat hits one or two ships in it."""

NEVER = 10**9
"""Substeps after which a pair that does not approach is examined: beyond any step."""


MOST_TOUCHES = 40
"""First touches in a communication step at which the bodies stop. Beyond, hulls are examined at the ends of substeps
only: a fast thin body may then pass another. Without a limit, a body that rattles between others takes any time."""

MOST_EXAMINED = 120
"""Pairs examined at first touches in a communication step: MOST_TOUCHES for a boat between a ship and a quay, which are
three pairs. Larger: four boats that rattle between ships take more than 100 ms in a step."""


class ConservativeAdvancement:
    """Substeps of one communication step of H [s], the pairs due at each, and the motion of the bodies up to it."""

    def __init__(
        self, H: float, substep: float, bodies: Sequence[Body], states: Sequence[BodyState], detector: Detector,
        caches: ContactCaches, near: Mapping[Pair, NearPair], with_fender: Container[Pair],
    ) -> None:  # fmt: skip
        """near: pairs that could touch within the step. Raises StepError for too many substeps."""
        self._requested, self.h = divide_into_substeps(H, substep)
        self.count = limit_substeps(self._requested, H, len(near))
        self.is_limited = self.count < self._requested
        if self.is_limited:
            self.h = H / self.count
        self._H, self._bodies, self._states, self._detector, self._caches = H, bodies, states, detector, caches
        self._moving = [states[i] for i in {i for pair in near for i in pair} if not states[i].fixed]
        self._fenders = any(pair in with_fender for pair in near)
        self._approach = {pair: each.approach for pair, each in near.items()}  # bounds [m/s] until twists change
        self._due = {pair: 0 if pair in with_fender else self._free_substeps(pair, near[pair].gap) for pair in near}
        self._fast = {pair: FAST * detector.thickness(*pair) / self.h for pair in near}  # speed limits [m/s]
        self._apart = {pair for pair in near if near[pair].gap > 0.0}  # when last measured
        self.touched = False  # set it when impulses were given at a stop
        self.touches_left = min(MOST_TOUCHES, max(LEAST_TOUCHES, MOST_EXAMINED // len(near)))
        self._most_touches = self.touches_left
        self._pending_substeps = 0  # by which the predicted poses lag

    def pairs_due(self, substep: int) -> list[Pair]:
        """Pairs to be examined at the end of a substep, counted from 0. Call it for every substep in turn."""
        self._pending_substeps += 1
        return [pair for pair, due in self._due.items() if due <= substep]

    def advance(self, substep: int, pairs: list[Pair]) -> Iterator[tuple[float, list[Pair]]]:
        """Move the near bodies through a substep, and stop at each first touch and at its end.

        Yields (time [s] since the start of the step, pairs to be examined there). Twists may change in between: set
        `touched` then. In the end, sets when the pairs are due again.
        """
        self.touched, examined, passed = False, pairs, 0.0
        if self._fenders:
            self._approach.clear()
        if self._fast_pairs(pairs):
            self._pending_substeps -= 1
            self._advance_pending()
            touch = self._advance_to_touch(pairs, self.h)
        else:
            self._advance_pending()
            touch = self._return_to_missed_touch(pairs)
        while touch is not None:
            self.touches_left -= 1
            passed += touch
            yield substep * self.h + passed, pairs
            self._approach.clear()
            pairs = list(self._due)
            touch = self._advance_to_touch(pairs, self.h - passed)
        yield (substep + 1) * self.h, pairs
        self._reschedule(substep, examined)

    def _advance_to_touch(self, pairs: list[Pair], rest: float) -> float | None:
        """Move the near bodies to the first touch within the rest [s] of a substep, else by the rest.

        Returns the time [s] of the touch, None without one.
        """
        touch = self._first_touch(self._fast_pairs(pairs), rest) if self.touches_left else None
        advance_bodies(self._moving, rest if touch is None else touch)
        missed = self._return_to_missed_touch(pairs, rest if touch is None else touch)
        return touch if missed is None else missed

    def _return_to_missed_touch(self, pairs: list[Pair], moved: float | None = None) -> float | None:
        """Move the near bodies back to the first touch of slow pairs, if it was missed in the last motion, of a substep
        or of `moved` [s].

        Returns the time [s] of that touch after the motion began, None without one.
        """
        known, detector, states = self._caches.last_normals, self._detector, self._states
        missed = [p for p in pairs if p in self._apart and p not in known and detector.misses_first_touch(*p, states)]
        if not missed or not self.touches_left:
            return None
        reached = [(state.x, state.R) for state in self._moving]
        for state in self._moving:
            state.x, state.R = state.pose_before
        apart = [(p, self._relative_speed(*p)) for p in missed if not detector.touching(*p, states)]
        touch = self._first_touch(apart, self.h if moved is None else moved)
        if touch is None:
            for state, (x, R) in zip(self._moving, reached, strict=True):
                state.x, state.R = x, R
        else:
            advance_bodies(self._moving, touch)
        return touch

    def _advance_pending(self) -> None:
        advance_bodies(self._moving, self.h, self._pending_substeps)
        self._pending_substeps = 0

    def _reschedule(self, substep: int, examined: Sequence[Pair]) -> None:
        """Set when the pairs examined at a substep are due again."""
        if self.touched:
            self._approach.clear()
            self._due = dict.fromkeys(self._due, substep + 1)
        elif not self._fenders:
            rest = (self.count - 1 - substep) * self.h
            for pair in examined:
                gap = self._detector.clearance(*pair, self._states, rest * self._approach_speed(pair))
                self._due[pair] = substep + 1 + self._free_substeps(pair, gap)
                if gap > 0.0:
                    self._apart.add(pair)

    def describe_limited(self, t: float) -> str:
        """The warning of the step from t [s] if it has fewer substeps than were asked for."""
        return (
            f"{len(self._due)} pairs of hulls are near each other in the step from t = {t:g} s by {self._H:g} s, which "
            f"has {self.count} substeps in place of {self._requested}: take a longer substep, or shorter steps"
        )

    def describe_exhausted(self, t: float) -> str:
        """The warning of the step from t [s] if it had more first touches than are looked for."""
        return (
            f"fast or thin bodies touched {self._most_touches} times in the step from t = {t:g} s by {self._H:g} s; "
            "later touches in it may be missed: take shorter steps"
        )

    def finish(self) -> None:
        """Move the near bodies to the end of the communication step."""
        if self._pending_substeps == self.count:
            advance_bodies(self._moving, self._H)
        else:
            self._advance_pending()

    def _first_touch(self, pairs: Sequence[tuple[Pair, float]], rest: float) -> float | None:
        """Time [s] of the first touch of pairs within the rest [s] of the substep; None: there is none.

        pairs: with the bounds of their relative speeds [m/s].
        """
        first: float | None = None
        for pair, speed in pairs:
            touch = self._detector.first_touch(
                *pair, self._states, rest if first is None else first, speed, self._caches.last_normals
            )
            first = touch if touch is not None else first
        return first

    def _fast_pairs(self, pairs: Sequence[Pair]) -> list[tuple[Pair, float]]:
        """Pairs that may come so near within a substep that their first touch is looked for (detection.FAST), and the
        bound of their relative speed [m/s]."""
        fast = []
        for pair in pairs:
            limit = self._fast[pair]
            if self._approach_speed(pair) > limit and (speed := self._relative_speed(*pair)) > limit:
                fast.append((pair, speed))
        return fast

    def _relative_speed(self, a: int, b: int) -> float:
        """Bound [m/s] of the relative speed of any two points of the hulls."""
        velocity, turning = np.zeros(3), 0.0
        for i, sign in ((a, 1.0), (b, -1.0)):
            if not self._states[i].fixed:
                v, omega = self._states[i].predicted_motion()
                velocity = velocity + sign * v
                turning += 0.0 if omega is None else 2.0 * self._bodies[i].reach * hypot(*omega.tolist())
        return hypot(*velocity.tolist()) + turning

    def _free_substeps(self, pair: Pair, gap: float) -> int:
        """Substeps in which a gap [m] cannot close."""
        if gap <= 0.0:
            return 0
        self._caches.last_normals.pop(pair, None)
        approach = self.h * self._approach_speed(pair)
        return int(min(gap / approach, NEVER)) if approach > 0.0 else NEVER

    def _approach_speed(self, pair: Pair) -> float:
        """Bound V [m/s] of the speed at which two hulls come nearer."""
        if pair not in self._approach:
            self._approach[pair] = sum(self._bodies[i].largest_speed(self._states[i]) for i in pair)
        return self._approach[pair]


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


def limit_substeps(count: int, H: float, near: int) -> int:
    """`count`, or the fewer substeps of a step of H [s] that so many pairs near each other leave."""
    most = max(MOST_PAIR_SUBSTEPS * max(1.0, H / STEP) / near, ceil(H / USUAL_SUBSTEP - 1e-9))
    return count if count <= most else int(most)
