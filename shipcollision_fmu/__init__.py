"""Ship collisions as FMI co-simulation FMUs.

Users import from here:

    from shipcollision_fmu import build_fmus, encounter, imazu, load_scenario, load_ship, simulate

    run = simulate(load_scenario("guan2014"))
    run.states, run.contacts, run.events, run.summary
    run = simulate(encounter("t-bone", own="kcs", own_speed=4.0).scenario)

A name is imported on its first use. An FMU needs only the models, so it imports no master and no pictures. Type
checkers read the imports under TYPE_CHECKING, and a test holds both lists together.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .batch.collide import collide
    from .batch.encounter_tables import Encounters
    from .batch.encounters import run_encounters
    from .batch.impact import impact
    from .collision.model import ShipCollision
    from .cosim.run import Run
    from .cosim.simulate import simulate
    from .encounters.encounter import encounter
    from .encounters.imazu import imazu
    from .encounters.traffic.situation import traffic_scenario
    from .errors import HostError, InputError, ScenarioError, ShipCollisionError, ShipError, StepError, StudyError
    from .fmi.builder.package import build_fmus
    from .manoeuvring.model import ShipManoeuvring
    from .scenario.scenario import Scenario, load_scenario
    from .ship.loading.library import load_ship
    from .ship.ship import Ship
    from .study.definition.study import read_study
    from .study.engine.run import run_study

__version__ = "0.1.0"

__all__ = [
    "Encounters", "HostError", "InputError", "Run", "Scenario", "ScenarioError", "Ship", "ShipCollision",
    "ShipCollisionError", "ShipError", "ShipManoeuvring", "StepError", "StudyError", "__version__", "build_fmus",
    "collide", "encounter", "imazu", "impact", "load_scenario", "load_ship", "read_study", "run_encounters",
    "run_study", "simulate", "traffic_scenario",
]  # fmt: skip

_MODULES = {
    "batch.collide": ("collide",),
    "batch.encounter_tables": ("Encounters",),
    "batch.encounters": ("run_encounters",),
    "batch.impact": ("impact",),
    "collision.model": ("ShipCollision",),
    "cosim.run": ("Run",),
    "cosim.simulate": ("simulate",),
    "encounters.encounter": ("encounter",),
    "encounters.imazu": ("imazu",),
    "encounters.traffic.situation": ("traffic_scenario",),
    "errors": (
        "HostError", "InputError", "ScenarioError", "ShipCollisionError", "ShipError", "StepError", "StudyError",
    ),
    "fmi.builder.package": ("build_fmus",),
    "manoeuvring.model": ("ShipManoeuvring",),
    "scenario.scenario": ("Scenario", "load_scenario"),
    "ship.loading.library": ("load_ship",),
    "ship.ship": ("Ship",),
    "study.definition.study": ("read_study",),
    "study.engine.run": ("run_study",),
}  # fmt: skip
"""Modules and what users import of them."""


if not TYPE_CHECKING:  # a type checker that reads this function takes every misspelt name for one of type Any

    def __getattr__(name: str) -> Any:
        for module, names in _MODULES.items():
            if name in names:
                return getattr(import_module(f".{module}", __name__), name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
