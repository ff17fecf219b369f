"""Third-party masters, each driven with packaged encounters, in a process of its own.

    python masters.py HOST CASES.json RESULTS.json

CASES is a list of what `Encounter.case` makes; a result holds `rows`, one per communication point: the Real variables
of a case's `observed` in their order (None where the host does not show that point), `impacts`, the number of
collisions at the end, and `seconds`, the wall time of the step loop alone. benchmarks/hosts.py uses the same loops.

A host that is native code may take its process with it; pytest must not be that process.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from ctypes import CDLL
from importlib.metadata import files
from pathlib import Path
from time import perf_counter
from typing import Any

Case = dict[str, Any]
Result = dict[str, Any]


def fmpy_loop(case: Case) -> Result:
    """A loop of our own hand on fmpy.fmi2.FMU2Slave: all outputs are fetched, all inputs sent, then all step."""
    from fmpy import extract, read_model_description
    from fmpy.fmi2 import FMU2Slave

    slaves, references = {}, {}
    for name in case["instances"]:
        directory = extract(Path(case["osp"], f"{name}.fmu"))
        description = read_model_description(directory)
        references[name] = {variable.name: variable.valueReference for variable in description.modelVariables}
        slaves[name] = FMU2Slave(
            guid=description.guid, unzipDirectory=directory, instanceName=name,
            modelIdentifier=description.coSimulation.modelIdentifier,
        )  # fmt: skip
        slaves[name].instantiate()
        slaves[name].setupExperiment(startTime=0.0)
        slaves[name].enterInitializationMode()
        slaves[name].exitInitializationMode()
    wires: dict[tuple[str, str], tuple[list[int], list[int]]] = {}
    for source, output, target, taken in case["connections"]:
        pair = wires.setdefault((source, target), ([], []))
        pair[0].append(references[source][output])
        pair[1].append(references[target][taken])
    observed: dict[str, list[int]] = {}
    for name, variable in case["observed"]:
        observed.setdefault(name, []).append(references[name][variable])

    def row() -> list[float]:
        return [value for name, wanted in observed.items() for value in slaves[name].getReal(wanted)]

    rows = [row()]
    begin = perf_counter()
    for k in range(case["steps"]):
        values = {pair: slaves[pair[0]].getReal(outputs) for pair, (outputs, _) in wires.items()}
        for pair, (_, inputs) in wires.items():
            slaves[pair[1]].setReal(inputs, values[pair])
        for slave in slaves.values():
            slave.doStep(currentCommunicationPoint=k * case["step"], communicationStepSize=case["step"])
        if case["record"]:
            rows.append(row())
    seconds = perf_counter() - begin
    impacts = slaves["collision"].getInteger([references["collision"]["impact.count"]])[0]
    for slave in slaves.values():
        slave.terminate()
        slave.freeInstance()
    return {"rows": rows, "impacts": impacts, "seconds": seconds}


def fmpy_simulate(case: Case) -> Result:
    """fmpy.simulate_fmu, which knows one FMU: each in turn, fed with what our own master gave it at every point."""
    import numpy as np
    from fmpy import simulate_fmu

    steps, step = case["steps"], case["step"]
    series: dict[tuple[str, str], Any] = {}
    begin, impacts = perf_counter(), 0
    for name in case["instances"]:
        fed = {taken: case["given"][f"{source}|{output}"]
               for source, output, target, taken in case["connections"] if target == name}  # fmt: skip
        signals = np.zeros(steps + 1, dtype=[("time", float)] + [(variable, float) for variable in fed])
        signals["time"] = [k * step for k in range(steps + 1)]
        for variable, values in fed.items():
            signals[variable] = values
        wanted = [variable for instance, variable in case["observed"] if instance == name]
        found = simulate_fmu(
            str(Path(case["osp"], f"{name}.fmu")), stop_time=steps * step, output_interval=step, input=signals,
            output=[*wanted, "impact.count"] if name == "collision" else wanted,
        )  # fmt: skip
        for variable in wanted:
            series[name, variable] = found[variable].tolist()
        if name == "collision":
            impacts = int(found["impact.count"][-1])
    rows = [[series[instance, variable][k] for instance, variable in case["observed"]] for k in range(steps + 1)]
    return {"rows": rows, "impacts": impacts, "seconds": perf_counter() - begin}


def fmpy_ssp(case: Case) -> Result:
    """fmpy.ssp: its recorder shows the points after the first step. It unpacks and starts inside the timed part."""
    from fmpy.ssp.simulation import simulate_ssp

    steps, step = case["steps"], case["step"]
    begin = perf_counter()
    found = simulate_ssp(case["ssp"], stop_time=(steps - 0.5) * step, step_size=step)
    seconds = perf_counter() - begin
    columns = [found[f"{instance}.{variable}"].tolist() for instance, variable in case["observed"]]
    return {"rows": [None, *map(list, zip(*columns, strict=True))], "impacts": None, "seconds": seconds}


def libcosim(case: Case, kind: str) -> Result:
    """The Open Simulation Platform's libcosim, with its fixed-step algorithm."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver

    log_output_level(CosimLogLevel.WARNING)
    load = {"osp": CosimExecution.from_osp_config_file, "ssp": CosimExecution.from_ssp_file}[kind]
    execution = load(case[kind])
    if case.get("scenario"):
        manager = CosimManipulator.create_scenario_manager()
        execution.add_manipulator(manager)
        assert execution.load_scenario(manager, case["scenario"])
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    index = {name: execution.slave_index_from_instance_name(name) for name in case["instances"]}
    references = {
        name: {variable.name.decode(): variable.reference for variable in execution.slave_variables(i)}
        for name, i in index.items()
    }
    observed: dict[str, list[int]] = {}
    for name, variable in case["observed"]:
        observed.setdefault(name, []).append(references[name][variable])

    def row() -> list[float]:
        return [value for name, wanted in observed.items() for value in observer.last_real_values(index[name], wanted)]

    rows: list[Any] = [None]  # nothing is observed before the first step
    if case["record"]:
        begin = perf_counter()
        for _ in range(case["steps"]):
            assert execution.step()
            rows.append(row())
    else:
        assert execution.step()  # initialises
        begin = perf_counter()
        assert execution.step(case["steps"] - 1)
    seconds = perf_counter() - begin
    collision = [references["collision"]["impact.count"]]
    (impacts,) = observer.last_integer_values(index["collision"], collision)
    return {"rows": rows, "impacts": impacts, "seconds": seconds}


