"""The state of a ship in both languages, and by what a difference is judged."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np

from shipcollision_fmu.ship.frames import Array
from tests.native.native_ship import NativeShip

__all__ = ["RUN", "STEP", "compare", "flatten", "give_state", "take_state"]

STEP, RUN = 1e-11, 1e-9
"""Largest difference over the scale of the state: of a step, and of a run of a thousand steps."""


def flatten(state: dict[str, Any]) -> list[float]:
    """The state in the order of the native one."""
    return [x for value in state.values() for x in (value if isinstance(value, list | tuple) else [value])]


def give_state(native: NativeShip, state: dict[str, Any]) -> None:
    native.set_state({"bytes": struct.pack("<46d", *flatten(state)).hex()})


def take_state(native: NativeShip) -> list[float]:
    return list(struct.unpack("<46d", bytes.fromhex(native.get_state()["bytes"])))


def find_scales(state: list[float], length: float) -> Array:
    """What a difference of each number is judged by: the place by the ship's length or its distance, velocities by the
    fastest of all, forces by the largest of all."""
    x = np.abs(state)
    speed = max(x[6:9].max(), length * x[9:12].max(), 0.1)
    impulse = max(x[12:15].max(), x[15:18].max() / length, 1.0)
    force = max(max(x[k : k + 3].max(), x[k + 3 : k + 6].max() / length) for k in (22, 28, 34, 40)) or 1.0
    wrench = [*[force] * 3, *[force * length] * 3]
    return np.array([
        *[max(length, *x[:3])] * 3, *[max(1.0, *x[3:6])] * 3, *[speed] * 3, *[speed / length] * 3,
        *[impulse] * 3, *[impulse * length] * 3, 1.0, 1.0, 1.0, max(1.0, x[21]), *wrench * 4,
    ])  # fmt: skip


def compare(native: list[float], state: dict[str, Any], length: float) -> float:
    """The largest difference over its scale."""
    expected = flatten(state)
    return float(np.max(np.abs(np.array(native) - expected) / find_scales(expected, length)))
