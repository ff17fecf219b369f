"""Change of velocity of each ship by each collision.

    delta_v = sum over the steps with contact of R_nb(t_k) [M_free^-1 Delta impulse]        of CO, in n [m/s]

t_k is the step's start, where a sequential master applies the impulse. Delta impulse is the impulse that the collision
FMU issued in the step. A ship in two collisions in one step takes Delta impulse from the contact points of each
collision instead.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np

from ..fmi.names import AXES, NED
from ..ship.degrees_of_freedom import free_inverse, tilted_inverse
from ..ship.frames import Array
from ..ship.ship import Ship
from .contact_rows import Rows, row_state, row_vector
from .record import Record

__all__ = ["velocity_gains"]


def velocity_gains(
    record: Record, ships: Mapping[str, Ship], free: Mapping[str, int], prescribed: Collection[str] = ()
) -> dict[tuple[int, str], Array]:
    """delta_v (3,) by number of the collision and name of the ship; `free` are the degrees of freedom.

    Ships whose motion is `prescribed` gain nothing.
    """
    names = list(ships)
    upright = {name: free_inverse(ship.M, free[name]) for name, ship in ships.items()}
    gains: dict[tuple[int, str], Array] = {}
    issued_before, times = np.zeros((len(names), 6)), record.contacts["time"]
    for k, issued in record.issued.items():
        time = record.states["time"][k]
        rows = record.contacts[np.searchsorted(times, time) : np.searchsorted(times, time, side="right")]
        for i, name in enumerate(names):
            if name in prescribed:
                continue
            state = row_state(record.states[k - 1], name)
            R_nb = state.R_nb
            on_ship = rows[(rows["ship_a"] == name) | (rows["ship_b"] == name)]
            collisions = np.unique(on_ship["impact"])
            for number in collisions:
                wrench = issued[i] - issued_before[i]
                if len(collisions) > 1:
                    wrench = _contact_wrench(on_ship[on_ship["impact"] == number], name, R_nb)
                gain = R_nb @ (tilted_inverse(upright[name], free[name], state.attitude) @ wrench)[:3]
                gains[int(number), name] = gains.get((int(number), name), np.zeros(3)) + gain
        issued_before = issued
    return gains


def _contact_wrench(rows: Rows, name: str, R_nb: Array) -> Array:
    """Impulse of contact points on a ship, in b about CO [N s, N m s]; (6,)."""
    total = np.zeros(6)
    for row in rows:
        is_a = row["ship_a"] == name
        P_b = R_nb.T @ row_vector(row, "impulse", NED) * (-1.0 if is_a else 1.0)
        total += np.concatenate([P_b, np.cross(row_vector(row, "a" if is_a else "b", AXES), P_b)])
    return total
