"""What the ship model takes and gives, as plain lists and attributes.

Reals are lists of stable identity: they are filled, never replaced, so that a caller may hold on to them.
"""

from __future__ import annotations

from dataclasses import dataclass, field

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
    substep (one entry): the longest internal step of the hydrodynamics [s].
    """

    ship: str = "kvlcc2"
    degrees_of_freedom: int = 6
    hydrodynamics: bool = False
    initial_position: list[float] = field(default_factory=three)
    initial_attitude: list[float] = field(default_factory=three)
    initial_velocity: list[float] = field(default_factory=three)
    initial_rate: list[float] = field(default_factory=three)
    substep: list[float] = field(default_factory=lambda: [0.05])


@dataclass
class ShipInputs:
    """orders: rudder [rad], propeller [1/s]. current: north, east, towards [m/s]. wind: speed [m/s], direction that it
    comes from [rad], clockwise from north. impulse: cumulative [N s, N m s]. force: held over the step [N, N m]. Both
    (6), in b about CO."""

    orders: list[float] = field(default_factory=two)
    current: list[float] = field(default_factory=two)
    wind: list[float] = field(default_factory=two)
    impulse: list[float] = field(default_factory=six)
    force: list[float] = field(default_factory=six)


@dataclass
class ShipOutputs:
    """position in n [m]; attitude (phi, theta, psi) [rad], psi without jumps; velocity over ground and rate in b about
    CO [m/s, rad/s]; actuators: rudder angle [rad], propeller speed [1/s]; impulse_applied: cumulative, as the input
    impulse; hull, propeller, rudder, wind: forces by origin, (6), in b about CO [N, N m]."""

    position: list[float] = field(default_factory=three)
    attitude: list[float] = field(default_factory=three)
    velocity: list[float] = field(default_factory=three)
    rate: list[float] = field(default_factory=three)
    actuators: list[float] = field(default_factory=two)
    impulse_applied: list[float] = field(default_factory=six)
    hull: list[float] = field(default_factory=six)
    propeller: list[float] = field(default_factory=six)
    rudder: list[float] = field(default_factory=six)
    wind: list[float] = field(default_factory=six)
