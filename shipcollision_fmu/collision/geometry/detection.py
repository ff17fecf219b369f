"""Contacts of two hulls: Bullet's closest points, corrected for the solver.

1. A closest point with a gap above zero is a prediction, not a contact.
2. Bullet returns one point of a line or an area of contact, at an arbitrary place. The contact points are the corners
   that the two facing features have in common (contact_place.py).
3. In deep overlap the direction of least overlap jumps, for a ship soon to the vertical. While the overlap is deeper
   than SHALLOW, or its direction has jumped to the vertical, the last shallow normal is used. It turns with the hull
   whose face it belongs to.
4. The convex parts of one hull are joined (compound_hull.py). Faces and edges inside the hull give no contact, and
   contacts of several parts on one face are one contact.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from math import dist
from operator import add  # sum() rounds otherwise from Python 3.12 on

import numpy as np

from ...ship.frames import Array
from ...ship.hull.solid import HullMesh
from ..dynamics.body_state import BodyState
from ..dynamics.contact import Contact, make_contact, make_contacts
from ..dynamics.contact_frame import contact_axes
from .adapter import open_narrow_phase
from .compound_hull import join_parts, merge_coplanar, select_supported
from .contact_place import FEATURE_DEPTH, contact_manifold, facing_features
from .first_touch import TOUCH, MovingHull, find_first_touch, gap_before
from .narrow_phase import MARGIN, Closest
from .plan_overlap import least_overlap
from .thickness import least_width

__all__ = ["FAST", "SHALLOW", "Detector", "LastNormals"]

SHALLOW = 0.5
"""Overlap [m] down to which Bullet's normal is taken. Smaller than a step of a fast approach, it would be skipped.
Beyond half the breadth of a hull, least overlap points to the wrong side."""

SHALLOW_SHARE = 0.25
"""Least share of the thinner hull's least width that is SHALLOW. With a half, least overlap points to either side."""

FOLLOWS = 0.94
"""Cosine of the angle, 20 degrees, by which the normal of least overlap may differ from the last normal of a thin hull
that is in deep overlap. It then follows a curved side; with less, it follows a pole round to its other side."""

STEEP = 0.7
"""Share of the vertical in a normal, 45 degrees, from which on it must follow the last one. Otherwise ships that are
driven on would slide over a rock or under a deck which they overlap less in height than along."""

FAST = 0.05
"""Share of the thinner hull's least width by which hulls may come nearer in a substep without a search for the first
touch. At a round pole of diameter D the normal turns by up to 2 FAST; with a half, the side that was met is lost."""

SAME_POINT = 0.5
"""Contact points closer than this [m] are one point, found by several convex parts. With zero, it would count twice."""

FLUSH = 1e-6
"""Gap [m] at which a corner counts as touching when another corner of the same face touches. With zero, the last
bits of the gaps would decide how many corners of a flush face touch."""

SMALL = 15.0
"""Least extent [m] of a hull below which SAME_POINT and FEATURE_DEPTH shrink in proportion. With zero, all contacts of
a boat would be one point."""

LastNormals = dict[tuple[int, int], tuple[int, list[float]]]
"""Per pair (a, b): which body carries the last shallow normal (0: a, 1: b), and the normal in b of that body."""


