"""Impacts by the native library: its calls through ctypes, which releases the interpreter while they run."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ..errors import ShipError
from ..ship.frames import Array
from ..toolchain.load import load_library
from .impact_columns import IMPACTS

__all__ = ["ImpactShip", "NativeImpacts"]

MESSAGE = 4096
"""Bytes for a refusal."""
CHUNK = 4096
"""Cases of one call of the library. More, and Ctrl-C would wait for longer than a second."""


class ImpactShip(NamedTuple):
    """A ship as the library takes it.

    file                 path of its prepared file
    degrees_of_freedom   3, 4 or 6
    L_oa, middle         length over all, and its middle forward of CO [m]
    section              corners (n, 2) of the section at the height of contact, in b [m]
    """

    file: str
    degrees_of_freedom: int
    L_oa: float
    middle: float
    section: Array


class _Ship(ctypes.Structure):
    _fields_ = (
        ("file", ctypes.c_char_p), ("degrees_of_freedom", ctypes.c_int), ("L_oa", ctypes.c_double),
        ("middle", ctypes.c_double), ("section", ctypes.c_void_p), ("corner_count", ctypes.c_int),
    )  # fmt: skip


class NativeImpacts:
    """The impacts of own and target. Close it after use; one thread at a time may use it."""

    def __init__(self, own: ImpactShip, target: ImpactShip) -> None:
        """Raises HostError without a library, ShipError for a ship that it refuses."""
        self._library = load_library()
        self._library.shipcollision_make_impacts.restype = ctypes.c_void_p
        message = ctypes.create_string_buffer(MESSAGE)
        made = self._library.shipcollision_make_impacts(
            ctypes.byref(_as_structure(own)), ctypes.byref(_as_structure(target)), message, ctypes.c_size_t(MESSAGE)
        )
        if made is None:
            raise ShipError(message.value.decode())
        self._impacts = ctypes.c_void_p(made)

    def run(self, cases: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """A row of IMPACTS for each of the cases (n,)."""
        rows = np.empty(len(cases), IMPACTS)
        for begin in range(0, len(cases), CHUNK):
            given, filled = cases[begin : begin + CHUNK], rows[begin : begin + CHUNK]
            self._library.shipcollision_run_impacts(
                self._impacts, ctypes.c_void_p(given.ctypes.data), ctypes.c_size_t(len(given)),
                ctypes.c_void_p(filled.ctypes.data),
            )  # fmt: skip
        return rows

    def close(self) -> None:
        """Free the memory of the library."""
        self._library.shipcollision_free_impacts(self._impacts)


def _as_structure(ship: ImpactShip) -> _Ship:
    section = np.ascontiguousarray(ship.section, dtype=np.float64)
    structure = _Ship(
        ship.file.encode(), ship.degrees_of_freedom, ship.L_oa, ship.middle, section.ctypes.data, len(section)
    )
    structure.kept = section  # the memory behind its pointer
    return structure
