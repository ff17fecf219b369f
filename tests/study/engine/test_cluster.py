"""A scheduler and workers as processes on loopback: whatever dies, the tables are those of one process, bit for bit."""

from __future__ import annotations

import os
import signal
import site
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest

from shipcollision_fmu import __version__
from shipcollision_fmu.errors import HostError
from shipcollision_fmu.study.engine.run import run_study
from tests.study.engine.cluster import DEADLINE, process_cluster, wait_for
from tests.study.engine.folders import STUDY, digest
from tests.study.engine.stand_in import StandIn, compute_stand_in

pytestmark = pytest.mark.slow


class AtTheGate:
    """A study whose rows from some number on wait at a gate, and what happens when workers wait there."""

    def __init__(self, tmp_path: Path, gated: int) -> None:
        self.gate = tmp_path / "gate"
        self.study: StandIn = replace(STUDY, gate=str(self.gate), gated=gated)

    def wait(self, count: int) -> list[int]:
        """The process ids of workers, at least so many, that wait at the gate."""
        wait_for(lambda: len(self._found()) >= count)
        return self._found()

    def open(self) -> None:
        """Lets all rows pass."""
        self.gate.touch()

    def _found(self) -> list[int]:
        return [int(path.suffix[1:]) for path in self.gate.parent.glob("gate.*")]


def test_a_worker_that_is_killed_in_the_middle(whole: Path, tmp_path: Path) -> None:
    at = AtTheGate(tmp_path, gated=500)

    def kill() -> int:
        worker = at.wait(1)[0]
        os.kill(worker, signal.SIGKILL)
        at.open()
        return worker

    with process_cluster(tmp_path / "cluster", workers=3) as cluster, ThreadPoolExecutor() as aside:
        killed = aside.submit(kill)
        result = run_study(
            at.study, tmp_path / "study", scheduler=cluster.address, engine="python", compute=compute_stand_in
        )
        assert killed.result() in [worker.pid for worker in cluster.workers]
    assert digest(tmp_path / "study") == digest(whole)
    assert (result.rows, result.computed) == (1010, 1010)


def test_a_scheduler_that_is_restarted(whole: Path, tmp_path: Path) -> None:
    at = AtTheGate(tmp_path, gated=500)
    lines: list[str] = []

    def restart() -> None:
        at.wait(3)
        assert cluster.scheduler is not None
        cluster.scheduler.kill()
        cluster.scheduler.wait()
        at.open()
        for worker in cluster.workers:
            worker.wait(timeout=DEADLINE)  # by themselves: their scheduler is gone
        cluster.start_scheduler()
        cluster.start_workers(3)

    with process_cluster(tmp_path / "cluster", workers=3) as cluster, ThreadPoolExecutor() as aside:
        restarted = aside.submit(restart)
        result = run_study(
            at.study,
            tmp_path / "study",
            scheduler_file=cluster.file,
            engine="python",
            compute=compute_stand_in,
            notify=lines.append,
        )
        restarted.result()
    assert digest(tmp_path / "study") == digest(whole)
    assert (result.rows, result.computed) == (1010, 1010)
    assert [line for line in lines if line.endswith(("return", "goes on"))] == [
        f"the scheduler of {cluster.file} went away; waiting for it to return",
        f"the scheduler of {cluster.file} is back; the study goes on",
    ]


@pytest.fixture
def packages(tmp_path: Path) -> Path:
    """A folder with the packages of this Python, but ours."""
    made = tmp_path / "packages"
    made.mkdir()
    for place in map(Path, site.getsitepackages()):
        for entry in place.iterdir():
            if "shipcollision" not in entry.name and entry.suffix != ".pth":
                (made / entry.name).symlink_to(entry)
    return made


def test_a_worker_without_the_package_that_comes_later_harms_nothing(
    packages: Path, whole: Path, tmp_path: Path
) -> None:
    """It cannot read its first batch, and ends; others compute that."""
    at = AtTheGate(tmp_path, gated=500)

    def join() -> None:
        try:
            at.wait(1)
            cluster.start_foreign_worker(packages)
            cluster.workers[-1].wait(timeout=DEADLINE)
        finally:
            at.open()

    with process_cluster(tmp_path / "cluster", workers=1) as cluster, ThreadPoolExecutor() as aside:
        joined = aside.submit(join)
        run_study(at.study, tmp_path / "study", scheduler=cluster.address, engine="python", compute=compute_stand_in)
        joined.result()
    assert digest(tmp_path / "study") == digest(whole)


def test_a_cluster_without_the_package_is_refused_in_one_line(packages: Path, tmp_path: Path) -> None:
    python = (sys.executable, "-S")  # no site: the development install is not on its path
    with process_cluster(tmp_path / "cluster", workers=1, python=python, path=packages) as cluster:
        text = f"^the scheduler has no shipcollision-fmu, the client has {__version__}: run `python -m pip install"
        with pytest.raises(HostError, match=text):
            run_study(STUDY, tmp_path / "study", scheduler=cluster.address, engine="python", compute=compute_stand_in)
    assert not (tmp_path / "study").exists()


def test_a_cluster_with_another_version_is_refused_in_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shipcollision_fmu.study.engine.clusters.__version__", "9.9.9")
    with process_cluster(tmp_path / "cluster", workers=0) as cluster:
        text = rf"^the scheduler has shipcollision-fmu {__version__}, the client has 9\.9\.9"
        with pytest.raises(HostError, match=text):
            run_study(STUDY, tmp_path / "study", scheduler=cluster.address, engine="python", compute=compute_stand_in)
    assert not (tmp_path / "study").exists()


def test_a_cluster_without_workers_is_waited_for_and_then_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shipcollision_fmu.study.engine.dask_executor.PATIENCE", 1.0)
    with process_cluster(tmp_path / "cluster", workers=0) as cluster:
        lines: list[str] = []
        text = "has had no worker for 1 s: start one with `dask worker`, then go on with --resume$"
        with pytest.raises(HostError, match=text):
            run_study(
                STUDY, tmp_path / "study", scheduler=cluster.address, engine="python", compute=compute_stand_in,
                notify=lines.append,
            )  # fmt: skip
        assert lines == [  # and no dashboard, which this scheduler does not have
            f"the scheduler at {cluster.address} has no worker; waiting for one, 1 s at most: start one with `dask "
            f"worker {cluster.address}`"
        ]
