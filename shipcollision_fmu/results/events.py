"""Collisions and scratches, read off a record.

    impulse of a collision    sum of its contact points' impulses, on ship_b, in n
    delta_v of a ship         sum over the steps with contact of R_nb(t_k) [M^-1 Delta impulse], of CO, in n: t_k is
                              the step's start, where a sequential master applies the impulse, and Delta impulse is
                              what the collision FMU issued in the step. A ship in two collisions in one step takes
                              Delta impulse from each one's contact points instead.
    first point of a          the middle of what touched first, as the collision FMU gave it (impact.north ...): of two
    collision                 sides that meet nearly parallel, the middle of the line
    energy                    sum of what its contact points dissipated
    angle                     between the headings, 0 (overtaking) to pi (head-on)
    start, closing speed      as the collision FMU gave them; of all but the last of the collisions that began in one
                              step, from the states at its start
    relative velocity         of ship_a against ship_b at the first point, from the states at the start of that step
    damage                    indicative, from the energy, only when the scenario asks for it (collision/damage.py);
                              the striking bow is that of the ship that was touched farther forward, if that far

A scratch has one point per step, that of the largest impulse; it is kept in both ships' b, where paint keeps it.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import radians
from typing import Any

import numpy as np
import numpy.typing as npt

from ..collision.collisions import heading_angle
from ..fmi.names import AXES, NED, STATE, named
from ..scenario.tables.collision import DamageTable
from ..ship.degrees_of_freedom import free_inverse, tilted_inverse
from ..ship.frames import Array, rotation_vector
from ..ship.ship import Ship
from ..ship.ship_state import ShipState
from .damage import BOW, indicative_damage
from .record import Impact, Record

__all__ = ["events"]

Rows = npt.NDArray[Any]


def events(
    record: Record,
    ships: Mapping[str, Ship],
    free: Mapping[str, int],
    damage: DamageTable | None = None,
    obstacles: Mapping[str, float] | None = None,
) -> dict[str, Any]:
    """{"collisions": [...], "scratches": [...]} as JSON-able data; the schema is results/events.schema.json.

    `free` are the ships' degrees of freedom, `obstacles` the headings [rad] of what is fixed; with `damage` every
    collision has an object of that name.
    """
    contacts = record.contacts
    gained = _velocity_gains(record, ships, free)
    collisions = [
        _collision(int(number), contacts[contacts["impact"] == number], record, gained, obstacles or {})
        for number in np.unique(contacts["impact"])
        if number > 0  # 0: a fender acts, which is no collision
    ]
    if damage is not None:
        collisions = [{**collision, "damage": _damage(collision, ships, damage)} for collision in collisions]
    return {
        "collisions": collisions,
        "scratches": [
            _scratch(int(number), contacts[contacts["scratch"] == number])
            for number in np.unique(contacts["scratch"])
            if number > 0
        ],
    }  # fmt: skip


def _collision(
    number: int, rows: Rows, record: Record, gained: dict[tuple[int, str], Array], obstacles: Mapping[str, float]
) -> dict[str, Any]:
    touching = rows[rows["time"] == rows["time"][0]]
    first = _strongest(touching)
    start = record.impacts.get(number) or _start(touching, record, obstacles)
    impulse = sum((_triple(row, "impulse", NED) for row in rows), start=np.zeros(3))
    pair = [str(first["ship_a"]), str(first["ship_b"])]
    first_point = _middle(first, start, record)
    v_a, v_b = (
        state.velocity_at(np.array(first_point[b]))
        for state, b in zip(_states_before(first, record, obstacles), ("b_a", "b_b"), strict=True)
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
        "delta_v": {name: gained.get((number, name), np.zeros(3)).tolist() for name in pair},  # an obstacle's is none
        "energy": float(rows["energy"].sum()),
    }


def _start(touching: Rows, record: Record, obstacles: Mapping[str, float]) -> Impact:
    """Of a collision that began in the step in which another did, whose start the FMU shows: from the states at the
    start of that step, and the points that touched at its end."""
    states = _states_before(touching[0], record, obstacles)
    closing = 0.0
    for row in touching:
        v_a, v_b = (state.velocity_at(_triple(row, group, AXES)) for state, group in zip(states, "ab", strict=True))
        closing = max(closing, float((v_a - v_b) @ _triple(row, "normal", NED)))
    n, e, d = (sum((_triple(row, None, NED) for row in touching), start=np.zeros(3)) / len(touching)).tolist()
    return Impact(float(touching["time"][0]), closing, heading_angle(*(state.R_nb for state in states)), (n, e, d))


def _before(row: Any, record: Record) -> Any:
    """The states at the start of the step that a row is of."""
    return record.states[max(0, int(np.searchsorted(record.states["time"], row["time"])) - 1)]


def _states_before(row: Any, record: Record, obstacles: Mapping[str, float]) -> list[ShipState]:
    """Those of the pair that a row is of."""
    before = _before(row, record)
    return [
        _state(before, body) if body not in obstacles else ShipState.upright(0.0, 0.0, obstacles[body])
        for body in (str(row["ship_a"]), str(row["ship_b"]))
    ]  # fmt: skip


def _state(states: Any, ship: str) -> ShipState:
    """Of a ship, in a row of the states."""
    return ShipState(*(float(states[f"{ship}.{variable}"]) for variable in STATE))


def _damage(collision: Mapping[str, Any], ships: Mapping[str, Ship], table: DamageTable) -> dict[str, Any]:
    """Indicative damage of a collision, and whose bow struck: the ship's that was first touched farther forward."""
    point = collision["first_point"]
    forward = {
        collision[ship]: point[b][0] / ships[collision[ship]].L_pp
        for ship, b in (("ship_a", "b_a"), ("ship_b", "b_b"))
        if collision[ship] in ships  # an obstacle has no bow
    }
    striking = max(forward, key=lambda name: forward[name])
    by_bow = forward[striking] > BOW
    found = indicative_damage(
        collision["energy"],
        table.t_eq,
        radians(table.half_angle_deg),
        bow_length=ships[striking].L_pp if by_bow else None,
        closing_speed=collision["closing_speed"],
        shells=[(height, thickness) for height, thickness in table.shells],
    )
    return {**found, "striking": striking if by_bow else None}