class Detector:
    """Contacts and clearance between hulls. What a call returns depends on its arguments alone."""

    def __init__(self, hulls: Sequence[HullMesh], adapter: str | None = None) -> None:
        """adapter: see open_narrow_phase."""
        self._hulls = tuple(hulls)
        self._compounds = [join_parts(hull) for hull in hulls]
        self._widths = [least_width(hull) for hull in hulls]
        self._scales = [min(1.0, float(np.ptp(hull.vertices, axis=0).min()) / SMALL) for hull in hulls]
        self.narrow_phase = open_narrow_phase(hulls, adapter)
        self._lately: tuple[int, int, Array, Array, Array, Array, list[Closest]] | None = None  # what touched where

    def clearance(self, a: int, b: int, states: Sequence[BodyState], cap: float) -> float:
        """Least distance [m] between two hulls, negative in overlap, at most `cap`."""
        return self.narrow_phase.gap(a, b, states, cap)

    def touching(self, a: int, b: int, states: Sequence[BodyState]) -> bool:
        """Whether two hulls touch or overlap."""
        return self.narrow_phase.gap(a, b, states, MARGIN) <= 0.0

    def thickness(self, a: int, b: int) -> float:
        """Least width [m] of the thinner of two hulls (thickness.py)."""
        return min(self._widths[a], self._widths[b])

    def first_touch(
        self, a: int, b: int, states: Sequence[BodyState], h: float, speed: float, last_normals: LastNormals
    ) -> float | None:
        """Time [s] after the predicted poses at which two hulls first touch within h [s] (first_touch.py).

        speed: bound of the relative speed of any two points [m/s].
        """
        growth = max(2.0 * TOUCH, FAST * self.thickness(a, b))
        one, other = (MovingHull.of(i, self._hulls[i].parts, states[i]) for i in (a, b))
        return find_first_touch(self.narrow_phase, one, other, h, speed, growth, last_normals.get((a, b)))

    def misses_first_touch(self, a: int, b: int, states: Sequence[BodyState]) -> bool:
        """Whether two hulls, apart before they were last advanced, have met along another normal than that of their
        closest points now: along it, they overlapped before by more than Bullet's margin."""
        touching = self._touching(a, b, states)
        self._lately = a, b, states[a].x, states[a].R, states[b].x, states[b].R, touching
        deepest = min(touching, key=lambda c: c.gap, default=None)
        if deepest is None or deepest.gap >= -MARGIN:
            return False
        parts_a, parts_b = self._hulls[a].parts, self._hulls[b].parts
        return gap_before(deepest, parts_a, parts_b, states[a], states[b]) < -MARGIN

    def _touching(self, a: int, b: int, states: Sequence[BodyState]) -> list[Closest]:
        """Closest points of the parts that touch."""
        if (lately := self._lately) is not None and lately[:2] == (a, b):
            one, other = states[a], states[b]
            if lately[2] is one.x and lately[3] is one.R and lately[4] is other.x and lately[5] is other.R:
                return lately[6]
        return [c for c in self.narrow_phase.closest(a, b, states, 0.0) if c.gap <= 0.0]

    def contacts(self, a: int, b: int, states: Sequence[BodyState], last_normals: LastNormals) -> list[Contact]:
        """Contact points of two hulls, gap <= 0. Updates `last_normals` while the overlap is shallow."""
        touching = self._touching(a, b, states)
        if not touching:
            last_normals.pop((a, b), None)
            return []
        one, other, scale = self._compounds[a], self._compounds[b], self._scale(a, b)
        compound = not (one.whole and other.whole)
        if compound:
            touching = select_supported(touching, one, other, (states[a], states[b]))
        shallow = self._is_shallow(a, b, min(touching, key=lambda c: c.gap), states, last_normals)
        carried = None if shallow else last_normals.get((a, b))
        if carried is None and not shallow:  # deep inside each other from the start
            carried = last_normals[(a, b)] = self._plan_normal(a, b, touching, states)
        found: list[Contact] = []
        hidden: list[Contact] = []
        for closest in touching:
            normal = closest.normal if carried is None else _turn_with_hull(carried, states[a], states[b])
            feature_a, feature_b = self._features(a, b, closest, normal, states, scale * FEATURE_DEPTH)
            if shallow and closest is touching[0]:
                carrier = 0 if len(feature_a) > len(feature_b) else 1
                last_normals[(a, b)] = (carrier, (normal @ states[(a, b)[carrier]].R).tolist())
            # Features that pass each other (a corner beside a face's edge) leave Bullet's own point.
            axes = contact_axes(normal)
            corners = contact_manifold(feature_a, feature_b, axes)
            places = corners or [(0.5 * (closest.on_a + closest.on_b), closest.gap)]
            # Faces that meet flush touch with all their corners, whatever the last bits of the gaps say.
            touch = FLUSH if min(gap for _, gap in places) <= 0.0 else 0.0
            in_touch = [(point, gap) for point, gap in places if gap <= touch]
            for contact in make_contacts(a, b, states, in_touch, normal, axes):
                # With a last normal, parts that pass each other along it or lie behind others have no contact.
                inside = compound and not shallow and (not corners or self._is_inside(contact, closest, states))
                (hidden if inside else found).append(contact)
        return _remove_duplicates(merge_coplanar(found or hidden) if compound else found, scale * SAME_POINT)

    def facing(
        self, a: int, b: int, distance: float, states: Sequence[BodyState], last_normals: LastNormals
    ) -> Contact | None:
        """One contact at the middle of what is nearer than `distance` [m], with the least gap; None: nothing."""
        near = self.narrow_phase.closest(a, b, states, distance)
        if not near:
            return None
        nearest = min(near, key=lambda c: c.gap)
        gap, normal = nearest.gap, nearest.normal
        if gap <= -self._shallow(a, b) and (a, b) in last_normals:
            normal = _turn_with_hull(last_normals[a, b], states[a], states[b])
        depth = max(self._scale(a, b) * FEATURE_DEPTH, distance - gap)
        feature_a, feature_b = self._features(a, b, nearest, normal, states, depth)
        places = contact_manifold(feature_a, feature_b, contact_axes(normal)) or [
            (0.5 * (nearest.on_a + nearest.on_b), gap)
        ]
        weights = [max(distance - g, 0.0) for _, g in places]
        if not any(weights):
            weights = [1.0] * len(places)
        total = reduce(add, weights)
        middle: Array = sum((w / total * point for (point, _), w in zip(places, weights, strict=True)), np.zeros(3))
        return make_contact(a, b, states, middle, normal, gap)

    def _plan_normal(
        self, a: int, b: int, touching: Sequence[Closest], states: Sequence[BodyState]
    ) -> tuple[int, list[float]]:
        """Normal of least overlap of the two hulls in plan, carried by the body whose side it belongs to."""
        in_a = np.vstack([self._placed_part(a, i, states) for i in sorted({c.part_a for c in touching})])
        in_b = np.vstack([self._placed_part(b, i, states) for i in sorted({c.part_b for c in touching})])
        _, normal, carrier = least_overlap(in_a, in_b)
        return carrier, (normal @ states[(a, b)[carrier]].R).tolist()

    def _is_shallow(
        self, a: int, b: int, deepest: Closest, states: Sequence[BodyState], last_normals: LastNormals
    ) -> bool:
        """Whether Bullet's normals count. A steep normal, and that of a thin hull in deep overlap, must follow the
        last one."""
        limit = self._shallow(a, b)
        shallow = deepest.gap > -limit
        if shallow and -STEEP < deepest.normal[2] < STEEP:
            return True
        if (a, b) not in last_normals or (limit == SHALLOW and not shallow):
            return shallow
        last = _turn_with_hull(last_normals[a, b], states[a], states[b])
        return float(last @ deepest.normal) > FOLLOWS

    def _shallow(self, a: int, b: int) -> float:
        return min(SHALLOW, SHALLOW_SHARE * self.thickness(a, b))

    def _scale(self, a: int, b: int) -> float:
        return min(self._scales[a], self._scales[b])

    def _is_inside(self, contact: Contact, closest: Closest, states: Sequence[BodyState]) -> bool:
        """Whether a contact with a last normal lies on a face that another part of the same hull covers."""
        half = 0.5 * contact.gap * contact.normal
        a, b = states[contact.a], states[contact.b]
        return self._compounds[contact.a].covers(
            closest.part_a, a.in_body(contact.point - half), contact.normal @ a.R
        ) or self._compounds[contact.b].covers(closest.part_b, b.in_body(contact.point + half), -(contact.normal @ b.R))

    def _placed_part(self, ship: int, part: int, states: Sequence[BodyState]) -> Array:
        points: Array = states[ship].x + self._hulls[ship].parts[part] @ states[ship].R.T
        return points

    def _features(
        self, a: int, b: int, closest: Closest, normal: Array, states: Sequence[BodyState], depth: float
    ) -> tuple[Array, Array]:
        """Points (n, 3) of either part that face the other one: foremost along the normal, within `depth` [m]."""
        in_a = self._placed_part(a, closest.part_a, states)
        in_b = self._placed_part(b, closest.part_b, states)
        return facing_features(in_a, in_b, normal, depth)


def _remove_duplicates(contacts: list[Contact], apart: float) -> list[Contact]:
    """Contacts more than `apart` [m] from each other, the first of those that are nearer."""
    found: list[Contact] = []
    for contact in contacts:
        if all(dist(contact.point, c.point) > apart for c in found):
            found.append(contact)
    return found


def _turn_with_hull(carried: tuple[int, list[float]], one: BodyState, other: BodyState) -> Array:
    """The last normal of a pair in n, as it has turned with the hull that carries it."""
    carrier, normal_b = carried
    normal: Array = (one, other)[carrier].R @ np.array(normal_b)
    return normal
