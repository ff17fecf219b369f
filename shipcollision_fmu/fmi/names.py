"""The names of the FMUs' variables. Tables, masters, recorders and pictures take them from here.

A group of variables is the tuple of their names, in the order of its values. The collision FMU has the groups of each
ship under the ship's name: named("own", POSITION) is ("own.position.north", ...).
"""

from __future__ import annotations

from collections.abc import Sequence

__all__ = [
    "ANGLES", "ANSWERS", "APPLIED", "ATTITUDE", "AXES", "CLEARANCE", "CONTACT", "CONTACT_INTEGERS", "CONTACT_POINT",
    "CONTACT_REALS", "CONTACT_START", "CURRENT", "ENERGY", "FENDER", "FORCE", "HULL", "IMPACT_EVENT", "IMPACT_POINT",
    "IMPULSE", "LINEAR", "MOMENT", "NED", "ORDERS", "POSITION", "POST", "PROPELLER", "PROPELLER_ORDER", "RATE",
    "RUDDER", "RUDDER_ORDER", "STATE", "STEERING", "SURROUNDINGS", "VELOCITY", "WIND", "WIND_DIRECTION", "WIND_SPEED",
    "contact_point", "named",
]  # fmt: skip


def named(group: str, components: Sequence[str]) -> tuple[str, ...]:
    """('position', ('north', ...)) -> ('position.north', ...)."""
    return tuple(f"{group}.{component}" for component in components)


NED = ("north", "east", "down")
"""Components of a vector in n."""
LINEAR = ("surge", "sway", "heave")
"""Components along the axes of b: forward, starboard, down."""
ANGLES = ("roll", "pitch", "yaw")
"""Components about the axes of b, and the angles phi, theta, psi."""
AXES = ("x", "y", "z")
"""Components of a place in b."""

POSITION, ATTITUDE = named("position", NED), named("attitude", ANGLES)
VELOCITY, RATE = named("velocity", LINEAR), named("rate", ANGLES)
STATE = (*POSITION, *ATTITUDE, *VELOCITY, *RATE)
"""The 12 states of a ship, in the order of states.csv."""
POST = "post"
"""Prefix of the states that the collision FMU gives back."""
IMPULSE = named("impulse", (*LINEAR, *ANGLES))
"""Cumulative impulse in b about CO [N s, N m s]."""
APPLIED = named("impulse_applied", (*LINEAR, *ANGLES))
"""What the ship has applied of it."""
FORCE, MOMENT = named("force", LINEAR), named("moment", ANGLES)
"""External force on a ship, in b about CO [N, N m]."""
ANSWERS: dict[str, tuple[str, ...]] = {"ledger": IMPULSE, "force": (*FORCE, *MOMENT), "none": ()}
"""What the collision FMU sends to a ship, by `feedback`."""
HULL, PROPELLER, RUDDER, WIND = (
    named(origin, (*LINEAR, *ANGLES)) for origin in ("hull", "propeller", "rudder", "wind")
)  # fmt: skip
"""Forces on a ship by origin, in b about CO [N, N m]."""
ORDERS = RUDDER_ORDER, PROPELLER_ORDER = "rudder_order", "propeller_order"
"""What a helm gives [rad, rev/s]."""
STEERING = ("rudder_angle", "propeller_speed")
"""What the ship makes of the orders [rad, rev/s]."""
CURRENT = named("current", NED[:2])
WIND_SPEED, WIND_DIRECTION = "wind.speed", "wind.direction"
SURROUNDINGS = (*CURRENT, WIND_SPEED, WIND_DIRECTION)
"""Water and air around a ship [m/s, rad]."""

CONTACT_REALS = (
    *NED, *named("normal", NED), "gap", "impulse_normal", "impulse_tangential", *named("impulse", NED), "energy",
    *named("a", AXES), *named("b", AXES), *named("couple", NED),
)  # fmt: skip
"""Real variables of a contact point: the point and the normal (from ship_a to ship_b) in n, the impulse on ship_b in n,
the places in both ships' b, the moment of the impulses about the point in n."""
CONTACT_INTEGERS = ("ship_a", "ship_b", "impact", "scratch")
"""Its Integers."""
CONTACT_START = ("start", *named("first", NED), "closing_speed", "angle")
"""Real variables of a contact point about its collision: when and where it began, and how."""
IMPACT_POINT = named("impact", NED)
"""First contact point of the latest collision, in n [m]."""
IMPACT_EVENT = named("impact", ("count", "time", "closing_speed", "angle", "ship_a", "ship_b"))
"""The latest collision but for its place."""
CONTACT = ("contact.active", "contact.count", "scratch.id")
"""Whether hulls touch."""
CONTACT_POINT = ("gap", "impulse_normal", "impulse_tangential", "energy", *CONTACT_INTEGERS)
"""A contact point but for vectors."""
CLEARANCE = ("clearance", "nearest.ship_a", "nearest.ship_b")
FENDER = named("fender", ("stored", "dissipated"))
"""Energy in fenders [J]."""
ENERGY = named("energy", ("dissipated", "normal", "tangential"))
"""Kinetic energy lost to contact [J]."""


def contact_point(number: int) -> str:
    """Prefix of the variables of a contact point; the first is number 1."""
    return f"contact[{number}]"
