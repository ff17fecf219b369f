"""What impact is wanted: the types of encounter, what a user may ask of them, and what is refused.

The angle is that between the headings, 0 overtaking, 180 head-on; own comes from the side that is named. s = 0.5 and
s = -0.5 are the middle of the stem and of the stern. Speeds are those of the approach, through the water; a ship that
turns is slower at the impact.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from math import ceil, isfinite
from typing import Any

from ..errors import ScenarioError
from ..ship.loading.messages import suggestion
from .plan_contact import Side

__all__ = ["FASTEST", "KINDS", "Kind", "Wanted", "asked_for", "checked", "either", "whole_steps"]

FASTEST = 50.0
"""[m/s] A higher speed is one in another unit."""
LONGEST = 7200.0
"""[s] before and after the impact."""
FREEDOMS = (3, 4, 6)


@dataclass(frozen=True)
class Kind:
    """A type of encounter: what it is, and what holds where the user says nothing."""

    words: str
    angle_deg: float
    at: float
    own_speed: float
    target_speed: float
    sailed: bool = False  # needs hydrodynamics
    helm: str = ""  # what own's rudder does before the impact
    before: float = 0.0
    rudder_deg: float = 0.0
    drift_speed: float = 0.0


KINDS: dict[str, Kind] = {
    "head-on": Kind("meets target stem to stem", 180.0, 0.5, 5.0, 5.0),
    "crossing": Kind("crosses target's course and strikes her side", 90.0, 0.0, 5.0, 5.0),
    "overtaking": Kind("overtakes target and strikes her stern", 0.0, -0.5, 7.0, 3.0),
    "glancing": Kind("strikes target's side at a small angle", 20.0, 0.1, 6.0, 5.0),
    "t-bone": Kind("strikes the side of target, who lies stopped", 90.0, 0.0, 5.0, 0.0),
    "drifting-target": Kind("strikes target, who drifts across", 90.0, 0.0, 5.0, 0.0, drift_speed=1.0),
    "late-evasive": Kind(
        "puts her rudder over too late and strikes target", 70.0, 0.0, 6.0, 5.0, True, "evades", 40.0, 35.0
    ),
    "loss-of-steering": Kind(
        "strikes target after her rudder has jammed", 60.0, 0.0, 6.0, 4.0, True, "jams", 90.0, 15.0
    ),
}


@dataclass(frozen=True)
class Wanted:
    """The impact that is wanted, and what comes before it; None stands for what is usual for the kind.

    own, target        ships: a name or a path            angle_deg      between the headings, 0 to 180
    at                 place s on the target, -0.5 to 0.5 (stern to stem)       side      of the target that is struck
    own_speed, target_speed   [m/s]                       heading_deg    of the target at the impact
    time, after        from the start to the impact, and from it to the end [s]
    hydrodynamics      both ships under way with the manoeuvring model; None: if the kind needs it
    degrees_of_freedom of both ships, 3, 4 or 6; None: 3 (under way 4 and 6 add heel in the turn and the roll after the
                       impact, and take longer; a ship that coasts in 6 has no buoyancy and goes on rolling)
    before, rudder_deg own's rudder order: how long before the impact [s], positive to starboard (late-evasive,
                       loss-of-steering)
    drift_speed, drift_deg    of a drifting target [m/s], and where to, from her bow clockwise
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
    name: str | None = None


def asked_for(kind: str, options: Mapping[str, Any]) -> Wanted:
    """From options by name, of which None stands for one that is not given. Raises ScenarioError for an unknown one."""
    known = [field.name for field in fields(Wanted)][1:]
    for name in options:
        if name not in known:
            raise ScenarioError(
                f"encounter {kind} has no {name}:{suggestion(name, known)} there are {', '.join(known)}"
            )
    return Wanted(kind, **{name: value for name, value in options.items() if value is not None})


def checked(wanted: Wanted) -> Kind:
    """The kind with its defaults. Raises ScenarioError, in one line, for what no encounter can have."""
    if wanted.kind not in KINDS:
        raise ScenarioError(
            f"unknown encounter {wanted.kind!r}:{suggestion(wanted.kind, list(KINDS))} known: {', '.join(KINDS)}"
        )
    kind = KINDS[wanted.kind]
    _check_numbers(wanted)
    if wanted.side not in ("port", "starboard"):
        raise ScenarioError(f"encounter {wanted.kind}: side = {wanted.side!r} must be port or starboard")
    if wanted.degrees_of_freedom not in (None, *FREEDOMS):
        raise ScenarioError(
            f"encounter {wanted.kind}: degrees_of_freedom = {wanted.degrees_of_freedom} must be 3 (surge, sway, yaw), "
            "4 (and roll) or 6"
        )
    _check_they_go_together(wanted, kind)
    return kind


def _check_numbers(wanted: Wanted) -> None:
    longest_before = LONGEST if wanted.time is None else wanted.time
    limits: list[tuple[str, float | None, float, float, str]] = [
        ("angle_deg", wanted.angle_deg, 0.0, 180.0, "0 is overtaking, 180 head-on; the side is chosen with --side"),
        ("at", wanted.at, -0.5, 0.5, "-0.5 is the target's stern, 0.5 her stem"),
        ("own_speed", wanted.own_speed, 0.0, FASTEST, "give metres per second"),
        ("target_speed", wanted.target_speed, 0.0, FASTEST, "give metres per second"),
        ("heading_deg", wanted.heading_deg, -360.0, 720.0, "clockwise from north"),
        ("time", wanted.time, wanted.step, LONGEST, "give seconds from the start to the impact"),
        ("after", wanted.after, wanted.step, LONGEST, "give seconds from the impact to the end"),
        ("step", wanted.step, 1e-3, 10.0, "give the communication step in seconds"),
        ("before", wanted.before, 0.0, longest_before, "it is within the time to the impact"),
        ("rudder_deg", wanted.rudder_deg, -90.0, 90.0, "positive is to starboard"),
        ("drift_speed", wanted.drift_speed, 0.0, FASTEST, "give metres per second"),
        ("drift_deg", wanted.drift_deg, -360.0, 360.0, "from the target's bow clockwise"),
    ]
    for name, value, least, most, remedy in limits:
        if value is not None and not (isfinite(value) and least <= value <= most):
            raise ScenarioError(f"encounter {wanted.kind}: {name} = {value:g} must be {least:g} to {most:g}: {remedy}")


def _check_they_go_together(wanted: Wanted, kind: Kind) -> None:
    for name, value, has in (
        ("before", wanted.before, kind.helm), ("rudder_deg", wanted.rudder_deg, kind.helm),
        ("drift_speed", wanted.drift_speed, kind.drift_speed),
    ):  # fmt: skip
        if value is not None and not has:
            raise ScenarioError(f"encounter {wanted.kind} has no {name}: leave it out, or take another type")
    if kind.sailed and wanted.hydrodynamics is False:
        raise ScenarioError(
            f"encounter {wanted.kind} needs ships that steer: leave out --coasting, or take another type"
        )
    if kind.drift_speed and wanted.target_speed:
        raise ScenarioError(f"encounter {wanted.kind}: the target drifts: give drift_speed, not target_speed")


def either(given: float | None, usual: float) -> float:
    """What is given, else what is usual."""
    return usual if given is None else float(given)


def whole_steps(time: float, step: float) -> int:
    """Communication steps that last at least a time [s]."""
    return max(1, ceil(time / step - 1e-9))
