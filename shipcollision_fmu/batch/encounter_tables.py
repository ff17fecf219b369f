"""The tables of encounters that were run: the rows of the library with names of ships and numbers of encounters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from ..ship.frames import Array
from .encounter_columns import COLLISION_COLUMNS, ENCOUNTER_COLUMNS, ENCOUNTER_STATUS, SHIP_COLUMNS, make_type
from .impact_columns import LONGEST_REASON, Column
from .native_encounters import EncounterRows

__all__ = ["EncounterBook", "Encounters"]

Rows = npt.NDArray[Any]


@dataclass(frozen=True, repr=False)
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

    def __repr__(self) -> str:
        """What there is, in two lines: the arrays of a thousand encounters would fill the screen."""
        count, refused = len(self.encounters), np.count_nonzero(self.encounters["status"])
        tables = [name for name in ("encounters", "ships", "collisions", "tracks") if len(getattr(self, name))]
        return (
            f"{count} encounter{'s' * (count != 1)}, {refused} with a status other than 0, "
            f"{len(self.collisions)} collision{'s' * (len(self.collisions) != 1)}\n"
            f"next: {', '.join(f'.{name}' for name in tables) or 'give a scenario'}"
        )


@dataclass
class EncounterBook:
    """Rows by encounter, with the names of its bodies. has_tracks: whether tracks are kept."""

    has_tracks: bool
    _rows: list[EncounterRows | str] = field(default_factory=list)  # a text: why it was refused
    _bodies: list[list[str]] = field(default_factory=list)

    def add(self, rows: EncounterRows, bodies: list[str]) -> None:
        """Add an encounter of these bodies, ships first."""
        self._rows.append(rows)
        self._bodies.append(bodies)

    def refuse(self, reason: str) -> None:
        """Add an encounter that was not run."""
        self._rows.append(reason)
        self._bodies.append([])

    def build_tables(self) -> Encounters:
        """The tables of all encounters."""
        longest = max((len(name) for bodies in self._bodies for name in bodies), default=1)
        encounters = np.zeros(len(self._rows), make_type(ENCOUNTER_COLUMNS, longest))
        ships: list[Rows] = []
        collisions: list[Rows] = []
        tracks: list[Array] = []
        for i, (rows, bodies) in enumerate(zip(self._rows, self._bodies, strict=True)):
            if isinstance(rows, str):
                encounters[i]["status"], encounters[i]["reason"] = ENCOUNTER_STATUS.index("refused"), _cut(rows)
                tracks += [np.zeros((0, 0, 12))] * self.has_tracks
                continue
            encounters[i : i + 1] = _name(ENCOUNTER_COLUMNS, rows.encounter[None], bodies, longest)
            ships.append(_name(SHIP_COLUMNS, rows.ships, bodies, longest, i))
            collisions.append(_name(COLLISION_COLUMNS, rows.collisions, bodies, longest, i))
            tracks += [rows.track] * self.has_tracks
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
