"""Probes of what FMI demands and no wrapper in Python can give: the right status at once, handles of states, every URI.

They are binding for an FMU that needs no tool to run (needsExecutionTool). The author of a Python FMU cannot comply:
its wrapper refuses most calls with the next step only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from ctypes import byref, c_void_p
from pathlib import Path
from urllib.parse import quote

from .instance import ERROR, WARNING, Instance

__all__ = [
    "UNKNOWN_REFERENCE", "probe_error_status", "probe_locations", "probe_state_after_end", "probe_state_handle",
]  # fmt: skip

UNKNOWN_REFERENCE = 4_294_967_294
"""A value reference that no FMU has."""


def probe_error_status(folder: Path) -> Iterator[str]:
    """What FMI calls an error answers an error at once: neither success, nor a discarded step, nor fatal."""
    answers = {what: make(Instance(folder)) for what, make in _ERRORS.items()}
    wrong = [f"{what} ({status})" for what, status in answers.items() if status not in (None, ERROR)]
    if wrong:
        yield f"another status than error ({ERROR}): {'; '.join(wrong)}"


def probe_state_handle(folder: Path) -> Iterator[str]:
    """A handle is used again, nulled when it is freed, and freeing nothing is ignored."""
    instance = Instance(folder)
    if not instance.description.coSimulation.canGetAndSetFMUstate or instance.begin() > WARNING:
        return
    kind, h, state = "FMUState" if instance.fmi == 3 else "FMUstate", instance.step_size(), c_void_p()
    if instance.call(f"Free{kind}", byref(state)) > WARNING:
        yield "freeing a state that is a null pointer is refused"
    instance.call(f"Get{kind}", byref(state))
    instance.step(0.0, h)
    expected = instance.read_outputs()
    if instance.call(f"Get{kind}", byref(state)) > WARNING:
        yield "a handle of a state cannot be used for another state"
    instance.step(h, h)
    if instance.call(f"Set{kind}", state) > WARNING or instance.read_outputs() != expected:
        yield "a handle that was used for another state has not that state"
    if instance.call(f"Free{kind}", byref(state)) > WARNING or state.value is not None:
        yield "a handle is not a null pointer after its state was freed"


def probe_state_after_end(folder: Path) -> Iterator[str]:
    """A state brings an instance back that was terminated or reset, and its phase with it."""
    instance = Instance(folder)
    if not instance.description.coSimulation.canGetAndSetFMUstate or instance.begin() > WARNING:
        return
    kind, h, state = "FMUState" if instance.fmi == 3 else "FMUstate", instance.step_size(), c_void_p()
    if instance.step(0.0, h) > WARNING or instance.call(f"Get{kind}", byref(state)) > WARNING:
        return
    for end in ("Terminate", "Reset"):
        instance.call(end)
        if instance.call(f"Set{kind}", state) > WARNING or instance.step(h, h) > WARNING:
            yield f"after {end.lower()} a state does not bring it back"
    instance.call(f"Free{kind}", byref(state))


def probe_locations(folder: Path) -> Iterator[str]:
    """The place of the resources is any URI of RFC 3986 in FMI 2.0; FMI 3.0 has paths instead."""
    if Instance(folder).fmi == 3:
        return
    path = (folder / "resources").as_posix()
    encoded = "".join(c if c in "/:" else "".join(f"%{byte:02x}" for byte in c.encode()) for c in path)
    for location in (f"file:{quote(path)}", f"file://localhost{quote(path)}", f"file://{encoded}"):
        try:
            status = Instance(folder, location=location).begin()
        except Exception:
            status = ERROR
        if status > WARNING:
            yield f"with its resources given as {location} it does not initialise"


def _step_first(instance: Instance) -> int:
    return instance.step(0.0, instance.step_size())


def _exit_first(instance: Instance) -> int:
    return instance.call("ExitInitializationMode")


def _enter_twice(instance: Instance) -> int | None:
    return instance.enter() if instance.begin() <= WARNING else None


def _step_after_end(instance: Instance) -> int | None:
    if instance.begin() > WARNING or instance.call("Terminate") > WARNING:
        return None
    return instance.step(0.0, instance.step_size())


def _step_past_stop(instance: Instance) -> int | None:
    h = instance.step_size()
    return instance.step(0.0, 2.0 * h) if instance.begin(0.0, h) <= WARNING else None


def _read_unknown(instance: Instance) -> int | None:
    return instance.read([UNKNOWN_REFERENCE])[0] if instance.begin() <= WARNING else None


def _set_when_running(instance: Instance, causality: str) -> int | None:
    found = instance.find_variable(causality)
    if found is None or instance.begin() > WARNING or (causality == "parameter" and found.variability != "fixed"):
        return None
    return instance.set(found, 1.0)


_ERRORS: dict[str, Callable[[Instance], int | None]] = {
    "doStep before initialisation": _step_first,
    "exitInitializationMode before it was entered": _exit_first,
    "enterInitializationMode of an initialised instance": _enter_twice,
    "doStep after terminate": _step_after_end,
    "a step past the stop time": _step_past_stop,
    "reading an unknown value reference": _read_unknown,
    "setting an output": lambda instance: _set_when_running(instance, "output"),
    "setting a fixed parameter after initialisation": lambda instance: _set_when_running(instance, "parameter"),
}
"""Calls that FMI calls an error, each on an instance of its own; None where it cannot be tried."""
