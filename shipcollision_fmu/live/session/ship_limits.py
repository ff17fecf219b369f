"""What a ship can be ordered to do, and the check of an order against it.

Telegraph positions are fractions of the largest revolutions, ahead or astern.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from ...errors import InputError, ScenarioError
from ...scenario.scenario import Scenario
from ...ship.loading.messages import suggest_or_list
from ...ship.ship import Ship

__all__ = ["TELEGRAPH", "ShipLimits", "choose_own", "find_limits"]

TELEGRAPH = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Stop, dead slow, slow, half, full: of the largest revolutions."""


@dataclass(frozen=True)
class ShipLimits:
    """Largest rudder angle [deg], and revolutions ahead and astern [1/s], all positive."""

    rudder_deg: float
    ahead: float
    astern: float

    def check_rudder(self, ship: str, angle: float) -> float:
        """The angle [deg]. Raises InputError beyond the limit."""
        most = self.rudder_deg
        return _check(ship, "rudder_deg", angle, -most, most, "deg")

    def check_heading(self, ship: str, heading: float) -> float:
        """The heading [deg]. Raises InputError outside 0 to 360."""
        return _check(ship, "heading_deg", heading, 0.0, 360.0, "deg")

    def check_revolutions(self, ship: str, revolutions: float) -> float:
        """The revolutions [1/s]. Raises InputError beyond the limits."""
        return _check(ship, "rev_per_s", revolutions, -self.astern, self.ahead, "1/s")

    def convert_telegraph(self, ship: str, position: int) -> float:
        """Revolutions [1/s] of a telegraph position. Raises InputError for a position that is none."""
        most = len(TELEGRAPH) - 1
        if type(position) is not int or abs(position) > most:
            raise InputError(
                f"{ship}: telegraph = {position!r} must be a whole number from {-most} (full astern) to {most} (full "
                "ahead): 0 is stop"
            )
        return self.list_telegraph()[position + most]

    def list_telegraph(self) -> list[float]:
        """Revolutions [1/s] of all positions, from full astern to full ahead."""
        astern = [-self.astern * part if part else 0.0 for part in reversed(TELEGRAPH[1:])]
        return [*astern, *(self.ahead * part for part in TELEGRAPH)]


def find_limits(ship: Ship, hydrodynamics: bool) -> ShipLimits | None:
    """The limits of a ship; None for a ship that takes no orders, as it coasts or has no rudder and propeller."""
    if not hydrodynamics or ship.rudder is None or ship.engine is None or ship.propeller is None:
        return None
    return ShipLimits(ship.rudder.max_angle_deg, ship.engine.max_rev_per_s, ship.engine.max_astern_rev_per_s)


def choose_own(scenario: Scenario, ship: str | None) -> str:
    """The ship of the bridge: that of the name, or the first that takes orders.

    Raises ScenarioError for an unknown ship, for one that takes no orders, and for a scenario without any that does.
    """
    ships = scenario.load_ships()
    steerable = [name for name in ships if find_limits(ships[name], bool(scenario.ships[name].hydrodynamics))]
    if ship is not None and ship not in ships:
        raise ScenarioError(f"--ship {ship}: {scenario.name} has no such ship:{suggest_or_list(ship, list(ships))}")
    if not steerable:
        raise ScenarioError(
            f"{scenario.name} has no ship that takes orders, all coast: take one such as kvlcc2_crossing, or a ship "
            "with [manoeuvring] and hydrodynamics = true"
        )
    if ship is not None and ship not in steerable:
        raise ScenarioError(f"--ship {ship} takes no orders, it coasts: take {' or '.join(steerable)}")
    return ship or steerable[0]


def _check(ship: str, key: str, value: float, least: float, most: float, unit: str) -> float:
    if not isinstance(value, int | float) or isinstance(value, bool) or not isfinite(value):
        raise InputError(
            f"{ship}: {key} = {value!r} is not a finite number: give one from {least:g} to {most:g} {unit}"
        )
    if not least <= value <= most:
        raise InputError(f"{ship}: {key} = {value:g} {unit} is beyond what it can: give {least:g} to {most:g} {unit}")
    return float(value)
