"""Rudder, revolutions and wind of a finished run, from machinery.csv and surroundings.csv of its folder.

Pictures need neither file, so that another master may leave them out, as older versions of this program did.
"""

from __future__ import annotations

import csv

import numpy as np

from ...errors import InputError
from ...fmi.names import STEERING, WIND_DIRECTION, WIND_SPEED, named
from ...ship.frames import Array
from .run_folder import REMEDY, RunFolder, read_columns, read_text

__all__ = ["read_machinery", "read_wind"]


def read_machinery(run: RunFolder) -> dict[str, Array]:
    """Rudder [rad] and revolutions [1/s] (rows, 2) of each ship that machinery.csv has. Raises InputError."""
    path = run.path / "machinery.csv"
    if not path.is_file():
        return {}
    text = read_text(path)
    header = next(csv.reader([text.partition("\n")[0]]))
    found = {}
    for name in run.bodies.ships:
        columns = named(name, STEERING)
        if columns[0] in header:
            found[name] = read_columns(path, text, columns, len(run.times))
    return found


def read_wind(run: RunFolder) -> Array | None:
    """Wind (rows, 2), speed [m/s] and where it comes from [rad], at each row of states.csv; None without the file.

    Raises InputError.
    """
    path = run.path / "surroundings.csv"
    if not path.is_file():
        return None
    changes = read_columns(path, read_text(path), ("time", WIND_SPEED, WIND_DIRECTION), None)
    if not len(changes) or changes[0, 0] > run.times[0]:
        raise InputError(f"{path}: has no row for the start of the run: {REMEDY}")
    last = np.searchsorted(changes[:, 0], run.times, side="right") - 1
    wind: Array = changes[last, 1:]
    return wind
