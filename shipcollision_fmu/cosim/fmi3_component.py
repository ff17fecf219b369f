"""An FMI 3.0 FMU of this project as a Component: same names, same order of calls, same bits as FMI 2.0.

FMI 3.0 has arrays where the table of variables has scalars. A group of names is fetched as the arrays that hold them:
straight into the group's buffer when these are whole and in order, as all connections of the master are, otherwise
through a buffer beside it. A group that writes part of an array leaves the rest as it is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from ctypes import Array, byref, c_bool, c_char_p, c_double, c_int, c_int32, c_int64, c_uint
from typing import Any

from fmpy.fmi3 import FMU3Slave

from ..errors import HostError
from ..fmi.arrays import Layout
from ..fmi.variables import Kind, Table
from .component import Buffer, Group, Value, item_number
from .fmu_instance import REMEDY, WARNING, FmuInstance, UnpackedFmu

__all__ = ["Fmi3Component"]

_ACCESS: dict[Kind, tuple[str, Any]] = {
    "Real": ("Float64", c_double), "Integer": ("Int32", c_int32), "Enumeration": ("Int64", c_int64),
    "Boolean": ("Boolean", c_bool), "String": ("String", c_char_p),
}  # fmt: skip
"""fmi3GetXXX and fmi3SetXXX of a kind, and the type of their values."""


class Fmi3Component(FmuInstance):
    """An instance of an FMU for co-simulation, FMI 3.0; `table` is the table of variables that it was built from."""

    def __init__(self, name: str, fmu: UnpackedFmu, table: Table) -> None:
        self._table, self._layout = {line.name: line for line in table}, Layout(table)
        super().__init__(name, fmu)
        flags, self._last = (c_bool(), c_bool(), c_bool()), c_double()
        self._do_step, self._step_options = self._fmu.dll.fmi3DoStep, (True, *map(byref, flags), byref(self._last))

    def _instantiate(self, arguments: Mapping[str, str]) -> Any:
        fmu = FMU3Slave(**arguments)
        fmu.instantiate(loggingOn=True, logMessage=self._keep)
        return fmu

    def _enter_initialisation(self, stop_time: float) -> None:
        entered = self._fmu.dll.fmi3EnterInitializationMode(self._component, False, 0.0, 0.0, True, stop_time)
        self.check(entered, "initialisation")

    def _exit_initialisation(self) -> int:
        status: int = self._fmu.dll.fmi3ExitInitializationMode(self._component)
        return status

    def reals(self, names: Sequence[str], values: Buffer | None = None) -> Group:
        """See Component."""
        buffer = (c_double * len(names))() if values is None else values
        return _Group(self, names, ("Real",), buffer)

    def integers(self, names: Sequence[str]) -> Group:
        """See Component."""
        return _Group(self, names, ("Integer", "Enumeration"), (c_int * len(names))())

    def calls(self, kind: Kind) -> tuple[Callable[..., int], Callable[..., int]]:
        """fmi3GetXXX and fmi3SetXXX of a kind of variable."""
        suffix = _ACCESS[kind][0]
        return getattr(self._fmu.dll, f"fmi3Get{suffix}"), getattr(self._fmu.dll, f"fmi3Set{suffix}")

    def places(self, names: Sequence[str], kinds: Sequence[Kind]) -> list[tuple[int, int]]:
        """Array and position of each name. Raises HostError for a name that is not there, or of another kind."""
        places = []
        for name in names:
            place = self._layout.place(name)
            if place is None or self._table[name].kind not in kinds:
                raise HostError(f"{self.name}: the FMU has no {' or '.join(sorted(kinds))} {name!r}; {REMEDY}")
            places.append(place)
        return places

    def size(self, reference: int) -> int:
        """Values of the array with that value reference."""
        return self._layout.array(reference).size

    def kind(self, reference: int) -> Kind:
        """Kind of its elements."""
        return self._layout.array(reference).line.kind

    def _set(self, name: str, value: Value) -> None:
        if name not in self._table:
            raise HostError(f"{self.name}: the FMU has no variable {name!r}; {REMEDY}")
        line = self._table[name]
        if line.items and isinstance(value, str):
            value = item_number(self.name, name, value, line.items)
        ((reference, index),) = self.places([name], [line.kind])
        get, put = self.calls(line.kind)
        references, size = (c_uint * 1)(reference), self.size(reference)
        values = (_ACCESS[line.kind][1] * size)()
        if size > 1:
            self.check(get(self._component, references, 1, values, size), f"reading {name}")
        values[index] = _plain(line.kind, value)
        self.check(put(self._component, references, 1, values, size), f"setting {name} = {value!r}")

    def _keep(self, environment: Any, status: int, category: bytes, message: bytes) -> None:
        del environment, category
        self._remember(status, message)


def _plain(kind: Kind, value: Value) -> Any:
    if kind == "String":
        return str(value).encode()
    return {"Real": float, "Boolean": bool}.get(kind, int)(value)


class _Part:
    """The values of one kind in a group: the arrays that hold them, and where each goes in the group's buffer."""

    def __init__(self, owner: Fmi3Component, kind: Kind, places: Sequence[tuple[int, tuple[int, int]]], into: Buffer):
        arrays = list(dict.fromkeys(reference for _, (reference, _) in places))
        self._kind = kind
        self._owner, (self._get, self._put) = owner, owner.calls(kind)
        self._references: Array[c_uint] = (c_uint * len(arrays))(*arrays)
        self._size = sum(map(owner.size, arrays))
        offsets, offset = {}, 0
        for reference in arrays:
            offsets[reference] = offset
            offset += owner.size(reference)
        moves = [(target, offsets[reference] + index) for target, (reference, index) in places]
        self._direct = kind == "Real" and moves == [(k, k) for k in range(self._size)] and len(into) >= self._size
        self._moves = [] if self._direct else moves
        self._into = into
        self._values = into if self._direct else (_ACCESS[kind][1] * self._size)()

    def read(self) -> None:
        self._fetch()
        for target, source in self._moves:
            self._into[target] = self._values[source]

    def write(self) -> None:
        if self._moves:
            if len(self._moves) < self._size:
                self._fetch()  # what is not in the group stays
            for target, source in self._moves:
                self._values[source] = self._into[target]
        status = self._put(self._owner._component, self._references, len(self._references), self._values, self._size)
        if status > WARNING:
            self._owner.check(status, "writing inputs")

    def _fetch(self) -> None:
        status = self._get(self._owner._component, self._references, len(self._references), self._values, self._size)
        if status > WARNING:
            self._owner.check(status, "reading outputs")


class _Group:
    def __init__(self, owner: Fmi3Component, names: Sequence[str], kinds: Sequence[Kind], values: Buffer) -> None:
        self.values = values
        self._owner, self._names, self._kinds = owner, names, kinds
        self._parts = self._build_parts(len(names))
        self._heads: dict[int, list[_Part]] = {len(names): self._parts}

    def read(self, count: int | None = None) -> None:
        if count is None:
            parts = self._parts
        else:
            known = self._heads.get(count)
            parts = self._heads.setdefault(count, self._build_parts(count)) if known is None else known
        for part in parts:
            part.read()

    def write(self) -> None:
        for part in self._parts:
            part.write()

    def _build_parts(self, count: int) -> list[_Part]:
        """Parts of the first `count` names."""
        places = list(enumerate(self._owner.places(self._names[:count], self._kinds)))
        by_kind = {
            kind: [(k, place) for k, place in places if self._owner.kind(place[0]) == kind] for kind in self._kinds
        }
        return [_Part(self._owner, kind, part, self.values) for kind, part in by_kind.items() if part]
