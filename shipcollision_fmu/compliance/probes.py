"""Probes: calls that an FMU for co-simulation must refuse, or must answer in the same way again.

Each probe makes its own instances of an unpacked FMU. FMI requires an error status for a call in the wrong order. Some
wrappers can give it only from doStep, so a refusal may also come with the next step.
"""

from __future__ import annotations

import math
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from .instance import DISCARD, WARNING, Instance
from .strict_probes import (
    UNKNOWN_REFERENCE,
    probe_error_status,
    probe_locations,
    probe_state_after_end,
    probe_state_handle,
)

__all__ = ["PROBES", "Probe"]

FOLDER_NAME = "a(1) é#%25"
"""Name of a folder with what a URI encodes: brackets, a space, a letter beyond ASCII, and what a URI uses itself."""


@dataclass(frozen=True)
class Probe:
    """A probe: its name, its demand in words, the versions of FMI in which a breach is a problem (else a note), its
    function; and the versions in which it is one for an FMU that needs no tool to run."""

    name: str
    demand: str
    binding: tuple[int, ...]
    run: Callable[[Path], Iterator[str]]
    without_tool: tuple[int, ...] = ()

    def is_binding(self, fmi: int, needs_tool: bool) -> bool:
        """Whether a breach is a problem in an FMU."""
        return fmi in self.binding or (not needs_tool and fmi in self.without_tool)


def probe_run(folder: Path) -> Iterator[str]:
    """It initialises with its start values and makes a step."""
    instance = Instance(folder)
    status = instance.begin()
    if status > WARNING:
        yield f"initialisation with the start values answers status {status}"
        return
    status = instance.step(0.0, instance.step_size())
    if status > WARNING:
        yield f"the first step answers status {status}"


def probe_step_first(folder: Path) -> Iterator[str]:
    """doStep before initialisation is refused."""
    instance = Instance(folder)
    if instance.step(0.0, instance.step_size()) <= WARNING:
        yield "doStep before initialisation is not refused"


def probe_exit_first(folder: Path) -> Iterator[str]:
    """exitInitializationMode that was not entered is refused."""
    if Instance(folder).call("ExitInitializationMode") <= WARNING:
        yield "exitInitializationMode without enterInitializationMode is not refused"


def probe_enter_twice(folder: Path) -> Iterator[str]:
    """Initialisation is entered once."""
    instance = Instance(folder)
    instance.enter()
    if instance.enter() <= WARNING and instance.call("ExitInitializationMode") <= WARNING:
        yield "enterInitializationMode twice is not refused"


def probe_step_after_terminate(folder: Path) -> Iterator[str]:
    """doStep after terminate is refused."""
    instance = Instance(folder)
    instance.begin()
    instance.call("Terminate")
    if instance.step(0.0, instance.step_size()) <= WARNING:
        yield "doStep after terminate is not refused"


def probe_step_sizes(folder: Path) -> Iterator[str]:
    """A step of negative size or NaN is refused. After a discarded step a proper step follows; after an error FMI
    allows no step, so none is asked for."""
    for h in (-1.0, math.nan):
        instance = Instance(folder)
        if instance.begin() > WARNING:
            return
        status = instance.step(0.0, h * instance.step_size())
        if status <= WARNING:
            yield f"a step of {h * instance.step_size()} s is not refused"
        if status <= DISCARD and instance.step(0.0, instance.step_size()) > WARNING:
            yield "after a discarded step no further step succeeds: only reset or a saved state helps"
            return


def probe_stop_time(folder: Path) -> Iterator[str]:
    """A step that ends after the stop time of the experiment is refused, and the last one before it is not."""
    instance = Instance(folder)
    h = instance.step_size()
    if instance.begin(0.0, 2.0 * h) > WARNING:
        return
    if any(instance.step(k * h, h) > WARNING for k in range(2)):
        yield "a step that ends at the stop time is refused"
    elif instance.step(2.0 * h, h) <= WARNING:
        yield "a step that ends after the stop time is not refused"


