"""What native FMUs of a scenario read in place of TOML: its ships and its obstacles, prepared.

A shipped ship keeps its name; a user's becomes ships/NAME.ship among the resources of an FMU, and the obstacles of the
scenario become scenario.obstacles there.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import PurePosixPath

from ..collision.obstacles import format_obstacles
from ..collision.prepared_obstacles import SUFFIX as OBSTACLES
from ..collision.prepared_obstacles import prepare_obstacles
from ..errors import ScenarioError
from ..manoeuvring.prepared_ship import SUFFIX, prepare_ship
from ..scenario.scenario import Scenario, list_scenario_names, load_scenario
from ..ship.loading.library import list_ship_names
from .component import Value

__all__ = ["FOLDER", "NATIVE_RESPONSE", "PreparedFiles", "pack_prepared_ship", "prepare_files", "refuse_response"]

FOLDER = "ships"
"""Folder of ship files in an FMU's resources."""
NATIVE_RESPONSE = "pgs"
"""The only contact response that runs without Python."""
WITH_PYTHON = "packages whose FMUs run Python"
"""What to take for another one."""


@dataclass(frozen=True)
class PreparedFiles:
    """Values of parameters that name files among an FMU's resources, and these files, by place.

    ships         the parameter `ship` by name of the ship
    obstacles     the parameter `obstacles`; empty where the scenario has none, or the FMU takes them as text
    of_ships      files by name of the ship
    of_obstacles  files of the obstacles
    """

    ships: Mapping[str, str]
    obstacles: str
    of_ships: Mapping[str, Mapping[str, bytes]]
    of_obstacles: Mapping[str, bytes]

    def list_ship_values(self, name: str) -> dict[str, Value]:
        """Of the instance of a ship."""
        return {"ship": self.ships[name]}

    def list_collision_values(self) -> dict[str, Value]:
        """Of the instance of the collision."""
        ships: dict[str, Value] = {f"{name}.ship": place for name, place in self.ships.items()}
        return {**ships, "obstacles": self.obstacles} if self.obstacles else ships

    def list_collision_files(self) -> dict[str, bytes]:
        """Those that the instance of the collision needs: all."""
        of_ships = {place: data for files in self.of_ships.values() for place, data in files.items()}
        return {**of_ships, **self.of_obstacles}


def prepare_files(scenario: Scenario, otherwise: str = WITH_PYTHON) -> PreparedFiles:
    """The files of a scenario. Raises ScenarioError for a contact response that needs Python, with what to take
    otherwise; ShipError for a ship."""
    refuse_response(scenario, otherwise)
    packed = {name: pack_prepared_ship(name, scenario.ship_file(name)) for name in scenario.ships}
    of_obstacles = {}
    if scenario.obstacles:
        of_obstacles[f"scenario{OBSTACLES}"] = prepare_obstacles(format_obstacles(scenario.obstacles))
    return PreparedFiles(
        ships={name: place for name, (place, _) in packed.items()},
        obstacles=next(iter(of_obstacles), ""),
        of_ships={name: files for name, (_, files) in packed.items()},
        of_obstacles=of_obstacles,
    )


def refuse_response(scenario: Scenario, otherwise: str) -> None:
    """Raise ScenarioError for a contact response that needs Python. otherwise: how the caller runs Python."""
    if _is_native(scenario):
        return
    names = " and ".join(name for name in list_scenario_names() if _is_native(load_scenario(name)))
    raise ScenarioError(
        f"[collision] response = {scenario.collision.response!r} needs Python, and native code has "
        f"{NATIVE_RESPONSE!r} alone: take {NATIVE_RESPONSE!r}, as the scenarios {names} do, or {otherwise}"
    )


def _is_native(scenario: Scenario) -> bool:
    return scenario.collision.response in (None, NATIVE_RESPONSE)


def pack_prepared_ship(name: str, ship: str) -> tuple[str, dict[str, bytes]]:
    """The value of the parameter `ship` inside a native FMU for the ship called `name`, and the files it needs there.

    ship: the argument of load_ship. Raises ShipError when a file cannot be read.
    """
    if ship in list_ship_names():
        return ship, {}
    place = str(PurePosixPath(FOLDER, f"{name}{SUFFIX}"))
    return place, {place: prepare_ship(ship)}