def libtbb() -> str:
    """The library that Ecos needs, from the package tbb. pip puts it where no loader looks: load it before ecospy."""
    return next(str(file.locate()) for file in files("tbb") or () if file.name == "libtbb.so.12")


def ecos(case: Case, kind: str) -> Result:
    """NTNU's Ecos, with its fixed-step algorithm."""
    CDLL(libtbb())
    from ecospy import EcosSimulation, EcosSimulationStructure

    if kind == "ssp":
        simulation = EcosSimulation(case["step"], ssp_path=case["ssp"])
    else:
        structure = EcosSimulationStructure()
        for name in case["instances"]:
            structure.add_model(name, str(Path(case["osp"], f"{name}.fmu")))
        for source, output, target, taken in case["connections"]:
            structure.make_real_connection(f"{source}::{output}", f"{target}::{taken}")
        simulation = EcosSimulation(case["step"], structure=structure)
    assert simulation.init()
    names = [f"{instance}::{variable}" for instance, variable in case["observed"]]
    rows = [[simulation.get_real(name) for name in names]]
    begin = perf_counter()
    if case["record"]:
        for _ in range(case["steps"]):
            simulation.step()
            rows.append([simulation.get_real(name) for name in names])
    else:
        simulation.step(case["steps"])
    seconds = perf_counter() - begin
    impacts = simulation.get_integer("collision::impact.count")
    simulation.terminate()
    simulation.free()
    return {"rows": rows, "impacts": impacts, "seconds": seconds}


def container(case: Case, fmi: int) -> Result:
    """A container of fmu-manipulation-toolbox: the .ssp becomes one FMU, whose own master FMPy then steps."""
    import subprocess
    from tempfile import TemporaryDirectory

    import numpy as np
    from fmpy import simulate_fmu

    ssp, steps, step = Path(case["ssp" if fmi == 2 else "ssp3"]), case["steps"], case["step"]
    names = [f"{instance}.{variable}" for instance, variable in case["observed"]]
    with TemporaryDirectory() as folder:
        (Path(folder) / "package.ssp").write_bytes(ssp.read_bytes())
        command = ["-container", f"package.ssp:{step}", "-fmu-directory", ".", "-fmi", str(fmi)]
        tool = Path(sys.executable).with_name("fmucontainer")
        subprocess.run([tool, *command], cwd=folder, check=True, capture_output=True)
        begin = perf_counter()
        found = simulate_fmu(
            str(Path(folder) / "package.fmu"), stop_time=steps * step, output_interval=step, output=names
        )
    rows = np.array([found[name] for name in names]).T.tolist()
    return {"rows": rows, "impacts": None, "seconds": perf_counter() - begin}


MASTERS: dict[str, Callable[[Case], Result]] = {
    "fmpy-loop": fmpy_loop,
    "fmpy-simulate": fmpy_simulate,
    "fmpy-ssp": fmpy_ssp,
    "libcosim-osp": lambda case: libcosim(case, "osp"),
    "libcosim-ssp": lambda case: libcosim(case, "ssp"),
    "ecos-api": lambda case: ecos(case, "api"),
    "ecos-ssp": lambda case: ecos(case, "ssp"),
    "ecos-ssp-fmi3": lambda case: ecos({**case, "ssp": case["ssp3"]}, "ssp"),
    "container": lambda case: container(case, 2),
    "container-fmi3": lambda case: container(case, 3),
}
if sys.version_info < (3, 11):  # libcosimpy has no wheels for CPython 3.10
    MASTERS = {name: master for name, master in MASTERS.items() if not name.startswith("libcosim")}


def main() -> None:
    """Run one host on one case after the other."""
    host, cases, results = sys.argv[1:]
    found = [MASTERS[host](case) for case in json.loads(Path(cases).read_text())]
    Path(results).write_text(json.dumps(found))


if __name__ == "__main__":
    main()
