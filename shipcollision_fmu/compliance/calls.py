"""What only calls show: an FMU for co-simulation refuses what it must, and goes on afterwards.

    found = findings(fmu)

Each probe makes an instance of its own, in a process beside this one: an FMU that crashes there ends that process
only, and that is then what is found; the other probes are made in the next. FMI wants an error status for a call in
the wrong order; some wrappers can give it only from doStep, so a refusal may also come with the next step.

    python -m shipcollision_fmu.compliance.calls FOLDER PROBE ...      probes on an unpacked FMU; prints findings
"""

from __future__ import annotations

import json
import math
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from ctypes import byref, c_bool, c_double, c_int, c_uint
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile, mkdtemp
from typing import Any

from fmpy import extract, platform_tuple, read_model_description
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

__all__ = ["PROBES", "Probe", "findings"]

OK, WARNING = 0, 1
TIME_OUT = 60.0
"""Seconds that the probes may take."""
_MARK = "finding "
"""Before a line of the process beside; the FMU may print lines of its own."""


class Instance:
    """An FMU instance with the calls that the probes need, in one form for both versions of FMI."""

    def __init__(self, folder: Path, token: str | None = None) -> None:
        self.description = read_model_description(str(folder), validate=False)
        self.fmi = 3 if self.description.fmiVersion.startswith("3") else 2
        made: type = FMU3Slave if self.fmi == 3 else FMU2Slave
        self.fmu: Any = made(
            guid=self.description.guid if token is None else token,
            unzipDirectory=str(folder),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="one",
        )
        self.fmu.instantiate()
        self.dll, self.component = self.fmu.dll, self.fmu.component

    def call(self, name: str, *arguments: Any) -> int:
        """Status of a function; `name` without its prefix."""
        status: int = getattr(self.dll, f"fmi{self.fmi}{name}")(self.component, *arguments)
        return status

    def enter(self) -> int:
        """Into initialisation."""
        if self.fmi == 3:
            return self.call("EnterInitializationMode", False, 0.0, 0.0, False, 0.0)
        status = self.call("SetupExperiment", 0, 0.0, 0.0, 0, 0.0)
        return status if status > WARNING else self.call("EnterInitializationMode")

    def begin(self) -> int:
        """Through initialisation with the start values."""
        status = self.enter()
        return status if status > WARNING else self.call("ExitInitializationMode")

    def step(self, t: float, h: float) -> int:
        """One step."""
        if self.fmi == 2:
            return self.call("DoStep", t, h, 1)
        flags = [byref(c_bool()) for _ in range(3)]
        return self.call("DoStep", t, h, True, *flags, byref(c_double()))

    def h(self) -> float:
        """The step size that the FMU proposes [s]."""
        proposed = self.description.defaultExperiment and self.description.defaultExperiment.stepSize
        return float(proposed or 0.01)

    def set(self, variable: Any, value: float) -> int:
        """Set a Float64 or Real, an Integer or Int32, all elements the same."""
        real = variable.type in ("Real", "Float64")
        size = math.prod(variable.shape) if self.fmi == 3 else 1
        values: Any = (c_double * size)(*[value] * size) if real else (c_int * size)(*[int(value)] * size)
        sizes = (size,) if self.fmi == 3 else ()
        return self.call(f"Set{variable.type}", (c_uint * 1)(variable.valueReference), 1, values, *sizes)

    def reals(self) -> list[str]:
        """Every real output, exactly."""
        found = []
        for variable in self.description.modelVariables:
            if variable.type in ("Real", "Float64") and variable.causality == "output":
                size = math.prod(variable.shape) if self.fmi == 3 else 1
                values, sizes = (c_double * size)(), (size,) if self.fmi == 3 else ()
                self.call(f"Get{variable.type}", (c_uint * 1)(variable.valueReference), 1, values, *sizes)
                found += [value.hex() for value in values]
        return found

    def one(self, causality: str) -> Any:
        """A number of that causality to set; None when there is none."""
        for variable in self.description.modelVariables:
            if variable.causality == causality and variable.type in ("Real", "Float64", "Integer", "Int32"):
                return variable
        return None


@dataclass(frozen=True)
class Probe:
    """A name to call it by, what it demands, whether a breach is a problem or only a note, and the function."""

    name: str
    demand: str
    binding: bool
    broken: Callable[[Path], Iterator[str]]


def runs(folder: Path) -> Iterator[str]:
    """With its start values it initialises and makes a step."""
    one = Instance(folder)
    status = one.begin()
    if status > WARNING:
        yield f"initialisation with the start values answers status {status}"
        return
    status = one.step(0.0, one.h())
    if status > WARNING:
        yield f"the first step answers status {status}"


