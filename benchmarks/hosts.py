"""Steps per second of the three-instance encounter in every host, beside our own master; what a set and a get cost.

    python benchmarks/hosts.py [SECONDS]         simulated seconds, default 60

Needs the extra `hosts`. Two VLCCs under way meet in the middle of the run: own, target, collision at 0.05 s, nothing
recorded, all in turns, each figure the best of ROUNDS. "slaves" is what the same calls cost without FMI:
the models behind their access, driven by our loop in process; its share of a host's time is the part that is ours.

A set and a get go through fmi2SetReal and fmi2GetReal with arrays that are there already, all connected variables of an
FMU at once, in turns, for three FMUs with the same variables:

    ours      ShipCollision, initialised
    empty     the same table behind pythonfmu's own set and get, one attribute each, with a step that does nothing
    bare      the same with set and get replaced by the least that Python can do: one list, no checks at all
"""

# ruff: noqa: E402 - the tests' hosts are found only when the root of the project is on the path
from __future__ import annotations

import re
import sys
import tempfile
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from ctypes import c_double, c_uint
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from pythonfmu.builder import FmuBuilder
from rich.console import Console

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.cosim.factories import Factories, fmu_factories, model_factories
from shipcollision_fmu.cosim.master import jacobi
from shipcollision_fmu.cosim.wiring import connect
from shipcollision_fmu.encounters.encounter import encounter
from shipcollision_fmu.fmi.builder.package import build_fmus
from shipcollision_fmu.fmi.ship_collision import INTERFACE
from shipcollision_fmu.packaging.instance import COLLISION
from shipcollision_fmu.packaging.system_structure import build_system_structure
from shipcollision_fmu.scenario.scenario import Scenario, parse_scenario
from tests.hosts.encounter import Encounter, run_master
from tests.hosts.masters import MASTERS

ROUNDS = 3
CALLS = 2000
"""Sets and gets in a round."""
OURS = "our master, parallel"
NOT_A_LOOP = {"fmpy-simulate", "fmpy-ssp"}
"""Their times hold unpacking and starting as well: with this many steps, little."""

EMPTY = """
from pythonfmu import Fmi2Causality, Fmi2Slave, Real

INPUTS, OUTPUTS = {inputs!r}, {outputs!r}


class {name}(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        for causality, names in ((Fmi2Causality.input, INPUTS), (Fmi2Causality.output, OUTPUTS)):
            for name in names:
                setattr(self, name, 0.0)
                self.register_variable(Real(name, causality=causality))
        self.values = [0.0] * (len(INPUTS) + len(OUTPUTS))

    def do_step(self, t, h):
        return True
"""
BARE = """
    def get_real(self, vrs):
        values = self.values
        return [values[vr] for vr in vrs]

    def set_real(self, vrs, given):
        values = self.values
        for vr, value in zip(vrs, given):
            values[vr] = value
"""


def two_tankers(seconds: float) -> Scenario:
    """They meet halfway."""
    made = encounter("t-bone", hydrodynamics=True, time=seconds / 2, after=seconds / 2, name="benchmark")
    return parse_scenario(made.text, "benchmark.toml").changed(algorithm="jacobi")


def our_loop(scenario: Scenario, made: Callable[[ExitStack], Factories]) -> float:
    """Wall time of our own step loop [s], without a recorder."""
    with ExitStack() as stack:
        system, _ = connect(scenario, scenario.load_ships(), *made(stack))
        begin = perf_counter()
        for k in range(scenario.steps):
            jacobi(system, k * scenario.step, scenario.step)
        return perf_counter() - begin


class Calls:
    """An instance of an FMU, and all of some Reals set or got at once."""

    def __init__(self, fmu: Path, folder: Path, inputs: list[str], outputs: list[str], **start: Any) -> None:
        unpacked = extract(str(fmu), str(folder))
        description = read_model_description(unpacked, validate=False)
        references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.fmu = FMU2Slave(
            guid=description.guid, unzipDirectory=unpacked, instanceName="it",
            modelIdentifier=description.coSimulation.modelIdentifier,
        )  # fmt: skip
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.inputs = (c_uint * len(inputs))(*(references[name] for name in inputs))
        self.outputs = (c_uint * len(outputs))(*(references[name] for name in outputs))
        self.given, self.taken = (c_double * len(inputs))(), (c_double * len(outputs))()
        self.given[:] = [float(start.get(name, 0.0)) for name in inputs]
        self.set()
        self.fmu.exitInitializationMode()

    def set(self) -> None:
        self.fmu.dll.fmi2SetReal(self.fmu.component, self.inputs, len(self.given), self.given)

    def get(self) -> None:
        self.fmu.dll.fmi2GetReal(self.fmu.component, self.outputs, len(self.taken), self.taken)


