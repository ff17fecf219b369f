"""Records a run at its communication points.

The ships' states are in the wires' buffers already. From the collision FMU the recorder reads a few counters per step,
and contact points only while there are any: reading all of them at every step would cost more than the step.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from ..collision.interface import contact_point_count
from ..fmi.names import CONTACT_INTEGERS, CONTACT_START, IMPULSE, STATE, contact_point, named
from ..results.record import CONTACT_COLUMNS, SIGNALS, CollisionStart, Record
from ..ship.frames import Array
from .component import Group
from .master import System

__all__ = ["Recorder"]


@dataclass
class _ContactLog:
    rows: list[tuple[Any, ...]] = field(default_factory=list)
    issued: dict[int, Array] = field(default_factory=dict)
    starts: dict[int, CollisionStart] = field(default_factory=dict)


class Recorder:
    """Records `steps` steps of `step` [s] of a system: its ships by name, and the obstacles that they meet."""

    def __init__(
        self, system: System, names: list[str], step: float, steps: int, obstacles: Sequence[str] = ()
    ) -> None:
        self._names, self._step = names, step
        self._bodies = [*names, *obstacles]  # as the collision FMU counts them
        self._state_rows = np.zeros((steps + 1, 1 + len(names) * len(STATE)))
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
        self._signal_rows = np.zeros((steps + 1, 1 + len(SIGNALS)))
        self._log = _ContactLog()
        self._least, self._nearest = float("inf"), list[int]()

    def record(self, k: int) -> None:
        """Record communication point k, whose values are in the wires."""
        row = self._state_rows[k]
        row[0] = round(k * self._step, 9)  # 27.15, not 27.150000000000002
        width = len(STATE)
        for i, buffer in enumerate(self._buffers):
            row[1 + i * width : 1 + (i + 1) * width] = buffer[:width]
        self._signal_group.read()
        self._signal_rows[k] = (row[0], *self._signal_group.values)
        self._counts.read()
        count, *nearest = self._counts.values
        if (clearance := self._signal_group.values[0]) < self._least:
            self._least, self._nearest = clearance, nearest
        if count > 0:
            self._record_contacts(k, count)

    def build_record(self) -> Record:
        """The record of the whole run, at its end."""
        states = _table(self._state_rows, [f"{name}.{variable}" for name in self._names for variable in STATE])
        signals = _table(self._signal_rows, SIGNALS)
        text = f"U{max(map(len, self._bodies))}"
        contact_type = [
            ("time", np.float64), ("ship_a", text), ("ship_b", text), ("impact", np.int64), ("scratch", np.int64),
            *((column, np.float64) for column in CONTACT_COLUMNS),
        ]  # fmt: skip
        dissipated, normal, tangential = (float(signals[column][-1]) for column in SIGNALS[1:])
        stored, lost = _read(self._fender)
        unconverged, scaled = _read(self._solver)
        return Record(
            states=states,
            signals=signals,
            contacts=np.array(self._log.rows, dtype=contact_type),
            issued=self._log.issued,
            starts=self._log.starts,
            energy=(dissipated, normal, tangential),
            fender=(stored, lost),
            solver=(unconverged, scaled),
            issued_at_end=np.array(_read(self._issued)).reshape(-1, 6),
            applied=np.array([buffer[len(STATE) :] for buffer in self._buffers]),
            clearance=self._least,
            nearest=tuple(self._bodies[ship - 1] for ship in self._nearest if ship > 0),
        )

    def _record_contacts(self, k: int, count: int) -> None:
        time, width, ids = round(k * self._step, 9), len(CONTACT_COLUMNS), len(CONTACT_INTEGERS)
        self._reals.read(count * width)
        self._numbers.read(count * ids)
        for i in range(count):
            a, b, impact, scratch = self._numbers.values[i * ids : (i + 1) * ids]
            values = self._reals.values[i * width : (i + 1) * width]
            if impact > 0 and impact not in self._log.starts:
                self._log.starts[impact] = self._read_start(i)
            self._log.rows.append((time, self._bodies[a - 1], self._bodies[b - 1], impact, scratch, *values))
        self._log.issued[k] = np.array(_read(self._issued)).reshape(-1, 6)

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