def _scratch(number: int, rows: Rows) -> dict[str, Any]:
    line = [_strongest(rows[rows["time"] == time]) for time in np.unique(rows["time"])]
    return {
        "id": number,
        "collision": int(line[0]["impact"]),
        "ship_a": str(line[0]["ship_a"]),
        "ship_b": str(line[0]["ship_b"]),
        "start": float(line[0]["time"]),
        "end": float(line[-1]["time"]),
        "first_point": _point(line[0]),
        "time": [float(row["time"]) for row in line],
        "b_a": [_triple(row, "a", AXES).tolist() for row in line],
        "b_b": [_triple(row, "b", AXES).tolist() for row in line],
    }


def _velocity_gains(record: Record, ships: Mapping[str, Ship], free: Mapping[str, int]) -> dict[tuple[int, str], Array]:
    """Change of velocity of CO in n [m/s] by collision and ship; (3,) each."""
    names = list(ships)
    upright = {name: free_inverse(ship.M, free[name]) for name, ship in ships.items()}
    gains: dict[tuple[int, str], Array] = {}
    issued_before = np.zeros((len(names), 6))
    for k, issued in record.issued.items():
        rows = record.contacts[record.contacts["time"] == record.states["time"][k]]
        at = record.states[k - 1]
        for i, name in enumerate(names):
            state = _state(at, name)
            R_nb = state.R_nb
            on_ship = rows[(rows["ship_a"] == name) | (rows["ship_b"] == name)]
            collisions = np.unique(on_ship["impact"])
            for number in collisions:
                wrench = issued[i] - issued_before[i]
                if len(collisions) > 1:
                    wrench = _wrench(on_ship[on_ship["impact"] == number], name, R_nb)
                gain = R_nb @ (tilted_inverse(upright[name], free[name], state.attitude) @ wrench)[:3]
                gains[int(number), name] = gains.get((int(number), name), np.zeros(3)) + gain
        issued_before = issued
    return gains


def _wrench(rows: Rows, name: str, R_nb: Array) -> Array:
    """Impulse of contact points on a ship, in b about CO [N s, N m s]; (6,)."""
    total = np.zeros(6)
    for row in rows:
        is_a = row["ship_a"] == name
        P_b = R_nb.T @ _triple(row, "impulse", NED) * (-1.0 if is_a else 1.0)
        total += np.concatenate([P_b, np.cross(_triple(row, "a" if is_a else "b", AXES), P_b)])
    return total


def _strongest(rows: Rows) -> Any:
    """The row of the largest impulse, the first of equals."""
    return rows[int(np.hypot(rows["impulse_normal"], rows["impulse_tangential"]).argmax())]


def _point(row: Any) -> dict[str, list[float]]:
    n = [float(row[axis]) for axis in NED]
    return {"n": n, "b_a": _triple(row, "a", AXES).tolist(), "b_b": _triple(row, "b", AXES).tolist()}


def _middle(row: Any, start: Impact, record: Record) -> dict[str, list[float]]:
    """The first point of a collision, in n and in b of either ship as she was then; in that of an obstacle `row`'s."""
    n = np.array(start.point)
    before = _before(row, record)
    places = {}
    for body, group in ((str(row["ship_a"]), "a"), (str(row["ship_b"]), "b")):
        places[f"b_{group}"] = _triple(row, group, AXES).tolist()
        if f"{body}.{STATE[0]}" in before.dtype.names:
            state = _state(before, body)
            since = start.time - float(before["time"])
            R_nb = state.R_nb
            x = np.array(state.position) + R_nb @ np.array(state.velocity) * since
            places[f"b_{group}"] = (rotation_vector(np.array(state.rate) * -since) @ R_nb.T @ (n - x)).tolist()
    return {"n": n.tolist(), **places}


def _triple(row: Any, group: str | None, components: tuple[str, ...]) -> Array:
    return np.array([float(row[column]) for column in (components if group is None else named(group, components))])
