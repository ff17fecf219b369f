"""Workers that run out of memory: a nanny ends them at a limit, as queues and containers do."""

from __future__ import annotations

from pathlib import Path

import pytest

from shipcollision_fmu.errors import HostError
from shipcollision_fmu.study.engine.run import run_study
from tests.study.engine.cluster import process_cluster
from tests.study.engine.folders import digest
from tests.study.engine.stand_in import StandIn, compute_stand_in

pytestmark = pytest.mark.slow

LIMIT = "600MB"
"""A worker with the packages takes some 150 MB, and is ended at 95 % of the limit."""


@pytest.fixture(autouse=True)
def one_death_is_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    """Dask gives a batch to four workers before it gives up; here to one, so that the tests are short."""
    monkeypatch.setenv("DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES", "0")


def test_a_batch_that_takes_too_much_memory_is_halved(tmp_path: Path) -> None:
    """Four rows take 600 MB, two take 300."""
    study = StandIn(rows=4, megabytes=150, bearable=2)
    run_study(StandIn(rows=4), tmp_path / "whole", workers=0, engine="python", compute=compute_stand_in)
    with process_cluster(tmp_path / "cluster", workers=0) as cluster:
        cluster.start_limited_worker(LIMIT)
        result = run_study(
            study, tmp_path / "study", scheduler=cluster.address, engine="python", compute=compute_stand_in
        )
        log = (tmp_path / "cluster" / "log.txt").read_text()
    assert "exceeded 95% memory budget" in log
    assert (result.rows, result.computed) == (4, 4)
    assert digest(tmp_path / "study") == digest(tmp_path / "whole")


def test_a_row_that_takes_more_memory_than_a_worker_has_is_named(tmp_path: Path) -> None:
    with process_cluster(tmp_path / "cluster", workers=0) as cluster:
        cluster.start_limited_worker(LIMIT)
        with pytest.raises(
            HostError, match=r"^row \d ended one worker after the other, killed or out of memory: give ea"
        ):
            run_study(
                StandIn(rows=2, megabytes=700), tmp_path / "study", scheduler=cluster.address, engine="python",
                compute=compute_stand_in,
            )  # fmt: skip
