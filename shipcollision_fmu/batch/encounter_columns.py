"""Columns of the tables of encounters: one row for each encounter, each of its ships, and each collision."""

from __future__ import annotations

import numpy as np

from .impact_columns import LONGEST_REASON, Column, real

__all__ = [
    "COLLISION_COLUMNS", "COLLISION_ROW", "ENCOUNTER_COLUMNS", "ENCOUNTER_ROW", "ENCOUNTER_STATUS", "SHIP_COLUMNS",
    "SHIP_ROW", "make_type",
]  # fmt: skip

ENCOUNTER_STATUS = ("done", "refused")
"""What became of an encounter, by the number in the column `status`."""

_CASE = Column("case", "i8", 1, "", "number of the encounter in the call, from 0")

ENCOUNTER_COLUMNS = (
    Column("status", "i4", 1, "", ", ".join(f"{number}: {words}" for number, words in enumerate(ENCOUNTER_STATUS))),
    Column("steps", "i4", 1, "", "communication steps that were made"),
    Column("collisions", "i4", 1, "", "number of collisions"),
    Column("unconverged", "i4", 1, "", "answers of the contact solver that missed the law by more than 1e-9"),
    Column("scaled", "i4", 1, "", "answers that were scaled back so as not to add energy"),
    real("time", 1, "s", "time at the end"),
    real("clearance", 1, "m", "least distance between hulls, capped"),
    real("energy", 1, "J", "kinetic energy lost to contact"),
    real("energy_normal", 1, "J", "share of it that was lost along the normals"),
    real("energy_tangential", 1, "J", "share of it that was lost to friction"),
    real("fender_stored", 1, "J", "energy stored in fenders at the end"),
    real("fender_dissipated", 1, "J", "energy dissipated in fenders"),
    Column("nearest_a", "U", 1, "", "name of the first body of the least distance, empty beyond the cap"),
    Column("nearest_b", "U", 1, "", "name of the second one"),
    Column("reason", f"S{LONGEST_REASON}", 1, "", "why the encounter was refused, in UTF-8; empty if it was not"),
    Column("warning", f"S{LONGEST_REASON}", 1, "", "the first warning of a model, in UTF-8"),
)
"""Columns of the encounters, in the order of the call. Of a refused one the values are those before it."""

SHIP_COLUMNS = (
    _CASE,
    Column("ship", "U", 1, "", "name of the ship"),
    real("start", 12, "m, rad, m/s, rad/s", "state at the start, in the order of states.csv"),
    real("end", 12, "m, rad, m/s, rad/s", "state at the end"),
    real("issued", 6, "N s, N m s", "impulse that the collision model issued, in b about CO"),
    real("applied", 6, "N s, N m s", "impulse that the ship applied"),
)
"""Columns of the ships."""

COLLISION_COLUMNS = (
    _CASE,
    Column("number", "i4", 1, "", "number of the collision in the encounter, from 1"),
    Column("ship_a", "U", 1, "", "name of the first ship"),
    Column("ship_b", "U", 1, "", "name of the second ship or obstacle"),
    Column("contacts", "i4", 1, "", "contact points of all steps"),
    real("start", 1, "s", "time of the impact"),
    real("end", 1, "s", "end of the last step with contact"),
    real("point", 3, "m", "first point of contact in n"),
    real("a_point", 3, "m", "the same in b of ship_a"),
    real("b_point", 3, "m", "the same in b of ship_b"),
    real("relative_velocity", 3, "m/s", "velocity of ship_a against ship_b at the first point, in n"),
    real("closing_speed", 1, "m/s", "speed at which the hulls closed along the normal"),
    real("angle", 1, "rad", "angle between the headings at the impact, 0 to pi"),
    real("impulse", 3, "N s", "impulse on ship_b in n, summed over the collision"),
    real("energy", 1, "J", "kinetic energy lost in the collision"),
    real("a_before", 6, "m/s, rad/s", "velocity and angular velocity of ship_a before the collision, in b"),
    real("a_after", 6, "m/s, rad/s", "the same after its last contact"),
    real("b_before", 6, "m/s, rad/s", "velocity and angular velocity of ship_b before the collision, in b"),
    real("b_after", 6, "m/s, rad/s", "the same after its last contact"),
    real("a_gain", 3, "m/s", "velocity that ship_a gained by the impulses, in n"),
    real("b_gain", 3, "m/s", "velocity that ship_b gained by the impulses, in n"),
)
"""Columns of the collisions: the numbers of events.json. An obstacle has no motion."""

ENCOUNTER_ROW = np.dtype(
    [
        ("status", "i4"), ("steps", "i4"), ("collisions", "i4"), ("unconverged", "i4"), ("scaled", "i4"),
        ("nearest_a", "i4"), ("nearest_b", "i4"), ("unused", "i4"),
        *(
            (name, "f8")
            for name in (
                "time", "clearance", "energy", "energy_normal", "energy_tangential", "fender_stored",
                "fender_dissipated",
            )
        ),
        ("reason", f"S{LONGEST_REASON}"), ("warning", f"S{LONGEST_REASON}"),
    ]
)  # fmt: skip
"""What the native library writes of an encounter; bodies are numbered from 1."""

SHIP_ROW = np.dtype([("start", "f8", 12), ("end", "f8", 12), ("issued", "f8", 6), ("applied", "f8", 6)])
"""What it writes of a ship."""

COLLISION_ROW = np.dtype(
    [
        ("number", "i4"), ("ship_a", "i4"), ("ship_b", "i4"), ("contacts", "i4"), ("start", "f8"), ("end", "f8"),
        ("point", "f8", 3), ("a_point", "f8", 3), ("b_point", "f8", 3), ("relative_velocity", "f8", 3),
        ("closing_speed", "f8"), ("angle", "f8"), ("impulse", "f8", 3), ("energy", "f8"),
        ("a_before", "f8", 6), ("a_after", "f8", 6), ("b_before", "f8", 6), ("b_after", "f8", 6),
        ("a_gain", "f8", 3), ("b_gain", "f8", 3),
    ]
)  # fmt: skip
"""What it writes of a collision."""


def make_type(columns: tuple[Column, ...], longest_name: int) -> np.dtype[np.void]:
    """The type of a row; names have at most so many characters."""
    return np.dtype(
        [
            (column.name, f"U{max(1, longest_name)}" if column.type == "U" else column.type,
             (column.size,) if column.size > 1 else ())
            for column in columns
        ]
    )  # fmt: skip
