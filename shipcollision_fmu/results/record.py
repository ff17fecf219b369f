"""The record of a run: tables of states, signals and contact points, and the starts of its collisions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy.typing as npt

from ..fmi.names import CONTACT_REALS, ENERGY
from ..ship.frames import Array

__all__ = ["CONTACT_COLUMNS", "SIGNALS", "CollisionStart", "Record"]

CONTACT_COLUMNS = CONTACT_REALS
"""Real columns of contacts.csv."""
SIGNALS = ("clearance", *ENERGY)
"""Columns of signals.csv after the time: variables of the collision FMU [m, J]."""


@dataclass(frozen=True)
class CollisionStart:
    """The start of a collision as the collision FMU shows it: time [s], closing speed [m/s], angle between the headings
    [rad], and the middle of the points that touched first, in n [m]."""

    time: float
    closing_speed: float
    angle: float
    point: tuple[float, float, float]


@dataclass
class Record:
    """The record of a run.

    states     structured array, a row per communication point: time and 12 states per ship
    signals    structured array, a row per communication point: time and SIGNALS
    machinery  structured array, a row per communication point: time, rudder [rad] and revolutions [1/s] of each ship
               that sails; no rows where none does
    contacts   structured array, a row per contact point and step; time is the step's end
    issued     by communication point k that ends a step with contact: cumulative impulses (ships, 6) after the step
    starts     by number of the collision
    energy     dissipated, normal, tangential [J] at the end
    issued_at_end    cumulative impulses (ships, 6) at the end, as the collision FMU issued them
    applied    the same, as the ships applied them
    clearance  least distance between hulls at any communication point [m], capped
    nearest    names of the pair with that clearance, at the first such point; empty if it was never below the cap
    solver     answers that missed the law of contact by more than 1e-9, and answers scaled back so as not to add energy
    fender     energy stored in fenders, and dissipated in them [J], at the end
    """

    states: npt.NDArray[Any]
    signals: npt.NDArray[Any]
    machinery: npt.NDArray[Any]
    contacts: npt.NDArray[Any]
    issued: dict[int, Array]
    starts: dict[int, CollisionStart]
    energy: tuple[float, float, float]
    issued_at_end: Array
    applied: Array
    clearance: float
    nearest: tuple[str, ...] = ()
    fender: tuple[float, float] = (0.0, 0.0)
    solver: tuple[int, int] = (0, 0)
