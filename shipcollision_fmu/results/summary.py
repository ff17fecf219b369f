"""summary.json: the balance of a run, of impulses, momentum and energy.

    ledger     per ship: impulse issued by the collision FMU, impulse applied by the ship, and the difference, pending;
               cumulative, in b about CO [N s, N m s]. An impulse that jacobi issues in the last step stays pending. A
               ship that follows a recorded track applies all: its track takes it
    momentum   M nu of every ship, summed: linear in n [N s], angular in n about the scenario's origin [N m s]. nu is in
               b, or in level axes for 3 and 4 degrees of freedom (ship/kinetic_energy.py)
    closed     of momentum: whether the ships' linear momentum must be the same after as before. An obstacle takes some;
               water, rudder and propeller change it, and so does coasting with added mass, which turns with the hull,
               while the velocity does not
    energy     kinetic energy of every ship [J]; the energy that contact dissipated, along the normals and across them;
               the energy stored in fenders and dissipated by them, which is counted apart
    place      latitude, longitude of n's origin and time at time 0, where the scenario gives them
    solver     answers of the contact solver that missed the law by more than 1e-9 of the approach, and answers that
               were scaled back because they would have added energy
    obstacles  by name: the impulse that the obstacle took, in n [N s]. An obstacle has no momentum of its own

M = M_RB + M_A is that of the ship file. Ships that coast without added mass keep linear momentum outside contact. They
also keep their energy, if they turn about a principal axis.

The summary depends neither on the machine's speed nor on whether FMUs or models in process ran; timing.json does.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import reduce
from importlib.metadata import PackageNotFoundError, version
from operator import add  # sum() rounds otherwise from Python 3.12 on
from typing import Any

import numpy as np

from .. import __version__
from ..collision.interface import CollisionParameters
from ..fmi.names import STATE
from ..scenario.scenario import Scenario
from ..scenario.tables.ship_start import ShipStart
from ..ship.frames import Array, rotation
from ..ship.kinetic_energy import kinetic_energy, motion_twist
from ..ship.ship import Ship
from .published import compare_published
from .record import Record

__all__ = ["build_summary"]

_PACKAGES = {"python": ("numpy", "pybullet", "FMPy", "pythonfmu"), "native": ("numpy", "FMPy")}
"""Whose versions are stated, by engine."""


def build_summary(
    scenario: Scenario, ships: Mapping[str, Ship], record: Record, events: Mapping[str, Any], engine: str = "python"
) -> dict[str, Any]:
    """summary.json as JSON-able data; `events` are the run's events. `engine` is stated where it is not "python"."""
    before, after = (_states(record, ships, row) for row in (0, -1))
    free = {name: table.free for name, table in scenario.ships.items()}
    data: dict[str, Any] = {
        "scenario": scenario.name,
        "description": scenario.scenario.description,
        "versions": {"shipcollision_fmu": __version__} | {name.lower(): _version(name) for name in _PACKAGES[engine]},
        **({} if engine == "python" else {"engine": engine}),
        "algorithm": scenario.algorithm,
        "step": scenario.step,
        "steps": scenario.steps,
        "duration": scenario.step * scenario.steps,
        "ships": {name: _ship(scenario, name, ship) for name, ship in ships.items()},
        "collisions": len(events["collisions"]),
        "scratches": len(events["scratches"]),
        "least_clearance": record.clearance,
        "nearest": list(record.nearest),
        "clearance_range": scenario.collision.clearance_range or CollisionParameters([]).clearance_range,
        "ledger": {
            name: {"issued": issued.tolist(), "applied": applied.tolist(), "pending": (issued - applied).tolist()}
            for name, issued, applied in _list_ledgers(scenario, record)
        },
        "momentum": {
            "before": _momentum(ships, free, before),
            "after": _momentum(ships, free, after),
            "closed": _is_momentum_closed(scenario, ships, record),
        },
        "solver": dict(zip(("unconverged", "scaled"), record.solver, strict=True)),
        "obstacles": {
            name: {"kind": table.kind, "impulse": _impulse_on_obstacle(record, name)}
            for name, table in scenario.obstacles.items()
        },
        "energy": {
            "before": _energy(ships, free, before),
            "after": _energy(ships, free, after),
            **dict(zip(("dissipated", "normal", "tangential"), record.energy, strict=True)),
            **dict(zip(("fender_stored", "fender_dissipated"), record.fender, strict=True)),
        },
    }
    if scenario.place is not None:
        data["place"] = scenario.place.model_dump(mode="json")
    if scenario.reference is not None:
        data["reference"] = {"source": scenario.reference.source, "time": scenario.reference.time}
        data["paper"] = compare_published(scenario.reference, record.states, ships)
    return data


