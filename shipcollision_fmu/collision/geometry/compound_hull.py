"""Compound hulls: several convex parts joined in one hull.

A hull with flare or a bulb, or from a user's mesh, has several convex parts. Where two parts meet there are inner faces
and edges, and a closest point may lie on them. A stem that slides along a side of five boxes would then catch on every
joint. Three steps prevent it:

1. A closest point counts if the hull as a whole supports it. The point must lie on the outside, and no part that holds
   the point may reach farther along the normal. On a face, no other part may cover the face there.
2. A closest point without support is replaced by the outer face of either part with the least overlap, if the parts
   face each other there. If they do not, the neighbouring part has the contact.
3. Contacts with one normal in one plane are one contact: the corners of their common outline remain.

Hulls of one part, and hulls without planes (ship/hull/), pass through unchanged, to the bit. Points and directions are
in b of their hull [m], contacts in n.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ...ship.frames import Array
from ...ship.hull.hull import HULLS_KEPT
from ...ship.hull.solid import HullMesh
from ..dynamics.body_state import BodyState
from ..dynamics.contact import Contact
from ..dynamics.contact_frame import contact_axes
from .clipping import convex_polygon
from .contact_place import FEATURE_DEPTH, contact_manifold, facing_features, spread
from .narrow_phase import Closest

__all__ = ["CompoundHull", "join_parts", "merge_coplanar", "select_supported"]

FLAT = 1e-3
"""Angle [rad] within which a normal is that of a face, and two normals are one. Far above rounding, far below the angle
between two faces of a hull."""
STEP = 0.02
"""How far [m] a point is moved off a face, and from its rim, to find what lies before the face. Less than the
thinnest part, more than JOINT."""
JOINT = 0.01
"""Distance [m] within which parts are joined; a part that reaches no farther than this along a normal supports it."""
DEEPEST = 1.0
"""Overlap [m] up to which an unsupported answer is replaced."""

_SAME = 1.0 - 0.5 * FLAT**2


class CompoundHull:
    """The parts of one hull, and which of their faces can be touched. whole: one part, or parts without planes."""

    def __init__(self, hull: HullMesh) -> None:
        self.parts = hull.parts
        self.whole = len(hull.parts) == 1 or len(hull.planes) != len(hull.parts)
        if self.whole:
            return
        self._planes = hull.planes
        self._middles = [_middles(part, planes) for part, planes in zip(self.parts, self._planes, strict=True)]
        self._outer = [self._outer_faces(i) for i in range(len(self.parts))]

    def supports(self, part: int, p: Array, direction: Array) -> bool:
        """Whether the hull can be touched at p (3,), on the surface of a part, with the outward normal `direction`."""
        if self.whole:
            return True
        towards = self._planes[part][:, :3] @ direction
        face = int(np.argmax(towards))
        if towards[face] >= _SAME:
            return not self.covers(part, self._off_the_rim(part, face, p), direction)
        reach = float(direction @ p) + JOINT
        return not any(
            self._holds(other, p, JOINT) and float((self.parts[other] @ direction).max()) > reach
            for other in range(len(self.parts))
            if other != part
        )

    def covers(self, part: int, p: Array, direction: Array) -> bool:
        """Whether another part lies just before the point p (3,) of a part, along `direction`."""
        if self.whole:
            return False
        before = p + STEP * direction
        return any(self._holds(other, before, -0.1 * STEP) for other in range(len(self.parts)) if other != part)

    def outer_normals(self, part: int) -> Array:
        """Outward normals (k, 3) of the faces of a part that can be touched; none of a whole hull."""
        return np.zeros((0, 3)) if self.whole else self._outer[part]

    def _holds(self, part: int, p: Array, margin: float) -> bool:
        planes = self._planes[part]
        return bool((planes[:, :3] @ p <= planes[:, 3] + margin).all())

    def _off_the_rim(self, part: int, face: int, p: Array) -> Array:
        inwards = self._middles[part][face] - p
        distance = float(np.linalg.norm(inwards))
        moved: Array = p + inwards * min(0.5, STEP / max(distance, STEP))
        return moved

    def _outer_faces(self, part: int) -> Array:
        """Normals of the faces of which some place is not covered: the middle, or half way to a corner."""
        normals = []
        for plane, middle in zip(self._planes[part], self._middles[part], strict=True):
            corners = self.parts[part][_on(self.parts[part], plane)]
            places = np.vstack([middle, 0.5 * (middle + corners), 0.1 * middle + 0.9 * corners])
            if not all(self.covers(part, p, plane[:3]) for p in places):
                normals.append(plane[:3])
        return np.array(normals).reshape(-1, 3)


@lru_cache(maxsize=HULLS_KEPT)
def join_parts(hull: HullMesh) -> CompoundHull:
    """The parts of a hull; the same object for the same hull, as to find the outer faces takes milliseconds."""
    return CompoundHull(hull)


def select_supported(
    touching: list[Closest], one: CompoundHull, other: CompoundHull, states: tuple[BodyState, BodyState]
) -> list[Closest]:
    """The closest points of hulls a (`one`) and b (`other`) that the hulls as a whole support, deepest first.

    Without any support, all of them as they are: hulls that overlap do touch.
    """
    if one.whole and other.whole:
        return touching
    found = [c for c in (_find_supported(c, one, other, states) for c in touching) if c is not None]
    return sorted(found or touching, key=lambda c: c.gap)


def _find_supported(
    closest: Closest, one: CompoundHull, other: CompoundHull, states: tuple[BodyState, BodyState]
) -> Closest | None:
    """The closest point itself if both hulls support it, else its replacement, else None."""
    if _both_support(closest, one, other, states):
        return closest
    a, b = states
    in_a = a.x + one.parts[closest.part_a] @ a.R.T
    in_b = b.x + other.parts[closest.part_b] @ b.R.T
    normals = np.vstack([one.outer_normals(closest.part_a) @ a.R.T, -(other.outer_normals(closest.part_b) @ b.R.T)])
    depths = (normals @ in_a.T).max(axis=1) - (normals @ in_b.T).min(axis=1)
    for k in np.argsort(depths, kind="stable"):
        if depths[k] > DEEPEST:
            break
        normal = normals[k]
        for point, gap in contact_manifold(*facing_features(in_a, in_b, normal), contact_axes(normal)):
            half = 0.5 * gap * normal
            instead = replace(closest, on_a=point - half, on_b=point + half, normal=normal, gap=-float(depths[k]))
            if gap <= 0.0 and _both_support(instead, one, other, states):
                return instead
    return None


def _both_support(
    closest: Closest, one: CompoundHull, other: CompoundHull, states: tuple[BodyState, BodyState]
) -> bool:
    a, b = states
    return one.supports(closest.part_a, a.in_body(closest.on_a), closest.normal @ a.R) and other.supports(
        closest.part_b, b.in_body(closest.on_b), -(closest.normal @ b.R)
    )


def merge_coplanar(contacts: list[Contact]) -> list[Contact]:
    """Contacts of joined parts: of those with one normal in one plane the corners of their common outline."""
    groups: list[list[Contact]] = []
    for contact in contacts:
        for group in groups:
            first = group[0]
            same_plane = abs(float(first.normal @ (contact.point - first.point))) <= FEATURE_DEPTH
            if same_plane and float(first.normal @ contact.normal) >= _SAME:
                group.append(contact)
                break
        else:
            groups.append([contact])
    return [contact for group in groups for contact in _outline(group)]


def _outline(group: Sequence[Contact]) -> list[Contact]:
    axes = contact_axes(group[0].normal)[1:]
    places = {(float(u), float(v)): c for c, (u, v) in ((c, axes @ c.point) for c in reversed(group))}
    return [places[corner] for corner in spread(convex_polygon(places))]


def _middles(part: Array, planes: Array) -> Array:
    """Middle (k, 3) of the face in every plane of a part."""
    return np.array([part[_on(part, plane)].mean(axis=0) for plane in planes])


def _on(part: Array, plane: Array) -> Array:
    """Which corners of a part lie in a plane; at least the foremost one."""
    height = part @ plane[:3]
    on: Array = height >= height.max() - 1e-4
    return on
