"""The bodies of the collision model: the ships in the order of the build, then the obstacles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import hypot
from pathlib import Path
from typing import TypeAlias
from zlib import crc32

import numpy as np

from ..errors import InputError, ShipError, StepError
from ..ship.coasting_law import CoastingLaw, Motion, make_coasting
from ..ship.degrees_of_freedom import free_inverse, held_mobility, tilted_inverse
from ..ship.frames import Array, skew
from ..ship.hull.hull import build_hull
from ..ship.hull.solid import HullMesh
from ..ship.loading.library import Ship, load_ship
from ..ship.ship_checksum import compute_checksum
from .dynamics.body_state import BodyState
from .feedback import PRESCRIBED, choose_feedbacks
from .fender import Fender, build_fender
from .geometry.broad_phase import Rectangle
from .geometry.bullet import BulletBody, require_dynamics
from .interface import CollisionParameters, ShipParameters
from .obstacles import Obstacle, read_obstacles

__all__ = ["Body", "prepare_bodies"]

Vector: TypeAlias = Sequence[float]


@dataclass(frozen=True, eq=False)
class Body:
    """A ship or an obstacle.

    reach: no point of the hull is farther from CO [m]; free: degrees of freedom, 0 for an obstacle; fender_thickness:
    how far before the hull the fender acts [m], 0 without one; coasting: law of motion between impulses; wall: the
    state of an obstacle, None for a ship; rectangle: where an obstacle stands; checksum: of what was read of it.
    """

    name: str
    hull: HullMesh
    reach: float
    free: int
    upright_inverse: Array  # (6, 6), see inverse_at
    held: Array | None  # (3, 3), see degrees_of_freedom.held_mobility
    bullet: BulletBody
    fender: Fender | None
    coasting: CoastingLaw | None = None  # None: straight
    feedback: str = PRESCRIBED  # of a ship; an obstacle never answers
    wall: BodyState | None = None
    rectangle: Rectangle = (0.0, 0.0, 0.0, 0.0)
    checksum: int = 0
    fender_thickness: float = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "fender_thickness", self.fender.thickness if self.fender else 0.0)

    def inverse_at(self, attitude: Sequence[float]) -> Array:
        """M^-1 (6, 6) in the free degrees of freedom at an attitude [rad]: d(nu) = M^-1 impulse, in b about CO."""
        return tilted_inverse(self.upright_inverse, self.free, attitude)

    def largest_speed(self, state: BodyState) -> float:
        """Bound [m/s] of the speed of any point of the hull, in the mean over the step: |v| + |omega| reach."""
        if state.fixed:
            return 0.0
        u, v, w, p, q, r = state.nu_path.tolist()
        return hypot(u, v, w) + hypot(p, q, r) * self.reach


class _NamedLaw:
    """The law of a ship, whose refusals name the ship."""

    def __init__(self, name: str, law: CoastingLaw) -> None:
        self._name, self._coast = name, law.coast
        self.keeps_course, self.is_straight = law.keeps_course, law.is_straight

    def coast(self, position: Vector, attitude: Vector, velocity: Vector, rate: Vector, h: float) -> Motion:
        """The motion after h [s]. Raises StepError, as the law does."""
        try:
            return self._coast(position, attitude, velocity, rate, h)
        except StepError as error:
            raise StepError(f"{self._name}: {error}") from None


def prepare_bodies(names: Sequence[str], parameters: CollisionParameters, directory: Path | None = None) -> list[Body]:
    """The bodies that the parameters ask for; ship files are looked for in `directory` first. Raises InputError."""
    feedbacks = choose_feedbacks(names, parameters)
    ships = [_load(name, p.ship, directory) for name, p in zip(names, parameters.ships, strict=True)]
    if parameters.response == "bullet":
        _refuse_what_bullet_lacks(names, ships, parameters.ships, feedbacks)
        require_dynamics()
    bodies = [_ship(*each) for each in zip(names, ships, parameters.ships, feedbacks, strict=True)]
    for obstacle in read_obstacles(parameters.obstacles):
        if obstacle.name in names:
            raise InputError(f"obstacles: {obstacle.name!r} is the name of a ship: give the obstacle another name")
        bodies.append(_wall(obstacle))
    return bodies


def _load(name: str, source: str, directory: Path | None) -> Ship:
    try:
        return load_ship(source, directory)
    except ShipError as error:
        raise ShipError(f"{name}.ship: {error}") from None


def _ship(name: str, ship: Ship, parameters: ShipParameters, feedback: str) -> Body:
    hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
    S, fender = skew(ship.r_bg), parameters.fender
    inertia_g = np.diag(ship.M_RB[3:, 3:] + ship.mass * S @ S).copy()
    try:
        M_inverse, held = free_inverse(ship.M, parameters.degrees_of_freedom), None
    except ShipError as error:
        raise ShipError(f"{name}.{error}") from None
    if feedback == PRESCRIBED:  # no impulse changes its motion
        M_inverse = np.zeros((6, 6))
    else:
        held = held_mobility(ship.M, parameters.degrees_of_freedom)
    return Body(
        name, hull, float(np.linalg.norm(hull.vertices, axis=1).max()),
        parameters.degrees_of_freedom, M_inverse, held, BulletBody(ship.mass, inertia_g, np.array(ship.r_bg)),
        build_fender(f"{name}.fender", fender.stiffness, fender.damping, fender.thickness),
        _predict_coasting(name, ship, parameters), feedback, checksum=_add_hull(compute_checksum(ship), hull),
    )  # fmt: skip


def _predict_coasting(name: str, ship: Ship, parameters: ShipParameters) -> CoastingLaw | None:
    """How the ship is expected to move between impulses; None for straight.

    A ship that does not float upright, or whose buoyancy cannot be estimated, is expected to move without buoyancy.
    """
    law, free = parameters.coasting, parameters.degrees_of_freedom
    if law == "straight":
        return None
    try:
        return _NamedLaw(name, make_coasting(ship, free, law))
    except ShipError:
        return _NamedLaw(name, make_coasting(ship, free, "free"))
    except InputError as error:
        raise InputError(f"{name}.{error}") from None


def _wall(obstacle: Obstacle) -> Body:
    wall = BodyState.wall(obstacle.position, obstacle.heading)
    corners = wall.x + obstacle.solid.vertices @ wall.R.T
    (n_0, e_0, _), (n_1, e_1, _) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    return Body(
        obstacle.name, obstacle.solid, float(np.linalg.norm(obstacle.solid.vertices, axis=1).max()),
        0, wall.M_inverse, None, BulletBody(0.0, np.zeros(3), np.zeros(3)), obstacle.fender, None, PRESCRIBED, wall,
        (n_0, n_1, e_0, e_1), _add_hull(crc32(repr((obstacle.name, corners.tolist(), obstacle.fender)).encode()),
                                        obstacle.solid),
    )  # fmt: skip


def _add_hull(checksum: int, hull: HullMesh) -> int:
    """The checksum of a body with its hull."""
    for part in hull.parts:
        checksum = crc32(np.ascontiguousarray(part).tobytes(), checksum)
    return checksum


def _refuse_what_bullet_lacks(
    names: Sequence[str], ships: Sequence[Ship], given: Sequence[ShipParameters], feedbacks: Sequence[str]
) -> None:
    for name, ship, parameters, feedback in zip(names, ships, given, feedbacks, strict=True):
        if feedback == PRESCRIBED:
            raise InputError(
                f"response 'bullet' moves bodies by their mass, and {name} is prescribed: take response 'pgs', or "
                "feedback 'none'"
            )
        if parameters.degrees_of_freedom != 6:
            raise InputError(
                f"response 'bullet' moves bodies freely, and {name}.degrees_of_freedom = "
                f"{parameters.degrees_of_freedom}: take response 'pgs', or 6 degrees of freedom"
            )
        if ship.M_A.any():
            raise InputError(
                f"response 'bullet' knows a scalar mass only, and {name} = {ship.name!r} has added mass: take response "
                "'pgs', or a ship whose [added_mass] is zero"
            )
