"""Kinds of encounter, the options of each, their limits and the messages for options that are refused.

angle_deg is the angle between the headings: 0 is overtaking, 180 is head-on. Own comes from the side that is named.
The place s runs from -0.5, the middle of the stern, to 0.5, the middle of the stem. Speeds are those of the approach,
through the water; a ship that turns is slower at the impact.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from math import ceil, isfinite
from typing import Any

from ..errors import ScenarioError
from ..scenario.tables.environment import MAXIMUM_CURRENT, MAXIMUM_WIND
from ..ship.loading.messages import suggest_or_list
from .plan_contact import Side

__all__ = [
    "FASTEST", "KINDS", "Kind", "Request", "check_request", "check_surroundings", "count_steps", "make_request",
    "value_or_default",
]  # fmt: skip

FASTEST = 50.0
"""[m/s] Limit of every speed. No ship is faster, so a higher value was meant in another unit. The check for an earlier
contact also relies on it: its strides are safe for ships up to twice this speed."""
LONGEST = 7200.0
"""[s] Limit of the times before and after the impact; a longer time was meant in another unit."""
FREEDOMS = (3, 4, 6)
"""Degrees of freedom that the manoeuvring model offers."""

HEAD_ON_ANGLES = (135.0, 180.0)
"""[deg] Nearer to opposite courses than to a right angle."""
OVERTAKING_ANGLES = (0.0, 67.5)
"""[deg] From more than 22.5 deg abaft the target's beam (COLREG, rule 13)."""
GLANCING_ANGLES = (0.0, 45.0)
"""[deg] Nearer to the same course than to a right angle."""


@dataclass(frozen=True)
class Kind:
    """A kind of encounter: its description and the values used where a request gives none.

    words, elsewhere          predicate of the sentence "Own ... ." in the scenario file, and that for a place s other
                              than the kind's own; empty where the predicate names no place
    moving                    predicate where a target that lies stopped by default has a speed
    angles                    least and greatest angle between the headings [deg] that the name of the kind allows
    angle_deg, at             angle between the headings [deg], place s on the target
    own_speed, target_speed   approach speeds through the water [m/s]
    sailed                    whether the kind needs the manoeuvring model
    helm                      what own's rudder does before the impact; empty where it stays amidships
    before, rudder_deg        time before the impact [s] and angle [deg] of the rudder order
    drift_speed               speed of a drifting target [m/s]; zero where the kind has no drift
    """

    words: str
    angle_deg: float
    at: float
    own_speed: float
    target_speed: float
    sailed: bool = False
    helm: str = ""
    before: float = 0.0
    rudder_deg: float = 0.0
    drift_speed: float = 0.0
    moving: str = ""
    elsewhere: str = ""
    angles: tuple[float, float] = (0.0, 180.0)


KINDS: dict[str, Kind] = {
    "head-on": Kind(
        "meets target stem to stem",
        180.0,
        0.5,
        5.0,
        5.0,
        elsewhere="meets target on a nearly opposite course",
        angles=HEAD_ON_ANGLES,
    ),
    "crossing": Kind("crosses target's course and strikes its side", 90.0, 0.0, 5.0, 5.0),
    "overtaking": Kind(
        "overtakes target and strikes its stern",
        0.0,
        -0.5,
        7.0,
        3.0,
        elsewhere="overtakes target and strikes it",
        angles=OVERTAKING_ANGLES,
    ),
    "glancing": Kind("strikes target's side at a small angle", 20.0, 0.1, 6.0, 5.0, angles=GLANCING_ANGLES),
    "t-bone": Kind(
        "strikes the side of target, which lies stopped", 90.0, 0.0, 5.0, 0.0, moving="strikes the side of target"
    ),
    "drifting-target": Kind("strikes target, which drifts across", 90.0, 0.0, 5.0, 0.0, drift_speed=1.0),
    "late-evasive": Kind(
        "puts its rudder over too late and strikes target", 70.0, 0.0, 6.0, 5.0, True, "evades", 40.0, 35.0
    ),
    "loss-of-steering": Kind(
        "strikes target after its rudder has jammed", 60.0, 0.0, 6.0, 4.0, True, "jams", 90.0, 15.0
    ),
}
"""The kinds by name. A change of a value changes every encounter generated without that option."""


