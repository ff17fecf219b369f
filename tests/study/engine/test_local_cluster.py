"""A local cluster: the tables of one process, bit for bit, also when workers die under a row."""

from __future__ import annotations

import os
import resource
import signal
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import dask
import distributed  # its defaults must be there before one is changed
import pytest

from shipcollision_fmu.errors import HostError
from shipcollision_fmu.study.engine.batches import Batch
from shipcollision_fmu.study.engine.dask_executor import DaskExecutor
from shipcollision_fmu.study.engine.run import run_study
from tests.study.engine.cluster import DEADLINE, PROJECT, wait_for
from tests.study.engine.folders import STUDY, digest, list_files
from tests.study.engine.stand_in import StandIn, compute_stand_in

pytestmark = pytest.mark.slow


@pytest.fixture(autouse=True)
def one_death_is_enough() -> Iterator[None]:
    """Dask gives a row to four workers before it gives up; here to one, so that the tests are short."""
    assert distributed.__version__
    with dask.config.set({"distributed.scheduler.allowed-failures": 0}):
        yield


def test_two_workers_give_the_bytes_of_one_process(
    whole: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lines: list[str] = []
    out: list[int] = []
    submit = DaskExecutor.submit

    def count(self: DaskExecutor, batch: Batch) -> None:
        submit(self, batch)
        out.append(len(self._out))

    monkeypatch.setattr(DaskExecutor, "submit", count)
    run_study(STUDY, tmp_path / "study", workers=2, engine="python", compute=compute_stand_in, notify=lines.append)
    assert digest(tmp_path / "study") == digest(whole)
    assert max(out) == 4  # two for each worker, so that memory is bounded
    assert [line.partition("127.0.0.1:")[0] for line in lines] == ["dashboard: http://"]


def test_real_rows_are_those_of_one_process(tmp_path: Path) -> None:
    for workers in (0, 2):
        run_study("quick", tmp_path / str(workers), workers=workers)
    assert len(digest(tmp_path / "0")) == 2
    assert list_files(tmp_path / "2") == list_files(tmp_path / "0")
    assert digest(tmp_path / "2") == digest(tmp_path / "0")


def test_workers_take_no_part_of_the_package_that_an_fmu_has_brought(
    whole: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """FMUs hold a part of it, put it first on the path of the process that runs them, and leave it there."""
    (tmp_path / "resources" / "shipcollision_fmu").mkdir(parents=True)
    (tmp_path / "resources" / "shipcollision_fmu" / "__init__.py").write_text("")
    path = [str(tmp_path / "resources"), *sys.path]
    monkeypatch.setattr(sys, "path", list(path))
    run_study(STUDY, tmp_path / "study", workers=1, engine="python", compute=compute_stand_in)
    assert digest(tmp_path / "study") == digest(whole)
    assert sys.path == path


def test_a_disk_that_fills_under_a_worker_ends_the_study_with_one_line(whole: Path, tmp_path: Path) -> None:
    """Workers write whole parts; a limit of the size of files, which they inherit, stands for the full disk."""
    out = tmp_path / "study"
    largest = max(path.stat().st_size for path in whole.rglob("*.parquet"))
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (largest - 1, before[1]))
    try:
        with pytest.raises(HostError, match=rf"^cannot write to {out}: File too large; make room on the disk, or its"):
            run_study(STUDY, out, workers=1, engine="python", compute=compute_stand_in)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert not [path for path in list_files(out) if ".shipcollision" in path]
    run_study(STUDY, out, workers=1, resume=True, engine="python", compute=compute_stand_in)
    assert digest(out) == digest(whole)


def test_a_batch_that_kills_its_worker_is_halved(whole: Path, tmp_path: Path) -> None:
    run_study(
        replace(STUDY, deadly=450, bearable=100),
        tmp_path / "study",
        workers=2,
        engine="python",
        compute=compute_stand_in,
    )
    assert digest(tmp_path / "study") == digest(whole)


def test_a_row_that_kills_every_worker_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shipcollision_fmu.study.engine.batches.FIRST_ROWS", 1)
    monkeypatch.setattr("shipcollision_fmu.study.engine.batches.TARGET", 1e-9)
    with pytest.raises(HostError, match=r"^row 5 ended one worker after the other"):
        run_study(StandIn(rows=8, deadly=5), tmp_path / "study", workers=1, engine="python", compute=compute_stand_in)


def test_a_row_that_cannot_be_computed_ends_the_study_with_its_error(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="row 5 cannot be computed"):
        run_study(StandIn(rows=8, fails=5), tmp_path / "study", workers=1, engine="python", compute=compute_stand_in)


CLIENT = """
from dataclasses import replace
from pathlib import Path
import signal, sys
from shipcollision_fmu.study.engine.batches import Batch
from shipcollision_fmu.study.engine.dask_executor import DaskExecutor
from shipcollision_fmu.study.engine.run import run_study
from tests.study.engine.folders import STUDY
from tests.study.engine.stand_in import compute_stand_in

if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell that starts the tests may have it ignored
    study = replace(STUDY, gate=sys.argv[1], gated=500)
    try:
        run_study(study, Path(sys.argv[2]), workers=2, engine="python", compute=compute_stand_in)
    except KeyboardInterrupt as interrupt:
        sys.exit(str(interrupt))
"""


def is_running(pid: int) -> bool:
    """A process that has ended may stay as a zombie until the one that inherited it asks for its status."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT])
def test_a_client_that_is_ended(whole: Path, tmp_path: Path, number: signal.Signals) -> None:
    """Killed, or interrupted with all of its processes as by Ctrl-C in a terminal: the workers end, and the rest is
    computed later."""
    out, gate = tmp_path / "study", tmp_path / "gate"
    (tmp_path / "client.py").write_text(CLIENT, encoding="utf-8")
    client = subprocess.Popen(
        [sys.executable, str(tmp_path / "client.py"), str(gate), str(out)],
        env=os.environ | {"PYTHONPATH": str(PROJECT)}, stderr=subprocess.PIPE, text=True, start_new_session=True,
    )  # fmt: skip
    workers: list[int] = []
    try:
        wait_for(lambda: len(list(tmp_path.glob("gate.*"))) == 2)
        wait_for(lambda: len(list((out / "encounters").glob("part-*"))) == 2)
        workers += [int(path.suffix[1:]) for path in tmp_path.glob("gate.*")]
        if number == signal.SIGINT:
            os.killpg(client.pid, number)
        else:
            client.kill()
        _, said = client.communicate(timeout=DEADLINE)
        wait_for(lambda: not any(map(is_running, workers)))
    finally:
        gate.touch()
        client.kill()
        client.wait()
        for pid in workers:
            if is_running(pid):
                os.kill(pid, signal.SIGKILL)
    if number == signal.SIGINT:
        assert said == f"interrupted; 400 of 1010 rows are in {out}: go on with --resume\n"
        assert client.returncode == 1
    result = run_study(STUDY, out, workers=0, resume=True, engine="python", compute=compute_stand_in)
    assert result.computed == 610
    assert digest(out) == digest(whole)
