"""impact(): what a collision does in its first instant, for arrays of cases.

Two upright ships are placed so that they just touch at a place of the target, under an angle, each with its own motion.
The collision model answers this one contact: no time passes, before or after. A run answers the same contact when it
comes to it, and goes on: the bow may slide along the side and press again.

    place      as for an encounter: a point of the target's section at the height of the lower deck
    overlap    12 mm at first, then deeper by the gap that is left: Bullet rounds the corners of hulls by centimetres

The work is done by native/batch, about 100 microseconds for each case, without the interpreter.
"""

from __future__ import annotations

from contextlib import closing
from functools import lru_cache
from numbers import Integral
from typing import Any

import numpy.typing as npt

from ..encounters.plan_contact import cut_section, find_top
from ..errors import ScenarioError
from ..ship.frames import Array
from ..ship.hull.hull import build_hull
from ..ship.hull.solid import HullMesh
from ..ship.ship import Ship
from .case_table import fill_cases
from .native_impacts import ImpactShip, NativeImpacts
from .prepared_ships import AnyShip, PreparedShips, find_ship

__all__ = ["check_freedom", "impact", "open_impacts", "run_cases"]

FREEDOMS = (3, 4, 6)
"""Degrees of freedom that a ship may have."""
SECTIONS_KEPT = 2048
"""Sections of ships: enough for every pair of sixty. Each keeps its ship in memory, 80 kB."""


def impact(
    own: AnyShip,
    target: AnyShip,
    angle_deg: npt.ArrayLike = 90.0,
    at: npt.ArrayLike = 0.0,
    own_speed: npt.ArrayLike = 5.0,
    target_speed: npt.ArrayLike = 0.0,
    *,
    side: npt.ArrayLike = "starboard",
    own_sway: npt.ArrayLike = 0.0,
    own_yaw_rate: npt.ArrayLike = 0.0,
    target_sway: npt.ArrayLike = 0.0,
    target_yaw_rate: npt.ArrayLike = 0.0,
    heading_deg: npt.ArrayLike = 0.0,
    friction: npt.ArrayLike = 0.3,
    restitution: npt.ArrayLike = 0.0,
    degrees_of_freedom: int = 3,
) -> npt.NDArray[Any]:
    """The impacts of own on the target: a structured array of the shape to which the arguments broadcast.

    own, target      a ship, its name, the path of its file, or the file's tables
    angle_deg        angle between the headings [deg]: 0 is overtaking, 180 head-on
    at, side         place on the target, from -0.5 (stern) to 0.5 (stem) of its length; "port" or "starboard"
    ..._speed, ..._sway, ..._yaw_rate   motion of each ship before the impact, in b about CO [m/s, rad/s]
    heading_deg      heading of the target [deg]
    friction, restitution   of the contact

    A case that is out of range, or whose ships do not close at the place, is a row with a status other than zero and
    the reason. Raises ScenarioError for arguments that do not fit together, ShipError for a ship that is refused,
    HostError when there is no native library and no compiler.
    """
    check_freedom("impact", degrees_of_freedom)
    cases = fill_cases(
        "impact",
        {
            "angle_deg": angle_deg, "at": at, "own_speed": own_speed, "own_sway": own_sway,
            "own_yaw_rate": own_yaw_rate, "target_speed": target_speed, "target_sway": target_sway,
            "target_yaw_rate": target_yaw_rate, "heading_deg": heading_deg, "friction": friction,
            "restitution": restitution,
        },
        side,
    )  # fmt: skip
    with PreparedShips() as files:
        return run_cases(find_ship(own), find_ship(target), degrees_of_freedom, cases, files)


def check_freedom(caller: str, degrees_of_freedom: int) -> None:
    """Raises ScenarioError for a number of degrees of freedom that no ship has."""
    if not isinstance(degrees_of_freedom, Integral) or degrees_of_freedom not in FREEDOMS:
        raise ScenarioError(
            f"{caller}: degrees_of_freedom = {degrees_of_freedom!r} must be 3 (surge, sway, yaw), 4 (and roll) or 6"
        )


def run_cases(
    own: Ship, target: Ship, degrees_of_freedom: int, cases: npt.NDArray[Any], files: PreparedShips
) -> npt.NDArray[Any]:
    """The rows of the cases, of their shape."""
    with closing(open_impacts(own, target, degrees_of_freedom, files)) as impacts:
        return impacts.run(cases.ravel()).reshape(cases.shape)


def open_impacts(own: Ship, target: Ship, degrees_of_freedom: int, files: PreparedShips) -> NativeImpacts:
    """The impacts of two ships, ready to run; the files are read here and not later. Raises ShipError or HostError."""
    deck = max(_find_deck(own), _find_deck(target))  # as find_contact_height() has it
    own_ship, target_ship = (
        ImpactShip(files.write(ship), degrees_of_freedom, ship.L_oa, ship.hull.trim_x, _cut_ship(ship, deck))
        for ship in (own, target)
    )
    return NativeImpacts(own_ship, target_ship)


@lru_cache(maxsize=SECTIONS_KEPT // 2)
def _find_deck(ship: Ship) -> float:
    return find_top(_build(ship))


@lru_cache(maxsize=SECTIONS_KEPT)
def _cut_ship(ship: Ship, z: float) -> Array:
    """Section of a ship at height z (down), kept for its other pairs: to cut it takes as long as ten impacts."""
    section = cut_section(_build(ship), z)
    section.flags.writeable = False
    return section


def _build(ship: Ship) -> HullMesh:
    return build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
