"""From a scenario to a System: instances, initialised and connected by wires, and the helms of the ships.

ship      position attitude velocity rate impulse_applied  ->  S.position ... S.impulse_applied      collision
ship      impulse                                          <-  S.impulse           feedback "ledger"
ship      force, moment                                    <-  S.force, S.moment   feedback "force"
                                                           nothing                 feedback "none"

A ship that follows a recorded track is no instance of an FMU (track_component.py). Its states go to the collision,
whose parameter S.feedback is "prescribed"; nothing comes back.
"""

from __future__ import annotations

from collections.abc import Mapping

from ..fmi.names import ANSWERS, APPLIED, STATE, SURROUNDINGS, named
from ..scenario.scenario import Scenario
from ..ship.ship import Ship
from .component import Component
from .factories import MakeCollision, MakeShip
from .helm import Helm
from .master import System, Wire
from .parameters import changed_surroundings, collision_parameters, ship_parameters, surroundings
from .prepared_files import PreparedFiles
from .scenario_helm import build_helm
from .track_component import TrackComponent

__all__ = ["connect"]


def connect(
    scenario: Scenario,
    ships: Mapping[str, Ship],
    make_ship: MakeShip,
    make_collision: MakeCollision,
    prepared: PreparedFiles | None = None,
) -> tuple[System, list[Helm]]:
    """The scenario's instances, initialised and wired, and the helms of those of its `ships` that are steered;
    prepared: files of native FMUs.

    The two functions make the components and own them: they close all, also when this function fails.
    """
    end = scenario.step * scenario.steps
    instances: dict[str, Component] = {}
    helms: list[Helm] = []
    changes = changed_surroundings(scenario)
    for name, start in scenario.ships.items():
        if start.recorded is not None:
            instances[name] = TrackComponent(name, start.recorded)
            continue
        instances[name] = make_ship(name)
        helm = build_helm(start, ships[name].L_pp, instances[name], scenario.step)
        around = instances[name].reals(SURROUNDINGS)
        around.values[:] = changes.get(0, surroundings(scenario))
        helm.around, helm.changes = around, dict(changes)
        inputs = [around, helm.group] if helm.load(0) else [around]
        instead = prepared.list_ship_values(name) if prepared is not None else {}
        instances[name].initialise({**ship_parameters(scenario, name, start), **instead}, end, inputs)
        helms.append(helm)

    collision = make_collision()
    states, answers = [], []
    answer = ANSWERS[scenario.collision.feedback or "ledger"]
    for name, instance in instances.items():
        outputs = (*STATE, *APPLIED)
        states.append(Wire.between(instance, outputs, collision, named(name, outputs)))
        if answer and scenario.ships[name].recorded is None:
            answers.append(Wire.between(collision, named(name, answer), instance, answer))
    for wire in states:
        wire.outputs.read()
    buffers = dict(zip(instances, (wire.outputs.values for wire in states), strict=True))
    steered = [(name, start) for name, start in scenario.ships.items() if start.recorded is None]
    for helm, (name, start) in zip(helms, steered, strict=True):
        helm.own = buffers[name]
        helm.other = None if start.evasion is None else buffers[start.evasion.of]
    instead = prepared.list_collision_values() if prepared is not None else {}
    collision.initialise({**collision_parameters(scenario), **instead}, end, [wire.inputs for wire in states])
    for wire in answers:
        wire.outputs.read()
    return System(list(instances.values()), collision, states, answers), helms
