"""An encounter as the native library reads it, from a scenario."""

from __future__ import annotations

from ctypes import pointer
from math import radians
from typing import Any

from ..collision.feedback import COMMON_FEEDBACKS
from ..collision.interface import CollisionParameters
from ..collision.obstacles import format_obstacles
from ..collision.responses import RESPONSES
from ..cosim.parameters import surroundings
from ..cosim.prepared_files import refuse_response
from ..cosim.scenario_helm import build_steering
from ..errors import ScenarioError
from ..scenario.order_schedule import schedule_headings, schedule_orders
from ..scenario.scenario import Scenario
from ..scenario.tables.ship_start import ShipStart
from ..ship.coasting_law import COASTING
from ..ship.degrees_of_freedom import free_inverse
from ..ship.ship import Ship
from .native_encounters import (
    REAL,
    Autopilot,
    EncounterCase,
    EncounterShip,
    Evasion,
    HeadingOrder,
    HelmTable,
    Point,
    Route,
    RudderOrder,
    as_array,
)
from .prepared_ships import PreparedShips

__all__ = ["make_case"]

NEVER = -1.0
"""Stands for no time after which a separation ends an encounter."""


def make_case(scenario: Scenario, files: PreparedShips, separation: float | None) -> EncounterCase:
    """The encounter of a scenario, with its ships and obstacles in `files`.

    separation: time without contact [s] after which it ends. Raises ScenarioError for a ship that cannot be loaded,
    and for a contact response that needs Python.
    """
    refuse_response(scenario, "simulate() with engine = 'python'")
    if scenario.tracks:
        raise ScenarioError(
            f"{scenario.name}: [ships.{next(iter(scenario.tracks))}] follows a track, which encounters in one call "
            "cannot: take simulate()"
        )
    if scenario.environment.changes:
        raise ScenarioError(
            f"{scenario.name}: [environment] has {len(scenario.environment.changes)} changes, but encounters in one "
            "call keep their current and wind: remove changes, or take simulate()"
        )
    numbers = _collision_numbers(scenario)
    ships = scenario.load_ships()
    order = {name: i for i, name in enumerate(ships)}
    obstacles = scenario.obstacles
    return EncounterCase(
        ships=as_array(
            EncounterShip,
            (
                _make_ship(name, start, ships[name], files.write(ships[name]), order, scenario.step)
                for name, start in scenario.ships.items()
            ),
        ),
        obstacles=files.write_obstacles(format_obstacles(obstacles)).encode(),
        headings=as_array(REAL, (radians(table.heading_deg) for table in obstacles.values())),
        ship_count=len(ships),
        obstacle_count=len(obstacles),
        surroundings=(REAL * 4)(*surroundings(scenario)),
        response=list(RESPONSES).index(numbers.pop("response")),
        feedback=COMMON_FEEDBACKS.index(numbers.pop("feedback")),
        is_parallel=scenario.algorithm == "jacobi",
        steps=scenario.steps,
        step=scenario.step,
        separation=NEVER if separation is None else separation,
        **numbers,
    )


def _collision_numbers(scenario: Scenario) -> dict[str, Any]:
    """Parameters of the collision model, those that the scenario leaves out at their start values."""
    default, given = CollisionParameters([]), scenario.collision
    names = ("friction", "restitution", "substep", "minimum_separation_time", "clearance_range", "response", "feedback")
    values = {name: getattr(given, name) for name in names}
    return {name: getattr(default, name) if value is None else value for name, value in values.items()}


def _make_ship(
    name: str, table: ShipStart, ship: Ship, file: str, order: dict[str, int], step: float
) -> EncounterShip:  # fmt: skip
    start, fender = table.start, table.fender
    state = (*start.position, *start.attitude, *start.velocity, *start.rate)
    return EncounterShip(
        name=name.encode(),
        file=file.encode(),
        degrees_of_freedom=table.free,
        hydrodynamics=bool(table.hydrodynamics),
        coasting=COASTING.index(table.law),
        predicted_coasting=COASTING.index(table.predicted_law),
        fender=(REAL * 3)() if fender is None else (REAL * 3)(fender.stiffness, fender.damping, fender.thickness),
        start=(REAL * 12)(*state),
        inverse=(REAL * 36)(*free_inverse(ship.M, table.free).ravel()),
        helm=_make_helm(table, ship.L_pp, order, step),
    )


def _make_helm(table: ShipStart, L_pp: float, order: dict[str, int], step: float) -> HelmTable:
    orders = schedule_orders(table, step)
    helm = HelmTable(
        orders=as_array(RudderOrder, (RudderOrder(k, 0, *values) for k, values in orders)), order_count=len(orders)
    )
    steering = build_steering(table, L_pp)
    if steering is None:
        return helm
    headings = schedule_headings(table, step)
    helm.headings = as_array(HeadingOrder, (HeadingOrder(k, h is not None, h or 0.0) for k, h in headings))
    helm.heading_count = len(headings)
    autopilot, route, evasion = steering.autopilot, steering.route, steering.evasion
    helm.autopilot = pointer(
        Autopilot(autopilot.gain, autopilot.rate_gain, autopilot.integral_gain, autopilot.rudder_limit)
    )
    if route is not None:
        points = as_array(Point, (Point(*place) for place in (route.start, *route.waypoints)))
        helm.route = pointer(Route(points, len(route.waypoints), 0, route.lookahead, route.acceptance))
    if evasion is not None:
        if table.evasion is not None and table.evasion.until is not None:
            raise ScenarioError(
                f"evasion: until = {table.evasion.until:g} s, but in one call an evasion has no end: remove until, or "
                "take simulate()"
            )
        revolutions = evasion.revolutions
        helm.evasion = pointer(
            Evasion(
                order[evasion.of], revolutions is not None, evasion.distance, evasion.time_to_closest, evasion.rudder,
                revolutions or 0.0,
            )
        )  # fmt: skip
    return helm
