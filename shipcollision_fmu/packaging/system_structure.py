"""A scenario as a system of FMUs that other hosts can run: instances, start values, connections.

    SHIP           an instance of ShipManoeuvring for each ship, by its name
    collision      the instance of ShipCollision

Some hosts ignore the parameter values of a system description, or have no strings or enumerations. All hosts use the
start values inside an FMU. Therefore every instance has an FMU of its own, whose start values are the scenario's
values; a system description repeats them for people and for the hosts that read them.

A helm is part of our master, not of an FMU. Its orders at time 0 become the start values of the ships' inputs. Later
orders and autopilots are not in the instances: `orders` and `helm` list them, and the writer of a format refuses what
the format cannot hold. The host chooses the algorithm that steps the instances.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import isclose

from ..cosim.component import Value
from ..cosim.parameters import changed_surroundings, collision_parameters, ship_parameters, surroundings
from ..cosim.prepared_files import PreparedFiles, prepare_files
from ..errors import ScenarioError
from ..fmi.names import ANSWERS, APPLIED, ORDERS, STATE, SURROUNDINGS, named
from ..fmi.ship_collision import INTERFACE as COLLISION_INTERFACE
from ..fmi.ship_manoeuvring import INTERFACE as SHIP_INTERFACE
from ..scenario.order_schedule import schedule_orders
from ..scenario.scenario import Scenario
from ..scenario.tables.ship_start import ShipStart
from .foreign_ship import ForeignShip
from .instance import COLLISION, Connection, Instance
from .packed_ship import pack_ship
from .replaced_ship import build_replaced_ship, connect_replaced_ship, describe_replaced_ship, list_frames

__all__ = [
    "SystemStructure",
    "TimedOrder",
    "build_system_structure",
]


@dataclass(frozen=True)
class TimedOrder:
    """An order after time 0: the value of a ship's input from a time [s] on."""

    time: float
    ship: str
    variable: str
    value: float


@dataclass(frozen=True)
class SystemStructure:
    """Instances and connections of a scenario, and its contents that they do not hold.

    orders     orders after time 0, in order of time
    helm       autopilots, routes and evasions, a phrase each ("[ships.own] follows a route")
    left_out   settings of our own master and its results, a sentence each
    replaced   ships whose model is somebody else's FMU
    """

    scenario: Scenario
    instances: tuple[Instance, ...]
    connections: tuple[Connection, ...]
    orders: tuple[TimedOrder, ...] = ()
    helm: tuple[str, ...] = ()
    left_out: tuple[str, ...] = field(default=())
    replaced: tuple[str, ...] = ()

    @property
    def title(self) -> str:
        """Name and description of the scenario, in a line."""
        header = self.scenario.scenario
        said = f": {header.description}" if header.description else ""
        return f"Scenario {header.name}{said}"


def build_system_structure(
    scenario: Scenario,
    fmi: int = 2,
    foreign: Mapping[str, ForeignShip] | None = None,
    native: tuple[str, ...] = (),
) -> SystemStructure:
    """The system of a scenario, for a version of FMI; foreign: ship models of others in place of ours, by ship;
    native: platforms for which ships and collision run without Python.

    Raises ScenarioError for a ship named COLLISION, for a foreign one that is not there, and for a contact response
    that needs Python in a native system; ShipError for a ship file.
    """
    foreign = foreign or {}
    _refuse_what_hosts_cannot_run(scenario, foreign)
    packed = prepare_files(scenario) if native else _pack_files(scenario)
    ships = _build_ships(scenario, packed, foreign, native)
    collision = _build_collision(scenario, packed, foreign, native)
    return SystemStructure(
        scenario=scenario,
        instances=tuple(_time_instance(instance, scenario, fmi) for instance in (*ships, collision)),
        connections=tuple(_connect(scenario, foreign)),
        orders=tuple(order for order in _list_orders(scenario) if order.ship not in foreign),
        helm=tuple(_describe_helms(scenario, foreign)),
        left_out=(*_describe_settings(scenario), *_describe_replaced(scenario, foreign, collision)),
        replaced=tuple(foreign),
    )


def _refuse_what_hosts_cannot_run(scenario: Scenario, foreign: Mapping[str, ForeignShip]) -> None:
    if COLLISION in scenario.ships:
        raise ScenarioError(
            f"[ships.{COLLISION}] cannot be packaged: that is the name of the collision's own instance; rename the ship"
        )
    for name in scenario.tracks:
        raise ScenarioError(
            f"[ships.{name}] follows a recorded track, which only our own master does: remove track and give position, "
            "or take `shipcollision run`"
        )
    for name in foreign:
        if name not in scenario.ships:
            known = ", ".join(scenario.ships)
            raise ScenarioError(f"--replace {name}: {scenario.name} has no such ship: it has {known}")


def _build_ships(
    scenario: Scenario, packed: PreparedFiles, foreign: Mapping[str, ForeignShip], native: tuple[str, ...]
) -> Iterator[Instance]:
    for name, ship in scenario.ships.items():
        if name in foreign:
            yield build_replaced_ship(name, foreign[name], tuple(scenario.ships))
        else:
            yield _build_ship(scenario, name, ship, packed, native)


