"""Ship collisions as FMI co-simulation FMUs.

Users import from here:

    from shipcollision_fmu import build_fmus, encounter, imazu, load_scenario, load_ship, simulate

    run = simulate(load_scenario("guan2014"))
    run.states, run.contacts, run.events, run.summary
    run = simulate(encounter("t-bone", own="kcs", own_speed=4.0).scenario)

Names are fetched on first use, so that an FMU, which needs only the models, does not import a master.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

__version__ = "0.1.0"

_HOME = {
    "ShipCollisionError": "shipcollision_fmu.errors",
    "build_fmus": "shipcollision_fmu.fmi.package",
    "encounter": "shipcollision_fmu.encounters.encounter",
    "imazu": "shipcollision_fmu.encounters.imazu",
    "load_scenario": "shipcollision_fmu.scenario.scenario",
    "load_ship": "shipcollision_fmu.ship.loading.library",
    "simulate": "shipcollision_fmu.cosim.simulate",
    "traffic_scenario": "shipcollision_fmu.encounters.traffic.situation",
}

__all__ = [
    "ShipCollisionError", "__version__", "build_fmus", "encounter", "imazu", "load_scenario", "load_ship", "simulate",
    "traffic_scenario",
]  # fmt: skip


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
