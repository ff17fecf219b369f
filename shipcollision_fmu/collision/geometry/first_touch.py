"""When two moving hulls touch first: conservative advancement along separating axes.

    s(n, tau) = min over b of n.p(tau) - max over a of n.p(tau)        separation along an axis n at the time tau  [m]

s is never more than the gap of two convex parts, whatever n is. Along the normal of the closest points, s is the gap
itself. As long as s along one axis is positive, the parts do not touch:

    1. closest points at tau: gap, n                                   Bullet
    2. the first time at which gap + s(n, .) - s(n, tau) reaches the target; none: the parts do not touch
    3. repeat from there, until the gap is no more than the target

Parts that touch at the start have an axis already: the last normal of the pair, carried by its hull. The next touch of
such parts is where the overlap along the normal has grown to `growth`, or by two TOUCH if it is more: a log that was
hit at one end swings its other end round.

Mirtich (1996), conservative advancement; Catto (2013), Continuous collision: the search along local separating axes.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import ceil, hypot

import numpy as np

from ...ship.frames import Array
from ..dynamics.body_state import BodyState
from .narrow_phase import MARGIN, Closest, NarrowPhase

__all__ = ["TOUCH", "MovingHull", "find_first_touch", "gap_before"]

TOUCH = 0.5 * MARGIN
"""Overlap [m] up to which the search for a first touch may end. With zero it would take many steps more; beyond two
margins Bullet takes the normal of least overlap, which for a thin body is the wrong one."""

MOST_ADVANCES = 24
"""Closest points taken in the search of one pair of parts. Where they do not suffice, the time reached so far is
returned: it is not later than the touch."""

MOST_HALVINGS = 40
"""Steps of the search along one axis: a bisection would then end at the rounding of the time."""

TURN = 0.05
"""Largest turn [rad] within which an axis is trusted between two times: a log of 10 m bulges by 2 mm in it."""

MOST_TURNS = 64
"""Pieces into which a motion is cut by TURN. Above 3 rad a substep it is no ship's, and TURN is exceeded."""

Pose = tuple[Array, Array]
"""Place of CO in n [m] (3,), and R_nb (3, 3)."""


@dataclass(frozen=True)
class MovingHull:
    """A hull in motion. index: of the body; parts: their vertices in b [m]; pose_at: its pose after some time [s];
    turning: its rate of turn [rad/s]."""

    index: int
    parts: Sequence[Array]
    pose_at: Callable[[float], Pose]
    turning: float

    @classmethod
    def of(cls, index: int, parts: Sequence[Array], state: BodyState) -> MovingHull:
        """A hull that moves as its body does, from the predicted pose on."""
        if state.fixed:
            pose = state.x, state.R
            return cls(index, parts, lambda _: pose, 0.0)
        _, omega = state.predicted_motion()
        return cls(index, parts, state.predict_pose, 0.0 if omega is None else hypot(*omega.tolist()))


def find_first_touch(
    narrow_phase: NarrowPhase, a: MovingHull, b: MovingHull, h: float, speed: float, growth: float,
    carried: tuple[int, list[float]] | None,
) -> float | None:  # fmt: skip
    """Time [s] at which two hulls first touch within h [s], or touch on; None: they do not.

    speed: bound of the relative speed of any two points [m/s]; growth: overlap [m] at which parts that touch already
    touch on; carried: the last normal of the pair (detection.py), None without one.
    """
    pieces = min(MOST_TURNS, ceil(h * max(a.turning, b.turning) / TURN)) or 1
    for k in range(pieces):
        begin, end = h * k / pieces, h * (k + 1) / pieces
        first: float | None = None
        for i, part_a in enumerate(a.parts):
            for j, part_b in enumerate(b.parts):
                pair = _Parts(narrow_phase, a, b, i, j, part_a, part_b)
                found = pair.first_touch(begin, end if first is None else first, speed, growth, carried)
                first = found if found is not None else first
        if first is not None:
            return first
    return None


