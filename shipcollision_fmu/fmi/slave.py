"""The base of every slave: a model behind FMI 2.0, through pythonfmu.

A slave in fmu_src/ is a name and an Interface, nothing else. This class makes of it what a host expects:

    get_*, set_*                    straight to the ports, a few microseconds for a hundred Reals
    exit_initialization_mode        the model reads its parameters
    do_step                         fmi2OK, or fmi2Discard and one logged line; the state before the step stays
    _get_fmu_state, ...             the whole state, exact to the bit, JSON as bytes

What the wrapper of pythonfmu 0.7 does with an exception decides the rest. It can answer two things: fmi2Discard, when
do_step returns False, and fmi2Fatal, when any call raises. A call that raises also costs the wrapper one reference
too many to the instance, its class and its log, and whoever uses the instance afterwards (the host that frees it)
works on freed memory.

So nothing raises, with one exception. A refused get or set is logged, changes nothing, answers NaN, 0 or "" where
something must be answered, and makes the next doStep fail. Only initialisation that fails must not pass for success:
there the references are made good first, then an exception is let through, and the host sees fmi2Fatal with the
reason. The instance can still be reset and freed.
"""

from __future__ import annotations

import ctypes
import json
import math
import sys
from contextlib import suppress
from importlib import import_module
from typing import Any, ClassVar, TypeVar
from xml.etree.ElementTree import Element

from pythonfmu.enums import Fmi2Status
from pythonfmu.fmi2slave import Fmi2Slave

from shipcollision_fmu.errors import ShipCollisionError
from shipcollision_fmu.fmi.build_record import confirmed
from shipcollision_fmu.fmi.interface import SHIPS, Interface
from shipcollision_fmu.fmi.model_description import LOG_CATEGORIES, model_description
from shipcollision_fmu.fmi.ports import Ports

__all__ = ["ModelSlave"]

T = TypeVar("T")


class _InitialisationFailed(Exception):  # noqa: N818 - the wrapper shows its repr to the host: the message alone
    def __repr__(self) -> str:
        return str(self)


