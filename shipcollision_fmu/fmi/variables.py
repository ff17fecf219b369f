"""The one table of variables of a model.

A table is a tuple of `Variable`. Names, units, causality, description and the place of the value in the model are
written there and nowhere else; modelDescription.xml, the accessors, the documentation and the tests follow from it.
**The value reference of a variable is its position in the table.**

    TABLE = (
        *vector("output", POSITION, "m", "outputs.position", "Position of CO in n"),
        *wrench("input", IMPULSE, IMPULSE_UNITS, "inputs.impulse", "Cumulative impulse in b", "Its moment about CO"),
        real("input", RUDDER_ORDER, "rad", "inputs.rudder_order", None, "Ordered rudder angle"),
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
    "FORCE_UNITS", "IMPULSE_UNITS", "Array", "Causality", "Kind", "Table", "Variable", "boolean", "enumeration",
    "integer", "real", "string", "vector", "wrench",
]  # fmt: skip

Kind = Literal["Real", "Integer", "Boolean", "String", "Enumeration"]
Causality = Literal["parameter", "input", "output"]
Variability = Literal["fixed", "continuous", "discrete"]

FORCE_UNITS = ("N", "N.m")
IMPULSE_UNITS = ("N.s", "N.m.s")
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
    array of FMI 3.0 that it is an element of; None means that it is a scalar there too. `jumps`: a Real that keeps its
    value between events, such as the time of the latest collision.
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
    jumps: bool = False

    def __post_init__(self) -> None:
        if (self.kind == "Real") != (self.unit is not None):
            raise ValueError(f"variable {self.name}: a {self.kind} with unit {self.unit!r}; Reals have one ('1': none)")
        if self.unit is not None and self.unit not in UNITS:
            raise ValueError(f"variable {self.name}: unit {self.unit!r} is not one of {', '.join(UNITS)}")
        if (self.kind == "Enumeration") != bool(self.items):
            raise ValueError(f"variable {self.name}: a {self.kind} with items {self.items}: Enumerations have them")

    @property
    def variability(self) -> Variability:
        """Parameters are fixed; Reals vary in time unless they jump, everything else jumps."""
        if self.causality == "parameter":
            return "fixed"
        return "continuous" if self.kind == "Real" and not self.jumps else "discrete"


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
    jumps: bool = False,
) -> Variable:
    """A Real: entry `index` of the list at `path`, or, with None, the float at `path`."""
    return Variable(
        name, "Real", causality, path, index, description, unit, minimum, maximum, nominal, (), depends_on, array, jumps
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


def string(
    causality: Causality,
    name: str,
    path: str,
    description: str,
    *,
    index: int | None = None,
    depends_on: tuple[str, ...] | None = None,
) -> Variable:
    """A String: the str at `path`, or entry `index` of the list there."""
    return Variable(name, "String", causality, path, index, description, depends_on=depends_on)


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
    names: Sequence[str],
    unit: str,
    path: str,
    description: str,
    *,
    first: int = 0,
    depends_on: tuple[str, ...] | None = None,
    array: Array | None = None,
    jumps: bool = False,
) -> Table:
    """Reals by their full names ("position.north", ...): entries of the list at `path` from its entry `first` on.

    In FMI 3.0 they are the array that is called as the names begin ("position"), unless `array` says otherwise.
    """
    name, components = _common_name(names)
    within = array or Array(name, (len(names),), f"{description}: {', '.join(components)}")
    return tuple(
        real(
            causality, full, unit, path, first + i, f"{description}: {part}", depends_on=depends_on, array=within,
            jumps=jumps,
        )
        for i, (full, part) in enumerate(zip(names, components, strict=True))
    )  # fmt: skip


def wrench(
    causality: Causality,
    names: Sequence[str],
    units: tuple[str, str],
    path: str,
    description: str,
    about: str,
    *,
    depends_on: tuple[str, ...] | None = None,
) -> Table:
    """Six Reals, three along and three about the axes of b: the list at `path`, in the two units. `description` is of
    the first three, `about` of the moments.

    In FMI 3.0 they are two arrays, because an array has one unit. Where the names of both halves begin alike, the
    arrays are told apart: NAME.force and NAME.moment, or NAME.linear and NAME.angular of an impulse.
    """
    lines: list[Variable] = []
    halves = ("force", "moment") if units == FORCE_UNITS else ("linear", "angular")
    alike = _common_name(names[:3])[0] == _common_name(names[3:])[0]
    for first, half, unit, said in zip((0, 3), halves, units, (description, about), strict=True):
        own = names[first : first + 3]
        name, components = _common_name(own)
        array = Array(f"{name}.{half}" if alike else name, (3,), f"{said}: {', '.join(components)}")
        lines += vector(causality, own, unit, path, said, first=first, depends_on=depends_on, array=array)
    return tuple(lines)


def _common_name(names: Sequence[str]) -> tuple[str, tuple[str, ...]]:
    """("position.north", "position.east") -> "position", ("north", "east")."""
    split = [name.rpartition(".") for name in names]
    (name,) = {begin for begin, _, _ in split}
    return name, tuple(component for _, _, component in split)
