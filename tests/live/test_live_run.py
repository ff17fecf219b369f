"""A live run and the scenario that it writes: the same files, to the byte."""

from __future__ import annotations

import random
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.errors import InputError
from shipcollision_fmu.live.session.live_run import LiveRun
from shipcollision_fmu.live.session.run_folder import write_run

FILES = ("states.csv", "contacts.csv", "events.json", "signals.csv", "summary.json", "bodies.json")


@pytest.fixture
def run(tmp_path: Path) -> Iterator[LiveRun]:
    """The shipped crossing, whose ships meet after half a minute."""
    with closing(LiveRun(load_scenario("kvlcc2_crossing"), tmp_path)) as made:
        yield made


def advance(run: LiveRun, until: float) -> None:
    while run.time < until - 1e-9:
        run.advance()


def assert_same_again(run: LiveRun, folder: Path) -> None:
    """The run's files are those of its scenario.toml, simulated in process."""
    write_run(run, folder / "live")
    simulate(load_scenario(folder / "live" / "scenario.toml"), in_process=True, out=folder / "again")
    for name in FILES:
        assert (folder / "live" / name).read_bytes() == (folder / "again" / name).read_bytes(), name


def do_anything(run: LiveRun, rng: random.Random) -> None:
    """Now and then an order, a failure, another wind or current."""
    for bridge in run.bridges.values():
        draw = rng.random()
        try:
            if draw < 0.01:
                bridge.order(rng.uniform(-35.0, 35.0), None, None, None)
            elif draw < 0.02:
                bridge.order(None, rng.uniform(0.0, 360.0), rng.uniform(0.0, 1.6), None)
            elif draw < 0.03:
                bridge.order(None, None, None, rng.randint(-4, 4))
            elif draw < 0.034:
                bridge.fail(rng.choice(["rudder", "blackout"]), rng.random() < 0.5)
            elif draw < 0.038:
                run.change((rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)), None)
            elif draw < 0.042:
                run.change(None, (rng.uniform(0.0, 20.0), rng.uniform(0.0, 360.0)))
        except InputError:
            pass  # a stuck rudder, for instance


@pytest.mark.parametrize("seed", [1, 2])
def test_whatever_is_ordered_the_scenario_gives_the_same_run(run: LiveRun, tmp_path: Path, seed: int) -> None:
    rng = random.Random(seed)
    back = {rng.randrange(500, 700), rng.randrange(500, 700)}
    for k in range(900):
        do_anything(run, rng)
        if k == 450:
            run.mark("before")
        if k in back:
            run.go_back("before")
        run.advance()
    assert run.k < 901
    assert_same_again(run, tmp_path)
