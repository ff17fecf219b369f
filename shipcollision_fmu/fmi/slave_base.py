"""What a slave does in every version of FMI: it drives a model, and lets no exception cross into the host.

    exit_initialization_mode        the model reads its parameters
    do_step                         one step, or a refusal and one logged line; the state before the step stays. A step
                                    that was made with a reservation of the model logs it as a warning, and is OK.
                                    What happened in it, such as the beginning of a collision, is logged as an event
    _get_fmu_state, ...             the whole state, exact to the bit, JSON as bytes

The wrappers of pythonfmu 0.7 (FMI 2.0) and pythonfmu3 0.3 (FMI 3.0) decide the rest. Where a call raises, they answer
fatal, and give back one reference too many to the instance, its class and its log: whoever uses the instance
afterwards (the host that frees it) works on freed memory.

So nothing raises, with one exception. A refused get or set, or a call in the wrong order, is logged, changes nothing,
answers NaN, 0 or "" where something must be answered, and makes the next doStep fail. Only initialisation that fails
must not pass for success. There the references are made good first, then an exception passes, and the host receives
fatal with the reason. The instance can still be reset and freed.
"""

from __future__ import annotations

import ctypes
import json
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from hashlib import sha256
from importlib import import_module
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from ..errors import InputError, ShipCollisionError, StepError
from .build_record import confirm_build, read_start_values
from .experiment import Experiment
from .interface import SHIPS, Interface
from .variable_access import VariableAccess
from .variables import Kind
from .wrapper_library import make_library_safe

__all__ = ["EVENTS", "LOG_CATEGORIES", "STDERR", "SlaveBase", "state_from_bytes", "state_to_bytes", "take_reference"]

STDERR = "SHIPCOLLISION_LOG"
"""Environment variable; with the value "stderr", what an FMU logs is printed as well."""

EVENTS = "logEvents"
"""Category of what happens in the model; FMI 2.0 proposes the name."""

LOG_CATEGORIES = {
    EVENTS: "First contact of each collision, one line each.",
    "logStatusError": "Calls that were refused and steps that could not be made, one line each.",
    "logStatusWarning": "Steps that are less exact than they should be, ships that are wired wrongly, one line each.",
}
"""Categories of log messages, and what is in them; the wrappers map the status of a message to its category."""

T = TypeVar("T")

INSTANTIATED, INITIALISING, RUNNING, TERMINATED = "instantiated", "initialising", "running", "terminated"
"""Phases of an instance, between which FMI has one way: reset or a restored state lead back."""


class _InitialisationFailed(Exception):  # noqa: N818 - the wrapper shows its repr to the host: the message alone
    def __repr__(self) -> str:
        return str(self)


