"""Access to a model through value references: what an FMU does, without FMI.

The slave in an FMU and a run in process both drive a model through `VariableAccess`, so that both give the same bits.
The order of calls is FMI's:

    1  set_* parameters and inputs, in any order; get_* of an output initialises the model first, so that it is right
    2  initialise()
    3  set_* inputs, do_step(t, h), get_*, again and again
    at any time: save() and restore(); get_* of everything

A call that is refused raises a ShipCollisionError and changes nothing. Values are not converted: give floats for Reals.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from hashlib import sha256
from typing import Any, Protocol

from ..errors import InputError, ShipCollisionError, StepError
from .build_record import name_running_build
from .variables import Kind, Table, Variable

__all__ = ["Model", "VariableAccess"]

_TYPES: dict[Kind, type] = {"Real": float, "Integer": int, "Boolean": bool, "String": str, "Enumeration": str}

Cell = tuple[Any, Any]
"""Where a value lies: container[key], a list with a position or an object's attributes with a name."""
Plans = dict[tuple[int, ...], list[Cell]]
"""Where the values of a whole call lie, by its value references."""
_PLANS = 1000
"""So many are kept. Fewer would only cost time, with a host that asks for ever new sets of variables."""


class Model(Protocol):
    """A model in time: plain Python without FMI. The paths of the table lead to its attributes. A model may have a
    method `note_inputs_set`, which is given the paths of all Reals that were ever set, and a method `list_files`, which
    returns checksums of the files that it has read by the names of the parameters that name them."""

    def initialise(self) -> None:
        """Read parameters and start values, compute the outputs of the start. May be called again; raises
        ShipCollisionError."""

    def step(self, t: float, h: float, /) -> None:
        """Advance from t to t + h [s]. Raises ShipCollisionError, and then state and outputs are those before the
        step."""

    def get_state(self) -> dict[str, Any]:
        """What parameters, inputs and outputs do not hold: a fresh copy, JSON-able."""

    def set_state(self, state: dict[str, Any], /) -> None:
        """Put such a state back, exact to the bit."""


