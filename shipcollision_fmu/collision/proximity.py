"""Pairs of bodies that could touch within a step, and the distances between hulls.

candidates    by rectangles in the plane (broad_phase.py), from the motion possible in the step
near          candidates whose bounds, then whose hulls, are closer than they can move in the step
clearance     least distance between hulls
"""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot
from typing import NamedTuple

from .bodies import Body
from .dynamics.body_state import BodyState
from .geometry.broad_phase import Pair, Rectangle, near_pairs
from .geometry.detection import Detector
from .interface import ShipState

__all__ = ["NearPair", "Proximity"]

REACH_MARGIN = 0.1
"""Gap [m] within which a pair at rest still counts as near. With zero, rounding of the bounds could miss a contact."""


class NearPair(NamedTuple):
    """Bodies that could touch within a step. gap: between their hulls [m]; approach: bound of its speed [m/s]."""

    gap: float
    approach: float


class Proximity:
    """Pairs and distances among bodies, of which the first `ships` move. clearance_range: cap of the clearance [m]."""

    def __init__(self, bodies: Sequence[Body], ships: int, detector: Detector, clearance_range: float) -> None:
        self._bodies, self._ships, self._detector, self._range = bodies, ships, detector, clearance_range
        half = 0.5 * clearance_range
        self._obstacles = [_widen(body.rectangle, half + body.fender_thickness) for body in bodies[ships:]]

    def find_candidates(
        self,
        states: Sequence[BodyState | None],
        received: Sequence[ShipState],
        H: float,
        absent: frozenset[int] = frozenset(),
    ) -> list[Pair]:
        """Pairs that could touch, or come within clearance_range, in H [s]. All others take no part in the step.

        A ship whose state is None is taken as received. Ships that are all zero (position, attitude, twist) have not
        been received yet, and do not collide with each other: FMPy's SSP master sends zeros in its first step, whatever
        the start values are. Ships of whose state nothing was ever set are absent: they have no pairs at all.
        """
        half = 0.5 * self._range
        rectangles: list[Rectangle] = []
        for body, state, ship in zip(self._bodies, states, received, strict=False):
            if state is None:
                n, e, _ = ship.position
                d = body.fender_thickness + H * (hypot(*ship.velocity) + hypot(*ship.rate) * body.reach)
            else:
                n, e, _ = state.x.tolist()
                d = body.fender_thickness + H * body.largest_speed(state)
            d += half + body.reach
            rectangles.append((n - d, n + d, e - d, e + d))
        pairs = near_pairs(rectangles + self._obstacles, self._ships)
        if absent:
            pairs = [pair for pair in pairs if absent.isdisjoint(pair)]
        not_received = {i for i, ship in enumerate(received) if _is_zero(ship)}
        return pairs if len(not_received) < 2 else [pair for pair in pairs if not not_received.issuperset(pair)]

    def find_near(self, candidates: Sequence[Pair], states: Sequence[BodyState], H: float) -> dict[Pair, NearPair]:
        """Candidates whose hulls, or fenders, could touch within H [s]."""
        if not candidates:
            return {}
        speed = {i: self._bodies[i].largest_speed(states[i]) for i in {i for pair in candidates for i in pair}}
        motion = {i: self._bodies[i].fender_thickness + H * v for i, v in speed.items()}
        near = {}
        for a, b in candidates:
            most = REACH_MARGIN + motion[a] + motion[b]
            if (
                self._bounds_distance(a, b, states) <= most
                and (gap := self._detector.clearance(a, b, states, most)) < most
            ):
                near[a, b] = NearPair(gap, speed[a] + speed[b])
        return near

    def measure_clearance(self, candidates: Sequence[Pair], states: Sequence[BodyState]) -> tuple[float, Pair]:
        """Least distance between hulls [m], at most clearance_range, and its pair, numbered from 1.

        The pair is (0, 0) where no hulls are within the range. Pairs with the nearest bounds are measured first: their
        distances soon exclude the others.
        """
        least, nearest = self._range, (0, 0)
        bounds = [(self._bounds_distance(a, b, states), a, b) for a, b in candidates]
        for bound, a, b in sorted(bounds) if len(bounds) > 1 else bounds:
            if bound >= least:
                break
            if (gap := self._detector.clearance(a, b, states, least)) < least:
                least, nearest = gap, (a + 1, b + 1)
        return least, nearest

    def _bounds_distance(self, a: int, b: int, states: Sequence[BodyState]) -> float:
        """Horizontal distance [m] of the bounds of two hulls: circles, or the rectangle of an obstacle. It is not more
        than the distance of the hulls."""
        n, e, _ = states[a].x.tolist()
        one, other = self._bodies[a], self._bodies[b]
        if states[b].fixed:
            n_0, n_1, e_0, e_1 = other.rectangle
            return hypot(max(n_0 - n, 0.0, n - n_1), max(e_0 - e, 0.0, e - e_1)) - one.reach
        n_b, e_b, _ = states[b].x.tolist()
        return hypot(n_b - n, e_b - e) - one.reach - other.reach


def _is_zero(ship: ShipState) -> bool:
    return not (any(ship.position) or any(ship.attitude) or any(ship.velocity) or any(ship.rate))


def _widen(rectangle: Rectangle, by: float) -> Rectangle:
    n_0, n_1, e_0, e_1 = rectangle
    return n_0 - by, n_1 + by, e_0 - by, e_1 + by
