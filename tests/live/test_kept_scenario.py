"""A live run whose process is killed: the scenario that is kept meanwhile gives it again, up to its last writing."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.errors import HostError
from shipcollision_fmu.live.session import kept_scenario, run_folder
from shipcollision_fmu.live.session.commands import ChangeEnvironment, End, Mark, Order, TakeCommand
from shipcollision_fmu.live.session.kept_scenario import UNFINISHED
from shipcollision_fmu.live.session.session import Session

from .live_server import PATIENCE
from .test_pacer import FakeClock

EVERY, ORDERS = 5.0, 100
"""Short, so that runs are."""


@pytest.fixture(autouse=True)
def _short_and_without_page(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run_folder, "write_page", lambda folder: folder / "replay.html")
    monkeypatch.setattr(kept_scenario, "EVERY", EVERY)
    monkeypatch.setattr(kept_scenario, "ORDERS", ORDERS)


def play(folder: Path, script: list[tuple[float, Any]]) -> list[dict[str, Any]]:
    """A run in `folder`/run; at the mark "kill" the folder is copied to `folder`/killed. What was told."""
    clock, told = FakeClock([(0.0, TakeCommand("me", "own")), *script]), list[dict[str, Any]]()
    session = clock.session = Session(load_scenario("kvlcc2_crossing"), out=folder / "run", clock=clock)

    def hear(event: dict[str, Any]) -> None:
        told.append(event)
        if event["kind"] == "mark" and event["name"] == "kill":
            shutil.copytree(folder / "run", folder / "killed")

    session.listen(hear)
    session.start()
    assert session.join(PATIENCE)
    assert session.error is None
    return told


def test_a_killed_run_is_run_again_from_its_orders(tmp_path: Path) -> None:
    """The states are those of the run had it lived, to the bit, up to where it was last written."""
    orders = [(1.0 * k, Order("me", "own", rudder_deg=(-1.0) ** k * 5.0 * k)) for k in range(1, 8)]
    wind = (2.5, ChangeEnvironment(wind=(9.0, 200.0)))
    play(tmp_path, [*orders, wind, (9.0, Mark("kill")), (9.5, End())])
    assert not (tmp_path / "run" / UNFINISHED).exists()
    simulate(load_scenario(tmp_path / "killed" / UNFINISHED), in_process=True, out=tmp_path / "again")
    lived, again = ((tmp_path / name / "states.csv").read_bytes().splitlines() for name in ("run", "again"))
    assert len(again) == pytest.approx(1 + EVERY / 0.05, abs=3)
    assert again == lived[: len(again)]


def test_many_orders_are_written_less_often(tmp_path: Path) -> None:
    """100 000 orders take some seconds, in which the simulation stands still."""
    orders = [(0.05 * k, Order("me", "own", rudder_deg=float(k % 20))) for k in range(1, 98)]
    play(tmp_path, [*orders, (2.5 * EVERY, Mark("kill")), (13.0, End())])
    kept = load_scenario(tmp_path / "killed" / UNFINISHED)
    assert kept.scenario.duration == pytest.approx(EVERY, abs=0.2)


def test_what_an_earlier_run_has_left_is_not_taken_for_this_one(tmp_path: Path) -> None:
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / UNFINISHED).touch()
    play(tmp_path, [(0.5 * EVERY, Mark("kill")), (3.0, End())])
    assert not (tmp_path / "killed" / UNFINISHED).exists()


def test_a_disk_that_is_full_ends_no_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(out: Path, files: Any) -> None:
        raise HostError("no room")

    monkeypatch.setattr(kept_scenario, "write_files", fail)
    told = play(tmp_path, [(2.5 * EVERY, End())])
    lines = [event["message"] for event in told if event["kind"] == "log"]
    assert lines == 2 * ["should the process be killed, the run is lost: no room"] + ["writing the run"]
