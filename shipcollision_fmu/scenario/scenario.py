"""Scenario: a whole scenario file, its checks, and load_scenario().

Keys, units and limits of the file are in tables/. Here are the checks that need more than one table: names, orders
after the end, ships that cannot be loaded, and bodies that overlap at the start (initial_overlap.py).
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import Field, PrivateAttr, ValidationError, model_validator

from ..collision.obstacles import ObstacleTable
from ..collision.ship_names import describe_name_fault, is_identifier, is_ship_name
from ..errors import ScenarioError, ShipError
from ..files import is_file, is_folder
from ..ship.coasting_law import make_coasting
from ..ship.loading.library import find_models, load_ship
from ..ship.loading.messages import describe_error, suggest_or_list
from ..ship.loading.toml import parse_toml, read_toml
from ..ship.ship import Ship
from ..ship.tables.table import Table
from .initial_overlap import refuse_overlap
from .recorded_ships import follow_tracks
from .tables.collision import Collision
from .tables.environment import Environment
from .tables.header import Algorithm, Header
from .tables.place import EVERYWHERE, Place
from .tables.reference import Reference
from .tables.ship_start import ShipStart
from .tracks.track import Track

__all__ = ["Scenario", "list_scenario_names", "load_scenario", "parse_scenario"]


class Scenario(Table):
    """A whole scenario file."""

    scenario: Header = Field(description="the table [scenario]: name, duration, step, algorithm")
    ships: dict[str, ShipStart] = Field(min_length=1, description="a table [ships.NAME] for each of two or more ships")
    collision: Collision = Field(default=Collision(), description="the table [collision]: contact and feedback")
    place: Place | None = Field(default=None, description="the table [place]: where on earth and when")
    environment: Environment = Field(default=Environment(), description="the table [environment]: current and wind")
    obstacles: dict[str, ObstacleTable] = Field(default={}, description="a table [obstacles.NAME] for each")
    reference: Reference | None = Field(default=None, description="the table [reference]: published results")

    _source: str = PrivateAttr(default="scenario")
    _directory: Path = PrivateAttr(default_factory=Path)
    _estimated_ships: dict[str, str] = PrivateAttr(default_factory=dict)

    @property
    def name(self) -> str:
        """Name of the scenario and of the folder of its run."""
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
        """Order of the master's steps."""
        return self.scenario.algorithm

    def ship_file(self, name: str) -> str:
        """The argument of load_ship for ship `name`: a shipped ship's name, or an absolute path.

        A path in a scenario file is relative to that file. A ship with a track and no ship file has one by estimate.
        """
        ship = self.ships[name].ship
        return self._estimated_ships[name] if ship is None else _resolve(ship, self._directory)

    def track_file(self, name: str) -> str:
        """The absolute path of the recording that ship `name` follows, which has a track."""
        track = self.ships[name].track
        assert track is not None
        return str((self._directory / track.file).resolve())

    @property
    def tracks(self) -> dict[str, Track]:
        """The tracks of the ships that have one, by name."""
        return {name: start.recorded for name, start in self.ships.items() if start.recorded is not None}

    @property
    def notes(self) -> list[str]:
        """Sentences on what was done to recorded tracks."""
        return list(dict.fromkeys(note for track in self.tracks.values() for note in track.notes))

    @property
    def somewhere(self) -> Place:
        """The table [place], or the usual one where there is none."""
        return EVERYWHERE if self.place is None else self.place

    def load_ships(self) -> dict[str, Ship]:
        """The ships by name. Raises ScenarioError, in one line, for a ship that cannot be loaded."""
        return {name: self._load_ship(name) for name in self.ships}

    def check(self) -> None:
        """Raise ScenarioError for ships that cannot be loaded, and for bodies that overlap at the start."""
        ships = self.load_ships()
        if self.collision.response == "bullet":
            for name, ship in ships.items():
                if ship.M_A.any():
                    raise ScenarioError(
                        f"{self._source}: [collision] response = 'bullet' supports scalar masses only, and "
                        f"[ships.{name}] ship = {self.ships[name].ship!r} has added mass: take 'pgs', or another ship"
                    )
        refuse_overlap(self._source, self.ships, ships, self.obstacles)

    def changed(self, *, algorithm: str | None = None, step: float | None = None) -> Scenario:
        """The same scenario with another algorithm or communication step [s].

        Raises ScenarioError when the duration is not a whole number of these steps, or the algorithm is unknown.
        """
        options = {key: value for key, value in (("algorithm", algorithm), ("step", step)) if value is not None}
        if not options:
            return self
        data = self.model_dump(exclude_unset=True)
        data["scenario"].update(options)
        return _validate(data, f"{self._source} with another {' and '.join(options)}", self._directory)

    def _load_ship(self, name: str) -> Ship:
        start = self.ships[name]
        key = f"{self._source}: [ships.{name}] ship = {start.ship!r}"
        try:
            ship = load_ship(self.ship_file(name))
        except ShipError as error:  # it names the ship or the file
            raise ScenarioError(f"{self._source}: [ships.{name}] {error}") from None
        if start.hydrodynamics and ship.manoeuvring is None:
            raise ScenarioError(
                f"{key} can only coast, it has no table [manoeuvring]: set hydrodynamics = false, or take "
                "a ship that has it"
            )
        if not start.hydrodynamics:
            try:
                make_coasting(ship, start.free, start.law)
            except ShipError as error:
                raise ScenarioError(f"{key}: {error}") from None
        return ship

    @model_validator(mode="after")
    def _check_two_bodies(self) -> Scenario:
        if len(self.ships) + len(self.obstacles) < 2:
            raise ValueError("[ships] has one ship and nothing to meet: give another [ships.NAME], or [obstacles.NAME]")
        return self

    @model_validator(mode="after")
    def _check_obstacle_names(self) -> Scenario:
        for name in self.obstacles:
            if not is_identifier(name) or name in self.ships:
                raise ValueError(
                    f"[obstacles.{name}] is no name for an obstacle: take letters, digits and '_', and no ship's name"
                )
        return self

    @model_validator(mode="after")
    def _check_ship_names(self) -> Scenario:
        for name in self.ships:
            if not is_ship_name(name):
                raise ValueError(f"[ships.{name}] {describe_name_fault(name)}")
        return self

    @model_validator(mode="after")
    def _check_positions(self) -> Scenario:
        places: dict[tuple[float, ...], str] = {}
        for name, ship in self.ships.items():
            if ship.track is not None:
                continue
            place = tuple(ship.start.position)
            if place in places:
                raise ValueError(f"[ships.{name}] position = {ship.position} is also that of {places[place]}: move one")
            places[place] = name
        return self

    @model_validator(mode="after")
    def _check_tracks(self) -> Scenario:
        tracked = [name for name, ship in self.ships.items() if ship.track is not None]
        if tracked and len(tracked) == len(self.ships):
            raise ValueError("[ships] all follow tracks, and nothing could answer: give a ship without track")
        if tracked and self.collision.response == "bullet":
            raise ValueError(
                f"[collision] response = 'bullet' moves bodies by their mass, and {tracked[0]} follows a track: "
                "take 'pgs'"
            )
        return self

    @model_validator(mode="after")
    def _check_effects(self) -> Scenario:
        end = self.scenario.duration
        for name, ship in self.ships.items():
            if ship.orders and ship.orders[-1].time > end:
                raise ValueError(
                    f"[ships.{name}] orders: time {ship.orders[-1].time:g} s is after the end: must be <= {end:g} s"
                )
            if ship.evasion is not None and ship.evasion.of not in set(self.ships) - {name}:
                of, others = ship.evasion.of, ", ".join(other for other in self.ships if other != name)
                raise ValueError(f"[ships.{name}] evasion: of = {of!r} is no other ship here: take {others}")
        changes = self.environment.changes
        if changes and changes[-1].time > end:
            raise ValueError(
                f"[environment] changes: time {changes[-1].time:g} s is after the end: must be <= {end:g} s"
            )
        acting = {
            "current": any(self.environment.current), "wind": self.environment.wind is not None,
            "changes": bool(changes),
        }  # fmt: skip
        for name, acts in acting.items():
            if acts and not any(ship.hydrodynamics for ship in self.ships.values()):
                raise ValueError(
                    f"[environment] {name} acts on no ship: set hydrodynamics = true for one, or remove {name}"
                )
        return self

    @model_validator(mode="after")
    def _check_reference(self) -> Scenario:
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


