"""From a scenario to a System: instances, parameters, wires and orders.

ship      position attitude velocity rate impulse_applied  ->  S.position ... S.impulse_applied      collision
ship      impulse                                          <-  S.impulse           feedback "ledger"
ship      force, moment                                    <-  S.force, S.moment   feedback "force"
                                                           nothing                 feedback "none"
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import hypot, radians

from ..collision.obstacles import obstacles_toml
from ..fmi.names import ANSWERS, APPLIED, ORDERS, STATE, SURROUNDINGS, named
from ..scenario.order_schedule import schedule_headings, schedule_orders
from ..scenario.scenario import Scenario
from ..scenario.tables.autopilot import AutopilotTable
from ..scenario.tables.ship_start import ShipStart
from ..ship.loading.library import load_ship
from ..ship.ship_state import ShipState
from .component import Buffer, Component, Group, Value
from .helm import Autopilot, Evasion, HelmState, Route, Steering, helmed
from .master import System, Wire

__all__ = [
    "Helm", "MakeCollision", "MakeShip", "collision_parameters", "connected", "ship_parameters", "surroundings",
]  # fmt: skip

MakeShip = Callable[[str], Component]
MakeCollision = Callable[[], Component]

RATE_GAIN = 2.0
"""K_d / K_p of an autopilot whose file gives none, in lengths sailed: about what a tanker takes to answer her helm."""
LOOKAHEAD, ACCEPTANCE = 2.5, 2.0
"""Of a route whose file gives none, in lengths: shorter, and a tanker snakes about her track."""
SLOWEST_STEERAGE = 0.1
"""[m^(1/2)/s] Speed / sqrt(L_pp) below which the default rate gain no longer grows: some 2 m/s for a tanker."""


@dataclass
class Helm:
    """The orders of one ship, given at their communication points, and who steers besides (helm.py).

    `headings` are the headings ordered by communication point; `own` and `other` the buffers of the ships' states.
    """

    group: Group
    orders: list[tuple[int, list[float]]] = field(default_factory=list)
    headings: dict[int, float | None] = field(default_factory=dict)
    steering: Steering | None = None
    step: float = 0.0
    state: HelmState = field(default_factory=HelmState)
    own: Buffer | None = None
    other: Buffer | None = None
    _by_hand: tuple[float, float] = (0.0, 0.0)

    def give(self, k: int) -> None:
        """Put what is ordered at communication point k into the buffer and send it; nothing when nothing is."""
        due = self.take(k)
        if self.steering is None:
            if due:
                self.group.write()
            return
        if k in self.headings:
            self.state = self.state._replace(heading=self.headings[k], on_route=False, integral=0.0)
        assert self.own is not None
        other = None if self.other is None else ShipState(*self.other[: len(STATE)])
        ordered, self.state = helmed(
            self.steering, self.state, self._by_hand, ShipState(*self.own[: len(STATE)]), other, self.step
        )
        self.group.values[:] = list(ordered)
        self.group.write()

    def take(self, k: int) -> bool:
        """Put what is ordered at communication point k into the buffer."""
        due = bool(self.orders) and self.orders[0][0] == k
        if due:
            ordered = self.orders.pop(0)[1]
            self._by_hand = ordered[0], ordered[1]
            self.group.values[:] = ordered
        return due


def connected(scenario: Scenario, make_ship: MakeShip, make_collision: MakeCollision) -> tuple[System, list[Helm]]:
    """The scenario's instances, initialised and wired, and the orders that are still to be given.

    Components come from the two functions, which also own them: they are closed there, also when this fails.
    """
    end = scenario.step * scenario.steps
    ships, helms = {}, []
    for name, start in scenario.ships.items():
        ships[name] = make_ship(name)
        helm = _helm(scenario, name, start, ships[name])
        around = ships[name].reals(SURROUNDINGS)
        around.values[:] = surroundings(scenario)
        inputs = [around, helm.group] if helm.take(0) else [around]
        ships[name].initialise(ship_parameters(scenario, name, start), end, inputs)
        helms.append(helm)

    collision = make_collision()
    states, answers = [], []
    answer = ANSWERS[scenario.collision.feedback or "ledger"]
    for name, ship in ships.items():
        outputs = (*STATE, *APPLIED)
        states.append(Wire.between(ship, outputs, collision, named(name, outputs)))
        if answer:
            answers.append(Wire.between(collision, named(name, answer), ship, answer))
    for wire in states:
        wire.outputs.read()
    buffers = dict(zip(ships, (wire.outputs.values for wire in states), strict=True))
    for helm, (name, start) in zip(helms, scenario.ships.items(), strict=True):
        helm.own = buffers[name]
        helm.other = None if start.evasion is None else buffers[start.evasion.of]
    collision.initialise(collision_parameters(scenario), end, [wire.inputs for wire in states])
    for wire in answers:
        wire.outputs.read()
    return System(list(ships.values()), collision, states, answers), helms


def _helm(scenario: Scenario, name: str, start: ShipStart, ship: Component) -> Helm:
    """The helm of a ship; its steering, when it has one, is scaled to her length and speed where the file is silent."""
    helm = Helm(ship.reals(ORDERS), schedule_orders(start, scenario.step), step=scenario.step)
    headings = schedule_headings(start, scenario.step)
    if start.route is None and start.evasion is None and all(heading is None for _, heading in headings):
        return helm
    L_pp = load_ship(scenario.ship_file(name)).L_pp
    pilot, route, evasion = start.autopilot or AutopilotTable(), None, None
    rate_gain = pilot.rate_gain
    if rate_gain is None:
        rate_gain = pilot.gain * RATE_GAIN * L_pp / max(hypot(*start.start.velocity[:2]), SLOWEST_STEERAGE * L_pp**0.5)
    autopilot = Autopilot(pilot.gain, rate_gain, pilot.integral_gain, radians(pilot.rudder_limit_deg))
    if start.route is not None:
        north, east = start.start.position[:2]
        route = Route(
            (north, east),
            tuple((float(n), float(e)) for n, e in start.route.waypoints),
            start.route.lookahead or LOOKAHEAD * L_pp,
            start.route.acceptance or ACCEPTANCE * L_pp,
        )
    if start.evasion is not None:
        table = start.evasion
        evasion = Evasion(
            table.of, table.distance or 0.0, table.time_to_closest or 0.0, radians(table.rudder_deg), table.rev_per_s
        )
    helm.headings, helm.state = dict(headings), HelmState(on_route=route is not None)
    helm.steering = Steering(autopilot, route, evasion)
    return helm


def surroundings(scenario: Scenario) -> list[float]:
    """What every ship is in, in the order of SURROUNDINGS."""
    wind = scenario.environment.wind
    speed, comes_from = (0.0, 0.0) if wind is None else (wind.speed, radians(wind.from_deg))
    return [*map(float, scenario.environment.current), float(speed), comes_from]


def ship_parameters(scenario: Scenario, name: str, ship: ShipStart) -> dict[str, Value]:
    """Parameters of a ship's instance, by their names."""
    start = ship.start
    state = (*start.position, *start.attitude, *start.velocity, *start.rate)
    return {
        "ship": scenario.ship_file(name),
        "degrees_of_freedom": ship.free,
        "hydrodynamics": ship.hydrodynamics,
        **{f"initial.{variable}": value for variable, value in zip(STATE, state, strict=True)},
    }


def collision_parameters(scenario: Scenario) -> dict[str, Value]:
    """Parameters of the collision's instance, by their names."""
    parameters: dict[str, Value] = {}
    for name, ship in scenario.ships.items():
        parameters[f"{name}.ship"] = scenario.ship_file(name)
        parameters[f"{name}.degrees_of_freedom"] = ship.free
        if ship.fender is not None:
            for key, value in ship.fender.model_dump().items():
                parameters[f"{name}.fender.{key}"] = value
    if scenario.obstacles:
        parameters["obstacles"] = obstacles_toml(scenario.obstacles)
    return parameters | scenario.collision.model_dump(exclude_none=True, exclude={"damage"})
