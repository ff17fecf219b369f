"""Parameters, inputs and outputs of the ship model: numbers by name, and vectors as lists.

The lists keep their identity: they are filled, never replaced, so that a caller may hold on to them.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from ..ship.coasting_law import COASTING

__all__ = ["ShipInputs", "ShipOutputs", "ShipParameters"]


def two() -> list[float]:
    """Two zeros, as a field of its own."""
    return [0.0] * 2


def three() -> list[float]:
    """Three zeros."""
    return [0.0] * 3


def six() -> list[float]:
    """Six zeros."""
    return [0.0] * 6


@dataclass
class ShipParameters:
    """Which ship, how it moves, and its state at the start: n [m], (phi, theta, psi) [rad], b [m/s], [rad/s], about CO.

    degrees_of_freedom: 3 (surge, sway, yaw), 4 (and roll) or 6: what moves.
    substep: the longest internal step of the hydrodynamics [s].
    coasting: how the ship moves without hydrodynamics, "kirchhoff", "free" or "straight" (ship/coasting_law.py).
    """

    ship: str = "kvlcc2"
    degrees_of_freedom: int = 6
    hydrodynamics: bool = False
    initial_position: list[float] = field(default_factory=three)
    initial_attitude: list[float] = field(default_factory=three)
    initial_velocity: list[float] = field(default_factory=three)
    initial_rate: list[float] = field(default_factory=three)
    substep: float = 0.05
    coasting: str = COASTING[0]


@dataclass
class ShipInputs:
    """Inputs, held over a step.

    rudder_order [rad]; propeller_order [1/s]
    current           velocity of the water towards north and east [m/s]
    wind_speed        of the air over ground [m/s]; wind_direction: where it comes from, clockwise from north [rad]
    impulse           cumulative, (6) in b about CO [N s, N m s]
    force             external force and moment, (6) in b about CO [N, N m]
    """

    rudder_order: float = 0.0
    propeller_order: float = 0.0
    current: list[float] = field(default_factory=two)
    wind_speed: float = 0.0
    wind_direction: float = 0.0
    impulse: list[float] = field(default_factory=six)
    force: list[float] = field(default_factory=six)


@dataclass
class ShipOutputs:
    """Outputs: the ship at the end of a step.

    position          of CO in n [m]
    attitude          (phi, theta, psi) [rad], psi without jumps
    velocity, rate    of CO over ground, and angular, in b [m/s, rad/s]
    rudder_angle [rad]; propeller_speed [1/s]
    impulse_applied   cumulative, as the input impulse
    hull, propeller, rudder, wind    forces by origin, (6) in b about CO [N, N m]
    """

    position: list[float] = field(default_factory=three)
    attitude: list[float] = field(default_factory=three)
    velocity: list[float] = field(default_factory=three)
    rate: list[float] = field(default_factory=three)
    rudder_angle: float = 0.0
    propeller_speed: float = 0.0
    impulse_applied: list[float] = field(default_factory=six)
    hull: list[float] = field(default_factory=six)
    propeller: list[float] = field(default_factory=six)
    rudder: list[float] = field(default_factory=six)
    wind: list[float] = field(default_factory=six)