def _list_ledgers(scenario: Scenario, record: Record) -> Iterator[tuple[str, Array, Array]]:
    """Name, impulse issued and impulse applied of each ship. A recorded track takes all at once."""
    for name, issued, applied in zip(scenario.ships, record.issued_at_end, record.applied, strict=True):
        yield name, issued, issued if name in scenario.tracks else applied


def _is_momentum_closed(scenario: Scenario, ships: Mapping[str, Ship], record: Record) -> bool:
    kept = all(_keeps_momentum(table, ships[name]) for name, table in scenario.ships.items())
    return kept and not any(name in scenario.obstacles for name in record.contacts["ship_b"].tolist())


def _keeps_momentum(table: ShipStart, ship: Ship) -> bool:
    """Whether the momentum of ship and water stays while the ship coasts."""
    if table.hydrodynamics or table.track is not None:
        return False
    if table.law == "straight":
        return not bool(ship.M_A.any())
    return table.law == "free" or table.free == 3


def _ship(scenario: Scenario, name: str, ship: Ship) -> dict[str, Any]:
    return {
        "ship": ship.name,
        "mass": ship.mass,
        "degrees_of_freedom": scenario.ships[name].free,
        "hydrodynamics": bool(scenario.ships[name].hydrodynamics),
        "coasting": None if scenario.ships[name].hydrodynamics else scenario.ships[name].law,
        "estimated": list(ship.estimated),
        **_identity(scenario, name),
    }


def _identity(scenario: Scenario, name: str) -> dict[str, Any]:
    """What a ship follows, and what it tells by AIS, where the scenario says so."""
    start = scenario.ships[name]
    identity: dict[str, Any] = {}
    if start.recorded is not None:
        identity["track"] = {"mmsi": start.recorded.mmsi}
    if start.ais is not None:
        identity["ais"] = start.ais.model_dump(exclude_unset=True)
    return identity


def _states(record: Record, ships: Mapping[str, Ship], row: int) -> dict[str, Array]:
    return {name: np.array([float(record.states[f"{name}.{s}"][row]) for s in STATE]) for name in ships}


def _momentum(
    ships: Mapping[str, Ship], free: Mapping[str, int], states: Mapping[str, Array]
) -> dict[str, list[float]]:
    linear, angular = np.zeros(3), np.zeros(3)
    for name, state in states.items():
        R = _axes(state[3:6], free[name])
        p = ships[name].M @ motion_twist(state[3:6], state[6:12], free[name])
        p_n = R @ p[:3]
        linear += p_n
        angular += R @ p[3:] + np.cross(state[:3], p_n)
    return {"linear": linear.tolist(), "angular": angular.tolist()}


def _axes(attitude: Array, free: int) -> Array:
    """To n, (3, 3), from the axes of the motions that M is of: those of b, or level ones."""
    return rotation(attitude if free == 6 else [0.0, 0.0, attitude[2]])


def _impulse_on_obstacle(record: Record, obstacle: str) -> list[float]:
    rows = record.contacts[record.contacts["ship_b"] == obstacle]
    return [float(rows[f"impulse.{axis}"].sum()) for axis in ("north", "east", "down")]


def _energy(ships: Mapping[str, Ship], free: Mapping[str, int], states: Mapping[str, Array]) -> dict[str, float]:
    kinetic = {
        name: float(kinetic_energy(ships[name].M, state[3:6], state[6:12], free[name]))
        for name, state in states.items()
    }
    return kinetic | {"total": reduce(add, kinetic.values())}


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:  # installed by copying
        return None