def gap_before(
    closest: Closest, parts_a: Sequence[Array], parts_b: Sequence[Array], a: BodyState, b: BodyState
) -> float:  # fmt: skip
    """Gap [m] of two touching parts before the bodies were last advanced, along the normal of their closest points now.

    It is the largest along the normal as it is, and as it turned with either hull. Where it is negative, the parts
    overlapped along the normal already: they have met along another one.
    """
    part_a, part_b, normal = parts_a[closest.part_a], parts_b[closest.part_b], closest.normal
    now, then = ((a.x, a.R), (b.x, b.R)), (a.pose_before, b.pose_before)
    axes = [normal] + [R_then @ (R.T @ normal) for (_, R), (_, R_then) in zip(now, then, strict=True)]
    before = max(_separation(axis, part_a, part_b, *then) for axis in axes)
    return closest.gap + before - _separation(normal, part_a, part_b, *now)


def _separation(normal: Array, part_a: Array, part_b: Array, at_a: Pose, at_b: Pose) -> float:
    """s(normal) [m] of two parts (n, 3) in b at their poses."""
    (x_a, R_a), (x_b, R_b) = at_a, at_b
    return float(normal @ (x_b - x_a) + (part_b @ (normal @ R_b)).min() - (part_a @ (normal @ R_a)).max())


def _constant(axis: Array) -> Callable[[float], Array]:
    return lambda _: axis


@dataclass(frozen=True)
class _Parts:
    """A pair of convex parts in motion."""

    narrow_phase: NarrowPhase
    a: MovingHull
    b: MovingHull
    i: int
    j: int
    part_a: Array
    part_b: Array

    def first_touch(
        self, begin: float, end: float, speed: float, growth: float, carried: tuple[int, list[float]] | None
    ) -> float | None:
        tau, target = begin, -0.5 * TOUCH
        for _ in range(MOST_ADVANCES):
            closest = self._closest(tau, speed * (end - tau) + TOUCH)
            if closest is None:
                return None
            gap, normal = closest
            if gap <= 0.0 and (tau > begin or (tau > 0.0 and carried is None)):
                return tau
            if gap <= 0.0:
                return self._touch_on(begin, end, normal, max(2.0 * TOUCH, growth + gap), carried)
            then = self._reach(tau, end, _constant(normal), gap - target)
            if then is None:
                return None
            tau = then
        return tau

    def _touch_on(
        self, begin: float, end: float, normal: Array, growth: float, carried: tuple[int, list[float]] | None
    ) -> float | None:
        """When the overlap along the normal has grown so far."""
        if carried is None:
            return self._reach(begin, end, _constant(normal), growth)
        carrier, normal_b = (self.a, self.b)[carried[0]], np.array(carried[1])
        return self._reach(begin, end, lambda tau: carrier.pose_at(tau)[1] @ normal_b, growth)

    def _closest(self, tau: float, distance: float) -> tuple[float, Array] | None:
        return self.narrow_phase.closest_of_parts(
            (self.a.index, self.i, *self.a.pose_at(tau)), (self.b.index, self.j, *self.b.pose_at(tau)), distance
        )

    def _separation(self, normal: Array, tau: float) -> float:
        return _separation(normal, self.part_a, self.part_b, self.a.pose_at(tau), self.b.pose_at(tau))

    def _reach(self, begin: float, end: float, axis: Callable[[float], Array], way: float) -> float | None:
        """The first time after `begin` at which the separation along the axis has fallen by `way` [m]; None: it does
        not by `end`. Regula falsi (Illinois); the time returned is just after the fall."""
        start = self._separation(axis(begin), begin) - way
        low, f_low, high, f_high = begin, way, end, self._separation(axis(end), end) - start
        if f_high > 0.0:
            return None
        f, side = f_high, 0
        for _ in range(MOST_HALVINGS):
            if (side >= 0 and f >= -0.25 * TOUCH) or high - low <= 1e-12 * end:
                break
            tau = low + (high - low) * f_low / (f_low - f_high)
            f = self._separation(axis(tau), tau) - start
            if f > 0.0:
                low, f_low, f_high, side = tau, f, f_high * (0.5 if side < 0 else 1.0), -1
            else:
                high, f_high, f_low, side = tau, f, f_low * (0.5 if side > 0 else 1.0), 1
        return high
