"""Columns of the tables of impacts: of the cases, as native/batch reads them, and of the rows that it writes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

__all__ = ["CASES", "COLUMNS", "IMPACTS", "LONGEST_REASON", "STATUS", "Column", "real"]

STATUS = ("done", "out of range", "not closing", "no contact", "refused")
"""What became of a case, by the number in the column `status`."""

LONGEST_REASON = 240
"""Bytes of a reason; a longer one is cut."""


class Column(NamedTuple):
    """A column: its name, its type, how many numbers it has, their unit and meaning."""

    name: str
    type: str
    size: int
    unit: str
    meaning: str


def real(name: str, size: int, unit: str, meaning: str) -> Column:
    """A column of so many real numbers."""
    return Column(name, "f8", size, unit, meaning)


COLUMNS = (
    Column("status", "i4", 1, "", ", ".join(f"{number}: {words}" for number, words in enumerate(STATUS))),
    Column("contacts", "i4", 1, "", "number of contact points"),
    real("own_position", 3, "m", "CO of own in n; the struck place of the target is n's origin"),
    real("target_position", 3, "m", "CO of the target in n"),
    real("own_heading", 1, "rad", "heading of own"),
    real("target_heading", 1, "rad", "heading of the target"),
    real("point", 3, "m", "point of contact in n, the middle of several"),
    real("own_point", 3, "m", "the same in own's b"),
    real("target_point", 3, "m", "the same in the target's b"),
    real("normal", 3, "", "normal from own to the target in n, of the strongest contact point"),
    real("own_before", 6, "m/s, rad/s", "velocity and angular velocity of own before the impact, in b"),
    real("own_after", 6, "m/s, rad/s", "the same after it"),
    real("target_before", 6, "m/s, rad/s", "velocity and angular velocity of the target before the impact, in b"),
    real("target_after", 6, "m/s, rad/s", "the same after it"),
    real("own_impulse", 6, "N s, N m s", "impulse on own in b about CO"),
    real("target_impulse", 6, "N s, N m s", "impulse on the target in b about CO"),
    real("impulse", 3, "N s", "impulse on the target in n"),
    real("impulse_normal", 1, "N s", "impulse along the normals, summed over the contact points"),
    real("impulse_tangential", 1, "N s", "impulse across the normals, summed over the contact points"),
    real("relative_velocity", 3, "m/s", "velocity of own against the target at the point before the impact, in n"),
    real("closing_speed", 1, "m/s", "speed at which the hulls close along the normal"),
    real("angle", 1, "rad", "angle between the headings, 0 to pi"),
    real("energy", 1, "J", "kinetic energy lost to the contact"),
    real("energy_normal", 1, "J", "share of it that was lost along the normals"),
    real("energy_tangential", 1, "J", "share of it that was lost to friction"),
    real("offset", 1, "m", "distance in plan of the point from the place; large where sides meet along a line"),
    real("residual", 1, "", "what the answer misses the law of contact by, as a share of the approach"),
    Column("reason", f"S{LONGEST_REASON}", 1, "", "why there is no impact, in UTF-8; empty if there is one"),
)
"""Columns of the table of impacts, in its order."""

IMPACTS = np.dtype(
    [(column.name, column.type, (column.size,) if column.size > 1 else ()) for column in COLUMNS], align=True
)
"""Type of a row. Of a case without impact all numbers but the status are zero."""

CASES = np.dtype(
    [
        *(
            (name, "f8")
            for name in (
                "angle_deg", "at", "own_speed", "own_sway", "own_yaw_rate", "target_speed", "target_sway",
                "target_yaw_rate", "heading_deg", "friction", "restitution",
            )
        ),
        ("is_starboard", "i4"), ("unused", "i4"),
    ]
)  # fmt: skip
"""Type of a case."""
