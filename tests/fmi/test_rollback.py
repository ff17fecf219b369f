"""States of the real FMUs, saved and restored through a host in the middle of a collision, exact to the bit; of those
with Python inside, and of those without.

Three instances sail guan2014_added_mass; all that they ever output is compared. Also in another process.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing
from pathlib import Path
from typing import Any

import pytest

from shipcollision_fmu.cosim.component import Component
from shipcollision_fmu.cosim.fmi2_component import Fmi2Component
from shipcollision_fmu.cosim.fmi3_component import Fmi3Component
from shipcollision_fmu.cosim.fmu_instance import UnpackedFmu
from shipcollision_fmu.cosim.master import System, gauss_seidel, jacobi
from shipcollision_fmu.cosim.wiring import connect
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from shipcollision_fmu.scenario.scenario import load_scenario

H = 0.05
STEPS = 40


class Encounter:
    """Own, target and the collision between them, through FMUs of one version of FMI."""

    def __init__(self, fmus: dict[tuple[str, int], Path], fmi: int, stack: ExitStack) -> None:
        self.fmi, self.parts = fmi, list[Any]()
        unpacked = {name: stack.enter_context(closing(UnpackedFmu(fmus[name, fmi])))
                    for name in ("ShipManoeuvring", "ShipCollision")}  # fmt: skip

        def component(name: str, made_from: Any) -> Component:
            fmu = unpacked[made_from.name]
            made = (
                Fmi2Component(name, fmu) if fmi == 2 else Fmi3Component(name, fmu, made_from.table(("own", "target")))
            )
            self.parts.append(stack.enter_context(closing(made)))
            return self.parts[-1]  # type: ignore[no-any-return]  # the component just made

        scenario = load_scenario("guan2014_added_mass")
        ships = lambda name: component(name, MANOEUVRING)  # noqa: E731  # short, and used once
        self.system: System = connect(
            scenario, scenario.load_ships(), ships, lambda: component("collision", COLLISION)
        )[0]
        self.all = [self._all(part) for part in self.parts]

    @staticmethod
    def _all(part: Any) -> list[Any]:
        """Groups of every Real and Integer output of an instance."""
        table = MANOEUVRING.table() if part.name != "collision" else COLLISION.table(("own", "target"))
        outputs = [line for line in table if line.causality == "output"]
        return [
            part.reals([line.name for line in outputs if line.kind == "Real"]),
            part.integers([line.name for line in outputs if line.kind == "Integer"] or ["degrees_of_freedom"]),
        ]

    def step(self, k: int, algorithm: Callable[[System, float, float], None] = gauss_seidel) -> str:
        """One step; everything after it, exactly."""
        algorithm(self.system, k * H, H)
        return self.everything()

    def everything(self) -> str:
        rows = []
        for groups in self.all:
            for group in groups:
                group.read()
                rows.append([value.hex() if isinstance(value, float) else value for value in group.values])
        return json.dumps(rows)

    def touching(self) -> bool:
        count = self.parts[-1].integers(["contact.count"])
        count.read()
        return bool(count.values[0])

    # States, by the FMI functions as fmpy has them. The wires are the master's own memory.

    def save(self) -> list[Any]:
        return [part._fmu.getFMUstate() if self.fmi == 2 else part._fmu.getFMUState() for part in self.parts]

    def restore(self, states: list[Any]) -> None:
        for part, state in zip(self.parts, states, strict=True):
            (part._fmu.setFMUstate if self.fmi == 2 else part._fmu.setFMUState)(state)
        self._wires()

    def free(self, states: list[Any]) -> None:
        for part, state in zip(self.parts, states, strict=True):
            (part._fmu.freeFMUstate if self.fmi == 2 else part._fmu.freeFMUState)(state)

    def serialised(self) -> list[bytes]:
        states = self.save()
        data = [
            (part._fmu.serializeFMUstate if self.fmi == 2 else part._fmu.serializeFMUState)(state)
            for part, state in zip(self.parts, states, strict=True)
        ]
        self.free(states)
        return data

    def deserialise(self, data: list[bytes]) -> None:
        states = [
            (part._fmu.deSerializeFMUstate if self.fmi == 2 else part._fmu.deserializeFMUState)(one)
            for part, one in zip(self.parts, data, strict=True)
        ]
        self.restore(states)
        self.free(states)

    def _wires(self) -> None:
        for wire in (*self.system.states, *self.system.answers):
            wire.outputs.read()


FORMS = ["Python", pytest.param("native", marks=pytest.mark.slow)]


@pytest.fixture(params=FORMS)
def fmus(request: pytest.FixtureRequest) -> dict[tuple[str, int], Path]:
    """Files of both FMUs, by name and version of FMI."""
    if request.param == "Python":
        python: dict[tuple[str, int], Path] = request.getfixturevalue("real_fmus")
        return python
    found = {"ShipManoeuvring": "native_fmus", "ShipCollision": "native_collisions"}
    files = {name: request.getfixturevalue(fixture) for name, fixture in found.items()}
    return {(name, fmi): by_flavour[str(fmi)] for name, by_flavour in files.items() for fmi in (2, 3)}


@pytest.fixture
def encounter(fmus: dict[tuple[str, int], Path], _tidy_path: None) -> Iterator[Callable[[int], Encounter]]:
    with ExitStack() as stack:
        yield lambda fmi: Encounter(fmus, fmi, stack)


@pytest.mark.parametrize(
    ("algorithm", "touching", "fmi"),
    [
        (gauss_seidel, 2, 3),
        pytest.param(jacobi, 10, 2, marks=pytest.mark.slow),
        pytest.param(gauss_seidel, 2, 2, marks=pytest.mark.slow),
        pytest.param(jacobi, 10, 3, marks=pytest.mark.slow),
    ],
)
def test_any_step_can_be_taken_back(
    encounter: Callable[[int], Encounter], algorithm: Any, touching: int, fmi: int
) -> None:
    """At every step: save, two steps ahead, back, and the same two again. A parallel master keeps the ships in contact
    for some steps, a sequential one strikes twice."""
    one = encounter(fmi)
    contacts = 0
    for k in range(STEPS):
        before, states = one.everything(), one.save()
        ahead = [one.step(k + j, algorithm) for j in range(2)]
        one.restore(states)
        assert one.everything() == before
        assert [one.step(k + j, algorithm) for j in range(2)] == ahead
        one.restore(states)
        one.free(states)
        one.step(k, algorithm)
        contacts += one.touching()
    assert contacts >= touching


@pytest.mark.parametrize("fmi", [2, 3])
def test_a_state_goes_back_after_a_step_that_was_refused(encounter: Callable[[int], Encounter], fmi: int) -> None:
    one = encounter(fmi)
    while not one.touching():
        one.step(0)
    states, ahead = one.save(), one.step(1)
    one.restore(states)
    place = one.parts[-1].reals(["own.position.north"])
    place.values[0] = float("nan")
    place.write()
    with pytest.raises(Exception, match="not finite"):
        one.parts[-1].step(H, H)
    one.restore(states)
    one.free(states)
    assert one.step(1) == ahead


GO_ON = """
import json, sys
from contextlib import ExitStack
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from tests.fmi.test_rollback import Encounter, jacobi
fmus = {(name, fmi): Path(path) for name, fmi, path in json.loads(sys.argv[2])}
with ExitStack() as stack:
    one = Encounter(fmus, int(sys.argv[3]), stack)
    one.deserialise([bytes.fromhex(text) for text in json.load(sys.stdin)])
    first = int(sys.argv[4])
    print(json.dumps([one.everything(), *[one.step(k, jacobi) for k in range(first, first + 10)]]))
"""


@pytest.mark.slow
@pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.slow)])
def test_a_new_process_goes_on_from_bytes(
    encounter: Callable[[int], Encounter], fmus: dict[tuple[str, int], Path], fmi: int
) -> None:
    """From the middle of contact."""
    one, k = encounter(fmi), 0
    while not one.touching():
        one.step(k, jacobi)
        k += 1
    one.step(k, jacobi)
    assert one.touching()
    data = one.serialised()
    rest = [one.everything(), *[one.step(j, jacobi) for j in range(k + 1, k + 11)]]
    fmus = json.dumps([[name, version, str(path)] for (name, version), path in fmus.items()])
    done = subprocess.run(
        [sys.executable, "-c", GO_ON, Path(__file__).parents[2], fmus, str(fmi), str(k + 1)],
        input=json.dumps([one.hex() for one in data]), capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout.splitlines()[-1]) == rest
