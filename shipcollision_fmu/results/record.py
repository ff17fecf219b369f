"""A run as recorded: tables of states, signals and contact points, and the starts of its collisions."""

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
    """The start of a collision, as the collision FMU gave it: time [s], closing speed [m/s], angle [rad], and the
    middle of what touched first, in n [m]."""

    time: float
    closing_speed: float
    angle: float
    point: tuple[float, float, float]


@dataclass
class Record:
    """A run as recorded.

    states     structured array, a row per communication point: time and 12 states per ship
    signals    structured array, a row per communication point: time and SIGNALS
    contacts   structured array, a row per contact point and step; time is the step's end
    issued     per communication point k that ends a step with contact: cumulative impulses (ships, 6) after it
    starts    by number of the collision; one is missing when another began in the same communication step
    energy     dissipated, normal, tangential [J] at the end
    applied    what the ships say they applied at the end (ships, 6); the final `issued` is `issued_at_end`
    clearance  least distance between hulls at any communication point [m], capped
    nearest    between which, at the first of them: two names, none if they were never within the cap
    solver     answers that did not meet the law of contact to 1e-9, and answers scaled back so as not to add energy
    fender     stored in fenders, dissipated in them [J] at the end
    """

    states: npt.NDArray[Any]
    signals: npt.NDArray[Any]
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
