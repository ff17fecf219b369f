"""Level `encounter`: whole collisions of coasting ships, as collide() has them."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ...batch.collide import collide
from ...errors import InputError, ShipError, StepError
from ...scenario.scenario import Scenario
from ...scenario.tables.collision import Collision
from ..definition.study import Study
from ..definition.study_file import USUAL_TIME
from .cases import Cases
from .encounter_results import put_encounters, run_scenario
from .fleet_ships import FleetShip
from .impact_rows import PAIRS, as_cases
from .pairs import group_pairs, refuse_all
from .results import Results
from .ship_folder import ShipFolder

__all__ = ["make_coasting_scenario", "make_impact_scenario", "run_coasting"]

GIVEN = (
    "angle_deg", "at", "own_speed", "target_speed", "own_sway", "target_sway", "heading_deg", "friction", "restitution",
)  # fmt: skip
"""Numbers that collide() takes."""
JUST_BEFORE = 1e-3
"""[s] Time from the start to the impact in the scenario of an impact, and its substep: hulls touch at the end of a
substep. The energy of the first contact differs from that of the row by some 1e-5 of itself, in proportion to it."""

Places = npt.NDArray[np.intp]


def run_coasting(study: Study, cases: Cases, engine: str) -> Results:
    """The results of the cases."""
    results = Results(cases, engine)
    for own, target, places in group_pairs(study, cases, results):
        try:
            if engine == "native":
                _run_native(study, own, target, places, results)
            else:
                _run_python(study, own, target, places, results)
        except ShipError as error:
            refuse_all(results, places, error)
    return results


def _run_native(study: Study, own: FleetShip, target: FleetShip, places: Places, results: Results) -> None:
    cases, run = results.cases, study.run
    given: dict[str, Any] = {name: cases.numbers[name][places] for name in GIVEN}
    tables = collide(
        own.loaded, target.loaded, side=cases.side[places], **given,
        degrees_of_freedom=run.degrees_of_freedom, before=run.time or USUAL_TIME, after=run.after,
        separation=run.separation, step=run.step,
    )  # fmt: skip
    put_encounters(results, places, tables)


def _run_python(study: Study, own: FleetShip, target: FleetShip, places: Places, results: Results) -> None:
    rows = PAIRS["python"].find(own, target, study.run.degrees_of_freedom).run(as_cases(results.cases)[places])
    with ShipFolder() as folder:
        files = {"own": folder.write(own), "target": folder.write(target)}
        for place, row in zip(places, rows, strict=True):
            if row["status"]:
                results.refuse(int(place), row["reason"].decode())
                continue
            try:
                scenario = make_coasting_scenario(study, files, row, results.cases, int(place))
                run_scenario(results, int(place), scenario, study.run.separation)
            except (InputError, StepError) as error:
                results.refuse(int(place), folder.name_ships(str(error)))


def make_coasting_scenario(study: Study, files: dict[str, str], row: Any, cases: Cases, place: int) -> Scenario:
    """The scenario of two ships that coast to the impact in the row."""
    run = study.run
    steps = round((run.time or USUAL_TIME) / run.step) or 1
    duration = (steps + (round(run.after / run.step) or 1)) * run.step
    contact = Collision(friction=cases.numbers["friction"][place], restitution=cases.numbers["restitution"][place])
    return _make_scenario(study, files, row, steps * run.step, duration, contact)


def make_impact_scenario(study: Study, files: dict[str, str], row: Any, cases: Cases, place: int) -> Scenario:
    """The scenario that begins with the impact in the row, and goes on from there."""
    run = study.run
    contact = Collision(
        friction=cases.numbers["friction"][place], restitution=cases.numbers["restitution"][place], substep=JUST_BEFORE
    )
    return _make_scenario(study, files, row, JUST_BEFORE, (round(run.after / run.step) or 1) * run.step, contact)


def _make_scenario(
    study: Study, files: dict[str, str], row: Any, time: float, duration: float, contact: Collision
) -> Scenario:
    """The scenario of ships that meet at the time [s], on straight courses."""
    run, ships = study.run, {}
    for role, file in files.items():
        heading, (surge, sway, *_, yaw_rate) = float(row[f"{role}_heading"]), row[f"{role}_before"].tolist()
        c, s = np.cos(heading), np.sin(heading)
        north, east = row[f"{role}_position"][:2] - time * np.array([surge * c - sway * s, surge * s + sway * c])
        ships[role] = {
            "ship": file, "position": [float(north), float(east)],
            "heading_deg": float(np.degrees(heading - yaw_rate * time)), "surge": surge, "sway": sway,
            "degrees_of_freedom": run.degrees_of_freedom, "hydrodynamics": False,
            **({"coasting": "straight"} if sway else {}), **({"rates": [0.0, 0.0, yaw_rate]} if yaw_rate else {}),
        }  # fmt: skip
    return Scenario.model_validate(
        {
            "scenario": {"name": study.name, "duration": duration, "step": run.step}, "ships": ships,
            "collision": contact,
        }
    )  # fmt: skip
