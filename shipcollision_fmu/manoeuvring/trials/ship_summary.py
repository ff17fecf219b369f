"""The figures of a ship that a user wants to see before sailing it: stability, roll period, speed, power, stopping."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan

from ...errors import ScenarioError, ShipError
from ...ship.roll_period import compute_is_code_period, compute_natural_period
from ...ship.seakeeping import compute_seakeeping
from ...ship.ship import Ship
from ..model import ShipManoeuvring
from .steady_course import find_steady_course
from .trials import sail_crash_stop

__all__ = ["ShipSummary", "summarise_ship"]


@dataclass(frozen=True)
class ShipSummary:
    """Figures of a ship in SI units; nan where the ship has none, with the reason in `notes`.

    KG above the keel, GM_T, roll period of its own inertia and that of the Intact Stability Code; service speed and
    revolutions; rated power; pull on the spot at full ahead; track reach and time of a crash stop from service speed.
    """

    ship: Ship
    KG: float
    GM_T: float
    roll_period: float
    code_period: float
    service_speed: float
    service_rev_per_s: float
    power: float
    bollard_pull: float
    track_reach: float
    time_to_stop: float
    notes: tuple[str, ...]


def summarise_ship(name: str, ship: Ship) -> ShipSummary:
    """The figures of the ship that `name` (or a path) loads. A crash stop is sailed for it in 3 degrees of freedom."""
    notes: list[str] = []
    GM = roll = code = nan
    try:
        GM = compute_seakeeping(ship).GM_T
        roll = compute_natural_period(ship.M, ship.mass, GM)
        code = compute_is_code_period(ship.L_pp, ship.B, ship.T, GM)
    except ShipError as error:
        notes.append(str(error))
    speed = n = power = pull = reach = time = nan
    if ship.propeller is None or ship.manoeuvring is None or ship.engine is None:
        notes.append("it coasts: no [manoeuvring] with [propeller]")
    else:
        speed, n = ship.propeller.service_speed or nan, ship.propeller.service_rev_per_s or nan
        power = ship.engine.power or nan
        pull = _find_bollard_pull(name, ship.engine.max_rev_per_s, 1.0 - ship.propeller.t_P)
        try:
            stop = sail_crash_stop(find_steady_course(name))
            reach, time = stop["track reach"] * ship.L_pp, stop["time to stop"]
        except ScenarioError as error:
            notes.append(str(error))
    return ShipSummary(
        ship, ship.T - float(ship.r_bg[2]), GM, roll, code, speed, n, power, pull, reach, time, tuple(notes)
    )


def _find_bollard_pull(name: str, rev_per_s: float, remaining: float) -> float:
    """Thrust of the propeller on the spot [N]."""
    model = ShipManoeuvring()
    model.parameters.ship, model.parameters.degrees_of_freedom, model.parameters.hydrodynamics = name, 3, True
    model.inputs.propeller_order = rev_per_s
    model.initialise()
    return model.outputs.propeller[0] / remaining
