"""The recipes for clusters of the guide, as they stand there: with programs of one's own in place of those of SLURM.

`sbatch` runs the script that it is given, here and at once; `srun` runs a command twice, not a hundred times.
"""

from __future__ import annotations

import os
import re
import shlex
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
import yaml

from tests.free_port import hold_free_port
from tests.study.engine.cluster import DEADLINE, PROJECT, wait_for
from tests.study.engine.folders import digest

pytestmark = pytest.mark.slow

GUIDE = PROJECT / "docs" / "guide" / "run-studies.md"
STUDY = """
[study]
name = "mine"
level = "impact"
rows = 200
[own]
ships = ["kcs"]
[encounter]
own_speed = { distribution = "uniform", least = 3.0, most = 6.0 }
"""
SBATCH = """#!/bin/sh
for script; do :; done
cp "$script" job-$$.sh
grep -v '^#' job-$$.sh >>jobs
setsid sh job-$$.sh >>log 2>&1 </dev/null &
echo $! >>pids
echo "Submitted batch job $$"
"""
SRUN = """#!/bin/sh
shift
"$@" >>log 2>&1 </dev/null &
"$@" >>log 2>&1 </dev/null
"""


def read_blocks(language: str, word: str) -> list[str]:
    """Blocks of code in the guide with a word in them."""
    blocks = re.findall(rf"^```{language}\n(.*?)^```", GUIDE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    return [block for block in blocks if word in block]


@pytest.fixture
def folder(tmp_path: Path) -> Iterator[Path]:
    """A folder with a study file, and programs of SLURM that are none. What they started ends with the test."""
    (tmp_path / "mine.toml").write_text(STUDY, encoding="utf-8")
    (tmp_path / "bin").mkdir()
    for name, text in (("sbatch", SBATCH), ("srun", SRUN), ("scancel", "#!/bin/sh\n")):
        (tmp_path / "bin" / name).write_text(text, encoding="utf-8")
        (tmp_path / "bin" / name).chmod(0o755)
    yield tmp_path
    for pid in (tmp_path / "pids").read_text().split() if (tmp_path / "pids").exists() else ():
        try:
            os.killpg(int(pid), signal.SIGKILL)
        except ProcessLookupError:
            continue


@contextmanager
def running(folder: Path, *command: str) -> Iterator[subprocess.Popen[bytes]]:
    """A command in the folder, ended with all that it started."""
    path = f"{folder / 'bin'}:{Path(sys.executable).parent}:{os.environ['PATH']}"
    with open(folder / "log", "ab") as log:
        process = subprocess.Popen(
            command, cwd=folder, env=os.environ | {"PATH": path, "PYTHONPATH": str(PROJECT)}, stdout=log, stderr=log,
            start_new_session=True,
        )  # fmt: skip
    try:
        yield process
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


@contextmanager
def after_scheduler(port: int) -> Iterator[None]:
    """Waits until a scheduler listens: its process starts slowly on a busy machine, and a client waits ten seconds."""

    def listens() -> bool:
        try:
            socket.create_connection(("127.0.0.1", port), 1.0).close()
        except OSError:
            return False
        return True

    wait_for(listens)
    yield


def check_rows(folder: Path) -> None:
    """The rows are those of one process."""
    with running(folder, "shipcollision", "study", "mine.toml", "--out", "here", "--workers", "0") as client:
        assert client.wait(timeout=DEADLINE) == 0
    assert digest(folder / "strait") == digest(folder / "here") != {}


def test_workers_that_dask_jobqueue_starts_as_jobs(folder: Path) -> None:
    (script,) = read_blocks("python", "SLURMCluster")
    few = script.replace("cores=20, processes=20", "cores=2, processes=2").replace('"40GB"', '"2GB"')
    few = few.replace("jobs=5", "jobs=1")
    assert few.count("2") != script.count("2")
    (folder / "client.py").write_text(few, encoding="utf-8")
    with running(folder, sys.executable, "client.py") as client:
        assert client.wait(timeout=DEADLINE) == 0, (folder / "log").read_text()
    jobs = (folder / "jobs").read_text()
    assert "-m distributed.cli.dask_worker tcp://" in jobs or "dask worker tcp://" in jobs
    assert "--nthreads 1 " in jobs
    assert "--nworkers 2" in jobs
    check_rows(folder)


def test_a_job_that_finds_its_scheduler_by_a_file(folder: Path) -> None:
    (script,) = read_blocks("sh", "#SBATCH")
    (folder / "job.sh").write_text(script, encoding="utf-8")
    with running(folder, "sh", "job.sh") as job:
        assert job.wait(timeout=DEADLINE) == 0, (folder / "log").read_text()
    check_rows(folder)


def test_processes_on_machines_that_reach_each_other(folder: Path) -> None:
    (script,) = read_blocks("sh", "tcp://HOST:8786")
    scheduler, worker, client = (shlex.split(line, comments=True) for line in script.splitlines())
    assert scheduler[-2:] == ["--port", "8786"]
    with (
        hold_free_port() as port,
        running(folder, *scheduler[:-1], str(port)),
        running(folder, *(word.replace("auto", "2").replace("HOST:8786", f"127.0.0.1:{port}") for word in worker)),
        after_scheduler(port),
        running(folder, *(word.replace("HOST:8786", f"127.0.0.1:{port}") for word in client)) as study,
    ):
        assert study.wait(timeout=DEADLINE) == 0, (folder / "log").read_text()
    check_rows(folder)


def test_the_manifests_of_kubernetes(folder: Path) -> None:
    """Names fit together; the commands of the containers are run here, with the service's name replaced."""
    (text,) = read_blocks("yaml", "kind: Job")
    found = {document["kind"] + " " + document["metadata"]["name"]: document for document in yaml.safe_load_all(text)}
    assert list(found) == [
        "Service study-scheduler",
        "Deployment study-scheduler",
        "Deployment study-workers",
        "Job study",
    ]
    service, scheduler, workers, job = found.values()
    for deployment in (scheduler, workers):
        labels = deployment["spec"]["template"]["metadata"]["labels"]
        assert deployment["spec"]["selector"]["matchLabels"] == labels
    assert service["spec"]["selector"] == scheduler["spec"]["template"]["metadata"]["labels"]
    assert service["spec"]["ports"] == [{"port": 8786}]
    commands = []
    for document in (scheduler, workers, job):
        (container,) = document["spec"]["template"]["spec"]["containers"]
        assert container["image"] == "shipcollision:0.1.0"
        commands.append(container["command"])
    (client,) = job["spec"]["template"]["spec"]["containers"]
    assert [mount["mountPath"] for mount in client["volumeMounts"]] == [client["workingDir"]]
    assert all(any("study-scheduler:8786" in word for word in command) for command in commands[1:])

    def give_port(command: list[str]) -> list[str]:
        return [word.replace("study-scheduler:8786", f"127.0.0.1:{port}") for word in command]

    with (
        hold_free_port() as port,
        running(folder, *commands[0], "--port", str(port)),
        running(folder, *give_port(commands[1])),
        after_scheduler(port),
        running(folder, *give_port(commands[2])) as study,
    ):
        assert study.wait(timeout=DEADLINE) == 0, (folder / "log").read_text()
    check_rows(folder)
