"""Columns of the two tables of a study: name, type, unit, meaning. The same at every level of detail.

A number is null where it does not apply: yaw rates of coasting ships, results of a refused case.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from ..definition.variables import NUMBERS
from ..extra import import_pyarrow

__all__ = ["COLLISIONS", "ENCOUNTERS", "StudyColumn", "make_schema"]


class StudyColumn(NamedTuple):
    """A column: its name, its type in Arrow, its unit and its meaning."""

    name: str
    type: str
    unit: str
    meaning: str


def _real(name: str, unit: str, meaning: str) -> StudyColumn:
    return StudyColumn(name, "double", unit, meaning)


def _describe_ships() -> list[StudyColumn]:
    return [
        column
        for role, words in (("own", "own, which strikes"), ("target", "the target"))
        for column in (
            StudyColumn(f"{role}_ship", "string", "", f"name of {words}"),
            _real(f"{role}_L_pp", "m", f"length between perpendiculars of {role}"),
            _real(f"{role}_B", "m", f"breadth of {role}"),
            _real(f"{role}_T", "m", f"draught of {role}"),
            _real(f"{role}_C_b", "", f"block coefficient of {role}"),
            _real(f"{role}_mass", "kg", f"displacement of {role}, without added mass"),
        )
    ]


_MOTIONS = (("surge", "m/s", "speed ahead"), ("sway", "m/s", "speed to starboard"), ("yaw_rate", "rad/s", "yaw rate"))


def _describe_motions(body: str, words: str, when: str, after: str) -> list[StudyColumn]:
    return [_real(f"{body}_{name}_{when}", unit, f"{what} of {words} {after}") for name, unit, what in _MOTIONS]


ENCOUNTERS = (
    StudyColumn("row", "int64", "", "number of the case in the study, from 0"),
    StudyColumn("status", "string", "", "done, or refused"),
    StudyColumn("reason", "string", "", "why the case is refused; null if it is not"),
    StudyColumn("level", "string", "", "level of detail: impact, encounter or sailed"),
    StudyColumn("engine", "string", "", "what computed the case: native or python"),
    StudyColumn("kind", "string", "", "kind of encounter"),
    StudyColumn("side", "string", "", "side of the target that is struck"),
    StudyColumn("situation", "string", "", "name of the file of traffic that is the case"),
    *_describe_ships(),
    *(_real(name, of.unit, of.meaning) for name, of in NUMBERS.items()),
    StudyColumn("collisions", "int32", "", "number of collisions"),
    StudyColumn("contacts", "int32", "", "contact points of all collisions"),
    _real("duration", "s", "time that was simulated"),
    StudyColumn(
        "contact_at_end",
        "bool",
        "",
        "whether hulls touched in the last second that was simulated: a longer time may give more energy and impulse",
    ),
    _real("clearance", "m", "least distance between hulls, at most 200; negative where they overlap"),
    _real("energy", "J", "kinetic energy lost to contact"),
    _real("energy_normal", "J", "share of it that was lost along the normals"),
    _real("energy_tangential", "J", "share of it that was lost to friction"),
    _real("closing_speed", "m/s", "speed at which the hulls closed along the normal, of the first collision"),
    _real("relative_speed", "m/s", "speed of own against the target at the point of contact, of the first collision"),
    _real("collision_angle_deg", "deg", "angle between the headings at the first impact, 0 to 180"),
    _real("impulse", "N s", "impulse on the target in plan, of the first collision"),
    _real("own_x", "m", "first point of contact forward of CO of own"),
    _real("own_y", "m", "the same to starboard"),
    _real("own_z", "m", "the same down"),
    _real("target_x", "m", "first point of contact forward of CO of the target"),
    _real("target_y", "m", "the same to starboard"),
    _real("target_z", "m", "the same down"),
    _real("normal_x", "", "normal from own to the target, forward in the target's axes; level impact"),
    _real("normal_y", "", "the same to starboard"),
    _real("normal_z", "", "the same down"),
    *_describe_motions("own", "own", "after", "after the first collision"),
    *_describe_motions("target", "the target", "after", "after the first collision"),
    _real("residual", "", "what the answer misses the law of contact by, as a share of the approach; level impact"),
    StudyColumn("unconverged", "int32", "", "answers of the contact solver that missed the law by more than 1e-9"),
)
"""Columns of the encounters: one line for each row of the study."""

COLLISIONS = (
    StudyColumn("row", "int64", "", "number of the case in the study, from 0"),
    StudyColumn("collision", "int32", "", "number of the collision in its case, from 1"),
    StudyColumn("ship_a", "string", "", "name of the first ship: own or target"),
    StudyColumn("ship_b", "string", "", "name of the second ship"),
    StudyColumn("contacts", "int32", "", "contact points of all steps"),
    _real("start", "s", "time of the impact from the start of the case"),
    _real("end", "s", "end of the last step with contact"),
    _real("energy", "J", "kinetic energy lost in the collision"),
    _real("closing_speed", "m/s", "speed at which the hulls closed along the normal"),
    _real("relative_speed", "m/s", "speed of ship_a against ship_b at the first point of contact"),
    _real("angle_deg", "deg", "angle between the headings at the impact, 0 to 180"),
    _real("impulse", "N s", "impulse on ship_b in plan, summed over the collision"),
    _real("a_x", "m", "first point of contact forward of CO of ship_a"),
    _real("a_y", "m", "the same to starboard"),
    _real("a_z", "m", "the same down"),
    _real("b_x", "m", "first point of contact forward of CO of ship_b"),
    _real("b_y", "m", "the same to starboard"),
    _real("b_z", "m", "the same down"),
    *_describe_motions("a", "ship_a", "before", "before the collision"),
    *_describe_motions("a", "ship_a", "after", "after it"),
    *_describe_motions("b", "ship_b", "before", "before the collision"),
    *_describe_motions("b", "ship_b", "after", "after it"),
)
"""Columns of the collisions: a line for each, none for a refused case."""


def make_schema(columns: tuple[StudyColumn, ...]) -> Any:
    """The pyarrow.Schema of a table; each field has `unit` and `meaning` in its metadata. Raises HostError."""
    pa = import_pyarrow()
    types = {
        "double": pa.float64(),
        "int64": pa.int64(),
        "int32": pa.int32(),
        "string": pa.string(),
        "bool": pa.bool_(),
    }
    return pa.schema(
        [
            pa.field(column.name, types[column.type], metadata={"unit": column.unit, "meaning": column.meaning})
            for column in columns
        ]
    )