class VariableAccess:
    """A model behind its table of variables. Raises ValueError for a table that does not fit the model."""

    def __init__(self, name: str, table: Table, model: Model) -> None:
        self.name = name
        self.table = table
        self.model = model
        self._cells = [_cell(model, variable) for variable in table]
        self._fresh = self._now(self._cells)
        self._references = {variable.name: reference for reference, variable in enumerate(table)}
        if len(self._references) != len(table):
            raise ValueError(f"{name}: the table names a variable twice")
        self._items = {reference: variable.items for reference, variable in enumerate(table) if variable.items}
        self._outputs = frozenset(self._of(causality={"output"}))
        self._parameters = self._of(causality={"parameter"})
        self._get = {kind: self._of(kind=kind) for kind in _TYPES}
        self._set = {kind: self._of(kind=kind, causality={"parameter", "input"}) for kind in _TYPES}
        self._set_running = {kind: self._of(kind=kind, causality={"input"}) for kind in _TYPES}
        self._can_set = self._set
        self._reading: Plans = {}
        self._writing: Plans = {}
        self._dirty = True  # outputs do not yet follow from what was set
        self._running = False  # initialised: parameters are fixed
        self._broken = ""  # why the model must not be stepped any more
        self._initialised_from: list[Any] | None = None  # the parameters that the model last read
        self._paths_set: set[str] = set()  # places of inputs that were ever set
        self._note_set(())
        self.tag = f"{name} {sha256(repr(table).encode()).hexdigest()[:16]}"

    def preset(self, start: Mapping[str, Any]) -> None:
        """Start values by name in place of the model's own: those of an FMU made for one instance. Items of
        Enumerations by name. Raises InputError for a value that cannot be set."""
        for name, value in start.items():
            reference = self.references([name])[0]
            variable = self.table[reference]
            start_value: Any = float(value) if variable.kind == "Real" and type(value) is int else value
            if type(start_value) is not _TYPES[variable.kind] or (variable.items and start_value not in variable.items):
                raise InputError(f"{self.name}: {name} = {value!r} is not a value of {variable.kind}")
            if variable.causality == "output":
                raise self._not_settable(variable.kind, reference)
            container, key = self._cells[reference]
            container[key] = start_value
            self._note_set([reference])
        self._fresh = self._now(self._cells)
        self._dirty = True

    def references(self, names: Sequence[str]) -> list[int]:
        """Value references of variables by name. Raises InputError for a name that is not there."""
        try:
            return [self._references[name] for name in names]
        except KeyError as error:
            raise InputError(f"{self.name} has no variable {error.args[0]!r}") from None

    def serves(self, reference: int, kinds: Sequence[Kind]) -> bool:
        """Whether there is a variable of one of these kinds with that value reference."""
        return any(reference in self._get[kind] for kind in kinds)

    # Reading. ------------------------------------------------------------------------------

    def get_real(self, references: Sequence[int]) -> list[float]:
        """Values of Reals."""
        if self._dirty:
            self._refresh(references)
        request = tuple(references)
        plan = self._reading.get(request)
        if plan is None:
            plan = self._plan(self._reading, self._get["Real"], request, self._no_such)
        return [container[key] for container, key in plan]

    def get_integer(self, references: Sequence[int]) -> list[int]:
        """Values of Integers, and of Enumerations as numbers from 1."""
        return [self._number(reference) for reference in self._checked(references, "Integer", "Enumeration")]

    def get_boolean(self, references: Sequence[int]) -> list[bool]:
        """Values of Booleans."""
        return [self._value(reference) for reference in self._checked(references, "Boolean")]

    def get_string(self, references: Sequence[int]) -> list[str]:
        """Values of Strings."""
        return [self._value(reference) for reference in self._checked(references, "String")]

    # Writing: all of a call or nothing. ------------------------------------------------------------------------------

    def set_real(self, references: Sequence[int], values: Sequence[float]) -> None:
        """Set Reals."""
        request = tuple(references)
        plan = self._writing.get(request)
        if plan is None:
            plan = self._plan(self._writing, self._can_set["Real"], request, self._not_settable)
            self._note_set(request)
        if len(plan) != len(values):
            raise InputError(f"{self.name}: {len(values)} values for {len(plan)} variables")
        for (container, key), value in zip(plan, values, strict=True):
            container[key] = value
        if not self._running:
            self._dirty = True

    def set_integer(self, references: Sequence[int], values: Sequence[int]) -> None:
        """Set Integers, and Enumerations by their number from 1."""
        named: list[Any] = []
        for reference, value in zip(references, values, strict=True):
            items = self._items.get(reference)
            if items is not None and not 1 <= value <= len(items):
                raise InputError(
                    f"{self.name}: {self.table[reference].name} = {value} is not one of "
                    + ", ".join(f"{number} ({item})" for number, item in enumerate(items, 1))
                )
            named.append(int(value) if items is None else items[value - 1])
        self._write(references, named, "Integer", "Enumeration")

    def set_boolean(self, references: Sequence[int], values: Sequence[bool]) -> None:
        """Set Booleans."""
        self._write(references, [bool(value) for value in values], "Boolean")

    def set_string(self, references: Sequence[int], values: Sequence[str]) -> None:
        """Set Strings. Raises InputError for what is none: a null pointer of the host arrives as None."""
        for reference, value in zip(references, values, strict=True):
            if not isinstance(value, str) and self.serves(reference, ("String",)):
                raise InputError(
                    f"{self.name}: {self.table[reference].name} = {value!r} is not a string: give text in UTF-8"
                )
        self._write(references, values, "String")

    # In time. ------------------------------------------------------------------------------

    @property
    def running(self) -> bool:
        """Initialised; from here on the parameters are fixed."""
        return self._running

    def initialise(self) -> None:
        """End of initialisation: the model reads what was set. Raises the model's error, and parameters can then be
        corrected."""
        if self._running:
            raise InputError(f"{self.name} is initialised already; reset it to start again")
        if self._dirty:
            self._initialise()
        self._enter(running=True)

    def do_step(self, t: float, h: float) -> None:
        """One communication step from t to t + h [s]. Raises StepError; state and outputs are then those before the
        step."""
        if not self._running:
            raise StepError(f"{self.name} is not initialised: initialise it before its first step")
        if self._broken:
            raise StepError(self._broken)
        if not (math.isfinite(t) and math.isfinite(h) and h > 0.0):
            raise StepError(f"{self.name}: no step from t = {t} s by {h} s: both must be finite and the step > 0")
        try:
            self.model.step(t, h)
        except ShipCollisionError:
            raise
        except BaseException as error:  # a fault of ours: how far the step got is unknown
            self._broken = f"{self.name} failed at t = {t} s: {_described(error)}; reset it or restore a saved state"
            raise StepError(self._broken) from error

    # The whole state. ------------------------------------------------------------------------------

    def save(self) -> dict[str, Any]:
        """Everything: parameters, inputs, outputs and what the model hides. JSON-able, and exact through JSON (NaN
        and inf too)."""
        return {
            "of": self.tag,
            "build": name_running_build(),
            "values": [container[key] for container, key in self._cells],
            "model": self.model.get_state(),
            "read": self._initialised_from,
            "files": self._list_files(),
            "dirty": self._dirty,
            "running": self._running,
            "broken": self._broken,
            "set": sorted(self._paths_set),
        }

    def restore(self, state: Mapping[str, Any]) -> None:
        """Put a saved state back, also into a fresh instance. Raises InputError for what is not a state of this
        model."""
        self._refuse_foreign_state(state)
        if state["broken"]:
            raise InputError(f"{self.name}: this state was saved after a fault ({state['broken']})")
        before = None if self._broken else self.save()
        try:
            self._put(state)
        except Exception as error:
            if before is not None:
                self._put(before, checks_files=False)  # files of its own may have changed since, too
            if isinstance(error, ShipCollisionError):
                raise
            raise InputError(f"{self.name}: this saved state cannot be read: {_described(error)}") from error

    def _refuse_foreign_state(self, state: Mapping[str, Any]) -> None:
        """Raise InputError for the state of another model, and for one that another build of this package saved.

        The keys of a state follow the names in the code, and only the code that saved a state continues it to the bit.
        """
        of = state.get("of") if isinstance(state, Mapping) else None
        ours = isinstance(of, str) and of.partition(" ")[0] == self.name
        if ours and state.get("build") != name_running_build():
            theirs = state.get("build", "an older one, without its name")
            raise InputError(
                f"{self.name}: this state was saved by another build of shipcollision_fmu ({theirs}; this one is "
                f"{name_running_build()}): a state can be restored only in the build that saved it"
            )
        if of != self.tag:
            raise InputError(f"{self.name}: this is not a saved state of it (of {of!r}, want {self.tag!r})")

    @property
    def warning(self) -> str:
        """What was not as it should be at the start or in the last step, in one line, or nothing.

        A model may have an attribute `warning`.
        """
        return str(getattr(self.model, "warning", ""))

    @property
    def events(self) -> Sequence[str]:
        """What happened in the last step that people should read, a line each. A model may have an attribute
        `events`."""
        found: Sequence[str] = getattr(self.model, "events", ())
        return found

    def close(self) -> None:
        """Let the model give back what it holds outside Python, if anything: a model may have a method `close`."""
        close = getattr(self.model, "close", None)
        if close is not None:
            close()

    def _list_files(self) -> dict[str, int]:
        list_files = getattr(self.model, "list_files", None)
        return {} if list_files is None or self._initialised_from is None else dict(list_files())

    def _refuse_other_files(self, saved: Mapping[str, int]) -> None:
        """Raise InputError when the model has read other files than the model that was saved."""
        for name, checksum in self._list_files().items():
            if saved[name] != checksum:
                raise InputError(
                    f"{self.name}: the file that {name} = {self._value(self._references[name])!r} names is not that of "
                    "the saved state: give the file of then, or initialise without this state"
                )

    def _put(self, state: Mapping[str, Any], *, checks_files: bool = True) -> None:
        if state["read"] is not None:
            if state["read"] != self._initialised_from:
                # What the model derives from its parameters is not in its state: it reads them again, inputs harmless.
                self._write_all(self._fresh)
                self._write_parameters(state["read"])
                self._initialise()
            self._write_parameters(state["read"])  # others may have been set since the model read these
            if checks_files:
                self._refuse_other_files(state["files"])
            self.model.set_state(state["model"])
        self._write_all(state["values"])
        self._dirty = state["dirty"]
        self._broken = ""
        self._paths_set = set(state["set"])
        self._note_set(())
        self._enter(running=state["running"])

    # Inside. ------------------------------------------------------------------------------

    def _of(self, *, kind: Kind | None = None, causality: set[str] | None = None) -> dict[int, Cell]:
        return {
            reference: self._cells[reference]
            for reference, variable in enumerate(self.table)
            if (kind is None or variable.kind == kind) and (causality is None or variable.causality in causality)
        }

    def _value(self, reference: int) -> Any:
        container, key = self._cells[reference]
        return container[key]

    def _number(self, reference: int) -> int:
        value = self._value(reference)
        items = self._items.get(reference)
        return value if items is None else items.index(value) + 1

    def _checked(self, references: Sequence[int], *kinds: Kind) -> Sequence[int]:
        if self._dirty:
            self._refresh(references)
        for reference in references:
            if not self.serves(reference, kinds):
                raise self._no_such(kinds[0], reference)
        return references

    def _write(self, references: Sequence[int], values: Sequence[Any], *kinds: Kind) -> None:
        for reference in references:
            if not any(reference in self._can_set[kind] for kind in kinds):
                raise self._not_settable(kinds[0], reference)
        for reference, value in zip(references, values, strict=True):
            container, key = self._cells[reference]
            container[key] = value
        if not self._running:
            self._dirty = True

    def _note_set(self, references: Sequence[int]) -> None:
        """Let a model that asks for it know which Reals were ever set. It is called for new sets of references only."""
        note = getattr(self.model, "note_inputs_set", None)
        if note is not None:
            self._paths_set.update(self.table[reference].path for reference in references)
            note(self._paths_set)

    def _write_parameters(self, values: Sequence[Any]) -> None:
        for (container, key), value in zip(self._parameters.values(), values, strict=True):
            container[key] = value

    def _write_all(self, values: Sequence[Any]) -> None:
        for (container, key), value in zip(self._cells, values, strict=True):
            container[key] = value

    @staticmethod
    def _now(cells: Any) -> list[Any]:
        return [container[key] for container, key in cells]

    def _refresh(self, references: Sequence[int]) -> None:
        if not self._outputs.isdisjoint(references):
            self._initialise()

    def _initialise(self) -> None:
        self.model.initialise()
        self._initialised_from = self._now(self._parameters.values())
        self._dirty = False

    def _enter(self, *, running: bool) -> None:
        self._running = running
        self._can_set = self._set_running if running else self._set
        self._writing.clear()

    @staticmethod
    def _plan(
        plans: Plans, cells: dict[int, Cell], request: tuple[int, ...], refuse: Callable[[Kind, int], InputError]
    ) -> list[Cell]:
        """Where the values of `request` lie. Kept, up to a limit: hosts ask for the same sets again and again."""
        for reference in request:
            if reference not in cells:
                raise refuse("Real", reference)
        if len(plans) >= _PLANS:
            plans.clear()
        plans[request] = [cells[reference] for reference in request]
        return plans[request]

    def _no_such(self, kind: Kind, reference: int) -> InputError:
        if not 0 <= reference < len(self.table):
            return InputError(f"{self.name}: value reference {reference} is unknown; it has 0 to {len(self.table) - 1}")
        variable = self.table[reference]
        return InputError(f"{self.name}: {variable.name} (value reference {reference}) is {variable.kind}, not {kind}")

    def _not_settable(self, kind: Kind, reference: int) -> InputError:
        if not 0 <= reference < len(self.table):
            return self._no_such(kind, reference)
        variable = self.table[reference]
        if variable.causality == "output":
            return InputError(f"{self.name}: {variable.name} is an output and cannot be set")
        if variable.causality == "parameter" and self._running:
            return InputError(f"{self.name}: parameter {variable.name} is fixed since initialisation; reset to set it")
        return self._no_such(kind, reference)


