"""events.json: the collisions (collision_events.py) and scratches (scratch_events.py) of a record.

A collision is an episode of contact between two bodies. With `damage` in the scenario it has an object of that name:
indicative damage from the energy (damage.py). The striking bow is then that of the ship whose first point lies farther
forward, if the point lies ahead of BOW.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from math import radians
from typing import Any

import numpy as np

from ..scenario.tables.collision import DamageTable
from ..ship.ship import Ship
from .collision_events import build_collision
from .contact_rows import Rows
from .damage import BOW, estimate_damage
from .record import Record
from .scratch_events import build_scratch
from .velocity_gains import velocity_gains

__all__ = ["build_events"]


def build_events(
    record: Record,
    ships: Mapping[str, Ship],
    free: Mapping[str, int],
    damage: DamageTable | None = None,
    obstacles: Mapping[str, float] | None = None,
    prescribed: Collection[str] = (),
) -> dict[str, Any]:
    """{"collisions": [...], "scratches": [...]} as JSON-able data; the schema is results/events.schema.json.

    `free` are the ships' degrees of freedom, `obstacles` the headings [rad] of what is fixed,
    `prescribed` the ships that follow a track.
    """
    gains = velocity_gains(record, ships, free, prescribed)
    collisions = [
        build_collision(number, rows, record, gains, obstacles or {})
        for number, rows in _group(record.contacts, "impact")  # 0: a fender acts, which is no collision
    ]
    if damage is not None:
        collisions = [{**collision, "damage": _damage(collision, ships, damage)} for collision in collisions]
    scratches = [build_scratch(number, rows) for number, rows in _group(record.contacts, "scratch")]
    return {"collisions": collisions, "scratches": scratches}


def _group(contacts: Rows, column: str) -> Iterator[tuple[int, Rows]]:
    """The rows by the number in a column, from 1."""
    for number in np.unique(contacts[column]):
        if number > 0:
            yield int(number), contacts[contacts[column] == number]


def _damage(collision: Mapping[str, Any], ships: Mapping[str, Ship], table: DamageTable) -> dict[str, Any]:
    """Indicative damage of a collision, and the ship whose bow struck, None if no bow did."""
    point = collision["first_point"]
    forward = {
        collision[ship]: point[b][0] / ships[collision[ship]].L_pp
        for ship, b in (("ship_a", "b_a"), ("ship_b", "b_b"))
        if collision[ship] in ships  # an obstacle has no bow
    }
    striking = max(forward, key=lambda name: forward[name])
    by_bow = forward[striking] > BOW
    damage = estimate_damage(
        collision["energy"],
        table.t_eq,
        radians(table.half_angle_deg),
        bow_length=ships[striking].L_pp if by_bow else None,
        closing_speed=collision["closing_speed"],
        shells=[(height, thickness) for height, thickness in table.shells],
    )
    return {**damage, "striking": striking if by_bow else None}
