"""The one table of variables of a model.

A table is a tuple of `Variable`. Names, units, causality, description and the place of the value in the model are
written there and nowhere else; modelDescription.xml, the accessors, the documentation and the tests follow from it.
**The value reference of a variable is its position in the table.**

    TABLE = (
        *vector("output", "position", NED, "m", "outputs.position", "Position of CO in n"),
        *wrench("input", "impulse", "impulse", IMPULSE, "inputs.impulse", "Cumulative impulse in b about CO"),
        real("input", "rudder_order", "rad", "inputs.rudder_order", None, "Ordered rudder angle"),
        integer("parameter", "degrees_of_freedom", "parameters.degrees_of_freedom", "3, 4 or 6", minimum=3, maximum=6),
        boolean("parameter", "hydrodynamics", "parameters.hydrodynamics", "false: the ship coasts"),
        string("parameter", "ship", "parameters.ship", "Name of a ship, or path of a TOML file"),
        enumeration("parameter", "response", ("pgs", "bullet"), "parameters.response", "Contact response"),
    )

`path` leads from the model to the value: attribute names and list positions joined by dots
("inputs.ships.0.position"). `index` is the position in the list found there, or None when the path ends at the value
itself. Start values are the model's own, of a model freshly made.

FMI 2.0 has scalars only; FMI 3.0 has arrays. A line names the array that it is an element of there: a vector is one by
itself, a block of lines that repeats ("contact[1].gap", "contact[2].gap") says so by `array`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from .units import UNITS

__all__ = [
    "ANGLES", "FORCE", "IMPULSE", "LINEAR", "NED", "Array", "Causality", "Kind", "Table", "Variable", "boolean",
    "enumeration", "integer", "real", "string", "vector", "wrench",
]  # fmt: skip

Kind = Literal["Real", "Integer", "Boolean", "String", "Enumeration"]
Causality = Literal["parameter", "input", "output"]
Variability = Literal["fixed", "continuous", "discrete"]

NED = ("north", "east", "down")
"""Components of a vector in n."""
LINEAR = ("surge", "sway", "heave")
"""Components along the axes of b: forward, starboard, down."""
ANGLES = ("roll", "pitch", "yaw")
"""Components about the axes of b, and the angles phi, theta, psi."""
FORCE = ("N", "N.m")
"""Units of a force and its moment."""
IMPULSE = ("N.s", "N.m.s")
"""Units of an impulse and its moment."""


@dataclass(frozen=True)
class Array:
    """An array of FMI 3.0: its elements are the lines of the table that name it, in their order, row by row."""

    name: str
    shape: tuple[int, ...]
    description: str


@dataclass(frozen=True)
class Variable:
    """One scalar variable of an FMU.

    Raises ValueError for a line that cannot be: an unknown unit, an enumeration without items, a Real that is
    discrete by mistake. `depends_on` names the parameters and inputs, one by one or as a group ("initial.position"),
    that the value of an output at the start depends on; None means that it may depend on all of them. `array` is the
    array of FMI 3.0 that it is an element of; None means that it is a scalar there too.
    """

    name: str
    kind: Kind
    causality: Causality
    path: str
    index: int | None
    description: str
    unit: str | None = None
    minimum: float | None = None
    maximum: float | None = None
    nominal: float | None = None
    items: tuple[str, ...] = ()
    depends_on: tuple[str, ...] | None = None
    array: Array | None = None

    def __post_init__(self) -> None:
        if (self.kind == "Real") != (self.unit is not None):
            raise ValueError(f"variable {self.name}: a {self.kind} with unit {self.unit!r}; Reals have one ('1': none)")
        if self.unit is not None and self.unit not in UNITS:
            raise ValueError(f"variable {self.name}: unit {self.unit!r} is not one of {', '.join(UNITS)}")
        if (self.kind == "Enumeration") != bool(self.items):
            raise ValueError(f"variable {self.name}: a {self.kind} with items {self.items}: Enumerations have them")

    @property
    def variability(self) -> Variability:
        """Parameters are fixed; Reals vary in time, everything else jumps."""
        if self.causality == "parameter":
            return "fixed"
        return "continuous" if self.kind == "Real" else "discrete"


Table = tuple[Variable, ...]


def real(
    causality: Causality,
    name: str,
    unit: str,
    path: str,
    index: int | None,
    description: str,
    *,
    minimum: float | None = None,
    maximum: float | None = None,
    nominal: float | None = None,
    depends_on: tuple[str, ...] | None = None,
    array: Array | None = None,
) -> Variable:
    """A Real: entry `index` of the list at `path`, or, with None, the float at `path`."""
    return Variable(
        name, "Real", causality, path, index, description, unit, minimum, maximum, nominal, (), depends_on, array
    )  # fmt: skip


def integer(
    causality: Causality,
    name: str,
    path: str,
    description: str,
    *,
    index: int | None = None,
    minimum: int | None = None,
    maximum: int | None = None,
    depends_on: tuple[str, ...] | None = None,
    array: Array | None = None,
) -> Variable:
    """An Integer: the int at `path`, or entry `index` of the list there."""
    return Variable(
        name, "Integer", causality, path, index, description, None, minimum, maximum, None, (), depends_on, array
    )  # fmt: skip


def boolean(
    causality: Causality,
    name: str,
    path: str,
    description: str,
    *,
    index: int | None = None,
    depends_on: tuple[str, ...] | None = None,
) -> Variable:
    """A Boolean: the bool at `path`, or entry `index` of the list there."""
    return Variable(name, "Boolean", causality, path, index, description, depends_on=depends_on)


def string(causality: Causality, name: str, path: str, description: str, *, index: int | None = None) -> Variable:
    """A String: the str at `path`, or entry `index` of the list there."""
    return Variable(name, "String", causality, path, index, description)


def enumeration(
    causality: Causality,
    name: str,
    items: tuple[str, ...],
    path: str,
    description: str,
    *,
    index: int | None = None,
) -> Variable:
    """One of `items`. The model holds the item's name, FMI its number counted from 1."""
    return Variable(name, "Enumeration", causality, path, index, description, items=items)


