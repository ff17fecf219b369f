"""A step costs at the end of a long run what it costs at its start, through the FMUs.

A run is cut into pieces that do the same. The cost is the number of calls that the interpreter makes, which does not
depend on what else the machine does. Processor time, which does, is compared in the soak only.
"""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing
from pathlib import Path
from time import process_time

import pytest

from shipcollision_fmu.cosim.component import Component
from shipcollision_fmu.cosim.fmi2_component import Fmi2Component
from shipcollision_fmu.cosim.fmu_files import ready_fmus
from shipcollision_fmu.cosim.fmu_instance import UnpackedFmu
from shipcollision_fmu.cosim.simulate import simulate
from shipcollision_fmu.scenario.scenario import load_scenario
from tests.conftest import BARGE, Write

H = 0.05
VISIT = 45
"""Steps from where the ships are apart to the deepest contact, and back again."""
PERIOD = 150
"""Steps from one visit to the next; the ships are apart for longer than a collision lasts."""
LOOK = 20
"""Calls of a look of the diagnosis at a ship, of which a piece may have one more: they come every 64 to 512 steps. What
grows by one call with every visit adds 57 in half an hour."""

Make = Callable[[str], Component]

# Half an hour tells a growth of one call in three visits; what begins later is for the soak.
durations = pytest.mark.parametrize(
    "duration", [pytest.param(1800, marks=pytest.mark.slow), pytest.param(7200, marks=pytest.mark.soak)]
)


@pytest.fixture
def make() -> Iterator[Make]:
    with ExitStack() as stack:

        def made(name: str) -> Component:
            fmu = stack.enter_context(closing(UnpackedFmu(ready_fmus()[name])))
            return stack.enter_context(closing(Fmi2Component("one", fmu)))

        yield made


def calls(piece: Callable[[int], None], pieces: int, ends: int) -> list[int]:
    """Calls, of Python's functions and of C's, that the first and the last `ends` of piece(1) ... piece(pieces) make,
    after one to warm up. Without the garbage collector, which calls what others have hung on it (hypothesis does)."""
    counts = []
    piece(0)
    for k in range(1, pieces + 1):
        if ends < k <= pieces - ends:
            piece(k)
            continue
        count = 0

        def seen(frame: object, event: str, argument: object) -> None:
            nonlocal count
            count += event in ("call", "c_call")

        gc.collect()
        gc.disable()
        sys.setprofile(seen)
        try:
            piece(k)
        finally:
            sys.setprofile(None)
            gc.enable()
        counts.append(count)
    return counts


def visiting(collision: Component, barge: Path, period: int = PERIOD) -> Callable[[int], None]:
    """A piece: own comes, touches target's side, slides along it and leaves. Positions are given, not sailed."""
    place = collision.reals(["own.position.north", "own.position.east", "own.velocity.surge", "own.velocity.sway"])
    impacts = collision.integers(["impact.count"])
    place.values[:] = [0.0, -80.0, 0.0, 0.0]
    other = collision.reals(["target.position.north"])  # at the origin: a ship of which nothing was set is absent
    parameters = {"own.ship": str(barge), "target.ship": str(barge), "feedback": "none", "minimum_separation_time": 1.0}
    collision.initialise(parameters, 1e5, [place, other])

    def piece(k: int) -> None:
        for j in range(period):
            into = max(0.0, 1.0 - abs(j - VISIT) / VISIT)  # 0 apart, 1 deepest
            speed = 0.5 if j < VISIT else -0.5
            place.values[:] = [0.1 * into, -23.0 + 3.5 * into, 0.1, speed if into else 0.0]
            place.write()
            collision.step((k * period + j) * H, H)
        impacts.read()
        assert impacts.values[0] == k + 1  # each visit is a collision of its own

    return piece


def sailing(ship: Component) -> Callable[[int], None]:
    """A piece: a turning ship in six degrees of freedom."""
    orders = ship.reals(["rudder_order", "propeller_order"])
    orders.values[:] = [0.1, 1.5]
    ship.initialise({"ship": "kvlcc2", "degrees_of_freedom": 6, "hydrodynamics": True, "initial.velocity.surge": 7.0},
                    1e5, [orders])  # fmt: skip

    def piece(k: int) -> None:
        for j in range(PERIOD):
            ship.step((k * PERIOD + j) * H, H)

    return piece


@pytest.mark.slow
def test_collisions_cost_the_same_after_others(make: Make, tmp_path: Path) -> None:
    (tmp_path / "barge.toml").write_text(BARGE, encoding="utf-8")
    counts = calls(visiting(make("ShipCollision"), tmp_path / "barge.toml"), 5, 5)
    assert counts[0] > 100 * PERIOD  # the FMU's own calls are among them
    assert max(counts) <= min(counts) + LOOK


@pytest.mark.slow
def test_a_ship_sails_on_at_the_same_cost(make: Make) -> None:
    counts = calls(sailing(make("ShipManoeuvring")), 5, 5)
    assert counts[0] > 100 * PERIOD
    assert counts == counts[:1] * 5


@durations
def test_collisions_at_constant_cost(make: Make, tmp_path: Path, duration: int) -> None:
    (tmp_path / "barge.toml").write_text(BARGE, encoding="utf-8")
    period = 4 * PERIOD
    piece = visiting(make("ShipCollision"), tmp_path / "barge.toml", period)
    counts = calls(piece, round(duration / (period * H)), 3)
    assert max(counts) <= min(counts) + LOOK


@durations
def test_sailing_at_constant_cost(make: Make, duration: int) -> None:
    counts = calls(sailing(make("ShipManoeuvring")), round(duration / (PERIOD * H)), 3)
    assert counts == counts[:1] * 6


@pytest.mark.soak
def test_two_hours_recorded_at_constant_cost(scenario_file: Write) -> None:
    """The whole run: master, recorder and both FMUs, the ships in lasting contact at the start."""
    stamps: list[float] = []
    scenario = load_scenario(scenario_file(("duration = 3.0", "duration = 7200.0")))
    run = simulate(scenario, progress=lambda done, total: stamps.append(process_time()))
    assert len(run.states) == 144_001
    piece = 1440
    costs = [stamps[k + piece] - stamps[k] for k in range(0, len(stamps) - piece, piece)]
    after = [cost for k, cost in enumerate(costs) if k * piece * H > 120.0]  # the ships have parted
    assert min(after[-10:]) / min(after[:10]) < 1.3
