"""Names of the ships of a collision model: the FMU's variables of a ship begin with its name."""

from __future__ import annotations

from collections.abc import Sequence

from ..errors import InputError

__all__ = ["RESERVED", "check_ship_names", "describe_name_fault", "is_identifier", "is_ship_name"]

RESERVED = frozenset({
    "clearance", "clearance_range", "contact", "diagnosis", "energy", "feedback", "fender", "friction", "impact",
    "minimum_separation_time", "nearest", "obstacles", "response", "restitution", "scratch", "solver", "substep",
    "time",
})  # fmt: skip
"""Names that no ship may have: the collision FMU's own variables begin so, and states.csv has a column `time`."""


def describe_name_fault(name: object) -> str:
    """What a message says of a name that is_ship_name refuses."""
    if name in RESERVED:
        return "is no name for a ship, since variables of ShipCollision have it: take another"
    return "is no name for a ship, whose FMI variables begin with it: take letters, digits and '_', no digit first"


def is_identifier(name: object) -> bool:
    """Whether `name` is text of ASCII letters, digits and '_' that begins with no digit."""
    return isinstance(name, str) and name.isidentifier() and name.isascii()


def is_ship_name(name: object) -> bool:
    """Whether a ship may have `name`."""
    return is_identifier(name) and name not in RESERVED


def check_ship_names(names: Sequence[str]) -> tuple[str, ...]:
    """The names of the ships of a model as a tuple. One ship is enough, as it may meet obstacles.

    Raises InputError for no names, for a name that no ship may have, and for two equal names.
    """
    if isinstance(names, str) or not isinstance(names, Sequence) or not names:
        raise InputError(f"ships = {names!r} must be a tuple of one or more names, such as ('own', 'target')")
    for i, name in enumerate(names):
        if not is_ship_name(name):
            raise InputError(f"ships: {name!r} {describe_name_fault(name)}")
        if name in names[:i]:
            raise InputError(f"ships: {name!r} is there twice: give each ship a name of its own")
    return tuple(names)
