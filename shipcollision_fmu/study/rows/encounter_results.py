"""Results of whole encounters, from the tables of the native library and from runs of the Python models."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ...batch.encounter_tables import Encounters
from ...batch.encounters import run_encounters
from ...cosim.run import Run
from ...fmi.names import STATE
from ...scenario.scenario import Scenario
from .python_run import run_python
from .results import MOTION, Results

__all__ = ["put_encounters", "put_run", "run_scenario"]

Values = npt.NDArray[Any]


def run_scenario(results: Results, place: int, scenario: Scenario, separation: float | None) -> None:
    """Run the scenario of a case and put what comes of it at the place. Raises InputError, StepError."""
    if results.engine == "native":
        put_encounters(results, np.array([place]), run_encounters([scenario], separation=separation))
    else:
        put_run(results, place, run_python(scenario, separation))


def put_encounters(results: Results, places: npt.NDArray[np.intp], tables: Encounters) -> None:
    """Put the encounters of the native library at the places of their cases."""
    encounters, found = tables.encounters, tables.collisions
    for place, row in zip(places, encounters, strict=True):
        if row["status"]:
            results.refuse(int(place), row["reason"].decode())
    done = encounters["status"] == 0
    for name in ("energy", "energy_normal", "energy_tangential", "clearance", "collisions", "unconverged"):
        results.put(name, places[done], encounters[name][done])
    results.put("duration", places[done], encounters["time"][done])
    found = found[done[found["case"]]]
    collisions: dict[str, Values] = {
        "case": places[found["case"]], "collision": found["number"], "ship_a": found["ship_a"],
        "ship_b": found["ship_b"], "contacts": found["contacts"], "start": found["start"], "end": found["end"],
        "energy": found["energy"], "closing_speed": found["closing_speed"], "angle_deg": np.degrees(found["angle"]),
        "relative_speed": np.linalg.norm(found["relative_velocity"], axis=1),
        "impulse": np.hypot(*found["impulse"][:, :2].T),
    }  # fmt: skip
    for letter in "ab":
        for i, axis in enumerate("xyz"):
            collisions[f"{letter}_{axis}"] = found[f"{letter}_point"][:, i]
        for when in ("before", "after"):
            for name, i in MOTION.items():
                collisions[f"{letter}_{name}_{when}"] = found[f"{letter}_{when}"][:, i]
    _put_collisions(results, places[done], collisions)


def _put_collisions(results: Results, places: npt.NDArray[np.intp], collisions: dict[str, Values]) -> None:
    """Put the collisions, and of the first of each case its columns of the encounter."""
    results.put("contacts", places, 0.0)
    np.add.at(results.numbers["contacts"], collisions["case"], collisions["contacts"])
    results.collisions.append(collisions)
    cases, first = np.unique(collisions["case"], return_index=True)  # the first of each comes first
    for name in ("closing_speed", "relative_speed", "impulse"):
        results.put(name, cases, collisions[name][first])
    results.put("collision_angle_deg", cases, collisions["angle_deg"][first])
    for letter, other in ("ab", "ba"):
        for role, of in (("own", letter), ("target", other)):
            is_role = collisions[f"ship_{of}"][first] == "own"
            for name in ("x", "y", "z", *(f"{motion}_after" for motion in MOTION)):
                results.put(f"{role}_{name}", cases[is_role], collisions[f"{letter}_{name}"][first][is_role])


def put_run(results: Results, place: int, run: Run) -> None:
    """Put a run of the Python models at the place of its case."""
    events, signals, where = run.events["collisions"], run.signals[-1], np.array([place])
    results.put("duration", where, run.states["time"][-1])
    results.put("energy", where, signals["energy.dissipated"])
    for name in ("normal", "tangential"):
        results.put(f"energy_{name}", where, signals[f"energy.{name}"])
    results.put("clearance", where, run.summary["least_clearance"])
    results.put("collisions", where, len(events))
    results.put("unconverged", where, run.summary["solver"]["unconverged"])
    rows = [_describe_collision(run, place, event) for event in events]
    if rows:
        _put_collisions(results, where, {name: np.array([row[name] for row in rows]) for name in rows[0]})
    else:
        results.put("contacts", where, 0.0)


def _describe_collision(run: Run, place: int, event: dict[str, Any]) -> dict[str, Any]:
    contacts = run.contacts[run.contacts["impact"] == event["id"]]
    touches = np.searchsorted(run.states["time"], contacts["time"])
    row: dict[str, Any] = {
        "case": place, "collision": event["id"], "contacts": len(contacts), "start": event["start"],
        "end": event["end"], "energy": event["energy"], "closing_speed": event["closing_speed"],
        "angle_deg": float(np.degrees(event["angle"])),
        "relative_speed": float(np.linalg.norm(event["relative_velocity"])),
        "impulse": float(np.hypot(*event["impulse"]["n"][:2])),
    }  # fmt: skip
    states = {"before": run.states[touches[0] - 1], "after": run.states[touches[-1]]}
    for letter in "ab":
        row[f"ship_{letter}"] = name = event[f"ship_{letter}"]
        for i, axis in enumerate("xyz"):
            row[f"{letter}_{axis}"] = event["first_point"][f"b_{letter}"][i]
        for when, state in states.items():
            for motion, i in MOTION.items():
                row[f"{letter}_{motion}_{when}"] = float(state[f"{name}.{STATE[6 + i]}"])
    return row
