"""The columns of a run's tables, from the tuples that the recorder writes them by."""

from __future__ import annotations

from typing import Any

import numpy.typing as npt

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.fmi.interface import SHIPS
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING

from .markdown import cell, table

__all__ = ["columns"]

_IN_CONTACTS = {
    "ship_a": ("", "name of the first ship"),
    "ship_b": ("", "name of the second ship or obstacle"),
    "impact": ("", "number of the collision, from 1; 0: a fender acts, the hulls do not touch"),
    "scratch": ("", "number of the scratch, from 1; 0: a fender acts"),
}
"""Columns of contacts.csv that differ from the variables of the same name: there bodies are numbers, here names."""


def columns() -> str:
    """The columns of the tables: of runs of the published collision, and of a ship that sails."""
    run = simulate(load_scenario("guan2014"), in_process=True)
    sailed = simulate(load_scenario("kvlcc2_crossing"), step=1.0, in_process=True)
    ship = {variable.name: variable for variable in MANOEUVRING.table(())}
    collision = {variable.name: variable for variable in COLLISION.table(SHIPS)}
    time = ("`time`", "s", "communication point; in contacts.csv the end of the step")
    states = [time]
    for column in _names(run.states):
        name = column.partition(".")[2]
        if column.startswith(f"{SHIPS[0]}."):
            states.append((f"`{column}`", ship[name].unit or "", cell(ship[name].description)))
    contacts = [time]
    for column in _names(run.contacts):
        line = collision[f"contact[1].{column}"]
        unit, said = _IN_CONTACTS.get(column, (line.unit or "", line.description))
        contacts.append((f"`{column}`", unit, cell(said)))
    signals = [time]
    for column in _names(run.signals):
        signals.append((f"`{column}`", collision[column].unit or "", cell(collision[column].description)))
    machinery, surroundings = [time], [("`time`", "s", "communication point from which the row counts")]
    for column in _names(sailed.machinery):
        name = column.partition(".")[2]
        if column.startswith(f"{SHIPS[0]}."):
            machinery.append((f"`{column}`", ship[name].unit or "", cell(ship[name].description)))
    for column in _names(sailed.surroundings):
        surroundings.append((f"`{column}`", ship[column].unit or "", cell(ship[column].description)))
    header = ("column", "unit", "meaning")
    return (
        f"### states.csv\n\nA row per communication point. Every ship has the columns of `{SHIPS[0]}`.\n\n"
        f"{table(header, states)}\n### contacts.csv\n\nA row per contact point and step.\n\n{table(header, contacts)}\n"
        f"### signals.csv\n\nA row per communication point.\n\n{table(header, signals)}\n"
        f"### machinery.csv\n\nA row per communication point. Every ship that sails has the columns of `{SHIPS[0]}`; "
        f"without such a ship there are no rows.\n\n{table(header, machinery)}\n"
        f"### surroundings.csv\n\nA row for the start, and one for each change.\n\n{table(header, surroundings)}"
    )


def _names(rows: npt.NDArray[Any]) -> tuple[str, ...]:
    """The columns after the time."""
    assert rows.dtype.names is not None
    return rows.dtype.names[1:]
