"""Records a run at its communication points.

The ships' states are in the wires' buffers already. From the collision FMU the recorder reads a few counters per step,
and contact points only while there are any: reading all of them at every step would cost more than the step.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ..collision.interface import contact_point_count
from ..fmi.names import AXES, CONTACT_INTEGERS, CONTACT_START, IMPULSE, STATE, STEERING, contact_point, named
from ..results.record import CONTACT_COLUMNS, SIGNALS, CollisionStart, Record
from ..ship.frames import Array
from .component import Component, Group
from .master import System
from .row_log import RowLog

__all__ = ["CollisionSoFar", "ContactPoint", "EndValues", "Recorder", "RecorderMark"]

ENERGY = CONTACT_COLUMNS.index("energy")
PLACES = [[CONTACT_COLUMNS.index(column) for column in named(body, AXES)] for body in "ab"]
CONTACT_ROOM = 64
"""Rows for contact points at first; they double when they are full."""


class EndValues(NamedTuple):
    """What a record has of its last communication point alone."""

    issued: Array
    applied: Array
    fender: tuple[float, float]
    solver: tuple[int, int]


class CollisionSoFar(NamedTuple):
    """A collision while a run goes on: its ships, the energy dissipated so far [J], and when they last touched [s].

    a, b: where they touched first, in the b of each [m].
    """

    ship_a: str
    ship_b: str
    energy: float
    last: float
    a: tuple[float, float, float]
    b: tuple[float, float, float]


class ContactPoint(NamedTuple):
    """A contact point of the present: its bodies, and its values by the columns of contacts.csv."""

    ship_a: str
    ship_b: str
    values: Mapping[str, float]


class RecorderMark(NamedTuple):
    """What a recorder had recorded at a communication point: lengths of its tables, starts, and least clearance."""

    rows: int
    contacts: int
    issued: int
    starts: dict[int, CollisionStart]
    collisions: dict[int, CollisionSoFar]
    least: float
    nearest: list[int]


class Recorder:
    """Records a system at steps of `step` [s]: its ships by name, and the obstacles that they meet.

    Of the ships that sail, `sailing` by name, rudder and revolutions are recorded as well.

    There is room for `steps` steps at first; more may come. With `spool`, a folder, tables are in temporary files.
    `starts` and `collisions` have the collisions so far by their number.
    """

    def __init__(
        self, system: System, names: list[str], step: float, steps: int, obstacles: Sequence[str] = (),
        sailing: Mapping[str, Component] | None = None, spool: Path | None = None,
    ) -> None:  # fmt: skip
        self._names, self._step = names, step
        self._bodies = [*names, *obstacles]  # as the collision FMU counts them
        self._state_rows = RowLog(np.float64, 1 + len(names) * len(STATE), steps + 1, spool)
        self._buffers = [np.ctypeslib.as_array(wire.outputs.values) for wire in system.states]
        collision = system.collision
        slots = [contact_point(i) for i in range(1, contact_point_count(len(names)) + 1)]
        self._counts = collision.integers(["contact.count", "nearest.ship_a", "nearest.ship_b"])
        self._reals = collision.reals([variable for slot in slots for variable in named(slot, CONTACT_COLUMNS)])
        self._numbers = collision.integers([variable for slot in slots for variable in named(slot, CONTACT_INTEGERS)])
        self._starts = collision.reals([variable for slot in slots for variable in named(slot, CONTACT_START)])
        self._issued = collision.reals([variable for name in names for variable in named(name, IMPULSE)])
        self._signal_group = collision.reals(SIGNALS)
        self._fender = collision.reals(named("fender", ("stored", "dissipated")))
        self._solver = collision.integers(["solver.unconverged", "solver.scaled"])
        self._signal_rows = RowLog(np.float64, 1 + len(SIGNALS), steps + 1, spool)
        text = f"U{max(map(len, self._bodies))}"
        contact_type = [
            ("time", np.float64), ("ship_a", text), ("ship_b", text), ("impact", np.int64), ("scratch", np.int64),
            *((column, np.float64) for column in CONTACT_COLUMNS),
        ]  # fmt: skip
        self._contact_rows = RowLog(contact_type, room=CONTACT_ROOM, spool=spool)
        self._issued_rows = RowLog(np.float64, 1 + 6 * len(names), CONTACT_ROOM, spool)
        self._machines = {name: ship.reals(STEERING) for name, ship in (sailing or {}).items()}
        self._machinery_rows = RowLog(np.float64, 1 + len(self._machines) * len(STEERING), steps + 1, spool)
        self._row = np.zeros(1 + len(names) * len(STATE))
        self.starts: dict[int, CollisionStart] = {}
        self.collisions: dict[int, CollisionSoFar] = {}
        self._least, self._nearest = float("inf"), list[int]()

    def look(self) -> None:
        """Read clearance, energy and contacts of this point, which is not recorded: the record has its full length."""
        self._signal_group.read()
        self._counts.read()

    def record(self, k: int) -> None:
        """Record communication point k, the next one, whose values are in the wires."""
        row = self._row
        row[0] = round(k * self._step, 9)  # 27.15, not 27.150000000000002
        width = len(STATE)
        for i, buffer in enumerate(self._buffers):
            row[1 + i * width : 1 + (i + 1) * width] = buffer[:width]
        self._state_rows.append(row)
        self._signal_group.read()
        self._signal_rows.append((row[0], *self._signal_group.values))
        if self._machines:
            self._machinery_rows.append(
                (row[0], *(value for group in self._machines.values() for value in _read(group)))
            )
        self._counts.read()
        count, *nearest = self._counts.values
        if (clearance := self._signal_group.values[0]) < self._least:
            self._least, self._nearest = clearance, nearest
        if count > 0:
            self._record_contacts(k, count)

    @property
    def clearance(self) -> float:
        """The clearance at the last point that was recorded [m], capped."""
        return float(self._signal_group.values[0])

    @property
    def dissipated(self) -> float:
        """The energy dissipated in contact up to that point [J]."""
        return float(self._signal_group.values[1])

    @property
    def contact_count(self) -> int:
        """The number of contact points at that point."""
        return int(self._counts.values[0])

    def read_contact_points(self) -> list[ContactPoint]:
        """The contact points at that point."""
        count, width, ids = self.contact_count, len(CONTACT_COLUMNS), len(CONTACT_INTEGERS)
        if count == 0:
            return []
        self._reals.read(count * width)
        self._numbers.read(count * ids)
        found = []
        for i in range(count):
            a, b = self._numbers.values[i * ids : i * ids + 2]
            values = dict(zip(CONTACT_COLUMNS, self._reals.values[i * width : (i + 1) * width], strict=True))
            found.append(ContactPoint(self._bodies[a - 1], self._bodies[b - 1], values))
        return found

    @property
    def nearest(self) -> tuple[str, ...]:
        """The names of the pair with that clearance; empty beyond the cap."""
        return tuple(self._bodies[ship - 1] for ship in self._counts.values[1:] if ship > 0)

    def mark(self) -> RecorderMark:
        """What is recorded so far, for go_back()."""
        return RecorderMark(
            len(self._state_rows), len(self._contact_rows), len(self._issued_rows), dict(self.starts),
            dict(self.collisions), self._least, list(self._nearest),
        )  # fmt: skip

    def go_back(self, mark: RecorderMark) -> None:
        """Forget what was recorded after a mark. The components are to be at the mark already."""
        self._state_rows.truncate(mark.rows)
        self._signal_rows.truncate(mark.rows)
        self._machinery_rows.truncate(mark.rows if self._machines else 0)
        self._contact_rows.truncate(mark.contacts)
        self._issued_rows.truncate(mark.issued)
        self.starts, self.collisions = dict(mark.starts), dict(mark.collisions)
        self._least, self._nearest = mark.least, list(mark.nearest)
        self._signal_group.read()
        self._counts.read()

    def read_end(self) -> EndValues:
        """What a record that ended at the last point would have of this point."""
        stored, lost = _read(self._fender)
        unconverged, scaled = _read(self._solver)
        return EndValues(
            np.array(_read(self._issued)).reshape(-1, 6), np.array([buffer[len(STATE) :] for buffer in self._buffers]),
            (stored, lost), (unconverged, scaled),
        )  # fmt: skip

    def build_record(self, end: EndValues | None = None) -> Record:
        """The record of the whole run, at its end; `end` where components have gone beyond the last point recorded."""
        end = end or self.read_end()
        state_columns = [f"{name}.{variable}" for name in self._names for variable in STATE]
        signals = _table(self._signal_rows.build_array(), SIGNALS)
        dissipated, normal, tangential = (float(signals[column][-1]) for column in SIGNALS[1:])
        return Record(
            states=_table(self._state_rows.build_array(), state_columns),
            signals=signals,
            machinery=_table(
                self._machinery_rows.build_array(),
                [column for name in self._machines for column in named(name, STEERING)],
            ),
            contacts=self._contact_rows.build_array(),
            issued={int(row[0]): row[1:].reshape(-1, 6) for row in self._issued_rows.build_array()},
            starts=self.starts,
            energy=(dissipated, normal, tangential),
            fender=end.fender,
            solver=end.solver,
            issued_at_end=end.issued,
            applied=end.applied,
            clearance=self._least,
            nearest=tuple(self._bodies[ship - 1] for ship in self._nearest if ship > 0),
        )

    def close(self) -> None:
        """Remove the temporary files. The record stays valid."""
        for log in (self._state_rows, self._signal_rows, self._machinery_rows, self._contact_rows, self._issued_rows):
            log.close()

    def _record_contacts(self, k: int, count: int) -> None:
        time, width, ids = round(k * self._step, 9), len(CONTACT_COLUMNS), len(CONTACT_INTEGERS)
        self._reals.read(count * width)
        self._numbers.read(count * ids)
        for i in range(count):
            a, b, impact, scratch = self._numbers.values[i * ids : (i + 1) * ids]
            values = self._reals.values[i * width : (i + 1) * width]
            if impact > 0:
                if impact not in self.starts:
                    self.starts[impact] = self._read_start(i)
                before = self.collisions.get(impact)
                energy = values[ENERGY] + (before.energy if before else 0.0)
                places = (before.a, before.b) if before else [tuple(values[j] for j in place) for place in PLACES]
                self.collisions[impact] = CollisionSoFar(
                    self._bodies[a - 1], self._bodies[b - 1], energy, time, *places
                )
            self._contact_rows.append((time, self._bodies[a - 1], self._bodies[b - 1], impact, scratch, *values))
        self._issued_rows.append((k, *_read(self._issued)))

    def _read_start(self, i: int) -> CollisionStart:
        """How the collision of contact point i, from 0, began."""
        width = len(CONTACT_START)
        self._starts.read((i + 1) * width)
        time, north, east, down, closing_speed, angle = self._starts.values[i * width : (i + 1) * width]
        return CollisionStart(time, closing_speed, angle, (north, east, down))


def _table(rows: Array, columns: Sequence[str]) -> npt.NDArray[Any]:
    return rows.view([(column, np.float64) for column in ("time", *columns)])[:, 0]


def _read(group: Group) -> list[Any]:
    group.read()
    return list(group.values)