def _cell(model: Model, variable: Variable) -> Cell:
    """Find the place of a variable's value in the model, and see that a value of its type lies there."""
    owner: Any = model
    steps = variable.path.split(".")
    try:
        for step in steps[:-1]:
            owner = owner[int(step)] if step.isdigit() else getattr(owner, step)
        last = steps[-1]
        found = owner[int(last)] if last.isdigit() else getattr(owner, last)
        cell: Cell = (found, variable.index) if variable.index is not None else (vars(owner), last)
        value = cell[0][cell[1]]
    except (AttributeError, IndexError, KeyError, TypeError) as error:
        raise ValueError(f"variable {variable.name}: no value at {variable.path}[{variable.index}]: {error}") from None
    if type(value) is not _TYPES[variable.kind] or (variable.items and value not in variable.items):
        raise ValueError(f"variable {variable.name}: {value!r} at {variable.path} is not a value of {variable.kind}")
    return cell


def _described(error: BaseException) -> str:
    """The error in one line, with the place it comes from."""
    trace = error.__traceback__
    place = ""
    while trace is not None:
        place = f" ({trace.tb_frame.f_code.co_filename.rpartition('/')[2]}, line {trace.tb_lineno})"
        trace = trace.tb_next
    return " ".join(f"{type(error).__name__}: {error}".split()) + place
