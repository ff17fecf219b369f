"""run_encounters(): scenarios by the thousand, each a whole run in one call of the native library.

The native library holds the master's loop, the ship models, the collision model and the helms. Its numbers are those of
simulate(): the same models in the same order. It keeps no tables over time unless tracks are asked for.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import InputError, ScenarioError
from ..scenario.scenario import Scenario, load_scenario
from ..ship.frames import Array
from .encounter_case import make_case
from .encounter_table import COLLISION_COLUMNS, ENCOUNTER_COLUMNS, ENCOUNTER_STATUS, SHIP_COLUMNS, make_type
from .impact_table import LONGEST_REASON, Column
from .native_encounters import EncounterRows, NativeEncounters
from .prepared_ships import PreparedShips

__all__ = ["Encounters", "run_encounters"]

Rows = npt.NDArray[Any]


@dataclass(frozen=True)
class Encounters:
    """Encounters that were run, as structured arrays.

    encounters   a row for each, in the order of the call
    ships        a row for each ship of each encounter
    collisions   a row for each collision of each encounter: the numbers of events.json
    tracks       of each encounter the states (steps + 1, ships, 12) at its communication points; empty unless asked for
    """

    encounters: Rows
    ships: Rows
    collisions: Rows
    tracks: list[Array]


@dataclass
class _Book:
    """Rows by encounter, and the names of its bodies."""

    rows: list[EncounterRows | str] = field(default_factory=list)  # a text: why it was refused
    bodies: list[list[str]] = field(default_factory=list)


def run_encounters(
    scenarios: Iterable[Scenario | str | Path],
    *,
    algorithm: str | None = None,
    step: float | None = None,
    separation: float | None = None,
    tracks: bool = False,
) -> Encounters:
    """The encounters of scenarios, of their names or of their paths.

    algorithm, step   replace those of the scenarios, as in simulate()
    separation        time [s] without contact after a collision, after which an encounter ends; None: at its duration
    tracks            whether the states at all communication points are kept

    A scenario that is refused, or whose models refuse a step, is a row with a status other than zero and the reason.
    Raises ScenarioError for a separation that is no time, HostError when there is no native library and no compiler.
    """
    if separation is not None and not (isfinite(separation) and separation >= 0.0):
        raise ScenarioError(f"run_encounters: separation = {separation!r} must be seconds, at least 0, e.g. 10.0")
    book = _Book()
    with PreparedShips() as files, closing(NativeEncounters()) as native:
        for given in scenarios:
            try:
                scenario = given if isinstance(given, Scenario) else load_scenario(given)
                scenario = scenario.changed(algorithm=algorithm, step=step)
                case = make_case(scenario, files, separation)
            except InputError as error:
                book.rows.append(str(error))
                book.bodies.append([])
                continue
            book.rows.append(native.run(case, has_track=tracks))
            book.bodies.append([*scenario.ships, *scenario.obstacles])
    return _as_tables(book, tracks)


def _as_tables(book: _Book, has_tracks: bool) -> Encounters:
    longest = max((len(name) for bodies in book.bodies for name in bodies), default=1)
    encounters = np.zeros(len(book.rows), make_type(ENCOUNTER_COLUMNS, longest))
    ships: list[Rows] = []
    collisions: list[Rows] = []
    tracks: list[Array] = []
    for i, (rows, bodies) in enumerate(zip(book.rows, book.bodies, strict=True)):
        if isinstance(rows, str):
            encounters[i]["status"], encounters[i]["reason"] = ENCOUNTER_STATUS.index("refused"), _cut(rows)
            tracks += [np.zeros((0, 0, 12))] * has_tracks
            continue
        encounters[i : i + 1] = _name(ENCOUNTER_COLUMNS, rows.encounter[None], bodies, longest)
        ships.append(_name(SHIP_COLUMNS, rows.ships, bodies, longest, i))
        collisions.append(_name(COLLISION_COLUMNS, rows.collisions, bodies, longest, i))
        tracks += [rows.track] * has_tracks
    return Encounters(
        encounters, _join(ships, SHIP_COLUMNS, longest), _join(collisions, COLLISION_COLUMNS, longest), tracks
    )


def _name(columns: tuple[Column, ...], rows: Rows, bodies: Sequence[str], longest: int, case: int = 0) -> Rows:
    """The rows with names in place of numbers of bodies, from 1, and with the number of the encounter."""
    table = np.zeros(len(rows), make_type(columns, longest))
    names = np.array(["", *bodies])
    for column in columns:
        if column.name == "case":
            table["case"] = case
        elif column.name == "ship":
            table["ship"] = bodies[: len(rows)]
        elif column.type == "U":
            table[column.name] = names[rows[column.name]]
        else:
            table[column.name] = rows[column.name]
    return table


def _join(tables: list[Rows], columns: tuple[Column, ...], longest: int) -> Rows:
    return np.concatenate(tables) if tables else np.zeros(0, make_type(columns, longest))


def _cut(reason: str) -> bytes:
    """The bytes of a reason that fit into its column, whole characters."""
    return reason.encode()[:LONGEST_REASON].decode(errors="ignore").encode()
