"""The table of variables as FMI 3.0 has it: arrays where lines of the table belong together.

    position.north, position.east, position.down          ->  position[3]
    contact[1].gap, contact[2].gap, ...                    ->  contact.gap[8]
    contact[1].normal.north, ..., contact[8].normal.down   ->  contact.normal[8, 3], row by row

Hosts that do not pass arrays take the scalar flavour: every line of the table is a variable, with its name there.

**The value reference in FMI 3.0 is the position here plus 1; 0 is the time**, which is a variable in FMI 3.0.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import prod

from .variables import Kind, Table, Variable

__all__ = ["TIME", "TYPES", "ArrayVariable", "Layout", "gather_arrays"]

TIME = 0
"""Value reference of the independent variable."""
TYPES: dict[Kind, str] = {
    "Real": "Float64", "Integer": "Int32", "Boolean": "Boolean", "String": "String", "Enumeration": "Enumeration",
}  # fmt: skip
"""What a kind of variable is called in FMI 3.0."""


@dataclass(frozen=True)
class ArrayVariable:
    """A variable of FMI 3.0. shape () is a scalar; `references` are those of its elements in the table, row by row;
    `line` is what all elements have in common."""

    name: str
    shape: tuple[int, ...]
    description: str
    references: tuple[int, ...]
    line: Variable

    @property
    def size(self) -> int:
        """Number of values."""
        return len(self.references)


def gather_arrays(table: Table, scalar: bool = False) -> tuple[ArrayVariable, ...]:
    """The variables of FMI 3.0, in the order in which the table first mentions them; one for each line when `scalar`.

    Raises ValueError for an array whose elements do not belong together, or are not as many as its shape says.
    """
    if scalar:
        return tuple(ArrayVariable(line.name, (), line.description, (k,), line) for k, line in enumerate(table))
    gathered: dict[str, list[int]] = {}
    for reference, line in enumerate(table):
        gathered.setdefault(line.name if line.array is None else line.array.name, []).append(reference)
    return tuple(_array(name, references, table) for name, references in gathered.items())


class Layout:
    """Where a scalar of the table lies in the arrays of FMI 3.0."""

    def __init__(self, table: Table) -> None:
        self.arrays = gather_arrays(table)
        self._places = {
            table[scalar].name: (reference, index)
            for reference, array in enumerate(self.arrays, TIME + 1)
            for index, scalar in enumerate(array.references)
        }

    def place(self, name: str) -> tuple[int, int] | None:
        """Value reference of the array and position in it; None for a name that is not in the table."""
        return self._places.get(name)

    def array(self, reference: int) -> ArrayVariable:
        """The array with that value reference."""
        return self.arrays[reference - TIME - 1]


def _array(name: str, references: list[int], table: Table) -> ArrayVariable:
    first = table[references[0]]
    if first.array is None:
        if len(references) > 1:
            raise ValueError(f"array {name} has the name of the scalar {first.name}")
        return ArrayVariable(name, (), first.description, tuple(references), first)
    shape = first.array.shape
    for reference in references:
        if _common(table[reference]) != _common(first):
            raise ValueError(f"array {name}: {table[reference].name} is not of the same kind as {first.name}")
    if len(references) != prod(shape):
        raise ValueError(f"array {name} has shape {shape} and {len(references)} elements")
    return ArrayVariable(name, shape, first.array.description, tuple(references), first)


def _common(line: Variable) -> Variable:
    """A line without what is its own among the elements of an array."""
    return replace(line, name="", path="", index=None, description="")