def probe_start_time(folder: Path) -> Iterator[str]:
    """The variable `time` begins at the start time of the experiment."""
    instance = Instance(folder)
    time = [v for v in instance.description.modelVariables if v.causality == "independent"]
    start = 100.0 * instance.step_size()
    if not time or time[0].type not in ("Real", "Float64") or instance.begin(start) > WARNING:
        return
    status, (value,) = instance.read([time[0].valueReference])
    if status <= WARNING and not math.isclose(value, start, rel_tol=1e-9):
        yield f"the independent variable is {value} at the start time {start}"


def probe_wrong_reference(folder: Path) -> Iterator[str]:
    """A read that is not refused gives the values of the references that are right, whatever stands beside them."""
    instance = Instance(folder)
    scalars = [
        v.valueReference
        for v in instance.description.modelVariables
        if v.type in ("Real", "Float64") and v.causality == "output" and not getattr(v, "dimensions", None)
    ]
    if not scalars or instance.begin() > WARNING:
        return
    _, (right,) = instance.read(scalars[:1])
    status, values = instance.read([scalars[0], UNKNOWN_REFERENCE])
    if status <= WARNING and values[0].hex() != right.hex():
        yield "one unknown value reference spoils the other values of the call, which is not refused"


def probe_setting_outputs(folder: Path) -> Iterator[str]:
    """An output cannot be set."""
    yield from _set_when_running(folder, "output", "setting output {} is not refused")


def probe_setting_parameters(folder: Path) -> Iterator[str]:
    """A fixed parameter cannot be set after initialisation."""
    instance = Instance(folder)
    found = instance.find_variable("parameter")
    if found is not None and found.variability == "fixed":
        yield from _set_when_running(folder, "parameter", "setting parameter {}, fixed, after initialisation")


def probe_unknown_references(folder: Path) -> Iterator[str]:
    """A value reference that is not in the model description is refused."""
    instance = Instance(folder)
    instance.begin()
    status, _ = instance.read([UNKNOWN_REFERENCE])
    if status <= WARNING and instance.step(0.0, instance.step_size()) <= WARNING:
        yield "reading a value reference that does not exist is not refused"


def probe_reset(folder: Path) -> Iterator[str]:
    """After reset it repeats the first step to the bit."""
    instance = Instance(folder)
    results = []
    for again in (False, True):
        if instance.begin() > WARNING or instance.step(0.0, instance.step_size()) > WARNING:
            if again:
                yield "after terminate and reset it does not run again"
            return
        results.append(instance.read_outputs())
        instance.call("Terminate")
        instance.call("Reset")
    if results[0] != results[1]:
        yield "after reset the outputs of the first step differ from the first time"


def probe_instances(folder: Path) -> Iterator[str]:
    """Two instances run side by side, unless the description allows only instance."""
    instance = Instance(folder)
    if instance.description.coSimulation.canBeInstantiatedOnlyOncePerProcess:
        return
    other = Instance(folder)
    for each in (instance, other):
        if each.begin() > WARNING or each.step(0.0, each.step_size()) > WARNING:
            if each is other:
                yield "two instances do not run side by side"
            return
    instance.fmu.freeInstance()
    if other.step(other.step_size(), other.step_size()) > WARNING:
        yield "an instance fails when another is freed"


def probe_state(folder: Path) -> Iterator[str]:
    """A saved and restored state, also as bytes, repeats the step to the bit."""
    instance = Instance(folder)
    able = instance.description.coSimulation
    if not able.canGetAndSetFMUstate:  # fmpy calls it so for both versions
        return
    get, put, h = (
        ("getFMUState", "setFMUState", instance.step_size())
        if instance.fmi == 3
        else ("getFMUstate", "setFMUstate", instance.step_size())
    )
    if instance.begin() > WARNING or instance.step(0.0, h) > WARNING:
        return
    saved = getattr(instance.fmu, get)()
    instance.step(h, h)
    expected = instance.read_outputs()
    getattr(instance.fmu, put)(saved)
    if instance.step(h, h) > WARNING or instance.read_outputs() != expected:
        yield "a restored state gives a step that differs from the first time"
    if able.canSerializeFMUstate:
        serialise, read = (
            ("serializeFMUState", "deserializeFMUState") if instance.fmi == 3
            else ("serializeFMUstate", "deSerializeFMUstate")
        )  # fmt: skip
        data = getattr(instance.fmu, serialise)(saved)
        other = Instance(folder)
        getattr(other.fmu, put)(getattr(other.fmu, read)(data))
        if other.step(h, h) > WARNING or other.read_outputs() != expected:
            yield "a serialised state, restored in a fresh instance, gives a step that differs"


