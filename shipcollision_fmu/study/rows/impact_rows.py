"""Level `impact`: the first contact alone, of all cases of a pair of ships in one call."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
import numpy.typing as npt

from ...batch.impact import open_impacts
from ...batch.impact_columns import CASES
from ...batch.prepared_ships import PreparedShips
from ...errors import ShipError
from ..definition.study import Study
from .cases import Cases
from .fleet_ships import FleetShip
from .pairs import Impacts, OpenPairs, group_pairs, refuse_all
from .python_impacts import PythonImpacts
from .results import MOTION, Results

__all__ = ["PAIRS", "OpenNative", "as_cases", "run_impacts"]


FILES_KEPT = 256
"""Prepared ships that stay on the disk, some 50 kB each, for the pairs that are opened next."""


class OpenNative(threading.local):
    """Opens pairs in the native library. A fleet has many more pairs than ships: each ship is prepared once."""

    def __init__(self) -> None:
        self._files: PreparedShips | None = None  # no folder before the first pair

    def __call__(self, own: FleetShip, target: FleetShip, degrees_of_freedom: int) -> Impacts:
        """The impacts of these ships. Raises ShipError for a ship that is refused."""
        if self._files is None or len(self._files) >= FILES_KEPT:
            self._files = PreparedShips()
        return open_impacts(own.loaded, target.loaded, degrees_of_freedom, self._files)


PAIRS = {"native": OpenPairs(OpenNative()), "python": OpenPairs(PythonImpacts)}
"""Open pairs by engine."""


def run_impacts(study: Study, cases: Cases, engine: str) -> Results:
    """The results of the cases."""
    results = Results(cases, engine)
    given = as_cases(cases)
    done: list[tuple[npt.NDArray[np.intp], npt.NDArray[Any]]] = []
    for own, target, places in group_pairs(study, cases, results):
        try:
            impacts = PAIRS[engine].find(own, target, study.run.degrees_of_freedom)
        except ShipError as error:
            refuse_all(results, places, error)
            continue
        rows = impacts.run(given[places])
        for place, row in zip(places[rows["status"] != 0], rows[rows["status"] != 0], strict=True):
            results.refuse(int(place), row["reason"].decode())
        done.append((places[rows["status"] == 0], rows[rows["status"] == 0]))
    if done:  # at once: by pairs it would take longer than the impacts
        places, rows = (np.concatenate(parts) for parts in zip(*done, strict=True))
        _put_rows(results, places, rows)
    return results


def as_cases(cases: Cases) -> npt.NDArray[Any]:
    """The cases as batch/ has them."""
    given = np.zeros(len(cases), CASES)
    for name in CASES.names or ():
        if name in cases.numbers:
            given[name] = cases.numbers[name]
    given["is_starboard"] = cases.side == "starboard"
    return given


def _put_rows(results: Results, places: npt.NDArray[np.intp], rows: npt.NDArray[Any]) -> None:
    relative, impulse = np.linalg.norm(rows["relative_velocity"], axis=1), np.hypot(*rows["impulse"][:, :2].T)
    both: dict[str, Any] = {
        "contacts": rows["contacts"], "energy": rows["energy"], "closing_speed": rows["closing_speed"],
        "relative_speed": relative, "impulse": impulse,
    }  # fmt: skip
    angle = np.degrees(rows["angle"])
    c, s, (x, y, z) = np.cos(rows["target_heading"]), np.sin(rows["target_heading"]), rows["normal"].T
    encounter = {
        **both, "collisions": 1.0, "duration": 0.0, "energy_normal": rows["energy_normal"],
        "energy_tangential": rows["energy_tangential"], "collision_angle_deg": angle, "residual": rows["residual"],
        "unconverged": rows["residual"] > 1e-9,
        "normal_x": c * x + s * y, "normal_y": c * y - s * x, "normal_z": z,
    }  # fmt: skip
    one = np.ones(len(rows))
    collision = {
        "case": places, **both, "collision": one, "ship_a": np.full(len(rows), "own"),
        "ship_b": np.full(len(rows), "target"), "start": 0.0 * one, "end": 0.0 * one, "angle_deg": angle,
    }  # fmt: skip
    for role, letter in (("own", "a"), ("target", "b")):
        for i, axis in enumerate("xyz"):
            encounter[f"{role}_{axis}"] = collision[f"{letter}_{axis}"] = rows[f"{role}_point"][:, i]
        for name, i in MOTION.items():
            encounter[f"{role}_{name}_after"] = collision[f"{letter}_{name}_after"] = rows[f"{role}_after"][:, i]
            collision[f"{letter}_{name}_before"] = rows[f"{role}_before"][:, i]
    for name, values in encounter.items():
        results.put(name, places, values)
    results.collisions.append(collision)
