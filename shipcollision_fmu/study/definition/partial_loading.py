"""load_partially(): the tables of a ship at a lesser draught.

    T' = s T,   C_b' = 1 - (1 - C_b) / s^(1/3)

C_b' follows Riddlesworth's relation for the block coefficient at draughts other than the loaded one, in Barrass and
Derrett, Ship Stability for Masters and Mates, and in Molland, The Maritime Engineering Reference Book; known from
secondary sources. The hull keeps its depth, so its deck rises above the water; rake and flare become steeper, so that
the deck keeps its outline. Mass, stability, added mass and manoeuvring are estimated at the new draught, as for a ship
file with its main dimensions alone.
"""

from __future__ import annotations

from math import atan, degrees, radians, tan
from typing import Any

from ...errors import ShipError
from ...ship.ship import Ship

__all__ = ["find_block_coefficient", "load_partially"]


def find_block_coefficient(C_b: float, share: float) -> float:
    """C_b' at the draught share T."""
    return float(1.0 - (1.0 - C_b) * share ** (-1.0 / 3.0))


def load_partially(ship: Ship, share: float) -> dict[str, Any]:
    """The tables of the ship at the draught share T. Raises ShipError for a ship with a hull from a mesh."""
    if ship.hull.shape == "mesh":
        raise ShipError("a hull from a mesh has one draught: take loading = 1, or a parametric hull")
    hull = ship.hull.model_dump(exclude_unset=True, exclude_none=True)
    freeboard, risen = ship.hull.depth - ship.T, ship.hull.depth - share * ship.T
    for key in ("stem_rake_deg", "flare_deg"):
        if key in hull:
            hull[key] = degrees(atan(tan(radians(hull[key])) * max(freeboard, 0.0) / risen))
    return {
        "ship": {"name": ship.name, "kind": ship.kind, "source": f"{ship.source} Loaded to {share:g} of its draught."},
        "particulars": {
            "L_pp": ship.L_pp, "L_oa": ship.L_oa, "B": ship.B, "T": share * ship.T, "rho": ship.rho,
            "C_b": find_block_coefficient(ship.C_b, share),
        },
        "hull": hull,
        "manoeuvring": {"estimate": True},
    }  # fmt: skip
