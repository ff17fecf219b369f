"""One packaged encounter: what a host is given, and what our own master makes of it."""

from __future__ import annotations

import json
import subprocess
import sys
from contextlib import ExitStack, closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from shipcollision_fmu.cosim.component import Component
from shipcollision_fmu.cosim.factories import Factories, model_factories
from shipcollision_fmu.cosim.fmi2_component import Fmi2Component
from shipcollision_fmu.cosim.fmu_instance import UnpackedFmu
from shipcollision_fmu.cosim.master import jacobi
from shipcollision_fmu.cosim.prepared_files import prepare_files
from shipcollision_fmu.cosim.wiring import connect
from shipcollision_fmu.fmi.names import APPLIED, IMPULSE, STATE, named
from shipcollision_fmu.packaging.osp import write_osp
from shipcollision_fmu.packaging.ssp import write_ssp
from shipcollision_fmu.packaging.system_structure import build_system_structure
from shipcollision_fmu.scenario.scenario import Scenario

MASTERS = Path(__file__).with_name("masters.py")
Rows = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Encounter:
    """A scenario packaged in a folder, as package.ssp, package3.ssp (FMI 3.0) and osp/.

    Rows: one per communication point, columns observed.
    """

    scenario: Scenario
    folder: Path

    @classmethod
    def packaged(cls, scenario: Scenario, folder: Path, native: tuple[str, ...] = ()) -> Encounter:
        """native: platforms for which all run without Python."""
        write_osp(scenario, folder / "osp", native=native)
        if not build_system_structure(scenario).orders:
            write_ssp(scenario, folder / "package.ssp", native=native)
            write_ssp(scenario, folder / "package3.ssp", fmi=3, native=native)
        return cls(scenario, folder)

    @property
    def ships(self) -> tuple[str, ...]:
        return tuple(self.scenario.ships)

    @property
    def observed(self) -> list[tuple[str, str]]:
        """Per ship its 12 states and what it applied; then per ship what the collision issued."""
        ships = [(name, variable) for name in self.ships for variable in (*STATE, *APPLIED)]
        return ships + [("collision", variable) for name in self.ships for variable in named(name, IMPULSE)]

    def column(self, instance: str, variables: tuple[str, ...]) -> list[int]:
        return [self.observed.index((instance, variable)) for variable in variables]

    def case(self, *, record: bool = True, **more: Any) -> dict[str, Any]:
        """What masters.py reads."""
        return {
            "osp": str(self.folder / "osp"), "ssp": str(self.folder / "package.ssp"),
            "ssp3": str(self.folder / "package3.ssp"),
            "instances": [*self.ships, "collision"], "steps": self.scenario.steps, "step": self.scenario.step,
            "connections": [
                [c.source, c.output, c.target, c.input] for c in build_system_structure(self.scenario).connections
            ],
            "observed": self.observed, "record": record, **more,
        }  # fmt: skip

    def ours(self, *, through_fmi: bool = False) -> tuple[Rows, int, dict[str, list[float]]]:
        """Our own parallel master in process, or with the packaged FMUs: rows, number of collisions, and every
        connected output by point."""
        with ExitStack() as stack:
            if through_fmi:
                factories, prepared = self._open_fmus(stack), prepare_files(self.scenario)
            else:
                factories, prepared = model_factories(tuple(self.scenario.ships), stack), None
            system, helms = connect(self.scenario, self.scenario.load_ships(), *factories, prepared)
            issued = system.collision.reals([variable for name in self.ships for variable in named(name, IMPULSE)])
            impacts = system.collision.integers(["impact.count"])
            sent = [f"{name}|{variable}" for name in self.ships for variable in (*STATE, *APPLIED)]
            answered = [f"collision|{v}" for name in self.ships for v in named(name, IMPULSE)]
            rows: list[list[float]] = []
            given: dict[str, list[float]] = {key: [] for key in (*sent, *answered)}

            def take_down() -> None:
                issued.read()
                states = [value for wire in system.states for value in wire.outputs.values]
                rows.append([*states, *issued.values])
                for key, value in zip((*sent, *answered), rows[-1], strict=True):
                    given[key].append(value)

            take_down()
            for k in range(self.scenario.steps):
                for helm in helms:
                    helm.send(k)
                jacobi(system, k * self.scenario.step, self.scenario.step)
                take_down()
            impacts.read()
            return np.array(rows), int(impacts.values[0]), given

    def _open_fmus(self, stack: ExitStack) -> Factories:
        """Factories of the instances that the package holds an FMU for each of."""

        def make(name: str) -> Component:
            fmu = stack.enter_context(closing(UnpackedFmu(self.folder / "osp" / f"{name}.fmu")))
            return stack.enter_context(closing(Fmi2Component(name, fmu)))

        return make, lambda: make("collision")

    def rows(self, result: dict[str, Any]) -> Rows:
        """Of what a host found; NaN where it does not show a point."""
        width = len(self.observed)
        return np.array([[np.nan] * width if row is None else row for row in result["rows"]])


def run_master(host: str, cases: list[dict[str, Any]], folder: Path) -> list[dict[str, Any]]:
    """masters.py in a process of its own; AssertionError with all that it said when it fails."""
    given, taken = folder / f"{host}.cases.json", folder / f"{host}.results.json"
    given.write_text(json.dumps(cases))
    done = subprocess.run(
        [sys.executable, str(MASTERS), host, str(given), str(taken)],
        capture_output=True, text=True, check=False, timeout=1200,
    )  # fmt: skip
    assert done.returncode == 0, f"{host} ended with {done.returncode}\n{done.stdout}\n{done.stderr}"
    found: list[dict[str, Any]] = json.loads(taken.read_text())
    return found
