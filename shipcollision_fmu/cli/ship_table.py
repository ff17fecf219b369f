"""What `shipcollision ships NAME` prints: the figures of a ship as a table."""

from __future__ import annotations

from math import isnan

import numpy as np

from ..manoeuvring.trials.ship_summary import ShipSummary
from ..ship.inertia import H
from .table import WordTable, make_table

__all__ = ["make_ship_table"]

ADDED = (
    *((f"added mass, {motion}", "kg") for motion in ("surge", "sway", "heave")),
    *((f"added inertia about CO, {motion}", "kg m2") for motion in ("roll", "pitch", "yaw")),
)
"""The diagonal of M_A: names and units."""


def make_ship_table(summary: ShipSummary) -> WordTable:
    """Table of a ship's figures; a figure that the ship has not is '-'."""
    ship = summary.ship
    to_CG = H(-ship.r_bg)
    I_xx, I_yy, I_zz = np.diag(to_CG.T @ ship.M_RB @ to_CG)[3:].tolist()
    rows = make_table("figure", ">value", "unit", title=f"{ship.name}, {ship.kind}")
    figures = (
        ("length L_pp", ship.L_pp, "g", "m"),
        ("breadth B", ship.B, "g", "m"),
        ("draught T", ship.T, "g", "m"),
        ("mass", ship.mass / 1e3, ".0f", "t"),
        ("block coefficient C_b", ship.C_b, ".3f", "1"),
        ("inertia about CG, roll I_xx", I_xx, ".4g", "kg m2"),
        ("inertia about CG, pitch I_yy", I_yy, ".4g", "kg m2"),
        ("inertia about CG, yaw I_zz", I_zz, ".4g", "kg m2"),
        ("CG forward of midship", float(ship.r_bg[0]), ".4g", "m"),
        *((name, float(ship.M_A[i, i]), ".4g", unit) for i, (name, unit) in enumerate(ADDED)),
        ("KG above the keel", summary.KG, ".2f", "m"),
        ("GM_T", summary.GM_T, ".2f", "m"),
        ("roll period", summary.roll_period, ".1f", "s"),
        ("roll period, IS Code 2008", summary.code_period, ".1f", "s"),
        ("service speed", summary.service_speed, ".3g", "m/s"),
        ("service speed", summary.service_speed * 3600.0 / 1852.0, ".1f", "kn"),
        ("revolutions at service speed", summary.service_rev_per_s, ".4g", "rev/s"),
        ("rated power", summary.power / 1e3, ".4g", "kW"),
        ("bollard pull", summary.bollard_pull / 1e3, ".4g", "kN"),
        ("crash stop, track reach", summary.track_reach, ".0f", "m"),
        ("crash stop, track reach", summary.track_reach / ship.L_pp, ".1f", "L"),
        ("crash stop, time", summary.time_to_stop, ".0f", "s"),
    )
    for name, value, form, unit in figures:
        rows.add_row(name, "-" if isnan(value) else format(value, form), unit)
    return rows
