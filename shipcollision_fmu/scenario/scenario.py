"""A scenario: which ships start where, how their contact is modelled, and what was published about it.

All times are whole numbers of communication steps: t_k = k step, never a running sum. An order is held until the next
one; it is given at the first communication point at or after its time. The tables of the file are in cosim/tables.py.
"""

from __future__ import annotations

from math import ceil, radians
from pathlib import Path
from typing import Any

from pydantic import Field, PrivateAttr, ValidationError, model_validator

from ..collision.obstacles import ObstacleTable
from ..errors import ScenarioError, ShipError
from ..ship.loading.library import load_ship, models_directory
from ..ship.loading.messages import one_line, suggestion
from ..ship.loading.toml import parsed, read_toml
from ..ship.ship import Ship
from .initial_overlap import refuse_overlap
from .tables import Algorithm, Collision, Environment, Header, Reference, ShipStart, Table

__all__ = [
    "RESERVED", "Scenario", "heading_table", "load_scenario", "order_table", "scenario_names", "scenario_of",
]  # fmt: skip

RESERVED = frozenset({
    "clearance", "clearance_range", "contact", "energy", "feedback", "fender", "friction", "impact",
    "minimum_separation_time", "obstacles", "response", "restitution", "scratch", "solver", "substep", "time",
})  # fmt: skip
"""Names that no ship may have: the collision FMU's own variables, and the column `time` of states.csv."""


class Scenario(Table):
    """A whole scenario file."""

    scenario: Header
    ships: dict[str, ShipStart] = Field(min_length=1, description="a table [ships.NAME] for each of two or more ships")
    collision: Collision = Collision()
    environment: Environment = Environment()
    obstacles: dict[str, ObstacleTable] = Field(default={}, description="a table [obstacles.NAME] for each")
    reference: Reference | None = None

    _source: str = PrivateAttr(default="scenario")
    _directory: Path = PrivateAttr(default_factory=Path)

    @property
    def name(self) -> str:
        """Name of the scenario; its run is stored under it."""
        return self.scenario.name

    @property
    def step(self) -> float:
        """Communication step [s]."""
        return self.scenario.step

    @property
    def steps(self) -> int:
        """Number of communication steps."""
        return self.scenario.steps

    @property
    def algorithm(self) -> Algorithm:
        """How the master orders its steps."""
        return self.scenario.algorithm

    def ship_file(self, name: str) -> str:
        """What load_ship takes for ship `name`: a shipped model's name, or an absolute path.

        A path in a scenario file is relative to that file.
        """
        ship = self.ships[name].ship
        return str((self._directory / ship).resolve()) if _is_path(ship) else ship

    def load_ships(self) -> dict[str, Ship]:
        """The ships by their names in the scenario; ScenarioError, in one line, for one that cannot be had."""
        return {name: self._load_ship(name) for name in self.ships}

    def check(self) -> None:
        """Raises ScenarioError for ships that cannot be had, and for bodies that start inside each other."""
        ships = self.load_ships()
        if self.collision.response == "bullet":
            for name, ship in ships.items():
                if ship.M_A.any():
                    raise ScenarioError(
                        f"{self._source}: [collision] response = 'bullet' knows a scalar mass only, and [ships.{name}] "
                        f"ship = {self.ships[name].ship!r} has added mass: take 'pgs', or a ship without it"
                    )
        refuse_overlap(self._source, self.ships, ships, self.obstacles)

    def changed(self, *, algorithm: str | None = None, step: float | None = None) -> Scenario:
        """The same scenario with another algorithm or communication step [s]; ScenarioError if that does not fit."""
        options = {key: value for key, value in (("algorithm", algorithm), ("step", step)) if value is not None}
        if not options:
            return self
        data = self.model_dump(exclude_unset=True)
        data["scenario"].update(options)
        said = " and ".join(f"{key} {value}" for key, value in options.items())
        return _validated(data, f"{self._source} with {said}", self._directory)

    def _load_ship(self, name: str) -> Ship:
        start = self.ships[name]
        key = f"{self._source}: [ships.{name}] ship = {start.ship!r}"
        try:
            ship = load_ship(self.ship_file(name))
        except ShipError as error:
            raise ScenarioError(f"{key}: {error}") from None
        if start.hydrodynamics and ship.manoeuvring is None:
            raise ScenarioError(
                f"{key} can only coast, it has no table [manoeuvring]: set hydrodynamics = false, or take one that has"
            )
        return ship

    @model_validator(mode="after")
    def _something_to_meet(self) -> Scenario:
        if len(self.ships) + len(self.obstacles) < 2:
            raise ValueError("[ships] has one ship and nothing to meet: give another [ships.NAME], or [obstacles.NAME]")
        return self

    @model_validator(mode="after")
    def _obstacles_named_apart(self) -> Scenario:
        for name in self.obstacles:
            if not (name.isidentifier() and name.isascii()) or name in self.ships:
                raise ValueError(
                    f"[obstacles.{name}] is no name for an obstacle: take letters, digits and '_', and no ship's name"
                )
        return self

    @model_validator(mode="after")
    def _named_apart(self) -> Scenario:
        for name in self.ships:
            if not (name.isidentifier() and name.isascii()) or name in RESERVED:
                raise ValueError(
                    f"[ships.{name}] is no name for a ship, its FMI variables begin with it: take letters, digits and "
                    f"'_', and none of {', '.join(sorted(RESERVED))}"
                )
        return self

    @model_validator(mode="after")
    def _placed_apart(self) -> Scenario:
        places: dict[tuple[float, ...], str] = {}
        for name, ship in self.ships.items():
            place = tuple(ship.start.position)
            if place in places:
                raise ValueError(f"[ships.{name}] position = {ship.position} is also that of {places[place]}: move one")
            places[place] = name
        return self

    @model_validator(mode="after")
    def _nothing_without_effect(self) -> Scenario:
        end = self.scenario.duration
        for name, ship in self.ships.items():
            if ship.orders and ship.orders[-1].time > end:
                raise ValueError(
                    f"[ships.{name}] orders: time {ship.orders[-1].time:g} s is after the end: must be <= {end:g} s"
                )
            if ship.evasion is not None and ship.evasion.of not in set(self.ships) - {name}:
                of, others = ship.evasion.of, ", ".join(other for other in self.ships if other != name)
                raise ValueError(f"[ships.{name}] evasion: of = {of!r} is no other ship here: take {others}")
        acting = {"current": any(self.environment.current), "wind": self.environment.wind is not None}
        for name, acts in acting.items():
            if acts and not any(ship.hydrodynamics for ship in self.ships.values()):
                raise ValueError(
                    f"[environment] {name} acts on no ship: set hydrodynamics = true for one, or remove {name}"
                )
        return self

    @model_validator(mode="after")
    def _reference_fits(self) -> Scenario:
        if self.reference is None:
            return self
        if self.reference.time > self.scenario.duration:
            raise ValueError(
                f"[reference] time = {self.reference.time:g} s is after the end: must be <= duration = "
                f"{self.scenario.duration:g} s"
            )
        for name in self.reference.ships:
            if name not in self.ships:
                raise ValueError(f"[reference.ships.{name}] is no ship here: the ships are {', '.join(self.ships)}")
        return self


