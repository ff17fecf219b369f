"""What a whole encounter costs through FMUs without Python, beside the same through those with Python.

    python benchmarks/native_encounter.py

The three FMUs of kvlcc2_crossing, 3 000 steps with a parallel master: our own master on FMPy with either form, and the
host in C of examples/host.c with the native form, in turns. Processor time of the step loop, the host's as a whole less
that of no step. FMPy's loop must be 8 times faster with native FMUs, the host's 40 times.
"""

from __future__ import annotations

import resource
import subprocess
import tempfile
from pathlib import Path
from statistics import median
from time import process_time

from fmpy import extract

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.cli.console import print_table
from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.packaging.osp import write_osp
from shipcollision_fmu.scenario.scenario import Scenario
from shipcollision_fmu.toolchain.platforms import find_own_platform

HOST = Path(__file__).resolve().parent.parent / "examples" / "host.c"
TURNS = 3


def time_master(scenario: Scenario, engine: str) -> float:
    """Seconds of processor time from the first step to the last."""
    moments: list[float] = []
    simulate(scenario, engine=engine, progress=lambda done, total: moments.append(process_time()))
    return (moments[-1] - moments[0]) * len(moments) / (len(moments) - 1)


def time_host(program: Path, package: Path, scenario: Scenario, steps: int) -> float:
    """Seconds of processor time of the host in C, with nothing in its environment."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    arguments = [str(package), str(scenario.step), str(steps), *scenario.ships]
    subprocess.run([str(program), *arguments], env={}, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    platform = find_own_platform()
    assert platform is not None
    scenario = load_scenario("kvlcc2_crossing").changed(algorithm="jacobi")
    times: dict[str, list[float]] = {"Python": [], "native": [], "C": []}
    with tempfile.TemporaryDirectory() as home:
        program, package = Path(home, "host"), Path(home, "unpacked")
        write_osp(scenario, Path(home, "osp"), initial_orders=True, native=(platform.name,))
        for name in (*scenario.ships, "collision"):
            extract(str(Path(home, "osp", f"{name}.fmu")), str(package / name))
        subprocess.run(["cc", "-O2", "-o", str(program), str(HOST), "-ldl"], check=True)
        for _ in range(TURNS):
            times["Python"].append(time_master(scenario, "python"))
            times["native"].append(time_master(scenario, "native"))
            start = time_host(program, package, scenario, 0)
            times["C"].append(time_host(program, package, scenario, scenario.steps) - start)
    python, native, host = (median(times[name]) for name in ("Python", "native", "C"))
    shown = make_table("", ">CPU [s]", ">ratio", ">goal", title="kvlcc2_crossing, 150 s in 3 000 steps")
    shown.add_row("FMUs with Python, our master on FMPy", f"{python:.2f}", "1", "")
    shown.add_row("native FMUs, our master on FMPy", f"{native:.3f}", f"{python / native:.1f}", "8")
    shown.add_row("native FMUs, a host in C", f"{host:.3f}", f"{python / host:.0f}", "40")
    print_table(shown)


if __name__ == "__main__":
    main()
