"""A ship on a straight course at a steady speed: where a trial begins, and what revolutions keep the speed."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from ...errors import ScenarioError
from ...ship.loading.library import load_ship
from ...ship.ship import Ship
from ..model import ShipManoeuvring

__all__ = ["STEP", "SteadyCourse", "find_self_propulsion", "find_steady_course", "make_model"]

STEP = 0.005
"""Of a trial, in lengths at the approach speed: 0.2 s for a tanker. Half as long moves no figure by 0.3 %."""
FASTEST = 50.0
"""[m/s] A higher approach speed is one in another unit."""


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
        """Of the trial [s]."""
        return STEP * self.ship.L_pp / self.speed


def find_steady_course(
    name: str, *, speed: float | None = None, rev_per_s: float | None = None, degrees_of_freedom: int = 3
) -> SteadyCourse:
    """The ship `name` (or of a file) on her approach; without a speed [m/s], at her service speed.

    Without revolutions, those that go with the speed: the file's service revolutions in proportion, else those of
    self-propulsion. Raises ShipError for a ship that cannot be had, ScenarioError for a speed that she does not reach.
    """
    ship = load_ship(name)
    if ship.propeller is None or ship.manoeuvring is None or ship.engine is None:
        raise ScenarioError(
            f"ship {name!r} has no [manoeuvring] with [propeller], so she can only coast: take one that is listed as "
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
    """Revolutions [1/s] at which a ship keeps her speed [m/s] on a straight course.

    From the file's service point in proportion to the speed where it has one, so that a trial of a model tested off her
    own balance is sailed as the test was; else where the propeller's thrust equals the resistance.
    """
    ship = load_ship(name)
    propeller, most = ship.propeller, 0.0 if ship.engine is None else ship.engine.max_rev_per_s
    if propeller is not None and propeller.service_speed is not None and propeller.service_rev_per_s is not None:
        rev_per_s = propeller.service_rev_per_s * speed / propeller.service_speed
    elif _compute_surge_force(name, speed, most) < 0.0:
        raise ScenarioError(f"ship {name!r} does not reach {speed:g} m/s with her engine's {most:g} rev/s: go slower")
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
            f"ship {name!r} needs {rev_per_s:.4g} rev/s for {speed:g} m/s; must be above 0 and at most her engine's "
            f"{most:g}: take a lower speed, or more revolutions"
        )


def make_model(name: str, speed: float, rev_per_s: float, degrees_of_freedom: int = 3) -> ShipManoeuvring:
    """Her model, set to a straight course at a speed [m/s] and not yet initialised."""
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
