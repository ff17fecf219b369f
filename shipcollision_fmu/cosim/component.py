"""The interface of an instance to a master, and a model in process that has it.

The order of calls is that of FMI:

    reals / integers            a Group of variables that are read or written together, on one buffer
    initialise                  parameters, start values of inputs; afterwards the outputs are those of time 0
    Group.read, Group.write     at communication points
    step                        over one communication step
    close                       always, also after an error

A Group may share the buffer of another Group. A connection is then one read and one write, without a copy between them.
`Fmi2Component`, `Fmi3Component` and `InProcessComponent` give the same bits.

Errors: StepError when a model refuses a step (its state before the step stays), HostError when an FMU cannot be used.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from ctypes import Array, c_double, c_int
from typing import Any, Protocol, TypeAlias

from ..errors import HostError, InputError, ShipCollisionError, StepError
from ..fmi.variable_access import VariableAccess

__all__ = ["Buffer", "Component", "Group", "InProcessComponent", "Value", "item_number"]

Value: TypeAlias = float | int | bool | str
Buffer: TypeAlias = "Array[Any]"


class Group(Protocol):
    """Variables of one type of one component, read and written together."""

    @property
    def values(self) -> Buffer:
        """The buffer: filled by read, sent by write."""

    def read(self, count: int | None = None) -> None:
        """Fetch the values, or only the first `count` of them."""

    def write(self) -> None:
        """Send the values."""


class Component(Protocol):
    """An instance that a master steps."""

    @property
    def name(self) -> str:
        """Name of the instance, for messages."""

    def reals(self, names: Sequence[str], values: Buffer | None = None) -> Group:
        """Real variables as a Group, on its own buffer or on another Group's `values`."""

    def integers(self, names: Sequence[str]) -> Group:
        """Integer and Enumeration variables as a Group."""

    def initialise(self, parameters: Mapping[str, Value], stop_time: float, inputs: Sequence[Group] = ()) -> None:
        """Set parameters, write the inputs' start values, and compute the outputs of time 0."""

    def step(self, t: float, h: float) -> None:
        """Advance from t by h [s]."""

    def close(self) -> None:
        """Give everything back; may be called at any time and twice."""


class InProcessComponent:
    """A model that is driven without FMI, with the same variables and the same order of calls."""

    def __init__(self, name: str, access: VariableAccess) -> None:
        self.name = name
        self._access = access

    def reals(self, names: Sequence[str], values: Buffer | None = None) -> Group:
        """See Component."""
        buffer = (c_double * len(names))() if values is None else values
        return _InProcessGroup(self._access.get_real, self._access.set_real, self._references(names), buffer)

    def integers(self, names: Sequence[str]) -> Group:
        """See Component."""
        buffer = (c_int * len(names))()
        return _InProcessGroup(self._access.get_integer, self._access.set_integer, self._references(names), buffer)

    def initialise(self, parameters: Mapping[str, Value], stop_time: float, inputs: Sequence[Group] = ()) -> None:
        """See Component."""
        del stop_time  # a model has none
        try:
            for name, value in parameters.items():
                self._set(name, value)
            for group in inputs:
                group.write()
            self._access.initialise()
        except ShipCollisionError as error:
            raise HostError(f"{self.name}: initialisation failed: {error}") from None

    def step(self, t: float, h: float) -> None:
        """See Component."""
        try:
            self._access.do_step(t, h)
        except ShipCollisionError as error:
            raise StepError(f"{self.name}: {error}") from None  # the model's message has the time

    def save(self) -> dict[str, Any]:
        """The whole state, as VariableAccess.save() gives it."""
        return self._access.save()

    def restore(self, state: Mapping[str, Any]) -> None:
        """Back to a state that save() gave, exact to the bit."""
        self._access.restore(state)

    def close(self) -> None:
        """See Component."""
        close_model = getattr(self._access.model, "close", None)  # the collision model holds a world of Bullet's
        if close_model is not None:
            close_model()

    def _references(self, names: Sequence[str]) -> list[int]:
        try:
            return self._access.references(names)
        except InputError as error:
            raise HostError(f"{self.name}: {error}") from None

    def _set(self, name: str, value: Value) -> None:
        references = self._references([name])
        variable = self._access.table[references[0]]
        if variable.kind == "Real":
            self._access.set_real(references, [float(value)])
        elif variable.kind == "Boolean":
            self._access.set_boolean(references, [bool(value)])
        elif variable.kind == "String":
            self._access.set_string(references, [str(value)])
        else:
            number = item_number(self.name, name, value, variable.items) if isinstance(value, str) else int(value)
            self._access.set_integer(references, [number])


def item_number(component: str, name: str, item: str, items: Sequence[str]) -> int:
    """Number of an item of an Enumeration, from 1. Raises HostError for a text that is no item of it."""
    if item not in items:
        raise HostError(f"{component}: {name} = {item!r} must be one of {', '.join(items)}")
    return list(items).index(item) + 1


class _InProcessGroup:
    def __init__(self, getter: Any, setter: Any, references: list[int], values: Buffer) -> None:
        self.values = values
        self._get, self._set, self._references = getter, setter, references

    def read(self, count: int | None = None) -> None:
        if count is None:
            self.values[:] = self._get(self._references)
        else:
            self.values[:count] = self._get(self._references[:count])

    def write(self) -> None:
        self._set(self._references, self.values[:])
