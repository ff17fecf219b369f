"""Indicative damage from the energy of a collision: published correlations, each named where its number is used.

    Minorsky 1959    E = 47.2 R_T + 32.7            E [MJ], R_T volume of destroyed steel [m3]; for E >> 33 MJ only
    Woisin 1979      E = 47.2 R_T + 1/2 sum H t^2   H height of the rupture in a shell [m], t its thickness [cm]
    Pedersen 1993    bow against a rigid wall (EN 1991-1-7, annex C):
                     L' = L/275,  E' = E/1425 [MJ],  F_0 = 210 MN
                     P = F_0 L' sqrt(E' + (5 - L') L'^1.6)  [MN]    for E' >= L'^2.6
                     P = 2.24 F_0 sqrt(E' L')               [MN]    else
                     s = pi E / (2 P)  crush of the bow,     T = 1.67 s / V  duration
    wedge            R_T = t_eq delta^2 tan(phi)    penetration delta [m] of a bow of half-angle phi; t_eq [m]: plate
                     thickness of decks and bottoms of both ships, summed over the depth that overlaps

No value of this module enters the dynamics. The bow takes all of the energy in Pedersen's formula, the side all of it
in Minorsky's: two bounds, because the sharing between bow and side is not computed. The overlap of hulls in the contact
model is numerical and never reported as damage.

Sources: Minorsky (1959), constants in SI; Woisin (1979); Pedersen (1993), as in EN 1991-1-7, annex C. The wedge
estimate is this project's own.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import pi, sqrt, tan
from typing import Any

from ..errors import InputError

__all__ = [
    "BOW", "bow_crush", "bow_force", "crush_duration", "estimate_damage", "minorsky_volume", "wedge_penetration",
    "woisin_volume",
]  # fmt: skip

MJ, MN = 1e6, 1e6
STEEL = 47.2
"""Energy per volume of destroyed steel [MJ/m3]: Minorsky's 414.5 (long tons, knots, square feet times inches) in SI."""
SHELL = 32.7
"""Energy at which Minorsky's line has no volume [MJ]. Below it the line gives no volume, and little is sure near it."""
BOW = 0.3
"""Share of L_pp ahead of midship from which a contact counts as one of the bow. Less, and a side would be a bow."""


def minorsky_volume(energy: float) -> float:
    """Volume of destroyed steel R_T [m3] of both ships from the energy [J]; 0 below 32.7 MJ."""
    return max(0.0, (energy / MJ - SHELL) / STEEL)


def woisin_volume(energy: float, shells: Sequence[tuple[float, float]]) -> float:
    """R_T [m3] from the energy [J]; `shells`: (height of the rupture, thickness) [m] of every side shell torn open."""
    ruptured = 0.5 * sum(height * (100.0 * thickness) ** 2 for height, thickness in shells)
    return max(0.0, (energy / MJ - ruptured) / STEEL)


def bow_force(energy: float, length: float) -> float:
    """Greatest force [N] on the bow of a ship of `length` L_pp [m] that gives the energy [J] to a rigid wall."""
    E, L = max(energy, 0.0) / MJ / 1425.0, length / 275.0
    if E >= L**2.6:
        return 210.0 * MN * L * sqrt(E + (5.0 - L) * L**1.6)
    return 2.24 * 210.0 * MN * sqrt(E * L)


def bow_crush(energy: float, length: float) -> float:
    """Length [m] by which the bow of bow_force is crushed."""
    return pi * energy / (2.0 * bow_force(energy, length)) if energy > 0.0 else 0.0


def crush_duration(crush: float, speed: float) -> float:
    """Duration [s] of a crush of the length [m] from the approach speed [m/s]."""
    return 1.67 * crush / speed


def wedge_penetration(volume: float, t_eq: float, half_angle: float) -> float:
    """Penetration [m] into the side of a bow wedge of half-angle [rad] that destroys the volume [m3]."""
    return sqrt(volume / (t_eq * tan(half_angle)))


def estimate_damage(
    energy: float,
    t_eq: float,
    half_angle: float,
    *,
    bow_length: float | None,
    closing_speed: float | None,
    shells: Sequence[tuple[float, float]] = (),
) -> dict[str, Any]:
    """The object "damage" of a collision, JSON-able: energy [J], and by method its formula and values in SI.

    bow_length: L_pp [m] of the ship whose bow strikes. None, and there is neither crush nor penetration.
    Raises InputError for t_eq or half_angle [rad] out of range.
    """
    if not t_eq > 0.0:
        raise InputError(
            f"damage: t_eq = {t_eq:g} m must be > 0: sum the plate thicknesses of decks and bottoms, e.g. 0.1"
        )
    if not 0.0 < half_angle < 0.5 * pi:
        raise InputError(
            f"damage: half angle = {half_angle:g} rad must be between 0 and pi/2: give that of the bow, e.g. 0.5"
        )
    volume = minorsky_volume(energy)
    damage: dict[str, Any] = {
        "indicative": True,
        "energy": energy,
        "minorsky_1959": {"formula": "R_T = (E/MJ - 32.7)/47.2", "destroyed_volume": volume},
    }
    if shells:
        damage["woisin_1979"] = {
            "formula": "R_T = (E/MJ - sum(H (t/cm)^2)/2)/47.2",
            "destroyed_volume": woisin_volume(energy, shells),
        }
    if bow_length is None:
        return damage
    crush = bow_crush(energy, bow_length)
    damage["pedersen_1993"] = {
        "formula": "P = F_0 L' sqrt(E' + (5 - L') L'^1.6) or 2.24 F_0 sqrt(E' L'); s = pi E/(2 P); T = 1.67 s/V",
        "assumption": "rigid wall: the bow takes all energy",
        "peak_force": bow_force(energy, bow_length),
        "crush_length": crush,
        "duration": crush_duration(crush, closing_speed) if closing_speed else None,
    }
    damage["wedge"] = {
        "formula": "delta = sqrt(R_T/(t_eq tan(phi))), R_T of Minorsky",
        "t_eq": t_eq,
        "half_angle": half_angle,
        "penetration": wedge_penetration(volume, t_eq, half_angle),
    }
    return damage
