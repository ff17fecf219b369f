"""Sample: a run at one time, as the encoders of the protocols need it. SI units, radians; None where it is unknown."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from ...ship.ship_state import ShipState

__all__ = ["CollisionSample", "Sample", "ShipSample", "Wind"]


class Wind(NamedTuple):
    """The wind over ground: speed [m/s] and the direction from which it comes [rad], clockwise from n's north."""

    speed: float
    comes_from: float


class ShipSample(NamedTuple):
    """A ship: its state, rudder [rad] to starboard, revolutions [1/s], whether its engine is lost."""

    state: ShipState
    rudder: float | None = None
    rev_per_s: float | None = None
    is_disabled: bool = False


class CollisionSample(NamedTuple):
    """A collision that has begun: number from 1, time [s], bodies, first point in n [m]."""

    number: int
    time: float
    ship_a: str
    ship_b: str
    point: tuple[float, float, float]


class Sample(NamedTuple):
    """A run at `time` [s] since its start."""

    time: float
    ships: Mapping[str, ShipSample]
    wind: Wind | None = None
    collisions: tuple[CollisionSample, ...] = ()
