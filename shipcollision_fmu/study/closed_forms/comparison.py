"""The energy of a study's rows as a share of what the closed forms give: by angle, and by what is known of the contact.

compare_by_angle       each formula as its source has it, by angle between the headings, sticking and sliding
compare_by_knowledge   Pedersen and Zhang with one more part of the simulation from line to line, down to where both
                       solve the same problem
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array
from ...ship.ship import Ship
from .energies import estimate_energies, make_published_ships
from .pedersen_zhang import pedersen_zhang
from .planar_impact import PlanarShips
from .read_impacts import Contact, read_column, read_impacts

__all__ = ["ANGLES", "AngleClass", "Knowledge", "Spread", "compare_by_angle", "compare_by_knowledge"]

ANGLES = (15.0, 45.0, 75.0, 105.0, 135.0, 165.0)
"""Limits of the classes [deg]: those of 30, 60, 90, 120 and 150 degrees."""
INNER = 0.05, 0.95
"""90 % of the cases lie between these quantiles."""
LEVEL = 1e-6
"""Vertical part of a normal up to which it counts as level. Level ones are below 1e-9, leaning ones above 1e-3."""


@dataclass(frozen=True)
class Spread:
    """Ratios of the energy of the simulation to that of a formula: how many, the median, and what 90 % lie between."""

    cases: int
    median: float
    low: float
    high: float

    @classmethod
    def of(cls, ratios: Array) -> Spread:
        """That of the ratios that are no NaN; NaN throughout where there are none."""
        there = ratios[np.isfinite(ratios)]
        if not len(there):
            return cls(0, np.nan, np.nan, np.nan)
        low, median, high = np.quantile(there, [INNER[0], 0.5, INNER[1]])
        return cls(len(there), float(median), float(low), float(high))


@dataclass(frozen=True)
class AngleClass:
    """Cases between two angles [deg] that stick, or that slide, after Pedersen and Zhang."""

    least: float
    most: float
    sticks: bool
    minorsky: Spread
    popov: Spread
    pedersen_zhang: Spread


@dataclass(frozen=True)
class Knowledge:
    """What the formula of Pedersen and Zhang is given, in words; all cases, those that stick, those that slide."""

    words: str
    all: Spread
    stick: Spread
    slide: Spread


def compare_by_angle(encounters: Any) -> list[AngleClass]:
    """The classes that have a case. Raises StudyError as estimate_energies does."""
    energy, forms = read_column(encounters, "energy"), estimate_energies(encounters)
    angle, sticks = read_column(encounters, "angle_deg"), forms.pedersen_zhang.sticks
    classes = []
    for least, most in pairwise(ANGLES):
        for is_stick in (True, False):
            of = (angle >= least) & (angle < most) & (sticks == is_stick)
            spreads = (
                Spread.of(energy[of] / E[of]) for E in (forms.minorsky, forms.popov, forms.pedersen_zhang.energy)
            )  # fmt: skip
            classes.append(AngleClass(least, most, is_stick, *spreads))
    return [found for found in classes if found.pedersen_zhang.cases]


def compare_by_knowledge(encounters: Any, ships: Mapping[str, Ship]) -> list[Knowledge]:
    """Line by line one more part that is known; then the cases of the last line by what still differs.

    ships: those that the table names. Raises StudyError as estimate_energies does.
    """
    published = estimate_energies(encounters).pedersen_zhang
    inertia = [
        PlanarShips.of([ships[name] for name in encounters.column(f"{role}_ship").to_pylist()])
        for role in ("own", "target")
    ]
    in_yaw = [
        replace(make_published_ships(encounters, role), J_z=ships_of.J_z)
        for role, ships_of in zip(("own", "target"), inertia, strict=True)
    ]
    energy = read_column(encounters, "energy")
    lines = [_know("the added masses of the source", energy / published.energy, published.sticks)]
    known: tuple[tuple[str, list[PlanarShips], Contact], ...] = (
        ("and the ships' own yaw inertia", in_yaw, "nominal"),
        ("and their own surge and sway mass", inertia, "nominal"),
        ("and the place of the contact", inertia, "place"),
        ("and the normal in plan", inertia, "found"),
    )
    for words, of, contact in known:
        answers = pedersen_zhang(read_impacts(encounters, *of, contact=contact))
        lines.append(_know(words, energy / answers.energy, answers.sticks))
    several, leans = read_column(encounters, "contacts") > 1.0, np.abs(read_column(encounters, "normal_z")) > LEVEL
    back = answers.turns_back
    for words, those in (
        ("of these, one point and a level normal", ~(back | several | leans)),
        ("of these, one point and a normal that leans", leans & ~(back | several)),
        ("of these, several points", several & ~back),
        ("of these, the slip turns back", back),
    ):
        lines.append(_know(words, (energy / answers.energy)[those], answers.sticks[those]))
    return lines


def _know(words: str, ratios: Array, sticks: npt.NDArray[np.bool_]) -> Knowledge:
    return Knowledge(words, Spread.of(ratios), Spread.of(ratios[sticks]), Spread.of(ratios[~sticks]))