def _time_instance(instance: Instance, scenario: Scenario, fmi: int) -> Instance:
    """An instance with the scenario's duration and step, for a version of FMI."""
    duration, step = scenario.scenario.duration, scenario.step
    return replace(instance, interface=replace(instance.interface, stop_time=duration, step_size=step), fmi=fmi)


def _connect(scenario: Scenario, foreign: Mapping[str, ForeignShip]) -> Iterator[Connection]:
    for name in scenario.ships:
        yield from (
            connect_replaced_ship(name, foreign[name]) if name in foreign else _list_connections(scenario, name)
        )


def _pack_files(scenario: Scenario) -> PreparedFiles:
    """The same for FMUs with Python, which read ships and obstacles in TOML."""
    packed = {name: pack_ship(name, scenario.ship_file(name)) for name in scenario.ships}
    places = {name: place for name, (place, _) in packed.items()}
    files = {name: needed for name, (_, needed) in packed.items()}
    return PreparedFiles(places, "", files, {})


def _build_ship(
    scenario: Scenario, name: str, ship: ShipStart, packed: PreparedFiles, native: tuple[str, ...]
) -> Instance:
    parameters = {**ship_parameters(scenario, name, ship), **packed.list_ship_values(name)}
    at_start = next((ordered for k, ordered in schedule_orders(ship, scenario.step) if k == 0), [0.0, 0.0])
    inputs: dict[str, Value] = {
        **dict(zip(ORDERS, at_start, strict=True)),
        **dict(zip(SURROUNDINGS, changed_surroundings(scenario).get(0, surroundings(scenario)), strict=True)),
    }
    start = {**parameters, **inputs}
    files = packed.of_ships[name]
    return Instance(name, SHIP_INTERFACE, tuple(scenario.ships), start, tuple(start), files, native=native)


def _build_collision(
    scenario: Scenario, packed: PreparedFiles, foreign: Mapping[str, ForeignShip], native: tuple[str, ...]
) -> Instance:
    parameters = {**collision_parameters(scenario), **packed.list_collision_values()}
    for name, one in foreign.items():
        parameters |= list_frames(name, one)
    states: dict[str, Value] = {}
    for name, ship in scenario.ships.items():
        start = ship.start
        state = (*start.position, *start.attitude, *start.velocity, *start.rate)
        states |= dict(zip(named(name, STATE), state, strict=True))
    return Instance(
        COLLISION, COLLISION_INTERFACE, tuple(scenario.ships), {**parameters, **states}, tuple(parameters),
        packed.list_collision_files(), native=native,
    )  # fmt: skip


def _list_connections(scenario: Scenario, name: str) -> list[Connection]:
    answer = ANSWERS[scenario.collision.feedback or "ledger"]
    return [
        *(Connection(name, variable, COLLISION, f"{name}.{variable}") for variable in (*STATE, *APPLIED)),
        *(Connection(COLLISION, f"{name}.{variable}", name, variable) for variable in answer),
    ]


def _list_orders(scenario: Scenario) -> tuple[TimedOrder, ...]:
    """Rudder and propeller orders, current and wind after time 0, only where they change."""
    found: list[TimedOrder] = []
    changes = list(changed_surroundings(scenario).items())
    for name, start in scenario.ships.items():
        orders = schedule_orders(start, scenario.step)
        found += _list_changes(name, ORDERS, orders, [0.0, 0.0], scenario.step)
        found += _list_changes(name, SURROUNDINGS, changes, surroundings(scenario), scenario.step)
    return tuple(sorted(found, key=lambda order: order.time))


def _list_changes(
    ship: str, variables: Sequence[str], schedule: Sequence[tuple[int, list[float]]], now: list[float], step: float
) -> Iterator[TimedOrder]:
    """Values of inputs of a ship after time 0, which are `now` before the first, by communication point."""
    for k, values in schedule:
        if k > 0:
            for variable, value, before in zip(variables, values, now, strict=True):
                if not isclose(value, before, rel_tol=0.0, abs_tol=0.0):
                    yield TimedOrder(round(k * step, 9), ship, variable, value)
        now = values


def _describe_helms(scenario: Scenario, foreign: Mapping[str, ForeignShip]) -> Iterator[str]:
    for name, start in scenario.ships.items():
        if name in foreign:
            continue
        if any(order.heading_deg is not None for order in start.orders):
            yield f"[ships.{name}] steers a heading by autopilot"
        if start.route is not None:
            yield f"[ships.{name}] follows a route"
        if start.evasion is not None:
            yield f"[ships.{name}] evades {start.evasion.of}"


def _describe_replaced(scenario: Scenario, foreign: Mapping[str, ForeignShip], collision: Instance) -> Iterator[str]:
    for name, ship in foreign.items():
        yield from describe_replaced_ship(name, ship, collision.start, scenario.ships[name].start)


def _describe_settings(scenario: Scenario) -> tuple[str, ...]:
    lines = [
        f"The host chooses the algorithm; the scenario's own is {scenario.algorithm}.",
        f"The scenario's communication step is {scenario.step!r} s, its duration {scenario.scenario.duration!r} s.",
    ]
    if scenario.collision.damage is not None:
        lines.append("[collision] damage is reported by `shipcollision run` only.")
    if scenario.reference is not None:
        lines.append("[reference] is compared by `shipcollision run` only.")
    return tuple(lines)