def step_first(folder: Path) -> Iterator[str]:
    """doStep before initialisation is refused."""
    one = Instance(folder)
    if one.step(0.0, one.h()) <= WARNING:
        yield "doStep before initialisation is not refused"


def exit_first(folder: Path) -> Iterator[str]:
    """exitInitializationMode that was not entered is refused."""
    if Instance(folder).call("ExitInitializationMode") <= WARNING:
        yield "exitInitializationMode without enterInitializationMode is not refused"


def enter_twice(folder: Path) -> Iterator[str]:
    """Initialisation is entered once."""
    one = Instance(folder)
    one.enter()
    if one.enter() <= WARNING and one.call("ExitInitializationMode") <= WARNING:
        yield "enterInitializationMode twice is not refused"


def step_after_the_end(folder: Path) -> Iterator[str]:
    """doStep after terminate is refused."""
    one = Instance(folder)
    one.begin()
    one.call("Terminate")
    if one.step(0.0, one.h()) <= WARNING:
        yield "doStep after terminate is not refused"


def steps_that_are_none(folder: Path) -> Iterator[str]:
    """A step backwards, or of no number, is refused, and a proper one follows."""
    one = Instance(folder)
    one.begin()
    for h in (-one.h(), math.nan):
        if one.step(0.0, h) <= WARNING:
            yield f"a step of {h} s is not refused"
    if one.step(0.0, one.h()) > WARNING:
        yield "after a step that was refused there are no more: set back by reset or a saved state is all that is left"


def outputs_are_not_set(folder: Path) -> Iterator[str]:
    """An output cannot be set."""
    yield from _refused_when_running(folder, "output", "setting output {} is not refused")


def parameters_are_fixed(folder: Path) -> Iterator[str]:
    """A fixed parameter cannot be set after initialisation."""
    one = Instance(folder)
    found = one.one("parameter")
    if found is not None and found.variability == "fixed":
        yield from _refused_when_running(folder, "parameter", "setting parameter {}, fixed, after initialisation")


def unknown_references(folder: Path) -> Iterator[str]:
    """A value reference that is not in the model description is refused."""
    one = Instance(folder)
    one.begin()
    values, kind = (c_double * 1)(), "Float64" if one.fmi == 3 else "Real"
    sizes = (1,) if one.fmi == 3 else ()
    status = one.call(f"Get{kind}", (c_uint * 1)(4_294_967_294), 1, values, *sizes)
    if status <= WARNING and one.step(0.0, one.h()) <= WARNING:
        yield "reading a value reference that does not exist is not refused"


def reset(folder: Path) -> Iterator[str]:
    """After reset it runs again as it did the first time, to the bit."""
    one = Instance(folder)
    results = []
    for _ in range(2):
        if one.begin() > WARNING or one.step(0.0, one.h()) > WARNING:
            yield "after terminate and reset it does not run again"
            return
        results.append(one.reals())
        one.call("Terminate")
        one.call("Reset")
    if results[0] != results[1]:
        yield "after reset the outputs of the first step are others than the first time"


def instances(folder: Path) -> Iterator[str]:
    """Two instances run side by side, unless the description says that there may be one only."""
    one = Instance(folder)
    if one.description.coSimulation.canBeInstantiatedOnlyOncePerProcess:
        return
    two = Instance(folder)
    for each in (one, two):
        if each.begin() > WARNING or each.step(0.0, each.h()) > WARNING:
            yield "two instances do not run side by side"
            return
    one.fmu.freeInstance()
    if two.step(two.h(), two.h()) > WARNING:
        yield "an instance does not go on when another is freed"


def state(folder: Path) -> Iterator[str]:
    """A state that can be saved and restored, also as bytes, gives the same step again, to the bit."""
    one = Instance(folder)
    able = one.description.coSimulation
    if not able.canGetAndSetFMUstate:  # fmpy calls it so for both versions
        return
    get, put, h = ("getFMUState", "setFMUState", one.h()) if one.fmi == 3 else ("getFMUstate", "setFMUstate", one.h())
    one.begin()
    one.step(0.0, h)
    saved = getattr(one.fmu, get)()
    one.step(h, h)
    ahead = one.reals()
    getattr(one.fmu, put)(saved)
    if one.step(h, h) > WARNING or one.reals() != ahead:
        yield "a restored state gives another step than the first time"
    if able.canSerializeFMUstate:
        serialise, read = (
            ("serializeFMUState", "deserializeFMUState") if one.fmi == 3
            else ("serializeFMUstate", "deSerializeFMUstate")
        )  # fmt: skip
        data = getattr(one.fmu, serialise)(saved)
        two = Instance(folder)
        getattr(two.fmu, put)(getattr(two.fmu, read)(data))
        if two.step(h, h) > WARNING or two.reals() != ahead:
            yield "a serialised state, restored in a fresh instance, gives another step"


