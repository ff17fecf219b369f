"""Situations of traffic: each file a scenario, whose ships coast (level `encounter`) or are sailed (level `sailed`)."""

from __future__ import annotations

from math import isfinite
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ...encounters.traffic.situation import traffic_scenario
from ...errors import InputError, StepError
from ...scenario.scenario import Scenario, load_scenario
from ...scenario.tables.environment import CurrentTable, WindTable
from ..definition.study import Study
from ..definition.variables import SAILED
from .cases import Cases
from .encounter_results import run_scenario
from .fleet_ships import find_ship
from .results import Results
from .ship_folder import ShipFolder

__all__ = ["draw_into", "make_situation", "run_situations"]

REMEDIES = {
    "name a ship with --own or --ship": "give ships in [own] and [target]",
    "name a ship with --ship": "give ships in [target]",
    "leave out --hydrodynamics": 'take level = "encounter"',
}
"""Options of the command `import` that a refusal names, and what does the same in a study."""

Key = tuple[str, int, int]


def run_situations(study: Study, cases: Cases, engine: str) -> Results:
    """The results of the cases."""
    results, made = Results(cases, engine), dict[Key, Scenario | str]()
    with ShipFolder() as ships, TemporaryDirectory(prefix="shipcollision-") as folder:
        for place in range(len(cases)):
            key = str(cases.situation[place]), int(cases.ships["own"][place]), int(cases.ships["target"][place])
            if key not in made:
                made[key] = make_situation(study, key, ships, Path(folder, str(len(made))))
            scenario = made[key]
            if isinstance(scenario, str):
                results.refuse(place, scenario)
                continue
            try:
                run_scenario(results, place, draw_into(scenario, cases, place), study.run.separation)
            except (InputError, StepError) as error:
                results.refuse(place, ships.name_ships(str(error)))
    return results


def make_situation(study: Study, key: Key, ships: ShipFolder, folder: Path) -> Scenario | str:
    """The scenario of a situation, or why it is refused."""
    situation, *numbers = key
    folder.mkdir()
    path, out = folder / situation, folder / "situation.toml"
    path.write_bytes(study.situations[situation])
    try:
        own, target = (
            ships.write(find_ship(study, role, number)) if fleet.size else None
            for role, fleet, number in zip(("own", "target"), (study.own, study.target), numbers, strict=True)
        )
        made = traffic_scenario(
            path, out=out, ship=target, own=own, duration=study.situation_duration, step=study.run.step,
            hydrodynamics=study.level == SAILED,
        )  # fmt: skip
        for name, text in {**made.ship_files, out.name: made.text}.items():
            (folder / name).write_text(text, encoding="utf-8")
        return load_scenario(out)
    except InputError as error:
        reason = ships.name_ships(str(error)).replace(f"{folder}/", "")
        for option, remedy in REMEDIES.items():
            reason = reason.replace(option, remedy)
        return reason


def draw_into(scenario: Scenario, cases: Cases, place: int) -> Scenario:
    """The scenario with what the study draws: contact, current and wind."""
    numbers = {name: float(values[place]) for name, values in cases.numbers.items() if isfinite(values[place])}
    contact = {name: numbers[name] for name in ("friction", "restitution")}
    around: dict[str, Any] = {}
    if "current_speed" in numbers:
        current = CurrentTable(speed=numbers["current_speed"], towards_deg=numbers["current_towards_deg"])
        around["current"] = current.velocity
    if "wind_speed" in numbers:
        around["wind"] = WindTable(speed=numbers["wind_speed"], from_deg=numbers["wind_from_deg"])
    return scenario.model_copy(
        update={
            "collision": scenario.collision.model_copy(update=contact),
            "environment": scenario.environment.model_copy(update=around),
        }
    )
