"""From a scenario to a System: instances, parameters, wires and orders.

ship      position attitude velocity rate impulse_applied  ->  S.position ... S.impulse_applied      collision
ship      impulse                                          <-  S.impulse           feedback "ledger"
ship      force, moment                                    <-  S.force, S.moment   feedback "force"
                                                           nothing                 feedback "none"
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from .component import Component, Group, Value
from .master import System, Wire
from .scenario import Scenario, order_table
from .tables import ShipStart

__all__ = ["IMPULSE", "STATE", "Helm", "MakeCollision", "MakeShip", "connected", "named"]

MakeShip = Callable[[str], Component]
MakeCollision = Callable[[], Component]

_NED, _LINEAR, _ANGLES = ("north", "east", "down"), ("surge", "sway", "heave"), ("roll", "pitch", "yaw")


def named(group: str, components: Sequence[str]) -> tuple[str, ...]:
    """('position', ('north', ...)) -> ('position.north', ...)."""
    return tuple(f"{group}.{component}" for component in components)


STATE = (
    *named("position", _NED), *named("attitude", _ANGLES), *named("velocity", _LINEAR), *named("rate", _ANGLES),
)  # fmt: skip
"""The 12 states of a ship, in the order of states.csv."""
IMPULSE = named("impulse", (*_LINEAR, *_ANGLES))
"""Cumulative impulse in b about CO [N s, N m s]."""
_APPLIED = named("impulse_applied", (*_LINEAR, *_ANGLES))
_FORCE = (*named("force", _LINEAR), *named("moment", _ANGLES))
_ANSWERS: dict[str, tuple[str, ...]] = {"ledger": IMPULSE, "force": _FORCE, "none": ()}
_ORDERS = ("rudder_order", "propeller_order")
_CURRENT = ("current.north", "current.east")


@dataclass
class Helm:
    """The orders of one ship, given at their communication points."""

    group: Group
    orders: list[tuple[int, list[float]]] = field(default_factory=list)

    def give(self, k: int) -> None:
        """Put what is ordered at communication point k into the buffer and send it; nothing when nothing is."""
        if self.take(k):
            self.group.write()

    def take(self, k: int) -> bool:
        """Put what is ordered at communication point k into the buffer."""
        due = bool(self.orders) and self.orders[0][0] == k
        if due:
            self.group.values[:] = self.orders.pop(0)[1]
        return due


def connected(scenario: Scenario, make_ship: MakeShip, make_collision: MakeCollision) -> tuple[System, list[Helm]]:
    """The scenario's instances, initialised and wired, and the orders that are still to be given.

    Components come from the two functions, which also own them: they are closed there, also when this fails.
    """
    end = scenario.step * scenario.steps
    ships, helms = {}, []
    for name, start in scenario.ships.items():
        ships[name] = make_ship(name)
        helm = Helm(ships[name].reals(_ORDERS), order_table(start, scenario.step))
        current = ships[name].reals(_CURRENT)
        current.values[:] = scenario.environment.current
        inputs = [current, helm.group] if helm.take(0) else [current]
        ships[name].initialise(_ship_parameters(scenario, name, start), end, inputs)
        helms.append(helm)

    collision = make_collision()
    states, answers = [], []
    answer = _ANSWERS[scenario.collision.feedback or "ledger"]
    for name, ship in ships.items():
        outputs = (*STATE, *_APPLIED)
        states.append(Wire.between(ship, outputs, collision, named(name, outputs)))
        if answer:
            answers.append(Wire.between(collision, named(name, answer), ship, answer))
    for wire in states:
        wire.outputs.read()
    collision.initialise(_collision_parameters(scenario), end, [wire.inputs for wire in states])
    for wire in answers:
        wire.outputs.read()
    return System(list(ships.values()), collision, states, answers), helms


def _ship_parameters(scenario: Scenario, name: str, ship: ShipStart) -> dict[str, Value]:
    start = ship.start
    state = (*start.position, *start.attitude, *start.velocity, *start.rate)
    return {
        "ship": scenario.ship_file(name),
        "degrees_of_freedom": ship.free,
        "hydrodynamics": ship.hydrodynamics,
        **{f"initial.{variable}": value for variable, value in zip(STATE, state, strict=True)},
    }


def _collision_parameters(scenario: Scenario) -> dict[str, Value]:
    parameters: dict[str, Value] = {}
    for name, ship in scenario.ships.items():
        parameters[f"{name}.ship"] = scenario.ship_file(name)
        parameters[f"{name}.degrees_of_freedom"] = ship.free
    return parameters | scenario.collision.model_dump(exclude_none=True)
