"""What the FMI layer of native FMUs costs: set all inputs, one step, get all outputs, in ratio to a bare C FMU.

    python benchmarks/fmi_layer.py

Three FMUs of FMI 2.0 take turns in one process: the least that an FMU can be (reference_fmu.c), our layer around a
model that passes its inputs on, of the same shape, and the native ShipManoeuvring with hydrodynamics, beside a bare FMU
of its shape. Each is called through FMPy, as a script does, and through ctypes with arrays made once, as a master in C
does. The layer must cost at most 1.2 times the bare FMU through FMPy.
"""

from __future__ import annotations

import ctypes
import sys
import tempfile
from collections.abc import Callable
from ctypes import c_double, c_size_t, c_uint
from ctypes import c_void_p as pointer
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any

from fmpy.fmi2 import FMU2Slave, defaultCallbacks

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from shipcollision_fmu.fmi.interface import Interface  # noqa: E402  # after the path is set
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as SHIP  # noqa: E402  # after the path is set
from shipcollision_fmu.fmi.variables import real  # noqa: E402  # after the path is set
from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship  # noqa: E402  # after the path is set
from shipcollision_fmu.toolchain.libraries import build_library, native_cache  # noqa: E402  # after the path is set
from shipcollision_fmu.toolchain.platforms import find_own_target  # noqa: E402  # after the path is set
from shipcollision_fmu.toolchain.sources import find_fmi_headers, list_fmu_parts  # noqa: E402  # after the path is set
from tests.compiler import compile_c  # noqa: E402  # after the path is set
from tests.native.fmi.native_fmus import TOKEN, build_test_library, write_fmu  # noqa: E402  # after the path is set

INPUTS, OUTPUTS = 36, 80
ROUNDS, CHAINS = 30, 400
"""Rounds of turns, and chains of calls in a turn; the figures are medians of the rounds."""


class Values:
    """A model of that shape: only its names are used."""

    def __init__(self) -> None:
        self.inputs, self.outputs = [0.0] * INPUTS, [0.0] * OUTPUTS

    def initialise(self) -> None:
        """Nothing."""

    def step(self, t: float, h: float) -> None:
        """Nothing."""

    def get_state(self) -> dict[str, Any]:
        """Nothing."""
        return {}

    def set_state(self, state: dict[str, Any]) -> None:
        """Nothing."""


TABLE = (
    *(real("output", f"out{k}", "1", "outputs", k, "Output") for k in range(OUTPUTS)),
    *(real("input", f"in{k}", "1", "inputs", k, "Input") for k in range(INPUTS)),
)
FEEDTHROUGH = Interface("Feedthrough", "Inputs passed on.", lambda ships: TABLE, lambda ships: Values())

Chain = Callable[[int], None]


def chains(folder: Path, name: str, inputs: list[int], outputs: list[int]) -> tuple[Chain, Chain]:
    """Set, step, get of an instance in that folder: through FMPy, and through ctypes with arrays made once."""
    fmu = FMU2Slave(guid=TOKEN, unzipDirectory=str(folder), modelIdentifier=name, instanceName="one")
    fmu.instantiate(callbacks=defaultCallbacks)
    if name == SHIP.name:
        (hydrodynamics,) = SHIP.make_access().references(["hydrodynamics"])
        fmu.setBoolean([hydrodynamics], [True])
    fmu.setupExperiment()
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    dll, one = ctypes.CDLL(fmu.dll._name), pointer(fmu.component)
    given, got = (c_double * len(inputs))(), (c_double * len(outputs))()
    put, ask = (c_uint * len(inputs))(*inputs), (c_uint * len(outputs))(*outputs)
    n, m, h = c_size_t(len(inputs)), c_size_t(len(outputs)), c_double(0.05)
    values = [0.0] * len(inputs)
    made = [0]

    def through_fmpy(count: int) -> None:
        for _ in range(count):
            fmu.setReal(inputs, values)
            fmu.doStep(made[0] * 0.05, 0.05)
            fmu.getReal(outputs)
            made[0] += 1

    def through_ctypes(count: int) -> None:
        for _ in range(count):
            dll.fmi2SetReal(one, put, n, given)
            dll.fmi2DoStep(one, c_double(made[0] * 0.05), h, 1)
            dll.fmi2GetReal(one, ask, m, got)
            made[0] += 1

    return through_fmpy, through_ctypes


def bare(folder: Path, inputs: int, outputs: int) -> Path:
    """The folder of the least FMU of that shape."""
    binaries = folder / "binaries" / "linux64"
    binaries.mkdir(parents=True)
    shape, source = (f"-DINPUTS={inputs}", f"-DOUTPUTS={outputs}"), ROOT / "benchmarks" / "reference_fmu.c"
    headers = f"-I{find_fmi_headers()}"
    compile_c("-std=c11", "-O2", "-shared", "-fPIC", *shape, headers, source, "-o", binaries / "Bare.so")
    return folder


def main() -> None:
    cache, target = native_cache(), find_own_target()
    assert target is not None
    with tempfile.TemporaryDirectory() as home:
        layer = write_fmu(Path(home, "layer"), build_test_library(cache), FEEDTHROUGH)
        library = build_library(SHIP.name, list_fmu_parts(SHIP.name, cache), target, ("fmi2*", "fmi3*"), cache=cache)
        ship = write_fmu(Path(home, "ship"), library, SHIP)
        (ship / "resources" / "ships").mkdir()
        (ship / "resources" / "ships" / "kvlcc2.ship").write_bytes(prepare_ship("kvlcc2"))
        ins = [k for k, line in enumerate(SHIP.table(())) if line.causality == "input" and line.kind == "Real"]
        outs = [k for k, line in enumerate(SHIP.table(())) if line.causality == "output" and line.kind == "Real"]
        of_shape = {
            f"{INPUTS} in, {OUTPUTS} out": [
                ("Bare", bare(Path(home, "bare"), INPUTS, OUTPUTS), list(range(OUTPUTS, OUTPUTS + INPUTS)),
                 list(range(OUTPUTS))),
                ("Feedthrough", layer, list(range(OUTPUTS, OUTPUTS + INPUTS)), list(range(OUTPUTS))),
            ],
            f"{len(ins)} in, {len(outs)} out": [
                ("Bare", bare(Path(home, "bare ship"), len(ins), len(outs)),
                 list(range(len(outs), len(outs) + len(ins))), list(range(len(outs)))),
                (SHIP.name, ship, ins, outs),
            ],
        }  # fmt: skip
        for shape, fmus in of_shape.items():
            made = [chains(folder, name, inputs, outputs) for name, folder, inputs, outputs in fmus]
            for how, way in (("FMPy", 0), ("ctypes", 1)):
                took: list[list[float]] = [[] for _ in made]
                for _ in range(ROUNDS):
                    for turn, pair in enumerate(made):
                        begin = perf_counter()
                        pair[way](CHAINS)
                        took[turn].append((perf_counter() - begin) / CHAINS * 1e6)
                first, second = map(median, took)
                ratio = median(b / a for a, b in zip(*took, strict=True))
                name = fmus[1][0]
                print(f"{shape}, {how}: bare {first:.1f} us, {name} {second:.1f} us, {ratio:.2f} times")  # noqa: T201  # a program that prints


if __name__ == "__main__":
    main()
