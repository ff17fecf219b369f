"""A ship on a straight course at a steady speed: where a trial begins, and the revolutions that keep the speed."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from ...errors import ScenarioError
from ...ship.loading.library import load_ship
from ...ship.ship import Ship
from ..model import ShipManoeuvring

__all__ = ["STEP", "SteadyCourse", "find_self_propulsion", "find_steady_course", "make_model"]

STEP = 0.005
"""Time step of a trial, in lengths at the steady speed: 0.2 s for a tanker. Half of it moves no figure by 0.3 %."""
FASTEST = 50.0
"""[m/s] A higher speed is a number in another unit."""


@dataclass(frozen=True)
class SteadyCourse:
    """A ship on a straight course: its file, speed [m/s], revolutions [1/s], degrees of freedom."""

    name: str
    ship: Ship
    speed: float
    rev_per_s: float
    degrees_of_freedom: int = 3

    @property
    def step(self) -> float:
        """Time step of the trial [s]."""
        return STEP * self.ship.L_pp / self.speed


def find_steady_course(
    name: str, *, speed: float | None = None, rev_per_s: float | None = None, degrees_of_freedom: int = 3
) -> SteadyCourse:
    """The steady course of the ship `name` (or of a file), by default at its service speed [m/s].

    By default the revolutions [1/s] are those of find_self_propulsion. Raises ShipError for a ship that cannot be
    loaded, and ScenarioError for a speed that it does not reach.
    """
    ship = load_ship(name)
    if ship.propeller is None or ship.manoeuvring is None or ship.engine is None:
        raise ScenarioError(
            f"ship {name!r} has no [manoeuvring] with [propeller], so it can only coast: take one that is listed as "
            "manoeuvring by `shipcollision ships`"
        )
    service = ship.propeller.service_speed
    if speed is None:
        if service is None:
            raise ScenarioError(f"ship {name!r} gives no service_speed in [propeller]: give --speed in m/s")
        speed = service
    if not (isfinite(speed) and 0.0 < speed <= FASTEST):
        raise ScenarioError(f"speed = {speed:g} m/s must be above 0 and at most {FASTEST:g}: give metres per second")
    if rev_per_s is None:
        rev_per_s = find_self_propulsion(name, speed)
    _check_engine(name, speed, rev_per_s, ship.engine.max_rev_per_s)
    return SteadyCourse(name, ship, speed, rev_per_s, degrees_of_freedom)


def find_self_propulsion(name: str, speed: float) -> float:
    """Revolutions [1/s] at which a ship keeps a speed [m/s] on a straight course.

    They are in proportion to the speed from the file's service point where the file has one. A trial of a ship model
    that was tested away from its own balance is then sailed as the test was. Without a service point, the revolutions
    are those at which the propeller's thrust equals the resistance.
    """
    ship = load_ship(name)
    propeller, most = ship.propeller, 0.0 if ship.engine is None else ship.engine.max_rev_per_s
    if propeller is not None and propeller.service_speed is not None and propeller.service_rev_per_s is not None:
        rev_per_s = propeller.service_rev_per_s * speed / propeller.service_speed
    elif _compute_surge_force(name, speed, most) < 0.0:
        raise ScenarioError(f"ship {name!r} does not reach {speed:g} m/s with its engine's {most:g} rev/s: go slower")
    else:
        low, rev_per_s = 0.0, most
        for _ in range(60):
            middle = 0.5 * (low + rev_per_s)
            low, rev_per_s = (middle, rev_per_s) if _compute_surge_force(name, speed, middle) < 0.0 else (low, middle)
    _check_engine(name, speed, rev_per_s, most)
    return rev_per_s


def _check_engine(name: str, speed: float, rev_per_s: float, most: float) -> None:
    if not (isfinite(rev_per_s) and 0.0 < rev_per_s <= most):
        raise ScenarioError(
            f"ship {name!r} needs {rev_per_s:.4g} rev/s for {speed:g} m/s; must be above 0 and at most its engine's "
            f"{most:g}: take a lower speed, or more revolutions"
        )


def make_model(name: str, speed: float, rev_per_s: float, degrees_of_freedom: int = 3) -> ShipManoeuvring:
    """The ship's model on a straight course at a speed [m/s], not yet initialised."""
    model = ShipManoeuvring()
    parameters = model.parameters
    parameters.ship, parameters.degrees_of_freedom, parameters.hydrodynamics = name, degrees_of_freedom, True
    parameters.initial_velocity[0] = speed
    model.inputs.propeller_order = rev_per_s
    return model


def _compute_surge_force(name: str, speed: float, rev_per_s: float) -> float:
    model = make_model(name, speed, rev_per_s)
    model.initialise()
    o = model.outputs
    return o.hull[0] + o.propeller[0] + o.rudder[0]
