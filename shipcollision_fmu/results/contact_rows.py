"""Rows of contacts.csv beside the states of their bodies: vectors of a row, and poses at the start of its step."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from ..fmi.names import STATE, named
from ..ship.frames import Array
from ..ship.ship_state import ShipState
from .record import Record

__all__ = ["Rows", "pick_strongest", "row_state", "row_vector", "state_row_before", "states_before"]

Rows = npt.NDArray[Any]
"""Rows of Record.contacts."""


def row_vector(row: Any, group: str | None, components: tuple[str, ...]) -> Array:
    """The vector (3,) of a row's columns `group`.north ... or, without a group, north ..."""
    return np.array([float(row[column]) for column in (components if group is None else named(group, components))])


def pick_strongest(rows: Rows) -> Any:
    """The row of the largest impulse, the first of equals."""
    return rows[int(np.hypot(rows["impulse_normal"], rows["impulse_tangential"]).argmax())]


def state_row_before(row: Any, record: Record) -> Any:
    """The row of Record.states at the start of the step of a contact row."""
    return record.states[max(0, int(np.searchsorted(record.states["time"], row["time"])) - 1)]


def states_before(row: Any, record: Record, obstacles: Mapping[str, float]) -> list[ShipState]:
    """The states of ship_a and ship_b at the start of a row's step.

    An obstacle is at rest at the origin, with its heading [rad] from `obstacles`.
    """
    before = state_row_before(row, record)
    return [
        row_state(before, body) if body not in obstacles else ShipState.upright(0.0, 0.0, obstacles[body])
        for body in (str(row["ship_a"]), str(row["ship_b"]))
    ]  # fmt: skip


def row_state(states: Any, ship: str) -> ShipState:
    """The state of a ship in a row of Record.states."""
    return ShipState(*(float(states[f"{ship}.{variable}"]) for variable in STATE))