def scenario_names() -> list[str]:
    """Names of the shipped scenarios, sorted."""
    return sorted(path.stem for path in (models_directory() / "scenarios").glob("*.toml"))


def load_scenario(name_or_path: str | Path) -> Scenario:
    """The scenario of a shipped name (`guan2014`) or of a file (`my/scenario.toml`).

    Anything with the suffix .toml or a path separator is a file. Raises ScenarioError, in one line, for a file that
    is missing, is not TOML, or says something that cannot be run, and for ships that cannot be loaded.
    """
    path = _located(name_or_path)
    scenario = _validated(read_toml(path, ScenarioError), path.name, path.parent)
    scenario.check()  # so that everything a file can get wrong is said here
    return scenario


def scenario_of(text: str, source: str, directory: str | Path = ".") -> Scenario:
    """The scenario that TOML text describes; `source` names it in messages, paths of ships start in `directory`.

    Raises ScenarioError as load_scenario does.
    """
    scenario = _validated(parsed(text, source, ScenarioError), source, Path(directory))
    scenario.check()
    return scenario


def order_table(start: ShipStart, step: float) -> list[tuple[int, list[float]]]:
    """Communication points k and what is ordered there: [rudder_order rad, propeller_order rev/s], k rising.

    An order is given at the first communication point at or after its time. A billionth of a step is forgiven, so
    that 0.3 s is 6 steps of 0.05 s; of orders that fall on one point the last counts.
    """
    table: dict[int, list[float]] = {}
    rudder, revolutions = 0.0, 0.0
    for order in start.orders:
        rudder = rudder if order.rudder_deg is None else radians(order.rudder_deg)
        revolutions = revolutions if order.rev_per_s is None else float(order.rev_per_s)
        table[_point(order.time, step)] = [rudder, revolutions]
    return list(table.items())


def heading_table(start: ShipStart, step: float) -> list[tuple[int, float | None]]:
    """Communication points k and the heading to steer from there [rad], None for a rudder by hand; k rising."""
    table: dict[int, float | None] = {}
    for order in start.orders:
        if order.heading_deg is not None or order.rudder_deg is not None:
            heading = None if order.heading_deg is None else radians(order.heading_deg)
            table[_point(order.time, step)] = heading
    return list(table.items())


def _point(time: float, step: float) -> int:
    return ceil(time / step - 1e-9)


def _located(name_or_path: str | Path) -> Path:
    text, names = str(name_or_path), ", ".join(scenario_names())
    if isinstance(name_or_path, Path) or _is_path(text):
        path = Path(text)
        if not path.is_file():
            fault = "is a folder" if path.is_dir() else "does not exist"
            raise ScenarioError(f"scenario file {text} {fault}: give the path of a TOML file or one of {names}")
        return path
    path = models_directory() / "scenarios" / f"{text}.toml"
    if not path.is_file():
        near = suggestion(text, scenario_names())
        raise ScenarioError(f"unknown scenario {text!r}:{near} known: {names}; or give the path of a TOML file")
    return path


def _is_path(text: str) -> bool:
    return text.endswith(".toml") or "/" in text or "\\" in text


def _validated(data: dict[str, Any], source: str, directory: Path) -> Scenario:
    try:
        scenario = Scenario.model_validate(data)
    except ValidationError as error:
        raise ScenarioError(f"{source}: {one_line(error, Scenario)}") from None
    scenario._source, scenario._directory = source, directory
    return scenario
