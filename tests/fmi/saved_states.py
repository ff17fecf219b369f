"""States of both FMUs in the middle of a collision, serialised: before, at, during and after contact."""

from __future__ import annotations

from typing import Any

from shipcollision_fmu.cosim.component import InProcessComponent
from shipcollision_fmu.cosim.simulate import run_steps
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from shipcollision_fmu.fmi.slave_base import state_to_bytes
from shipcollision_fmu.fmi.variable_access import VariableAccess
from shipcollision_fmu.scenario.scenario import load_scenario

__all__ = ["saved_states"]


def saved_states(scenario: str = "guan2014_added_mass", every: int = 12) -> dict[str, list[bytes]]:
    """By name of the FMU. Of the scenario's steps every so many, and all in which the contact begins or ends."""
    made: dict[str, VariableAccess] = {}

    def component(name: str, access: VariableAccess) -> InProcessComponent:
        made[name] = access
        return InProcessComponent(name, access)

    found: dict[str, list[bytes]] = {"ShipCollision": [], "ShipManoeuvring": []}
    touching: list[Any] = [False]

    def keep(done: int, total: int) -> None:
        active = made["collision"].model.outputs.contact_active  # type: ignore[attr-defined]  # ours has a model
        if done % every == 1 or active != touching[-1]:
            found["ShipCollision"].append(state_to_bytes(made["collision"].save()))
            found["ShipManoeuvring"].append(state_to_bytes(made["own"].save()))
        touching.append(active)

    loaded = load_scenario(scenario)
    run_steps(
        loaded,
        loaded.load_ships(),
        (
            lambda name: component(name, MANOEUVRING.make_access()),
            lambda: component("collision", COLLISION.make_access()),
        ),
        keep,
    )
    assert True in touching, "no contact in this scenario"
    return found