class SlaveBase:
    """An Interface as a slave, without what the version of FMI decides. Subclasses set `interface`, or name the module
    that holds it as INTERFACE.

    The module is imported only after its build is confirmed: see build_record.

    Raises HostError when it is instantiated on another build of shipcollision_fmu than its own: the instantiation
    fails in the host.
    """

    log_categories = LOG_CATEGORIES
    interface: ClassVar[Interface | str]
    wrapper: ClassVar[str]
    access: VariableAccess
    resources: str | None
    instance_name: str
    log_queue: list[Any]

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._ships: tuple[str, ...] = SHIPS
        self._scalar = False
        self._start: dict[str, Any] = {}
        self.guid = ""
        if self.resources is not None:
            make_library_safe(str(self.resources))
            record = confirm_build(str(self.resources), self.wrapper)
            self._ships, self.guid, self._scalar = record.ships, record.guid, record.scalar
            self._start = read_start_values(str(self.resources))
        made_from = self.interface
        self._made_from: Interface = import_module(made_from).INTERFACE if isinstance(made_from, str) else made_from
        files = None if self.resources is None else Path(str(self.resources))
        self.access = self._made_from.make_access(self._ships, self._start, files)
        self._phase = INSTANTIATED
        self.experiment = Experiment()
        self._refused = ""  # why a call was refused that no status has reported yet
        self._unanswered = ""  # why the last get was refused

    def report(self, line: str) -> None:
        """Log a line as an error."""
        raise NotImplementedError

    def warn(self, line: str) -> None:
        """Log a line as a warning; no status follows from it."""
        raise NotImplementedError

    def tell(self, line: str) -> None:
        """Log a line of the category EVENTS."""
        raise NotImplementedError

    # In time. ------------------------------------------------------------------------------

    def setup_experiment(
        self, start_time: float, stop_time: float | None = None, tolerance: float | None = None
    ) -> None:
        """Start and stop of the simulation [s]. The models have tolerances of their own."""
        del tolerance
        if self._phase not in (INSTANTIATED, INITIALISING):
            self._refuse(InputError(f"the experiment cannot be set up: the instance is {self._phase}; reset it"))
        elif warning := self.experiment.set_up(start_time, stop_time):
            self._warn(warning)

    def enter_initialization_mode(self) -> None:
        """From here on start values are final, but for corrections."""
        if self._phase == INSTANTIATED:
            self._phase = INITIALISING
        else:
            self._refuse(InputError(f"initialisation cannot be entered: the instance is {self._phase}; reset it"))

    def exit_initialization_mode(self) -> None:
        """Initialise the model; a failure reaches the host as fatal."""
        try:
            if not self._refused and self._phase != INITIALISING:
                raise InputError(f"initialisation is not entered: the instance is {self._phase}")
            if not self._refused:
                self.access.initialise()
                self._phase = RUNNING
                self._pass_warning_on()
        except BaseException as error:
            self._refused = _line(error)
        if self._refused:
            self._print(f"cannot be initialised: {self._refused}")
            for lost in (self, type(self), self.log_queue):
                take_reference(lost)
            failed = _InitialisationFailed(self._text(f"{self._made_from.name} cannot be initialised: {self._refused}"))
            self._refused = ""
            raise failed

    def _pass_warning_on(self) -> None:
        if warning := self.access.warning:
            self._warn(warning)

    def terminate(self) -> None:
        """The last values stay readable; there are no more steps."""
        self._phase = TERMINATED

    def try_step(self, t: float, h: float) -> bool:
        """One step from t to t + h [s]; whether it could be made. If not, the reason is logged."""
        try:
            if not self._refused:
                if self._phase == TERMINATED:
                    raise StepError(f"{self._made_from.name} is terminated at t = {t:g} s: reset it or restore a state")
                gap = self.experiment.check_step(t, h)
                self.access.do_step(t, h)
                self.experiment.finish_step(t, h)
                if gap:
                    self._warn(gap)
                for line in self.access.events:
                    self.tell(line)
                    self._print(line)
                self._pass_warning_on()
                return True
            line = f"no step at t = {t} s after a refused call: {self._refused}"
        except BaseException as error:
            line = _line(error)
        self._refused = ""
        self._log(line)
        return False

    # Values. ------------------------------------------------------------------------------

    def get_values(
        self, get: Callable[[Sequence[int]], list[T]], references: Sequence[int], kinds: tuple[Kind, ...], missing: T
    ) -> list[T]:
        """What a getter gives for references in the table; `missing` in place of what it refuses, which is logged.

        A reference that is wrong costs its own value and no other. During initialisation parameters may still be
        corrected, so a refusal is then only logged, and once: a host asks for dozens of variables, one by one.
        """
        try:
            return get(references)
        except BaseException as error:
            self._note_unanswered(error)
        served = [self.access.serves(reference, kinds) for reference in references]
        if all(served) or not any(served):
            return [missing] * len(references)
        right = [reference for reference, fine in zip(references, served, strict=True) if fine]
        values = iter(self.get_values(get, right, kinds, missing))
        return [next(values) if fine else missing for fine in served]

    def _note_unanswered(self, error: BaseException) -> None:
        line = _line(error)
        if self.access.running:
            self._refused = line
        if self.access.running or line != self._unanswered:
            self._log(line)
        self._unanswered = line

    def set_values(self, put: Callable[[Sequence[int], Any], object], references: list[int], values: list[Any]) -> None:
        """Give values to a setter; its refusal is logged and discards the next step."""
        try:
            put(references, values)
        except BaseException as error:
            self._refuse(error)

    # The whole state. ------------------------------------------------------------------------------

    def _get_fmu_state(self) -> dict[str, Any]:
        try:
            return {**self.access.save(), "phase": self._phase, "experiment": self.experiment.get_state()}
        except BaseException as error:
            self._refuse(error)
            return {"of": f"nothing: {_line(error)}"}

    def _set_fmu_state(self, state: dict[str, Any]) -> None:
        try:
            self.access.restore(state)
            phase = state.get("phase", RUNNING if self.access.running else INSTANTIATED)
            self._phase, self._refused = str(phase), ""
            self.experiment = Experiment()
            if "experiment" in state:  # the state of a run in process has none: no stop time of before is left
                self.experiment.set_state(state["experiment"])
        except BaseException as error:
            self._refuse(error)

    @staticmethod
    def _fmu_state_to_bytes(state: dict[str, Any]) -> bytes:
        return state_to_bytes(state)

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> dict[str, Any]:
        try:
            return state_from_bytes(state)
        except InputError as error:
            return {"of": str(error)}  # refused by whoever restores it

    def __del__(self) -> None:
        """The host has freed the instance."""
        with suppress(Exception):  # after an instantiation that failed, and when the process ends, little is left
            self.access.close()

    # Inside. ------------------------------------------------------------------------------

    def _refuse(self, error: BaseException) -> None:
        self._refused = _line(error)
        self._log(self._refused)

    def _warn(self, line: str) -> None:
        self.warn(line)
        self._print(f"warning: {line}")

    def _log(self, line: str) -> None:
        self.report(line)
        self._print(line)

    def _print(self, line: str) -> None:
        """On stderr, on request: some hosts show nothing of an FMU's log, and drop its status."""
        if os.environ.get(STDERR) == "stderr":
            sys.stderr.write(f"{self._made_from.name} {self.instance_name}: {line}\n")

    @staticmethod
    def _text(line: str) -> str:
        """A line as the host's logger takes it."""
        return line


def state_to_bytes(state: Mapping[str, Any]) -> bytes:
    """A saved state as bytes: JSON, with floats as repr, which is exact, and a digest that shows damage."""
    return _sealed(json.dumps(state, separators=(",", ":")).encode())


def state_from_bytes(data: bytes) -> dict[str, Any]:
    """The state that the bytes are of. Raises InputError for damaged bytes, and for what was never a state."""
    inside = data[len(_sealed(b"")) - 1 : -1]
    if _sealed(inside) != data:
        raise InputError("bytes that are no state, or damaged ones")
    state = json.loads(inside)
    if not isinstance(state, dict):
        raise InputError("bytes that are no state")
    return state


def _sealed(text: bytes) -> bytes:
    return b'{"sha256":"%b","state":%b}' % (sha256(text).hexdigest().encode(), text)


def take_reference(lost: object) -> None:
    """Take a reference for good, in place of the reference that the wrapper gives back twice."""
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(lost))


def _line(error: BaseException) -> str:
    message = " ".join(str(error).split())
    return message if isinstance(error, ShipCollisionError) else f"{type(error).__name__}: {message}"