def timed(call: Callable[[], None]) -> float:
    """Wall time of a call [us]."""
    begin = perf_counter()
    for _ in range(CALLS):
        call()
    return 1e6 * (perf_counter() - begin) / CALLS


def main() -> None:
    """Measure and print."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 60.0
    scenario, console = two_tankers(seconds), Console(width=110)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        _hosts(scenario, folder, console)
        _set_and_get(scenario, folder, console)


def _hosts(scenario: Scenario, folder: Path, console: Console) -> None:
    packaged = Encounter.packaged(scenario, folder)
    fmus = build_fmus(folder)
    cases = {host: packaged.case(record=False) for host in MASTERS}
    cases["fmpy-simulate"]["given"] = packaged.ours()[2]
    walls: dict[str, list[float]] = {OURS: [], **{host: [] for host in MASTERS}}
    alone: list[float] = []
    for _ in range(ROUNDS):
        alone.append(our_loop(scenario, lambda stack: model_factories(tuple(scenario.ships), stack)))
        walls[OURS].append(our_loop(scenario, lambda stack: fmu_factories(fmus, stack)))
        for host, case in cases.items():
            walls[host].append(run_master(host, [case], folder)[0]["seconds"])
    slaves, rows = min(alone), {host: min(found) for host, found in walls.items()}
    ours = rows[OURS]
    title = f"{scenario.steps} steps of three instances; the slaves alone {1e6 * slaves / scenario.steps:.0f} us"
    shown = make_table("host", ">steps/s", ">to ours", ">us per step", ">share of the slaves", title=title)
    for host, wall in rows.items():
        said = f"{host} (with start)" if host in NOT_A_LOOP else host
        rate = scenario.steps / wall
        shown.add_row(said, f"{rate:.0f}", f"{ours / wall:.2f}", f"{1e6 / rate:.0f}", f"{100 * slaves / wall:.0f} %")
    console.print(shown)


def _set_and_get(scenario: Scenario, folder: Path, console: Console) -> None:
    connections = build_system_structure(scenario).connections
    inputs = [c.input for c in connections if c.target == COLLISION]
    outputs = [c.output for c in connections if c.source == COLLISION]
    reals = {v.name: v.causality for v in INTERFACE.table(tuple(scenario.ships)) if v.kind == "Real"}
    found = {"ours": _collision(scenario, folder, inputs, outputs)}
    for kind, more in (("empty", ""), ("bare", BARE)):
        slave = kind.capitalize()
        text = EMPTY.format(
            name=slave, inputs=_plain(n for n, causality in reals.items() if causality == "input"),
            outputs=_plain(n for n, causality in reals.items() if causality == "output"),
        )  # fmt: skip
        (folder / f"{kind}.py").write_text(text + more)
        FmuBuilder.build_FMU(folder / f"{kind}.py", dest=folder)
        found[kind] = Calls(folder / f"{slave}.fmu", folder / kind, _plain(inputs), _plain(outputs))
    costs: dict[str, list[tuple[float, float]]] = {kind: [] for kind in found}
    for _ in range(5 * ROUNDS):
        for kind, calls in found.items():
            costs[kind].append((timed(calls.set), timed(calls.get)))
    title = f"set of {len(inputs)} and get of {len(outputs)} Reals through FMI (goal: ours at most 1.3 times empty)"
    shown = make_table("slave", ">set [us]", ">get [us]", ">to empty", ">to bare", title=title)
    both = {kind: median(sum(pair) for pair in pairs) for kind, pairs in costs.items()}
    for kind, pairs in costs.items():
        set_, get = (median(column) for column in zip(*pairs, strict=True))
        ratios = (f"{both[kind] / both[other]:.2f}" for other in ("empty", "bare"))
        shown.add_row(kind, f"{set_:.1f}", f"{get:.1f}", *ratios)
    console.print(shown)


def _plain(names: Iterable[str]) -> list[str]:
    """As names of attributes."""
    return [re.sub(r"\W", "_", name) for name in names]


def _collision(scenario: Scenario, folder: Path, inputs: list[str], outputs: list[str]) -> Calls:
    """The packaged FMU: it starts from the scenario's values."""
    start = next(i for i in build_system_structure(scenario).instances if i.name == COLLISION).start
    return Calls(folder / "osp" / f"{COLLISION}.fmu", folder / "ours", inputs, outputs, **start)


main()
