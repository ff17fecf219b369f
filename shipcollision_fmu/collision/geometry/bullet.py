"""The adapter of pybullet: hulls as Bullet bodies, closest points, and one step of Bullet's own dynamics.

Arguments and results are in n and b; the world with z up exists only in this file. Bullet is used without memory: what
a call returns depends on its arguments alone, so that a restored FMU repeats every bit. For closest points this holds
by itself. Bullet's own step keeps contact manifolds and warm-start impulses, hence its bodies are made anew for
every step.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache, lru_cache
from types import ModuleType
from typing import Any

import numpy as np

from ...errors import HostError
from ...ship.frames import SWAP, Array, pose_w, poses_w, swap_axes, swapped_rows
from ...ship.hull.solid import HullMesh
from ..dynamics.body_state import BodyState
from .bullet_worlds import BulletWorlds
from .narrow_phase import MARGIN, SNAP_PLACE, SNAP_QUATERNION, Closest

__all__ = ["BulletAdapter", "BulletBody", "bullet_module", "has_pybullet", "require_dynamics"]


Place = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

ITERATIONS = 50
"""Iterations of Bullet's own solver in a step, PyBullet's default: the bound on its work. A pair of hulls has at most
four contact points there."""


@cache
def _worlds(bullet: ModuleType) -> BulletWorlds:
    """Those of this process."""
    return BulletWorlds(bullet)


def bullet_module() -> ModuleType:
    """pybullet, imported when first needed. Raises HostError when it is missing."""
    try:
        with _without_banner():
            import pybullet
    except ImportError as error:
        raise HostError(
            f"pybullet cannot be imported ({error}): install it with `pip install pybullet`; its wheels exist for "
            "CPython 3.10 and 3.11 on Linux (x86-64), on others pip needs a C++ compiler"
        ) from error
    return pybullet  # type: ignore[no-any-return]  # a module


def has_pybullet() -> bool:
    """Whether pybullet can be imported."""
    try:
        bullet_module()
    except HostError:
        return False
    return True


def require_dynamics() -> None:
    """Raise HostError, with the remedy, when pybullet is missing for the response 'bullet'."""
    try:
        bullet_module()
    except HostError as error:
        raise HostError(
            f"response 'bullet' is PyBullet's own dynamics, and {error}; or take response 'pgs' or 'closed_form'"
            ", as the shipped scenario guan2014_added_mass does"
        ) from error


@contextmanager
def _without_banner() -> Iterator[None]:
    """Suppress the line that PyBullet writes to standard error on import: its build time."""
    try:
        kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    except OSError:  # a process without a standard error
        yield
        return
    os.dup2(nowhere, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)


@dataclass(frozen=True)
class BulletBody:
    """A ship in Bullet's own dynamics: scalar mass [kg], diagonal inertia (3,) [kg m2] in b about CG."""

    mass: float
    inertia: Array
    r_bg: Array


