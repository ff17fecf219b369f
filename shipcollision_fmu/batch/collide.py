"""collide(): whole collisions of two coasting ships, for arrays of cases.

    impact()    where the ships touch at the place                          impact.py
    start       both go back on their straight ways by the time `before`
    run         master, ships and collision model, as for a scenario        native/batch/encounter.hpp

Two sections that close along the normals of the place touch there first: the ways before it are free. A ship that
drifts is carried by the water and keeps its heading, as in the encounters of encounter().
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from ctypes import c_double
from math import isfinite
from numbers import Real
from typing import Any

import numpy as np
import numpy.typing as npt

from ..collision.feedback import COMMON_FEEDBACKS
from ..collision.interface import CollisionParameters
from ..collision.responses import RESPONSES
from ..errors import ScenarioError
from ..scenario.tables.header import MAXIMUM_STEPS
from ..ship.coasting_law import COASTING
from ..ship.degrees_of_freedom import free_inverse
from ..ship.ship import Ship
from .case_table import fill_cases
from .encounter_case import NEVER
from .encounter_tables import EncounterBook, Encounters
from .encounters import check_separation
from .impact import check_freedom, run_cases
from .native_encounters import EncounterCase, EncounterShip, NativeEncounters
from .prepared_ships import AnyShip, PreparedShips, find_ship

__all__ = ["collide"]

LONGEST = 7200.0
"""[s] Limit of the times before and after the impact; a longer time was meant in another unit."""
ROLES = ("own", "target")


def collide(
    own: AnyShip,
    target: AnyShip,
    angle_deg: npt.ArrayLike = 90.0,
    at: npt.ArrayLike = 0.0,
    own_speed: npt.ArrayLike = 5.0,
    target_speed: npt.ArrayLike = 0.0,
    *,
    side: npt.ArrayLike = "starboard",
    own_sway: npt.ArrayLike = 0.0,
    target_sway: npt.ArrayLike = 0.0,
    heading_deg: npt.ArrayLike = 0.0,
    friction: npt.ArrayLike = 0.3,
    restitution: npt.ArrayLike = 0.0,
    degrees_of_freedom: int = 3,
    before: float = 1.0,
    after: float = 60.0,
    separation: float | None = None,
    step: float = 0.05,
    tracks: bool = False,
) -> Encounters:
    """The collisions of coasting ships "own" and "target", in the order of the cases to which the arguments broadcast.

    The arguments are those of impact(). The impact comes at the time `before` [s]; `after` [s] follow, or the
    `separation` [s] without contact, whichever is shorter. step: communication step [s]; tracks: whether the states at
    all communication points are kept.

    A case without impact is a row with a status other than zero and the reason. Raises as impact() does, and
    ScenarioError for a time that is out of range.
    """
    check_freedom("collide", degrees_of_freedom)
    check_separation("collide", separation)
    for name, value in (("before", before), ("after", after), ("step", step)):
        if not (isinstance(value, Real) and isfinite(value) and 0.0 < value <= LONGEST):
            raise ScenarioError(f"collide: {name} = {value!r} must be seconds, above 0 and at most {LONGEST:g}")
    if (before + after) / step > MAXIMUM_STEPS:
        raise ScenarioError(
            f"collide: step = {step!r} s makes {(before + after) / step:.3g} steps, the limit is {MAXIMUM_STEPS}: "
            "take a longer step"
        )
    cases = fill_cases(
        "collide",
        {
            "angle_deg": angle_deg, "at": at, "own_speed": own_speed, "own_sway": own_sway,
            "target_speed": target_speed, "target_sway": target_sway, "heading_deg": heading_deg,
            "friction": friction, "restitution": restitution,
        },
        side,
    ).ravel()  # fmt: skip
    ships, steps = (find_ship(own), find_ship(target)), round(before / step) or 1
    book = EncounterBook(tracks)
    with PreparedShips() as files, closing(NativeEncounters()) as native:
        rows = run_cases(*ships, degrees_of_freedom, cases, files)
        case = _make_case(ships, degrees_of_freedom, files)
        case.step, case.steps = step, steps + (round(after / step) or 1)
        case.separation = NEVER if separation is None else separation
        for _ in _set_starts(case, cases, rows, steps * step, book):
            book.add(native.run(case, has_track=tracks), list(ROLES))
    return book.build_tables()


def _make_case(ships: tuple[Ship, Ship], degrees_of_freedom: int, files: PreparedShips) -> EncounterCase:
    """The encounter of two ships that coast, without their starts."""
    p = CollisionParameters([])
    coasting = [
        EncounterShip(
            name=role.encode(), file=files.write(ship).encode(), degrees_of_freedom=degrees_of_freedom,
            inverse=(c_double * 36)(*free_inverse(ship.M, degrees_of_freedom).ravel()),
        )
        for role, ship in zip(ROLES, ships, strict=True)
    ]  # fmt: skip
    return EncounterCase(
        ships=(EncounterShip * 2)(*coasting), obstacles=b"", ship_count=2, substep=p.substep,
        minimum_separation_time=p.minimum_separation_time, clearance_range=p.clearance_range,
        response=list(RESPONSES).index(p.response), feedback=COMMON_FEEDBACKS.index(p.feedback),
    )  # fmt: skip


def _set_starts(
    case: EncounterCase, cases: npt.NDArray[Any], rows: npt.NDArray[Any], before: float, book: EncounterBook
) -> Iterator[None]:  # fmt: skip
    """Puts the start of one case after the other into `case`; those without impact are refused in the book."""
    for given, row in zip(cases, rows, strict=True):
        if row["status"]:
            book.refuse(row["reason"].decode())
            continue
        case.friction, case.restitution = given["friction"], given["restitution"]
        for i, role in enumerate(ROLES):
            ship, heading = case.ships[i], row[f"{role}_heading"]
            surge, sway = row[f"{role}_before"][:2]
            c, s = np.cos(heading), np.sin(heading)
            north, east = row[f"{role}_position"][:2] - before * np.array([surge * c - sway * s, surge * s + sway * c])
            ship.start[:] = [north, east, 0.0, 0.0, 0.0, heading, surge, sway, 0.0, 0.0, 0.0, 0.0]
            ship.coasting = ship.predicted_coasting = COASTING.index("straight" if sway else COASTING[0])
        yield
