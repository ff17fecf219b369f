"""Names of the FMUs' variables that others read, write and record, each group in the order of its values."""

from __future__ import annotations

from collections.abc import Sequence

from .variables import ANGLES, LINEAR, NED

__all__ = ["ANSWERS", "APPLIED", "IMPULSE", "ORDERS", "STATE", "SURROUNDINGS", "named"]


def named(group: str, components: Sequence[str]) -> tuple[str, ...]:
    """('position', ('north', ...)) -> ('position.north', ...)."""
    return tuple(f"{group}.{component}" for component in components)


STATE = (
    *named("position", NED), *named("attitude", ANGLES), *named("velocity", LINEAR), *named("rate", ANGLES),
)  # fmt: skip
"""The 12 states of a ship, in the order of states.csv."""
IMPULSE = named("impulse", (*LINEAR, *ANGLES))
"""Cumulative impulse in b about CO [N s, N m s]."""
APPLIED = named("impulse_applied", (*LINEAR, *ANGLES))
"""What the ship has applied of it."""
ANSWERS: dict[str, tuple[str, ...]] = {
    "ledger": IMPULSE, "force": (*named("force", LINEAR), *named("moment", ANGLES)), "none": (),
}  # fmt: skip
"""What the collision FMU sends to a ship, by `feedback`."""
ORDERS = ("rudder_order", "propeller_order")
"""What a helm gives [rad, rev/s]."""
SURROUNDINGS = ("current.north", "current.east", "wind.speed", "wind.direction")
"""What a ship is in [m/s, rad]."""
