"""Who is near whom: pairs that could touch within a step, by their bounds first, and the gaps that remain."""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot

from .bodies import Body, apart
from .dynamics.body_state import BodyState
from .geometry.broad_phase import Rectangle, near_pairs
from .geometry.detection import Detector
from .interface import ShipState

__all__ = ["Pair", "Proximity", "room"]

REACH_MARGIN = 0.1
"""Gap [m] within which a pair at rest still counts as near."""

Pair = tuple[int, int]


def room(body: Body, state: BodyState, H: float) -> float:
    """How far any point of the hull may get in H [s], and the fender before it [m]."""
    if state.fixed:
        return body.around
    u, v, w, p, q, r = state.expected.tolist()
    return body.around + H * (hypot(u, v, w) + hypot(p, q, r) * body.reach)


class Proximity:
    """Pairs and distances among bodies, of which the first `ships` move. range: beyond it nothing is measured [m]."""

    def __init__(self, bodies: Sequence[Body], ships: int, detector: Detector, reach: float) -> None:
        self._bodies, self._ships, self._detector, self._range = bodies, ships, detector, reach
        half = 0.5 * reach
        self._standing = [_widened(body, half + body.around) for body in bodies[ships:]]

    def candidates(self, states: Sequence[BodyState | None], received: Sequence[ShipState], H: float) -> list[Pair]:
        """Pairs that could come within the range, or touch, in H [s]; all others are out of this step. A ship without a
        state yet is taken from her ship.

        Ships that stand on each other at the origin are ships of which nothing has been heard: FMPy's SSP master sends
        noughts in its first step, whatever the start values are. They do not collide.
        """
        half = 0.5 * self._range
        rectangles: list[Rectangle] = []
        for body, state, ship in zip(self._bodies, states, received, strict=False):
            if state is None:
                n, e, _ = ship.position
                d = body.around + H * (hypot(*ship.velocity) + hypot(*ship.rate) * body.reach)
            else:
                n, e, _ = state.x.tolist()
                d = room(body, state, H)
            d += half + body.reach
            rectangles.append((n - d, n + d, e - d, e + d))
        pairs = near_pairs(rectangles + self._standing, self._ships)
        unheard = {i for i, ship in enumerate(received) if _is_nought(ship)}
        return pairs if len(unheard) < 2 else [pair for pair in pairs if not unheard.issuperset(pair)]

    def near(self, candidates: Sequence[Pair], states: Sequence[BodyState], H: float) -> dict[Pair, float]:
        """Pairs of them whose hulls, or fenders, could touch within H [s], and their gaps [m]."""
        found = {}
        for a, b in candidates:
            most = REACH_MARGIN + room(self._bodies[a], states[a], H) + room(self._bodies[b], states[b], H)
            if self._bounds_apart(a, b, states) <= most and (gap := self._gap(a, b, states, most)) < most:
                found[a, b] = gap
        return found

    def clearance(self, candidates: Sequence[Pair], states: Sequence[BodyState]) -> tuple[float, Pair]:
        """Least distance between hulls [m], capped, and between which, numbered from 1; (0, 0): none are within the
        range. The nearest bounds first: they soon rule out the others."""
        least, nearest = self._range, (0, 0)
        bounds = [(self._bounds_apart(a, b, states), a, b) for a, b in candidates]
        for bound, a, b in sorted(bounds) if len(bounds) > 1 else bounds:
            if bound >= least:
                break
            if (gap := self._gap(a, b, states, least)) < least:
                least, nearest = gap, (a + 1, b + 1)
        return least, nearest

    def _bounds_apart(self, a: int, b: int, states: Sequence[BodyState]) -> float:
        """Horizontal distance [m] of the bounds of two hulls, circles or an obstacle's rectangle; not more than the
        hulls'."""
        n, e, _ = states[a].x.tolist()
        one, other = self._bodies[a], self._bodies[b]
        if states[b].fixed:
            return apart((n, e), one.reach, other.rectangle)
        n_b, e_b, _ = states[b].x.tolist()
        return hypot(n_b - n, e_b - e) - one.reach - other.reach

    def _gap(self, a: int, b: int, states: Sequence[BodyState], cap: float) -> float:
        self._detector.place(a, states[a])
        if not states[b].fixed:
            self._detector.place(b, states[b])
        return self._detector.clearance(a, b, cap)


def _is_nought(ship: ShipState) -> bool:
    return not (any(ship.position) or any(ship.attitude) or any(ship.velocity) or any(ship.rate))


def _widened(body: Body, by: float) -> Rectangle:
    n_0, n_1, e_0, e_1 = body.rectangle
    return n_0 - by, n_1 + by, e_0 - by, e_1 + by