@dataclass(frozen=True)
class Request:
    """The impact to generate and the approach to it; None stands for the default of the kind.

    own, target        ships: a name or a path
    angle_deg          angle between the headings [deg], 0 to 180
    at                 place s on the target, -0.5 (stern) to 0.5 (stem)
    side               side of the target that is struck
    own_speed, target_speed   [m/s]
    heading_deg        heading of the target at the impact [deg]
    time, after        time from the start to the impact, and from the impact to the end [s]
    step               communication step [s]
    hydrodynamics      whether both ships are sailed with the manoeuvring model; None: if the kind needs it
    degrees_of_freedom of both ships, 3, 4 or 6; None: 3. Under way, 4 and 6 add heel in the turn and roll after the
                       impact, and take longer. A coasting ship in 6 has no buoyancy and goes on rolling.
    before, rudder_deg time of own's rudder order before the impact [s], and its angle [deg], positive to starboard
                       (late-evasive and loss-of-steering)
    drift_speed, drift_deg    speed of a drifting target [m/s] and its direction from the target's bow, clockwise [deg]
    current_speed, current_towards_deg    the water's [m/s] and the direction to which it flows [deg], for sailed ships
    wind_speed, wind_from_deg             the wind's [m/s] and the direction from which it comes [deg], likewise
    name               name of the scenario
    """

    kind: str
    own: str = "kvlcc2"
    target: str = "kvlcc2"
    angle_deg: float | None = None
    at: float | None = None
    side: Side = "starboard"
    own_speed: float | None = None
    target_speed: float | None = None
    heading_deg: float = 0.0
    time: float | None = None
    after: float = 60.0
    step: float = 0.05
    hydrodynamics: bool | None = None
    degrees_of_freedom: int | None = None
    before: float | None = None
    rudder_deg: float | None = None
    drift_speed: float | None = None
    drift_deg: float = 90.0
    current_speed: float | None = None
    current_towards_deg: float | None = None
    wind_speed: float | None = None
    wind_from_deg: float | None = None
    name: str | None = None


def make_request(kind: str, options: Mapping[str, Any]) -> Request:
    """A request from options by name; an option of value None counts as not given.

    Raises ScenarioError for an option that no request has.
    """
    known = [field.name for field in fields(Request)][1:]
    for name in options:
        if name not in known:
            raise ScenarioError(f"encounter {kind} has no {name}:{suggest_or_list(name, known)}")
    return Request(kind, **{name: value for name, value in options.items() if value is not None})


def check_request(request: Request) -> Kind:
    """The kind of a request that is within its limits.

    Raises ScenarioError, in one line, for an unknown kind, a value out of range, or options that exclude each other.
    """
    if request.kind not in KINDS:
        raise ScenarioError(f"unknown encounter {request.kind!r}:{suggest_or_list(request.kind, list(KINDS))}")
    kind = KINDS[request.kind]
    _check_ranges(request)
    if request.side not in ("port", "starboard"):
        raise ScenarioError(f"encounter {request.kind}: side = {request.side!r} must be port or starboard")
    if request.degrees_of_freedom not in (None, *FREEDOMS):
        raise ScenarioError(
            f"encounter {request.kind}: degrees_of_freedom = {request.degrees_of_freedom} must be 3 (surge, sway, "
            "yaw), 4 (and roll) or 6"
        )
    _check_options_of_kind(request, kind)
    return kind