def list_scenario_names() -> list[str]:
    """Names of the shipped scenarios, sorted."""
    return sorted(path.stem for path in (find_models() / "scenarios").glob("*.toml"))


def load_scenario(name_or_path: str | Path) -> Scenario:
    """The scenario of a shipped name (`guan2014`) or of a file (`my/scenario.toml`).

    An argument with the suffix .toml or a path separator is a file. Raises ScenarioError, in one line, for a file that
    is missing, is not TOML or cannot be run, for ships that cannot be loaded, and for bodies that overlap at the start.
    """
    path = _locate(_check_source(name_or_path))
    data = read_toml(path, ScenarioError)
    if "particulars" in data and "ships" not in data:
        raise ScenarioError(f"{path.name} is a ship, not a scenario: give a scenario, whose [ships.NAME] ship names it")
    scenario = _validate(data, path.name, path.parent)
    scenario.check()
    return scenario


def parse_scenario(text: str, source: str, directory: str | Path = ".") -> Scenario:
    """The scenario in TOML text; `source` is its name in messages, paths of ships are relative to `directory`.

    Raises ScenarioError as load_scenario does.
    """
    scenario = _validate(parse_toml(text, source, ScenarioError), source, Path(directory))
    scenario.check()
    return scenario


def _check_source(source: str | Path) -> str | Path:
    """The source of a scenario, which is a name or a path. Raises ScenarioError for anything else, and for no text."""
    if not isinstance(source, str | Path) or source == "":
        raise ScenarioError(f"scenario = {source!r} is no scenario: give a name or the path of a TOML file")
    return source


