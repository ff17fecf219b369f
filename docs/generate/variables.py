"""The variables of the FMUs from the tables in fmi/, in the scalar form of FMI 2.0 and the array form of FMI 3.0.

Elements of one array share a row: `own.position.north|east|down` stands for three scalars, `contact[1..8].gap` for
eight. The ships of a build differ in their names alone, so the rows of the first ship stand for all.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import product

from shipcollision_fmu.fmi.arrays import TIME, ArrayVariable, gather_arrays
from shipcollision_fmu.fmi.builder.model_description import format_start
from shipcollision_fmu.fmi.interface import SHIPS, Interface
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from shipcollision_fmu.fmi.variables import Causality, Variable

from .markdown import anchored, cell, table

__all__ = ["collision_starts", "ship_collision", "ship_manoeuvring"]

_HEADER = ("FMI 2.0", "FMI 3.0", "type", "unit", "limits", "start", "meaning")
_START = _HEADER.index("start")
_GROUPS: tuple[tuple[Causality, str], ...] = (("input", "Inputs"), ("output", "Outputs"), ("parameter", "Parameters"))


def ship_collision() -> str:
    """Every variable of ShipCollision in the default build."""
    return _page(COLLISION)


def ship_manoeuvring() -> str:
    """Every variable of ShipManoeuvring."""
    return _page(MANOEUVRING)


def collision_starts() -> dict[str, str]:
    """The start value of every parameter of ShipCollision, as a scenario file has it: an enumeration by its word."""
    access = COLLISION.make_access(SHIPS)
    starts = {}
    for reference, variable in enumerate(access.table):
        if variable.causality == "parameter":
            start = format_start(variable, reference, access)
            starts[variable.name] = f'"{variable.items[int(start) - 1]}"' if variable.items else start
    return starts


def _page(interface: Interface) -> str:
    access = interface.make_access(SHIPS)
    lines, gathered = access.table, gather_arrays(access.table)
    starts = [
        format_start(variable, reference, access) if variable.causality != "output" else ""
        for reference, variable in enumerate(lines)
    ]
    shown = [array for array in gathered if not array.name.startswith(tuple(f"{ship}." for ship in SHIPS[1:]))]
    parts = []
    for causality, heading in _GROUPS:
        rows = [_row(array, lines, starts) for array in shown if array.line.causality == causality]
        header, *rows = [row if causality != "output" else _without_start(row) for row in (_HEADER, *rows)]
        parts.append(f"## {heading}\n\n{table(header, rows)}")
    return "\n".join([*parts, _references(gathered, lines)])


def _row(array: ArrayVariable, lines: Sequence[Variable], starts: Sequence[str]) -> tuple[str, ...]:
    names = [lines[reference].name for reference in array.references]
    line = array.line
    pattern = _pattern(names)
    values = list(dict.fromkeys(starts[reference] for reference in array.references))
    shape = f"[{', '.join(map(str, array.shape))}]" if array.shape else ""
    kind = ", ".join(f"{n}: `{item}`" for n, item in enumerate(line.items, 1)) if line.items else line.kind
    return (
        anchored(pattern, names[0]), f"`{array.name}{shape}`", kind, line.unit or "",
        _limits(line), ", ".join(f"`{value}`" for value in values if value), cell(array.description),
    )  # fmt: skip


def _without_start(row: tuple[str, ...]) -> tuple[str, ...]:
    """An output has no start value."""
    return row[:_START] + row[_START + 1 :]


def _limits(line: Variable) -> str:
    bounds = (("≥", line.minimum), ("≤", line.maximum))
    return ", ".join(f"{sign} {bound:.6g}" for sign, bound in bounds if bound is not None)


def _pattern(names: Sequence[str]) -> str:
    """One name for several that differ in some of their parts. Raises ValueError when they are not all combinations."""
    columns = [list(dict.fromkeys(column)) for column in zip(*(name.split(".") for name in names), strict=True)]
    if [".".join(parts) for parts in product(*columns)] != list(names):
        raise ValueError(f"{names[0]} and its like are not all combinations of their parts")
    return ".".join(_part(values) for values in columns)


def _part(values: Sequence[str]) -> str:
    numbered = [re.fullmatch(r"(\w+)\[(\d+)\]", value) for value in values]
    if len(values) > 1 and all(numbered):
        return f"{numbered[0][1]}[1..{len(values)}]"  # type: ignore[index]
    return "|".join(values)


def _references(gathered: Sequence[ArrayVariable], lines: Sequence[Variable]) -> str:
    """Every scalar with its value reference, folded away: a program's reader looks for numbers here."""
    places = {
        scalar: (reference, array, i)
        for reference, array in enumerate(gathered, TIME + 1)
        for i, scalar in enumerate(array.references)
    }
    rows = []
    for scalar, line in enumerate(lines):
        reference, array, i = places[scalar]
        within = f"`{array.name}`" + (f", element {i + 1}" if array.shape else "")
        rows.append((str(scalar), f"`{line.name}`", str(reference), within))
    body = table(("FMI 2.0 reference", "name", "FMI 3.0 reference", "array"), rows)
    folded = "".join(f"    {line}\n" for line in body.splitlines())
    return f'## Value references\n\n??? note "Every scalar of the default build"\n\n{folded}'
