"""Level `sailed`: ships under way with the manoeuvring model, as encounter() brings them to the impact.

To make an encounter takes most of the time: its way to the impact is sailed in Python, whatever the engine.
"""

from __future__ import annotations

from math import isfinite
from typing import Any

from ...encounters.encounter import encounter
from ...errors import InputError, StepError
from ...scenario.scenario import Scenario
from ..definition.study import Study
from ..definition.variables import NUMBERS
from .cases import Cases
from .encounter_results import run_scenario
from .fleet_ships import find_ship
from .results import Results
from .ship_folder import ShipFolder

__all__ = ["make_sailed_scenario", "run_sailed"]

OF_CONTACT = ("friction", "restitution")
"""Numbers of [collision], all others are options of encounter()."""


def run_sailed(study: Study, cases: Cases, engine: str) -> Results:
    """The results of the cases."""
    results = Results(cases, engine)
    with ShipFolder() as folder:
        for place in range(len(cases)):
            try:
                run_scenario(
                    results, place, make_sailed_scenario(study, cases, place, folder), study.run.separation
                )  # fmt: skip
            except (InputError, StepError) as error:
                results.refuse(place, folder.name_ships(str(error)))
    return results


def make_sailed_scenario(study: Study, cases: Cases, place: int, folder: ShipFolder) -> Scenario:
    """The scenario of a case. Raises InputError for ships that do not meet as the case has them."""
    run = study.run
    ships = {role: find_ship(study, role, int(cases.ships[role][place])) for role in ("own", "target")}
    for ship in ships.values():
        ship.loaded  # noqa: B018  refuses a ship that has none
    numbers = {name: float(values[place]) for name, values in cases.numbers.items() if isfinite(values[place])}
    contact = {name: numbers.pop(name) for name in OF_CONTACT}
    options: dict[str, Any] = {name: value for name, value in numbers.items() if name in NUMBERS}
    made = encounter(
        str(cases.kind[place]), side=str(cases.side[place]), **options,
        own=folder.write(ships["own"]), target=folder.write(ships["target"]),
        degrees_of_freedom=run.degrees_of_freedom, time=run.time, after=run.after, step=run.step, hydrodynamics=True,
    ).scenario  # fmt: skip
    return made.model_copy(update={"collision": made.collision.model_copy(update=contact)})
