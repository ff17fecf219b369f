"""One collision of events.json.

impulse                   sum of its contact points' impulses, on ship_b, in n
delta_v of a ship         see velocity_gains.py
start, closing speed,     as the collision FMU gave them with the contact points (contact[1].start ...): to a substep,
angle, first point        also where several collisions begin in one step. The first point is the middle of the points
                          that touched first; of two sides that meet nearly parallel, the middle of the line. The angle
                          is that between the headings, 0 (overtaking) to pi (head-on)
energy                    sum of the energies that its contact points dissipated
relative velocity         of ship_a against ship_b at the first point, from the states at the start of that step
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..fmi.names import AXES, NED, STATE
from ..ship.frames import Array, rotation_vector
from .contact_rows import Rows, pick_strongest, row_state, row_vector, state_row_before, states_before
from .record import CollisionStart, Record

__all__ = ["build_collision"]


def build_collision(
    number: int, rows: Rows, record: Record, gains: Mapping[tuple[int, str], Array], obstacles: Mapping[str, float]
) -> dict[str, Any]:
    """The collision of that number as JSON-able data, from its contact rows and all ships' velocity gains."""
    first_rows = rows[rows["time"] == rows["time"][0]]
    strongest = pick_strongest(first_rows)
    start = record.starts[number]
    impulse = sum((row_vector(row, "impulse", NED) for row in rows), start=np.zeros(3))
    pair = [str(strongest["ship_a"]), str(strongest["ship_b"])]
    first_point = _first_point(strongest, start, record)
    v_a, v_b = (
        state.velocity_at(np.array(first_point[b]))
        for state, b in zip(states_before(strongest, record, obstacles), ("b_a", "b_b"), strict=True)
    )
    return {
        "id": number,
        "ship_a": pair[0],
        "ship_b": pair[1],
        "start": start.time,
        "end": float(rows["time"][-1]),
        "first_point": first_point,
        "closing_speed": start.closing_speed,
        "relative_velocity": (v_a - v_b).tolist(),
        "angle": start.angle,
        "impulse": {"n": impulse.tolist(), "magnitude": float(np.linalg.norm(impulse))},
        "delta_v": {name: gains.get((number, name), np.zeros(3)).tolist() for name in pair},  # zero for an obstacle
        "energy": float(rows["energy"].sum()),
    }


def _first_point(row: Any, start: CollisionStart, record: Record) -> dict[str, list[float]]:
    """The first point in n, and in b of either ship in its pose at that time; of an obstacle the row's point."""
    n = np.array(start.point)
    before = state_row_before(row, record)
    places = {}
    for body, group in ((str(row["ship_a"]), "a"), (str(row["ship_b"]), "b")):
        places[f"b_{group}"] = row_vector(row, group, AXES).tolist()
        if f"{body}.{STATE[0]}" in before.dtype.names:
            state = row_state(before, body)
            since = start.time - float(before["time"])
            R_nb = state.R_nb
            x = np.array(state.position) + R_nb @ np.array(state.velocity) * since
            places[f"b_{group}"] = (rotation_vector(np.array(state.rate) * -since) @ R_nb.T @ (n - x)).tolist()
    return {"n": n.tolist(), **places}
