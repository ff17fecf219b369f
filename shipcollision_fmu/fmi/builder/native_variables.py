"""The table of variables as a native FMU reads it: resources/variables.txt, which native/fmi/variables.cpp reads.

    shipcollision variables 2               what it is, and the version of this format
    fmu "ShipManoeuvring"                   name of the FMU: it decides which model is made
    fmi 3                                   version of FMI that the FMU was built for
    tag "ShipManoeuvring 0123456789abcdef"  name and digest of the table: it must be that of a restored state
    build "0.1.0 0123456789ab"              what built the FMU: it must be that of a restored state
    token "{...}"                           guid (FMI 2.0) or instantiation token (FMI 3.0)
    ships "own" "target"                    names of the ships of a collision, none for another model
    scalars 2                               lines of the table that follow; the position of a line is its number, from 0
    Real output continuous "position.north" "outputs.position" 0 - - -
    Enumeration parameter fixed "coasting" "parameters.coasting" - 1 - - "kirchhoff" "free"
    presets 0                               numbers of the scalars whose start value is of this FMU alone
    references 1                            FMI 3.0: variables that follow; 0 in FMI 2.0, where they are the scalars
    "position" 0 1 2                        name, and numbers of its elements, row by row; value references count from 1
    crc32 0123abcd                          zlib.crc32 of all bytes before this line

A line of the table is: kind, causality, variability, name, path, index, start, min, max, and the items of an
Enumeration. A minus sign stands for an index, a limit or a start that is not there: outputs have no start. Numbers of
Reals are in the text of float.hex(), which is exact; the start of an Enumeration is its number from 1. Text stands in
double quotes, in UTF-8, with \\\\, \\", \\n, \\r and \\t for what they are in Python. Fields are parted by one space,
lines by one line feed, and the last line has one too.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Literal
from zlib import crc32

from ..arrays import gather_arrays
from ..interface import Interface
from ..variable_access import VariableAccess
from ..variables import Variable

__all__ = ["VARIABLES", "native_variables"]

VARIABLES = "variables.txt"
"""Name of the file among the resources of a native FMU."""
_ESCAPES = str.maketrans({"\\": r"\\", '"': r"\"", "\n": r"\n", "\r": r"\r", "\t": r"\t"})


def native_variables(
    interface: Interface,
    ships: tuple[str, ...],
    *,
    fmi: Literal[2, 3],
    token: str,
    build: str,
    starts: Mapping[str, Any] | None = None,
    scalar: bool = False,
) -> bytes:
    """The file for an FMU. `starts` are start values in place of the model's own; `scalar`: FMI 3.0 without arrays."""
    access = interface.make_access(ships, starts)
    arrays = gather_arrays(access.table, scalar) if fmi == 3 else ()
    lines = [
        "shipcollision variables 2",
        f"fmu {_quote(interface.name)}",
        f"fmi {fmi}",
        f"tag {_quote(access.tag)}",
        f"build {_quote(build)}",
        f"token {_quote(token)}",
        " ".join(["ships", *map(_quote, ships)]),
        f"scalars {len(access.table)}",
        *(" ".join(_fields(reference, line, access)) for reference, line in enumerate(access.table)),
        " ".join(["presets", *map(str, sorted(access.references(list(starts or {}))))]),
        f"references {len(arrays)}",
        *(" ".join([_quote(array.name), *map(str, array.references)]) for array in arrays),
    ]
    text = "".join(f"{line}\n" for line in lines).encode()
    return text + f"crc32 {crc32(text):08x}\n".encode()


def _fields(reference: int, line: Variable, access: VariableAccess) -> Iterator[str]:
    yield from (line.kind, line.causality, line.variability, _quote(line.name), _quote(line.path))
    yield "-" if line.index is None else str(line.index)
    yield "-" if line.causality == "output" else _start(reference, line, access)
    for limit in (line.minimum, line.maximum):
        yield "-" if limit is None else float(limit).hex() if line.kind == "Real" else str(int(limit))
    yield from map(_quote, line.items)


def _start(reference: int, line: Variable, access: VariableAccess) -> str:
    """What a fresh model holds there."""
    if line.kind == "Real":
        return access.get_real([reference])[0].hex()
    if line.kind == "Boolean":
        return str(access.get_boolean([reference])[0]).lower()
    if line.kind == "String":
        return _quote(access.get_string([reference])[0])
    return str(access.get_integer([reference])[0])


def _quote(text: str) -> str:
    return f'"{text.translate(_ESCAPES)}"'