def vector(
    causality: Causality,
    name: str,
    components: Sequence[str],
    unit: str,
    path: str,
    description: str,
    *,
    first: int = 0,
    depends_on: tuple[str, ...] | None = None,
    array: Array | None = None,
) -> Table:
    """Reals name.component, in the order of the list at `path` from its entry `first` on.

    In FMI 3.0 they are the array `name`, unless `array` says otherwise.
    """
    within = array or Array(name, (len(components),), f"{description}: {', '.join(components)}")
    return tuple(
        real(
            causality, f"{name}.{part}", unit, path, first + i, f"{description}: {part}",
            depends_on=depends_on, array=within,
        )
        for i, part in enumerate(components)
    )  # fmt: skip


def wrench(
    causality: Causality,
    linear: str,
    angular: str,
    units: tuple[str, str],
    path: str,
    description: str,
    *,
    depends_on: tuple[str, ...] | None = None,
) -> Table:
    """Six Reals of the list at `path`: linear.surge|sway|heave, then angular.roll|pitch|yaw, in the two units (FORCE
    or IMPULSE).

    In FMI 3.0 they are two arrays, because an array has one unit. Where both halves have one name, these are told
    apart: NAME.force and NAME.moment, or NAME.linear and NAME.angular of an impulse.
    """
    names = (linear, angular)
    if linear == angular:
        names = (f"{linear}.force", f"{linear}.moment") if units == FORCE else (f"{linear}.linear", f"{linear}.angular")
    halves = zip((linear, angular), names, (LINEAR, ANGLES), units, (0, 3), strict=True)
    return tuple(
        line
        for name, array, components, unit, first in halves
        for line in vector(
            causality, name, components, unit, path, description, first=first, depends_on=depends_on,
            array=Array(array, (3,), f"{description}: {', '.join(components)}"),
        )
    )  # fmt: skip
