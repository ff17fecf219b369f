"""Parameters of the FMUs' instances from a scenario, by the names of the FMUs' variables."""

from __future__ import annotations

from math import radians
from typing import Any

import numpy as np
import numpy.typing as npt

from ..collision.feedback import PRESCRIBED
from ..collision.obstacles import format_obstacles
from ..fmi.names import STATE, SURROUNDINGS
from ..scenario.order_schedule import find_point
from ..scenario.scenario import Scenario
from ..scenario.tables.environment import EnvironmentChange, WindTable
from ..scenario.tables.ship_start import ShipStart
from .component import Value

__all__ = [
    "change_surroundings", "changed_surroundings", "collision_parameters", "ship_parameters", "surroundings",
    "tabulate_surroundings",
]  # fmt: skip


def surroundings(scenario: Scenario) -> list[float]:
    """Current and wind around every ship, in the order of SURROUNDINGS."""
    around = scenario.environment
    return [*map(float, around.current), *_wind_values(around.wind)]


def changed_surroundings(scenario: Scenario) -> dict[int, list[float]]:
    """The same by communication point from which they act, for the changes of [environment]. Of changes that fall on
    one point the last counts."""
    values, changes = surroundings(scenario), dict[int, list[float]]()
    for change in scenario.environment.changes:
        values = change_surroundings(values, change)
        changes[find_point(change.time, scenario.step)] = values
    return changes


def change_surroundings(values: list[float], change: EnvironmentChange) -> list[float]:
    """The surroundings after a change of the surroundings `values`."""
    current = values[:2] if change.current is None else list(map(float, change.current))
    return [*current, *(values[2:] if change.wind is None else _wind_values(change.wind))]


def tabulate_surroundings(scenario: Scenario) -> npt.NDArray[Any]:
    """The same as a structured array: a row at time 0, and one at each time [s] from which another row counts."""
    rows = {0: surroundings(scenario), **changed_surroundings(scenario)}
    return np.array(
        [(round(k * scenario.step, 9), *values) for k, values in rows.items() if k < scenario.steps],
        dtype=[(column, np.float64) for column in ("time", *SURROUNDINGS)],
    )


def _wind_values(wind: WindTable | None) -> list[float]:
    return [0.0, 0.0] if wind is None else [float(wind.speed), radians(wind.from_deg)]


def ship_parameters(scenario: Scenario, name: str, ship: ShipStart) -> dict[str, Value]:
    """Parameters of a ship's instance."""
    start = ship.start
    state = (*start.position, *start.attitude, *start.velocity, *start.rate)
    return {
        "ship": scenario.ship_file(name),
        "degrees_of_freedom": ship.free,
        "hydrodynamics": bool(ship.hydrodynamics),
        "coasting": ship.law,
        **{f"initial.{variable}": value for variable, value in zip(STATE, state, strict=True)},
    }


def collision_parameters(scenario: Scenario) -> dict[str, Value]:
    """Parameters of the collision's instance."""
    parameters: dict[str, Value] = {}
    for name, ship in scenario.ships.items():
        parameters[f"{name}.ship"] = scenario.ship_file(name)
        parameters[f"{name}.degrees_of_freedom"] = ship.free
        parameters[f"{name}.coasting"] = ship.predicted_law
        if ship.track is not None:
            parameters[f"{name}.feedback"] = PRESCRIBED
        if ship.fender is not None:
            for key, value in ship.fender.model_dump().items():
                parameters[f"{name}.fender.{key}"] = value
    if scenario.obstacles:
        parameters["obstacles"] = format_obstacles(scenario.obstacles)
    return parameters | scenario.collision.model_dump(exclude_none=True, exclude={"damage"})
