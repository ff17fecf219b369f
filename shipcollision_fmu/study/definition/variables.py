"""The variables of a study: unit, limits, meaning, and the levels of detail at which each acts."""

from __future__ import annotations

from typing import NamedTuple

from ...encounters.request import FASTEST, KINDS
from ...scenario.tables.environment import MAXIMUM_CURRENT, MAXIMUM_WIND

__all__ = [
    "COASTING", "IMPACT", "LEVELS", "NUMBERS", "SAILED", "SIDES", "SITUATION", "SURROUNDINGS", "WORDS", "Number",
    "acts_with",
]  # fmt: skip

LEVELS = ("impact", "encounter", "sailed")
"""Levels of detail: the contact alone, coasting ships before and after it, sailed ships with orders to their helm."""

SITUATION = "situation"
"""Stands for the kind of encounter where a file of traffic is the case."""
OF_THE_WATER = ("current_speed", "current_towards_deg")
SURROUNDINGS = (*OF_THE_WATER, "wind_speed", "wind_from_deg")
OF_A_SITUATION = ("friction", "restitution", *SURROUNDINGS)
"""Variables of a situation; the others are in its file."""
SIDES = ("port", "starboard")

IMPACT, COASTING, SAILED = LEVELS
FASTEST_TURN = 1.0
"""[rad/s] Limit of yaw rates, as impact() has it."""


class Number(NamedTuple):
    """A variable that is a number: unit, limits, the levels at which it acts, its meaning, and a hint for refusals.

    default: the value where the file gives none; None: that of the kind of encounter.
    """

    unit: str
    least: float
    most: float
    levels: tuple[str, ...]
    meaning: str
    hint: str
    default: float | None = 0.0


_SPEED, _RATE = "give metres per second", "give radians per second"

NUMBERS = {
    "angle_deg": Number(
        "deg", 0.0, 180.0, LEVELS, "the angle between the headings", "0 is overtaking, 180 head-on", None
    ),
    "at": Number(
        "", -0.5, 0.5, LEVELS, "the place on the target as a share of its length",
        "-0.5 is the target's stern, 0.5 its stem", None,
    ),
    "own_speed": Number("m/s", -FASTEST, FASTEST, LEVELS, "the speed of own ahead", _SPEED, None),
    "target_speed": Number("m/s", -FASTEST, FASTEST, LEVELS, "the speed of the target ahead", _SPEED, None),
    "own_sway": Number("m/s", -FASTEST, FASTEST, (IMPACT, COASTING), "the speed of own to starboard", _SPEED),
    "target_sway": Number(
        "m/s", -FASTEST, FASTEST, (IMPACT, COASTING), "the speed of the target to starboard", _SPEED
    ),
    "own_yaw_rate": Number("rad/s", -FASTEST_TURN, FASTEST_TURN, (IMPACT,), "the yaw rate of own", _RATE),
    "target_yaw_rate": Number("rad/s", -FASTEST_TURN, FASTEST_TURN, (IMPACT,), "the yaw rate of the target", _RATE),
    "heading_deg": Number("deg", -360.0, 720.0, LEVELS, "the heading of the target", "clockwise from north"),
    "friction": Number(
        "", 0.0, 10.0, LEVELS, "Coulomb's coefficient of friction", "0.1 to 0.6 is usual for steel", 0.3
    ),
    "restitution": Number(
        "", 0.0, 1.0, LEVELS, "the share of the approach that comes back", "0 is for ships that crush"
    ),
    "drift_speed": Number("m/s", 0.0, FASTEST, LEVELS, "the speed of a drifting target", _SPEED, None),
    "drift_deg": Number(
        "deg", -360.0, 360.0, LEVELS, "the direction of the drift, clockwise from the target's bow",
        "90 is to starboard", 90.0,
    ),
    "before": Number(
        "s", 0.0, 7200.0, (SAILED,), "the time of own's rudder order before the impact", "give seconds", None
    ),
    "rudder_deg": Number(
        "deg", -90.0, 90.0, (SAILED,), "the angle of own's rudder order", "positive is to starboard", None
    ),
    "current_speed": Number(
        "m/s", 0.0, MAXIMUM_CURRENT, (SAILED,), "the speed of the water", _SPEED, None
    ),
    "current_towards_deg": Number(
        "deg", -360.0, 720.0, (SAILED,), "the direction to which the water flows", "clockwise from north", None
    ),
    "wind_speed": Number("m/s", 0.0, MAXIMUM_WIND, (SAILED,), "the speed of the wind", _SPEED, None),
    "wind_from_deg": Number(
        "deg", -360.0, 720.0, (SAILED,), "the direction from which the wind comes", "clockwise from north", None
    ),
}  # fmt: skip
"""By key of [encounter]."""

WORDS = {"kind": tuple(KINDS), "side": SIDES}
"""Variables that are words, and the words of each."""


def acts_with(name: str, kind: str) -> bool:
    """Whether a variable acts in encounters of a kind, or in a situation of traffic."""
    if kind == SITUATION:
        return name in OF_A_SITUATION
    of = KINDS[kind]
    if name in OF_THE_WATER:  # a target that drifts is carried by a current of its own
        return of.drift_speed == 0.0
    if name in ("before", "rudder_deg"):
        return bool(of.helm)
    if name in ("drift_speed", "drift_deg"):
        return of.drift_speed > 0.0
    return name != "target_speed" or of.drift_speed == 0.0
