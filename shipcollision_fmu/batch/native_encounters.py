"""Encounters by the native library: its calls, and the structures that it reads.

They are those of native/batch/encounter.hpp and helm.hpp.
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ..toolchain.load import load_library
from .encounter_columns import COLLISION_ROW, ENCOUNTER_ROW, SHIP_ROW

__all__ = [
    "REAL",
    "Autopilot",
    "EncounterCase",
    "EncounterRows",
    "EncounterShip",
    "Evasion",
    "HeadingOrder",
    "HelmTable",
    "NativeEncounters",
    "Point",
    "Route",
    "RudderOrder",
    "as_array",
]  # fmt: skip

REAL, INTEGER = ctypes.c_double, ctypes.c_int32


class RudderOrder(ctypes.Structure):
    """An order of rudder [rad] and revolutions [1/s] at the communication point k."""

    _fields_ = (("k", INTEGER), ("unused", INTEGER), ("rudder", REAL), ("revolutions", REAL))


class HeadingOrder(ctypes.Structure):
    """An order of a heading [rad] at the communication point k; not given: the rudder is ordered again."""

    _fields_ = (("k", INTEGER), ("is_given", INTEGER), ("heading", REAL))


class Autopilot(ctypes.Structure):
    """See cosim/autopilot.py."""

    _fields_ = (("gain", REAL), ("rate_gain", REAL), ("integral_gain", REAL), ("rudder_limit", REAL))


class Point(ctypes.Structure):
    """A place in n, north and east [m]."""

    _fields_ = (("north", REAL), ("east", REAL))


class Route(ctypes.Structure):
    """See cosim/route.py. points: the start, then the waypoints."""

    _fields_ = (
        ("points", ctypes.POINTER(Point)), ("waypoint_count", INTEGER), ("unused", INTEGER), ("lookahead", REAL),
        ("acceptance", REAL),
    )  # fmt: skip


class Evasion(ctypes.Structure):
    """See cosim/evasion.py. of: number of the ship, from 0."""

    _fields_ = (
        ("of", INTEGER), ("has_revolutions", INTEGER), ("distance", REAL), ("time_to_closest", REAL), ("rudder", REAL),
        ("revolutions", REAL),
    )  # fmt: skip


class HelmTable(ctypes.Structure):
    """The helm of a ship."""

    _fields_ = (
        ("orders", ctypes.POINTER(RudderOrder)), ("headings", ctypes.POINTER(HeadingOrder)),
        ("autopilot", ctypes.POINTER(Autopilot)), ("route", ctypes.POINTER(Route)),
        ("evasion", ctypes.POINTER(Evasion)), ("order_count", INTEGER), ("heading_count", INTEGER),
    )  # fmt: skip


class EncounterShip(ctypes.Structure):
    """A ship of an encounter."""

    _fields_ = (
        ("name", ctypes.c_char_p), ("file", ctypes.c_char_p), ("degrees_of_freedom", INTEGER),
        ("hydrodynamics", INTEGER), ("coasting", INTEGER), ("predicted_coasting", INTEGER), ("fender", REAL * 3),
        ("start", REAL * 12), ("inverse", REAL * 36), ("helm", HelmTable),
    )  # fmt: skip


class EncounterCase(ctypes.Structure):
    """An encounter."""

    _fields_ = (
        ("ships", ctypes.POINTER(EncounterShip)), ("obstacles", ctypes.c_char_p), ("headings", ctypes.POINTER(REAL)),
        ("ship_count", INTEGER), ("obstacle_count", INTEGER), ("surroundings", REAL * 4), ("friction", REAL),
        ("restitution", REAL), ("substep", REAL), ("minimum_separation_time", REAL), ("clearance_range", REAL),
        ("response", INTEGER), ("feedback", INTEGER), ("is_parallel", INTEGER), ("steps", INTEGER), ("step", REAL),
        ("separation", REAL),
    )  # fmt: skip


class EncounterRows(NamedTuple):
    """What became of an encounter: its row, and a row for each ship and each collision.

    track   states (steps + 1, ships, 12), empty unless it was asked for
    """

    encounter: npt.NDArray[Any]
    ships: npt.NDArray[Any]
    collisions: npt.NDArray[Any]
    track: npt.NDArray[np.float64]


class NativeEncounters:
    """Runs encounters one after the other. Close it after use; one thread at a time may use it."""

    def __init__(self) -> None:
        """Raises HostError without a library."""
        self._library = load_library()
        self._library.shipcollision_make_encounters.restype = ctypes.c_void_p
        made = self._library.shipcollision_make_encounters()
        if made is None:
            raise MemoryError
        self._encounters = ctypes.c_void_p(made)

    def run(self, case: EncounterCase, *, has_track: bool = False) -> EncounterRows:
        """The rows of an encounter."""
        encounter, ships = np.zeros((), ENCOUNTER_ROW), np.zeros(case.ship_count, SHIP_ROW)
        track = np.zeros((case.steps + 1 if has_track else 0, case.ship_count, 12))
        self._library.shipcollision_run_encounter(
            self._encounters, ctypes.byref(case), ctypes.c_void_p(encounter.ctypes.data),
            ctypes.c_void_p(ships.ctypes.data), ctypes.c_void_p(track.ctypes.data if has_track else None),
        )  # fmt: skip
        return EncounterRows(encounter, ships, self._copy_collisions(), track[: int(encounter["steps"]) + 1])

    def _copy_collisions(self) -> npt.NDArray[Any]:
        place = ctypes.c_void_p()
        count = self._library.shipcollision_encounter_collisions(self._encounters, ctypes.byref(place))
        content = ctypes.string_at(place, count * COLLISION_ROW.itemsize) if count else b""
        return np.frombuffer(content, COLLISION_ROW)

    def close(self) -> None:
        """Free the memory of the library."""
        self._library.shipcollision_free_encounters(self._encounters)


def as_array(kind: Any, entries: Iterable[Any]) -> Any:
    """An array of ctypes with these entries."""
    listed = list(entries)
    return (kind * len(listed))(*listed)
