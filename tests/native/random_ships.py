"""Ships of random size and type, and the shipped ones, as tables; the same for the same seed."""

from __future__ import annotations

from random import Random
from typing import Any

from shipcollision_fmu.ship.loading.library import list_ship_names, load_ship
from shipcollision_fmu.ship.ship_type import SHIP_TYPES
from tests.ship_files import ship_tables

__all__ = ["COASTING", "SAILING", "draw_sailing_ship"]

SAILING = tuple(name for name in list_ship_names() if load_ship(name).manoeuvring is not None)
COASTING = ("guan2014_target", "guan2014_own_added_mass", "buoy", "kvlcc2", "kcs")


def draw_sailing_ship(random: Random) -> dict[str, Any]:
    """The tables of a ship of random main dimensions, all else estimated by its type."""
    L = random.uniform(25.0, 360.0)
    B = L / random.uniform(4.5, 8.0)
    T = B / random.uniform(2.2, 3.6)
    kind = random.choice(list(SHIP_TYPES))
    return ship_tables(
        ship={"name": f"{kind}, {L:.0f} m", "kind": kind},
        particulars={"L_pp": L, "B": B, "T": T, "mass": 1025.0 * L * B * T * random.uniform(0.5, 0.85), "r_bg": None},
        hull={"depth": 1.6 * T}, manoeuvring={"estimate": True},
        engine={"reversal_delay": random.choice([0.0, random.uniform(1.0, 60.0)])},
        propeller={"astern_factor": random.choice([1.0, random.uniform(0.3, 1.0)])},
    )  # fmt: skip
