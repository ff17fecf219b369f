"""estimate_energies(): what the closed forms give for the rows of a study, from what is known before an impact.

Each formula has the added masses of its source. Place and normal are the nominal ones of read_impacts.py.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...ship.frames import Array
from .minorsky import minorsky_energy
from .pedersen_zhang import PedersenZhang, pedersen_zhang, pedersen_zhang_ships
from .planar_impact import PlanarShips
from .popov import popov_energy, popov_ships
from .read_impacts import read_column, read_impacts, read_table

__all__ = ["ClosedForms", "estimate_energies", "make_published_ships"]


@dataclass(frozen=True, eq=False)
class ClosedForms:
    """Energies [J] after Minorsky and Popov (n,), and the answers after Pedersen and Zhang."""

    minorsky: Array
    popov: Array
    pedersen_zhang: PedersenZhang


def estimate_energies(encounters: Any) -> ClosedForms:
    """The closed forms for a table of encounters of level `impact` (n lines), beside its `energy`.

    encounters   a pyarrow.Table, or a frame of pandas or polars

    Raises StudyError for what is no such table, and for rows of another level, or with a restitution.
    """
    encounters = read_table(encounters)
    popovs = [_make_popov_ships(encounters, role) for role in ("own", "target")]
    published = [make_published_ships(encounters, role) for role in ("own", "target")]
    return ClosedForms(
        minorsky_energy(
            read_column(encounters, "own_mass"), read_column(encounters, "target_mass"),
            read_column(encounters, "own_speed"), np.radians(read_column(encounters, "angle_deg")),
        ),
        popov_energy(read_impacts(encounters, *popovs, contact="nominal")),
        pedersen_zhang(read_impacts(encounters, *published, contact="nominal")),
    )  # fmt: skip


def make_published_ships(encounters: Any, role: str) -> PlanarShips:
    """The ships of a role, own or target, with the added masses of Pedersen and Zhang."""
    return pedersen_zhang_ships(read_column(encounters, f"{role}_L_pp"), read_column(encounters, f"{role}_mass"))


def _make_popov_ships(encounters: Any, role: str) -> PlanarShips:
    L, B, T, mass = (read_column(encounters, f"{role}_{name}") for name in ("L_pp", "B", "T", "mass"))
    return popov_ships(L, B, T, mass)