def wrong_token(folder: Path) -> Iterator[str]:
    """Another guid or instantiation token than the description's is refused."""
    try:
        Instance(folder, token="not the token of this FMU")
    except Exception:
        return
    yield "it is instantiated with a guid (instantiationToken) that is not its own"


PROBES = (
    Probe("runs", "initialises with its start values and steps", True, runs),
    Probe("step-first", "no step before initialisation", True, step_first),
    Probe("exit-first", "no end of initialisation before its start", True, exit_first),
    Probe("enter-twice", "initialisation starts once", True, enter_twice),
    Probe("step-after-end", "no step after terminate", True, step_after_the_end),
    Probe("step-size", "no step backwards", True, steps_that_are_none),
    Probe("set-output", "outputs cannot be set", True, outputs_are_not_set),
    Probe("set-parameter", "fixed parameters stay", True, parameters_are_fixed),
    Probe("reference", "unknown value references are refused", True, unknown_references),
    Probe("reset", "reset is a fresh start", True, reset),
    Probe("instances", "two instances do not disturb each other", True, instances),
    Probe("state", "a restored state repeats to the bit", True, state),
    # No wrapper in Python passes the token on, so this is a fault that nobody behind them can mend.
    Probe("wrong-token", "another token is refused", False, wrong_token),
)
"""Every probe, in the order in which findings are told."""


def findings(fmu: Path) -> list[tuple[Probe, str]]:
    """What the probes find in an FMU file, each in a process of its own; nothing for an FMU that is not for
    co-simulation, or has no library for this platform."""
    folder = Path(mkdtemp(prefix="shipcollision-"))
    try:
        extract(fmu, folder)
        description = read_model_description(str(folder), validate=False)
        fmi3 = description.fmiVersion.startswith("3")
        platform = platform_tuple if fmi3 else {"x86_64-linux": "linux64"}.get(platform_tuple, platform_tuple)
        if description.coSimulation is None or not (folder / "binaries" / platform).is_dir():
            return []
        return list(_probed(folder))
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _probed(folder: Path) -> Iterator[tuple[Probe, str]]:
    """Findings of all probes; after one that ends its process the rest are made in another."""
    left = list(PROBES)
    while left:
        said, ended = _process(folder, [probe.name for probe in left])
        for line in said:
            probe = left.pop(0)
            yield from ((probe, finding) for finding in line)
        if left:
            yield left.pop(0), ended


def _process(folder: Path, names: list[str]) -> tuple[list[list[str]], str]:
    """Findings of the probes that came to an end, and how the process ended."""
    with TemporaryFile("w+", encoding="utf-8", errors="replace") as errors:
        command = [sys.executable, "-m", __name__, str(folder), *names]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors, text=True, errors="replace") as process:
            try:
                said, _ = process.communicate(timeout=TIME_OUT)
                ended = ""
            except subprocess.TimeoutExpired:
                process.kill()
                said, _ = process.communicate()
                ended = f"no answer within {TIME_OUT:g} s"
        errors.seek(0)
        last = errors.read().strip().splitlines()[-1:] or ["no message"]
    if not ended and process.returncode < 0:
        ended = f"crashes the host ({signal.Signals(-process.returncode).name})"
    marked = [line[len(_MARK) :] for line in said.splitlines() if line.startswith(_MARK)]
    return [json.loads(line) for line in marked], ended or f"cannot be tried: {last[0]}"


def _refused_when_running(folder: Path, causality: str, finding: str) -> Iterator[str]:
    one = Instance(folder)
    found = one.one(causality)
    if found is None or one.begin() > WARNING:
        return
    if one.set(found, 1.0) <= WARNING and one.step(0.0, one.h()) <= WARNING:
        yield finding.format(found.name)


def main() -> None:
    """Make probes; findings of each as a list in JSON, on a line of its own behind a mark."""
    folder, *names = sys.argv[1:]
    for name in names:
        probe = next(probe for probe in PROBES if probe.name == name)
        print(f"{_MARK}{json.dumps(list(probe.broken(Path(folder))))}", flush=True)  # noqa: T201 - for who asked


if __name__ == "__main__":
    main()