def probe_wrong_token(folder: Path) -> Iterator[str]:
    """A guid or instantiation token that differs from the description's is refused."""
    try:
        Instance(folder, token="not the token of this FMU")
    except Exception:
        return
    yield "it is instantiated with a wrong guid (instantiationToken)"


def probe_folder_name(folder: Path) -> Iterator[str]:
    """It runs from a folder whose name needs percent-encoding in a URI."""
    other = folder / FOLDER_NAME
    for part in ("binaries", "resources"):
        if (folder / part).is_dir():
            shutil.copytree(folder / part, other / part)
    shutil.copy(folder / "modelDescription.xml", other)
    instance = Instance(other, by_standard=True)
    if instance.begin() > WARNING:
        yield f"in a folder named {FOLDER_NAME} it does not initialise"


def _set_when_running(folder: Path, causality: str, finding: str) -> Iterator[str]:
    instance = Instance(folder)
    found = instance.find_variable(causality)
    if found is None or instance.begin() > WARNING:
        return
    if instance.set(found, 1.0) <= WARNING and instance.step(0.0, instance.step_size()) <= WARNING:
        yield finding.format(found.name)


_ALL = (2, 3)

PROBES = (
    Probe("runs", "initialises with its start values and steps", _ALL, probe_run),
    Probe("step-first", "no step before initialisation", _ALL, probe_step_first),
    Probe("exit-first", "no end of initialisation before its start", _ALL, probe_exit_first),
    Probe("enter-twice", "initialisation starts once", _ALL, probe_enter_twice),
    Probe("step-after-end", "no step after terminate", _ALL, probe_step_after_terminate),
    Probe("step-size", "no step backwards", _ALL, probe_step_sizes),
    Probe("set-output", "outputs cannot be set", _ALL, probe_setting_outputs),
    Probe("set-parameter", "fixed parameters stay", _ALL, probe_setting_parameters),
    Probe("reference", "unknown value references are refused", _ALL, probe_unknown_references),
    # pythonfmu3 passes neither start nor stop time on, so the author of such an FMU cannot comply.
    Probe("stop-time", "no step after the stop time", (2,), probe_stop_time, _ALL),
    Probe("start-time", "time begins at the start time", (2,), probe_start_time, _ALL),
    Probe("wrong-reference", "a wrong value reference spoils no other value", (), probe_wrong_reference, _ALL),
    Probe("reset", "reset is a fresh start", _ALL, probe_reset),
    Probe("instances", "two instances do not disturb each other", _ALL, probe_instances),
    Probe("state", "a restored state repeats to the bit", _ALL, probe_state),
    # No wrapper in Python passes the token on, so the author of a Python FMU cannot comply; nor with what follows.
    Probe("wrong-token", "another token is refused", (), probe_wrong_token, _ALL),
    Probe("error-status", "what FMI calls an error answers an error at once", (), probe_error_status, _ALL),
    Probe("state-handle", "handles of states are used again and nulled", (), probe_state_handle, _ALL),
    Probe("state-after-end", "a state brings an instance back after its end", (), probe_state_after_end, _ALL),
    Probe("locations", "every form of the place of the resources is read", (), probe_locations, _ALL),
    # pythonfmu's wrapper decodes no URI. The last, since it ends the process.
    Probe("folder-name", f"any name of its folder will do, such as {FOLDER_NAME}", (), probe_folder_name, _ALL),
)
"""Every probe, in the order of the report."""