class BulletAdapter:
    """A private Bullet world (DIRECT, no rendering) with the hulls' convex parts. Close it when done."""

    def __init__(self, hulls: Sequence[HullMesh]) -> None:
        """hulls: one per ship; their vertices are in b about CO [m]. Raises HostError without pybullet."""
        self._p = p = bullet_module()
        self._client = _worlds(p).take()
        self._hulls = tuple(hulls)
        # One body per convex part; mass 0 keeps them out of any dynamics.
        self._parts = [[self._body(0.0, part) for part in hull.parts] for hull in hulls]
        self._dynamic_shapes: dict[tuple[int, bytes], Any] = {}
        self._placed: list[tuple[Array, Array] | None] = [None] * len(hulls)
        self._overlaps: dict[tuple[int, int], float] = {}  # gaps of pairs found touching where they are now

    def close(self) -> None:
        """Leave the Bullet world; safe to call twice."""
        if self._client >= 0:
            _worlds(self._p).give_back(self._client)
        self._client = -1

    def _place(self, *placed: tuple[int, Array, Array]) -> None:
        """Put the parts of ships at CO = x (3,) in n [m] with the attitude R_nb, each given as (ship, x, R_nb). A pose
        that is the same object as before moves nothing."""
        moved = []
        for ship, x, R_nb in placed:
            before = self._placed[ship]
            if before is None or before[0] is not x or before[1] is not R_nb:
                moved.append((ship, x, R_nb))
        for (ship, x, R_nb), pose in zip(moved, poses_w([pose[1:] for pose in moved]), strict=True):
            position = [(v + SNAP_PLACE) - SNAP_PLACE for v in pose[0]]
            orientation = [(v + SNAP_QUATERNION) - SNAP_QUATERNION for v in pose[1]]
            self._placed[ship] = x, R_nb
            self._overlaps = {pair: gap for pair, gap in self._overlaps.items() if ship not in pair}
            for body in self._parts[ship]:
                self._p.resetBasePositionAndOrientation(body, position, orientation, physicsClientId=self._client)

    def closest(self, a: int, b: int, states: Sequence[BodyState], distance: float) -> list[Closest]:
        """Closest points of every pair of parts of ships a and b not farther apart than `distance` [m]."""
        found = []
        self._place((a, states[a].x, states[a].R), (b, states[b].x, states[b].R))
        for i, part_a in enumerate(self._parts[a]):
            for j, part_b in enumerate(self._parts[b]):
                for row in self._p.getClosestPoints(
                    part_a, part_b, distance - 2 * MARGIN, physicsClientId=self._client
                ):
                    on_a, on_b, from_b = swapped_rows(row[5:8])
                    normal = -from_b  # Bullet's normal points from B to A
                    found.append(
                        Closest(on_a - MARGIN * normal, on_b + MARGIN * normal, normal, row[8] + 2 * MARGIN, i, j)
                    )
        if found and (gap := min(c.gap for c in found)) <= 0.0:
            self._overlaps[a, b] = gap
        return found

    def closest_of_parts(
        self, one: tuple[int, int, Array, Array], other: tuple[int, int, Array, Array], distance: float
    ) -> tuple[float, Array] | None:
        """(gap [m], normal (3,) from one to the other) of two convex parts; None: farther apart than `distance` [m].

        one, other: ship, its part, and its pose: CO in n [m], R_nb.
        """
        (a, i, x_a, R_a), (b, j, x_b, R_b) = one, other
        self._place((a, x_a, R_a), (b, x_b, R_b))
        rows = self._p.getClosestPoints(
            self._parts[a][i], self._parts[b][j], distance - 2 * MARGIN, physicsClientId=self._client
        )
        if not rows:
            return None
        row = min(rows, key=lambda r: float(r[8]))
        return row[8] + 2 * MARGIN, -np.array(swap_axes(row[7]))

    def corners(self, ship: int, part: int) -> Array:
        """The corners (n, 3) of a part as Bullet rounded them, in b about CO [m]."""
        _, corners = self._p.getMeshData(self._parts[ship][part], physicsClientId=self._client)
        found: Array = np.array(corners) @ SWAP
        return found

    def gap(self, a: int, b: int, states: Sequence[BodyState], cap: float) -> float:
        """Least distance [m] between ships a and b, negative in overlap, at most `cap`."""
        self._place((a, states[a].x, states[a].R), (b, states[b].x, states[b].R))
        if (a, b) in self._overlaps:
            return min(cap, self._overlaps[a, b])
        least = cap
        for part_a in self._parts[a]:
            for part_b in self._parts[b]:
                rows = self._p.getClosestPoints(part_a, part_b, least - 2 * MARGIN, physicsClientId=self._client)
                least = min((row[8] + 2 * MARGIN for row in rows), default=least)
        return least

    def dynamic_step(
        self,
        ships: tuple[int, int],
        bodies: tuple[BulletBody, BulletBody],
        poses: tuple[tuple[Array, Array], tuple[Array, Array]],
        twists: tuple[Array, Array],
        h: float,
        friction: float,
        restitution: float,
    ) -> list[tuple[Array, Array, Array, float, Array]]:
        """One step of h [s] of Bullet's rigid-body dynamics for a pair of ships.

        poses: (CO in n [m], R_nb); twists: (6,) in b about CO; friction, restitution: of the pair (Bullet multiplies
        the bodies' values, so each gets the square root). Returns (on_a, on_b, normal a to b, gap, P on b) of each
        contact point, in n. Position correction is off: an overlap must not add velocity.
        """
        p, client = self._p, self._client
        p.setPhysicsEngineParameter(
            fixedTimeStep=h,
            numSolverIterations=ITERATIONS,
            erp=0.0,
            contactERP=0.0,
            frictionERP=0.0,
            physicsClientId=client,
        )
        handles = [
            self._dynamic_body(ship, body, friction, restitution, *pose_w(x + R_nb @ body.r_bg, R_nb))
            for ship, body, (x, R_nb) in zip(ships, bodies, poses, strict=True)
        ]
        # A step at rest, without contact: before its first step, Bullet solves a body with the inertia of its shape at
        # the attitude of its making, whatever inertia was set since.
        p.setCollisionFilterPair(handles[0], handles[1], -1, -1, 0, physicsClientId=client)
        p.stepSimulation(physicsClientId=client)
        p.setCollisionFilterPair(handles[0], handles[1], -1, -1, 1, physicsClientId=client)
        for handle, body, (_, R_nb), nu in zip(handles, bodies, poses, twists, strict=True):
            velocity = R_nb @ (nu[:3] + np.cross(nu[3:], body.r_bg))
            p.resetBaseVelocity(handle, swap_axes(velocity), swap_axes(R_nb @ nu[3:]), physicsClientId=client)
        p.stepSimulation(physicsClientId=client)
        rows = p.getContactPoints(handles[0], handles[1], physicsClientId=client)
        for handle in handles:
            p.removeBody(handle, physicsClientId=client)
        return [_contact_row(row, h) for row in rows]

    def _shape(self, vertices: Array, r_origin: Array | float = 0.0) -> int:
        """Collision shape of a vertex set (n, 3) in b, relative to the point r_origin [m] in b."""
        relative = (vertices - r_origin) @ SWAP
        shape: int = self._p.createCollisionShape(
            self._p.GEOM_MESH, vertices=_vertices_as_lists(relative.tobytes()), physicsClientId=self._client
        )
        return shape

    def _body(self, mass: float, vertices: Array) -> int:
        p, client = self._p, self._client
        body: int = p.createMultiBody(mass, self._shape(vertices), useMaximalCoordinates=1, physicsClientId=client)
        p.setCollisionFilterGroupMask(body, -1, 0, 0, physicsClientId=client)  # asked for by name only
        return body

    def _dynamic_body(
        self, ship: int, body: BulletBody, friction: float, restitution: float, position: Place, orientation: Quaternion
    ) -> int:
        p, client = self._p, self._client
        key = (ship, body.r_bg.tobytes())
        if key not in self._dynamic_shapes:
            self._dynamic_shapes[key] = self._shape(np.vstack(self._hulls[ship].parts), body.r_bg)
        handle: int = p.createMultiBody(
            body.mass, self._dynamic_shapes[key], basePosition=position, baseOrientation=orientation,
            useMaximalCoordinates=1, physicsClientId=client,
        )  # fmt: skip
        # The mass once more: with an inertia and without a mass, changeDynamics sets the mass to zero.
        p.changeDynamics(
            handle, -1, mass=body.mass, linearDamping=0.0, angularDamping=0.0, lateralFriction=friction**0.5,
            restitution=restitution**0.5,
            localInertiaDiagonal=np.abs(swap_axes(body.inertia)).tolist(), physicsClientId=client,
        )  # fmt: skip
        return handle


@lru_cache(maxsize=512)
def _vertices_as_lists(vertices: bytes) -> list[list[float]]:
    """Vertices (n, 3) as lists, the same object for the same hull: pybullet 3.2 never gives back the references that it
    takes to the numbers, and would keep a copy of every hull of every world."""
    listed: list[list[float]] = np.frombuffer(vertices).reshape(-1, 3).tolist()
    return listed


def _contact_row(row: Sequence[Any], h: float) -> tuple[Array, Array, Array, float, Array]:
    """A row of getContactPoints in n; Bullet's forces act on A along a normal that points from B to A."""
    on_a, on_b, normal = swapped_rows(row[5:8])
    if row[9] == 0.0:  # a prediction: Bullet leaves the friction directions of a contact it did not solve unset
        return on_a, on_b, -normal, float(row[8]), np.zeros(3)
    force_on_a = normal * row[9] + np.array(swap_axes(row[11])) * row[10] + np.array(swap_axes(row[13])) * row[12]
    return on_a, on_b, -normal, float(row[8]), -force_on_a * h
