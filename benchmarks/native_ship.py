"""What the native ShipManoeuvring costs beside the FMU with Python, both in one process.

    python benchmarks/native_ship.py

doStep alone, through ctypes, of a KVLCC2 under helm with hydrodynamics, in turns of the two FMUs; then the time and the
memory of an instance, made, initialised and freed. Figures are medians of turns. The native step must take at most a
twentieth of the other's and 5 us, an instance 3 ms and 1 MB.
"""

from __future__ import annotations

import ctypes
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from ctypes import c_double
from pathlib import Path
from statistics import median
from time import perf_counter

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave, defaultCallbacks

from shipcollision_fmu import build_fmus
from shipcollision_fmu.cli.console import print_table
from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.fmi.builder.native_fmus import build_native_fmus
from shipcollision_fmu.toolchain.platforms import PLATFORMS, find_own_target

TURNS, STEPS, INSTANCES = 15, 400, 200


def prepare(fmu: Path, folder: Path) -> tuple[Path, dict[str, int]]:
    """The unpacked FMU, and its value references by name."""
    unpacked = Path(extract(str(fmu), str(folder)))
    description = read_model_description(str(unpacked))
    return unpacked, {variable.name: variable.valueReference for variable in description.modelVariables}


@contextmanager
def sailing(unpacked: Path, references: dict[str, int], degrees_of_freedom: int) -> Iterator[FMU2Slave]:
    """An instance under way."""
    guid = read_model_description(str(unpacked)).guid
    fmu = FMU2Slave(guid=guid, unzipDirectory=str(unpacked), modelIdentifier="ShipManoeuvring", instanceName="ship")
    fmu.instantiate(callbacks=defaultCallbacks)
    fmu.setBoolean([references["hydrodynamics"]], [True])
    fmu.setInteger([references["degrees_of_freedom"]], [degrees_of_freedom])
    fmu.setReal([references["initial.velocity.surge"], references["propeller_order"]], [7.0, 1.2])
    fmu.setupExperiment()
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    fmu.setReal([references["rudder_order"]], [0.3])
    try:
        yield fmu
    finally:
        fmu.freeInstance()


def time_steps(fmus: list[tuple[Path, dict[str, int]]], degrees_of_freedom: int) -> list[float]:
    """Microseconds of doStep of each FMU."""
    took: list[list[float]] = [[] for _ in fmus]
    with sailing(*fmus[0], degrees_of_freedom) as one, sailing(*fmus[1], degrees_of_freedom) as other:
        for turn in range(TURNS):
            for fmu, of in zip((one, other), took, strict=True):
                step, component = fmu.dll.fmi2DoStep, ctypes.c_void_p(fmu.component)
                h, begin = c_double(0.05), perf_counter()
                for k in range(turn * STEPS, (turn + 1) * STEPS):
                    step(component, c_double(k * 0.05), h, 1)
                of.append((perf_counter() - begin) / STEPS * 1e6)
    return [median(of) for of in took]


def resident() -> float:
    """Memory of this process [MB]."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6


def measure_instances(unpacked: Path, references: dict[str, int]) -> tuple[float, float]:
    """Milliseconds to make and initialise an instance, and its megabytes."""
    guid = read_model_description(str(unpacked)).guid
    kept, took, before = [], [], resident()
    for k in range(INSTANCES):
        fmu = FMU2Slave(guid=guid, unzipDirectory=str(unpacked), modelIdentifier="ShipManoeuvring", instanceName=str(k))
        begin = perf_counter()
        fmu.instantiate(callbacks=defaultCallbacks)
        fmu.setBoolean([references["hydrodynamics"]], [True])
        fmu.setupExperiment()
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        took.append((perf_counter() - begin) * 1e3)
        kept.append(fmu)
    size = (resident() - before) / INSTANCES
    for fmu in kept:
        fmu.freeInstance()
    return median(took), size


def main() -> None:
    """Measure, and print a table."""
    own = find_own_target()
    platform = next(one.name for one in PLATFORMS.values() if own in one.targets)
    with tempfile.TemporaryDirectory() as home:
        python = prepare(build_fmus(home)["ShipManoeuvring"], Path(home, "python"))
        native = prepare(
            build_native_fmus(home, platforms=[platform], names=["ShipManoeuvring"])["ShipManoeuvring"],
            Path(home, "native"),
        )
        shown = make_table("", ">Python", ">native", ">ratio", title="ShipManoeuvring, KVLCC2 under helm")
        for degrees_of_freedom in (3, 4, 6):
            one, other = time_steps([python, native], degrees_of_freedom)
            name = f"doStep, {degrees_of_freedom} degrees of freedom [us]"
            shown.add_row(name, f"{one:.1f}", f"{other:.2f}", f"{one / other:.0f}")
        (ms, size), (native_ms, native_size) = (measure_instances(*fmu) for fmu in (python, native))
        shown.add_row("an instance, initialised [ms]", f"{ms:.2f}", f"{native_ms:.2f}", f"{ms / native_ms:.0f}")
        ratio = size / native_size if native_size > 0.0 else float("inf")
        shown.add_row("an instance [MB]", f"{size:.2f}", f"{native_size:.2f}", f"{ratio:.0f}")
    print_table(shown)


main()