class ModelSlave(Fmi2Slave):  # type: ignore[misc]  # pythonfmu has no type information
    """An Interface as an FMI 2.0 slave. Subclasses set `interface`, or name the module that holds it as INTERFACE.

    The module is imported only when it is sure that it comes from the right build, and where from: see build_record.

    Raises HostError when it is instantiated on another build of shipcollision_fmu than its own: the host sees the
    instantiation fail.
    """

    interface: ClassVar[Interface | str]
    ports: Ports
    log_categories = LOG_CATEGORIES

    def __init_subclass__(cls, **kwargs: Any) -> None:
        """Keep the slave's module alive: at each instantiation pythonfmu 0.7 runs its text and drops one reference to
        its dictionary too many."""
        super().__init_subclass__(**kwargs)
        if cls.__module__ in sys.modules:
            _keep(vars(sys.modules[cls.__module__]))

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._ships: tuple[str, ...] = SHIPS
        self.guid = ""
        if self.resources is not None:
            record = confirmed(str(self.resources))
            self._ships, self.guid = record.ships, record.guid
        made_from = self.interface
        self._made_from: Interface = import_module(made_from).INTERFACE if isinstance(made_from, str) else made_from
        self.ports = self._made_from.ports(self._ships)
        self._refused = ""  # a call that was refused and that no status has told yet

    def to_xml(self, model_options: Any = None) -> Element:
        """modelDescription.xml."""
        del model_options  # what the slave can do does not depend on the builder
        return model_description(self._made_from, self._ships, str(self.guid))

    # In time. ------------------------------------------------------------------------------

    def exit_initialization_mode(self) -> None:
        """Initialise the model; a failure reaches the host as fmi2Fatal."""
        try:
            if not self._refused:
                self.ports.initialise()
        except BaseException as error:
            self._refused = _line(error)
        if self._refused:
            for lost in (self, type(self), self.log_queue):
                _keep(lost)
            failed = _InitialisationFailed(_printf(f"{self._made_from.name} cannot be initialised: {self._refused}"))
            self._refused = ""
            raise failed

    def do_step(self, current_time: float, step_size: float) -> bool:
        """One step; False (fmi2Discard) when it could not be made."""
        try:
            if not self._refused:
                self.ports.do_step(current_time, step_size)
                return True
            line = f"no step at t = {current_time} s after a refused call: {self._refused}"
        except BaseException as error:
            line = _line(error)
        self._refused = ""
        self._report(line)
        return False

    # Values. ------------------------------------------------------------------------------

    def get_real(self, vrs: list[int]) -> list[float]:
        """Values of Reals; NaN when refused."""
        try:
            return self.ports.get_real(vrs)
        except BaseException as error:
            return self._answer(error, [math.nan] * len(vrs))

    def get_integer(self, vrs: list[int]) -> list[int]:
        """Values of Integers and Enumerations; 0 when refused."""
        try:
            return self.ports.get_integer(vrs)
        except BaseException as error:
            return self._answer(error, [0] * len(vrs))

    def get_boolean(self, vrs: list[int]) -> list[bool]:
        """Values of Booleans; false when refused."""
        try:
            return self.ports.get_boolean(vrs)
        except BaseException as error:
            return self._answer(error, [False] * len(vrs))

    def get_string(self, vrs: list[int]) -> list[str]:
        """Values of Strings; empty when refused."""
        try:
            return self.ports.get_string(vrs)
        except BaseException as error:
            return self._answer(error, [""] * len(vrs))

    def set_real(self, vrs: list[int], values: list[float]) -> None:
        """Set Reals."""
        try:
            self.ports.set_real(vrs, values)
        except BaseException as error:
            self._refuse(error)

    def set_integer(self, vrs: list[int], values: list[int]) -> None:
        """Set Integers and Enumerations."""
        try:
            self.ports.set_integer(vrs, values)
        except BaseException as error:
            self._refuse(error)

    def set_boolean(self, vrs: list[int], values: list[bool]) -> None:
        """Set Booleans."""
        try:
            self.ports.set_boolean(vrs, values)
        except BaseException as error:
            self._refuse(error)

    def set_string(self, vrs: list[int], values: list[str]) -> None:
        """Set Strings."""
        try:
            self.ports.set_string(vrs, values)
        except BaseException as error:
            self._refuse(error)

    # The whole state. ------------------------------------------------------------------------------

    def _get_fmu_state(self) -> dict[str, Any]:
        try:
            return self.ports.save()
        except BaseException as error:
            self._refuse(error)
            return {"of": f"nothing: {_line(error)}"}

    def _set_fmu_state(self, state: dict[str, Any]) -> None:
        try:
            self.ports.restore(state)
            self._refused = ""
        except BaseException as error:
            self._refuse(error)

    @staticmethod
    def _fmu_state_to_bytes(state: dict[str, Any]) -> bytes:
        return json.dumps(state, separators=(",", ":")).encode()  # floats as repr: exact

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> dict[str, Any]:
        try:
            read = json.loads(state)
        except (ValueError, RecursionError) as error:
            return {"of": f"bytes that are no state: {error}"}  # refused by whoever restores it
        return read if isinstance(read, dict) else {"of": "bytes that are no state"}

    def __del__(self) -> None:
        """The host has freed the instance."""
        with suppress(Exception):  # after an instantiation that failed, and when the process ends, little is left
            self.ports.close()

    # Inside. ------------------------------------------------------------------------------

    def _answer(self, error: BaseException, value: list[T]) -> list[T]:
        """Answer a refused get. During initialisation parameters may still be corrected, so it is then only logged."""
        if self.ports.running:
            self._refused = _line(error)
        self._report(_line(error))
        return value

    def _refuse(self, error: BaseException) -> None:
        self._refused = _line(error)
        self._report(self._refused)

    def _report(self, line: str) -> None:
        self.log(_printf(line), Fmi2Status.error)


def _keep(lost: object) -> None:
    """Take a reference that nobody will give back, for the one that pythonfmu's wrapper gives back twice."""
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(lost))


def _printf(line: str) -> str:
    """FMI's logger takes a printf format: a lone percent sign would read the host's memory."""
    return line.replace("%", "%%")


def _line(error: BaseException) -> str:
    message = " ".join(str(error).split())
    return message if isinstance(error, ShipCollisionError) else f"{type(error).__name__}: {message}"
