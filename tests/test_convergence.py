"""What the steps change: velocities after impact in every shipped scenario, by the substep and by the master's step; in
both languages, but for the scenario whose response is Bullet's.

Per ship, the change of the velocity of CO as a share of its size, and of the whole twist in the norm of the kinetic
energy, which is the one that may add metres and radians. A single small component (a roll rate) changes by more.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from shipcollision_fmu import load_scenario, load_ship, simulate
from shipcollision_fmu.cosim.prepared_files import NATIVE_RESPONSE
from shipcollision_fmu.fmi.names import STATE
from shipcollision_fmu.scenario.scenario import list_scenario_names

pytestmark = pytest.mark.slow

FINEST = 0.01
ENGINES = [
    (engine, name) for name in list_scenario_names() for engine in ("python", "native")
    if engine == "python" or load_scenario(name).collision.response in (None, NATIVE_RESPONSE)
]  # fmt: skip
WAYS = [
    (*each, algorithm) for each in ENGINES for algorithm in ("gauss-seidel", "jacobi")
    if (*each, algorithm) != ("python", "kvlcc2_crossing", "jacobi")
]  # fmt: skip
"""Without the longest run, 20 s in Python: native code, which is tested to be its twin, takes 3 s."""


@cache
def twists(engine: str, name: str, algorithm: str, step: float, substeps: int = 1) -> dict[str, np.ndarray]:
    """Twist (6,) of every ship at the end, with the scenario's substep divided."""
    scenario = load_scenario(name)
    substep = (scenario.collision.substep or FINEST) / substeps
    scenario = scenario.model_copy(update={"collision": scenario.collision.model_copy(update={"substep": substep})})
    run = simulate(scenario, algorithm=algorithm, step=step, engine=engine, in_process=engine == "python")
    last = run.states[-1]
    return {ship: np.array([last[f"{ship}.{variable}"] for variable in STATE[6:]]) for ship in scenario.ships}


def differ(name: str, one: dict[str, np.ndarray], other: dict[str, np.ndarray]) -> float:
    """The largest of the ships' differences."""
    worst = 0.0
    for ship, table in load_scenario(name).ships.items():
        M, d = load_ship(table.ship).M, one[ship] - other[ship]
        worst = max(
            worst, float(np.linalg.norm(d[:3]) / np.linalg.norm(other[ship][:3])),
            float(np.sqrt(d @ M @ d / (other[ship] @ M @ other[ship]))),
        )  # fmt: skip
    return worst


@pytest.mark.parametrize(("engine", "name"), ENGINES)
def test_half_the_substep_changes_velocities_by_less_than_one_per_cent(engine: str, name: str) -> None:
    step = load_scenario(name).step
    one, other = twists(engine, name, "gauss-seidel", step, 2), twists(engine, name, "gauss-seidel", step)
    assert 0.0 < differ(name, one, other) < 0.01


@pytest.mark.parametrize(("engine", "name", "algorithm"), WAYS)
def test_the_communication_step_changes_velocities_by_less_than_two_and_five_per_cent(
    engine: str, name: str, algorithm: str
) -> None:
    finest = twists(engine, name, algorithm, FINEST)
    for step, most in ((0.02, 0.02), (0.05, 0.02), (0.1, 0.02), (0.5, 0.05)):
        assert differ(name, twists(engine, name, algorithm, step), finest) < most, step