def _check_ranges(request: Request) -> None:
    longest_before = LONGEST if request.time is None else request.time
    limits: list[tuple[str, float | None, float, float, str]] = [
        ("angle_deg", request.angle_deg, 0.0, 180.0, "0 is overtaking, 180 head-on; the side is chosen with --side"),
        ("at", request.at, -0.5, 0.5, "-0.5 is the target's stern, 0.5 its stem"),
        ("own_speed", request.own_speed, 0.0, FASTEST, "give metres per second"),
        ("target_speed", request.target_speed, 0.0, FASTEST, "give metres per second"),
        ("heading_deg", request.heading_deg, -360.0, 720.0, "clockwise from north"),
        ("time", request.time, request.step, LONGEST, "give seconds from the start to the impact"),
        ("after", request.after, request.step, LONGEST, "give seconds from the impact to the end"),
        ("step", request.step, 1e-3, 10.0, "give the communication step in seconds"),
        ("before", request.before, 0.0, longest_before, "the order is given within the time to the impact"),
        ("rudder_deg", request.rudder_deg, -90.0, 90.0, "positive is to starboard"),
        ("drift_speed", request.drift_speed, 0.0, FASTEST, "give metres per second"),
        ("drift_deg", request.drift_deg, -360.0, 360.0, "from the target's bow clockwise"),
        ("current_speed", request.current_speed, 0.0, MAXIMUM_CURRENT, "give metres per second"),
        ("current_towards_deg", request.current_towards_deg, -360.0, 720.0, "clockwise from north"),
        ("wind_speed", request.wind_speed, 0.0, MAXIMUM_WIND, "give metres per second"),
        ("wind_from_deg", request.wind_from_deg, -360.0, 720.0, "clockwise from north"),
    ]
    for name, value, least, most, remedy in limits:
        if value is not None and not (isfinite(value) and least <= value <= most):
            raise ScenarioError(f"encounter {request.kind}: {name} = {value:g} must be {least:g} to {most:g}: {remedy}")


def _check_options_of_kind(request: Request, kind: Kind) -> None:
    for name, value, has in (
        ("before", request.before, kind.helm), ("rudder_deg", request.rudder_deg, kind.helm),
        ("drift_speed", request.drift_speed, kind.drift_speed),
    ):  # fmt: skip
        if value is not None and not has:
            raise ScenarioError(f"encounter {request.kind} has no {name}: leave it out, or take another type")
    least, most = kind.angles
    if request.angle_deg is not None and not least <= request.angle_deg <= most:
        raise ScenarioError(
            f"encounter {request.kind}: angle_deg = {request.angle_deg:g} must be {least:g} to {most:g} for this type: "
            "take crossing for another angle"
        )
    if kind.sailed and request.hydrodynamics is False:
        raise ScenarioError(
            f"encounter {request.kind} needs ships that steer: leave out --coasting, or take another type"
        )
    if kind.drift_speed and request.target_speed:
        raise ScenarioError(f"encounter {request.kind}: the target drifts: give drift_speed, not target_speed")


def check_surroundings(request: Request, kind: Kind, sailed: bool) -> None:
    """Raise ScenarioError for a current or a wind that acts on neither ship, or that lacks its speed or direction."""
    for what, direction in (("current", "current_towards_deg"), ("wind", "wind_from_deg")):
        speed = f"{what}_speed"
        missing = [name for name in (speed, direction) if getattr(request, name) is None]
        if len(missing) == 2:
            continue
        given = direction if missing == [speed] else speed
        if not sailed:
            raise ScenarioError(
                f"encounter {request.kind}: {given} has no effect on ships that coast: give --hydrodynamics, or leave "
                "it out"
            )
        if missing:
            raise ScenarioError(
                f"encounter {request.kind}: {missing[0]} is missing: a {what} has a speed and a direction"
            )
        if what == "current" and kind.drift_speed:
            raise ScenarioError(
                f"encounter {request.kind}: the drift is that of the water: give drift_speed and drift_deg, not {given}"
            )


def value_or_default(given: float | None, default: float) -> float:
    """The value given, else the default."""
    return default if given is None else float(given)


def count_steps(time: float, step: float) -> int:
    """The least whole number of communication steps, at least one, that last a time [s]."""
    return max(1, ceil(time / step - 1e-9))
