"""Every step of the ships of the shipped scenarios again by the native model: from each state, and as a whole run."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass, field
from typing import Any

import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.manoeuvring.interface import ShipInputs, ShipParameters
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.scenario.scenario import list_scenario_names
from shipcollision_fmu.ship.loading.library import load_ship
from tests.native.kernels import load_kernels
from tests.native.manoeuvring.state import RUN, STEP, compare, give_state, take_state
from tests.native.native_ship import NativeShip

MARKS = {"guan2014": pytest.mark.needs("pybullet"), "kvlcc2_crossing": pytest.mark.slow}
"""guan2014 is answered by PyBullet's own dynamics; kvlcc2_crossing is the longest run."""


@dataclass
class Step:
    t: float
    h: float
    inputs: ShipInputs
    before: dict[str, Any]
    after: dict[str, Any]


@dataclass
class Record:
    """The steps of one ship."""

    parameters: ShipParameters
    steps: list[Step] = field(default_factory=list)


def record(name: str) -> list[Record]:
    """The steps of the ships of a scenario."""
    of_model: dict[int, Record] = {}
    original = ShipManoeuvring.step

    def step(model: ShipManoeuvring, t: float, h: float) -> None:
        before, inputs = model.get_state(), deepcopy(model.inputs)
        original(model, t, h)
        taken = of_model.setdefault(id(model), Record(deepcopy(model.parameters)))
        taken.steps.append(Step(t, h, inputs, before, model.get_state()))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ShipManoeuvring, "step", step)
        simulate(load_scenario(name), in_process=True)
    return list(of_model.values())


@pytest.mark.parametrize("name", [pytest.param(name, marks=MARKS.get(name, ())) for name in list_scenario_names()])
def test_each_step_and_the_whole_run(name: str) -> None:
    for taken in record(name):
        length = load_ship(taken.parameters.ship).L_pp
        single, whole = (NativeShip(load_kernels(), parameters=taken.parameters) for _ in range(2))
        give_state(whole, taken.steps[0].before)
        worst = 0.0
        for step in taken.steps:
            give_state(single, step.before)
            single.inputs = whole.inputs = step.inputs
            single.step(step.t, step.h)
            whole.step(step.t, step.h)
            worst = max(worst, compare(take_state(single), step.after, length))
        assert worst <= STEP
        assert compare(take_state(whole), taken.steps[-1].after, length) <= RUN