def _locate(name_or_path: str | Path) -> Path:
    text, names = str(name_or_path), ", ".join(list_scenario_names())
    if text.lower().endswith((".json", ".xml")):
        raise ScenarioError(f"{text} is no scenario file: make one with `shipcollision import {text} --out FILE.toml`")
    if isinstance(name_or_path, Path) or _is_path(text):
        path = Path(text)
        if not is_file(path):
            fault = "is a folder" if is_folder(path) else "does not exist"
            raise ScenarioError(f"scenario file {text} {fault}: give the path of a TOML file or one of {names}")
        return path
    path = find_models() / "scenarios" / f"{text}.toml"
    if not is_file(path):
        known = suggest_or_list(text, list_scenario_names(), "give the path of a TOML file")
        raise ScenarioError(f"unknown scenario {text!r}:{known}")
    return path


def _choose_motions(data: dict[str, Any], directory: Path) -> dict[str, Any]:
    """The data with `hydrodynamics` of each ship: true for one with manoeuvring data, unless a key says otherwise."""
    ships = data.get("ships")
    if not isinstance(ships, Mapping):
        return data
    return {**data, "ships": {name: _choose_motion(table, directory) for name, table in ships.items()}}


def _choose_motion(table: Any, directory: Path) -> Any:
    if not isinstance(table, Mapping) or "hydrodynamics" in table or "track" in table:
        return table
    if not isinstance(table.get("ship"), str):
        return table
    try:
        sails = "coasting" not in table and load_ship(_resolve(table["ship"], directory)).manoeuvring is not None
    except ShipError:  # raised again, with the ship's name; until then nothing is said of a ship that coasts
        sails = True
    return {**table, "hydrodynamics": sails}


def _resolve(ship: str, directory: Path) -> str:
    return str((directory / ship).resolve()) if _is_path(ship) else ship


def _is_path(text: str) -> bool:
    return text.endswith(".toml") or "/" in text or "\\" in text


def _validate(data: dict[str, Any], source: str, directory: Path) -> Scenario:
    try:
        scenario = Scenario.model_validate(_choose_motions(data, directory))
    except ValidationError as error:
        raise ScenarioError(f"{source}: {describe_error(error, Scenario)}") from None
    scenario._source, scenario._directory = source, directory
    try:
        duration = scenario.step * scenario.steps
        scenario._estimated_ships = follow_tracks(scenario.ships, scenario.place, directory, duration)
    except ScenarioError as error:
        raise ScenarioError(f"{source}: {error}") from None
    return scenario
