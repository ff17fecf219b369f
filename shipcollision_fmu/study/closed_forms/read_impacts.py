"""read_impacts(): the rows of a study as the closed forms take them, with the contact as far as it is known.

    nominal   what is known beforehand: the place `at` on the parallel side of the target, x = at L_pp, y = B/2; the
              stem of own, x = L_pp/2, y = 0; the normal across the target
    place     the point of contact that the simulation has found, and still the normal across the target
    found     that point, and the direction in plan of the normal that the simulation has found

Before the impact the ships have the motions of the row. A refused row has the nominal contact alone.
"""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from ...errors import StudyError
from ...ship.frames import Array
from ..extra import import_pyarrow
from .planar_impact import PlanarImpacts, PlanarShips

__all__ = ["Contact", "read_column", "read_impacts", "read_table"]

Contact = Literal["nominal", "place", "found"]

NEEDED = {
    "level", "side", "angle_deg", "at", "friction", "restitution",
    *(f"{role}_{name}" for role in ("own", "target") for name in (
        "L_pp", "B", "T", "mass", "speed", "sway", "yaw_rate", "x", "y",
    )),
}  # fmt: skip
"""Columns that are read."""


def read_impacts(encounters: Any, own: PlanarShips, target: PlanarShips, *, contact: Contact) -> PlanarImpacts:
    """The impacts in a table of encounters of level `impact` (pyarrow.Table of n lines); NaN for what a row has not.

    own, target: the ships of the rows. Raises StudyError for rows of another level, or that are not plastic.
    """
    _check(encounters)
    side = np.where(np.array(encounters.column("side").to_pylist()) == "starboard", 1.0, -1.0)
    zero = np.zeros(len(side))
    own_point, target_point = _columns(encounters, "own_x", "own_y"), _columns(encounters, "target_x", "target_y")
    if contact == "nominal":
        own_point = np.stack([0.5 * read_column(encounters, "own_L_pp"), zero], axis=1)
        along = read_column(encounters, "at") * read_column(encounters, "target_L_pp")
        target_point = np.stack([along, 0.5 * side * read_column(encounters, "target_B")], axis=1)
    normal = np.stack([zero, -side], axis=1)
    if contact == "found":
        normal = _columns(encounters, "normal_x", "normal_y")
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return PlanarImpacts(
        own, target, -side * np.radians(read_column(encounters, "angle_deg")), own_point, target_point,
        _columns(encounters, "own_speed", "own_sway", "own_yaw_rate"),
        _columns(encounters, "target_speed", "target_sway", "target_yaw_rate"),
        normal, read_column(encounters, "friction"),
    )  # fmt: skip


def read_table(encounters: Any) -> Any:
    """The pyarrow.Table of a table of encounters, as pyarrow, pandas and polars have it. Raises StudyError."""
    pa = import_pyarrow()
    try:
        table = encounters if isinstance(encounters, pa.Table) else pa.table(encounters)
    except (TypeError, ValueError):
        table = pa.table({})
    missing = sorted(NEEDED.difference(table.column_names))
    if missing:
        raise StudyError(
            f"closed forms: a {type(encounters).__name__} without the column {missing[0]!r} is no table of encounters: "
            "give compute_rows(...).encounters, or that of a study's folder, with all columns"
        )
    return table


def read_column(encounters: Any, name: str) -> Array:
    """A column of numbers (n,), NaN where it is null."""
    values: Array = encounters.column(name).to_numpy().astype(float)
    return values


def _columns(encounters: Any, *names: str) -> Array:
    return np.stack([read_column(encounters, name) for name in names], axis=1)


def _check(encounters: Any) -> None:
    for name, needed, remedy in (
        ("level", "impact", "give a study of level impact"),
        ("restitution", 0.0, "give a study with restitution = 0.0, for plastic impacts alone have a closed form here"),
    ):
        others = sorted(set(encounters.column(name).to_pylist()) - {needed})
        if others:
            raise StudyError(f"closed forms: rows have {name} = {others[0]!r}, must be {needed!r}: {remedy}")
