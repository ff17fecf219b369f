"""A Dask cluster of processes on loopback, as a user starts it: one scheduler, and workers without a nanny.

Workers end by themselves when their scheduler is gone; whatever is left at the end is killed by its process id.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

__all__ = ["DEADLINE", "PROJECT", "ProcessCluster", "process_cluster", "wait_for"]

PROJECT = Path(__file__).parents[3]
DEADLINE = 300.0
"""Longest time [s] that something may take on a busy machine before a test fails."""


def wait_for(condition: Callable[[], object]) -> None:
    """Returns when a condition holds; fails when it never does."""
    end = time.monotonic() + DEADLINE
    while not condition():
        assert time.monotonic() < end, "never came"
        time.sleep(0.02)


class ProcessCluster:
    """The processes, by the file of their scheduler."""

    def __init__(self, folder: Path, python: tuple[str, ...], path: Path) -> None:
        self._python = python
        self.file = folder / "scheduler.json"
        self._folder = folder
        self._environment = os.environ | {"PYTHONPATH": str(path), "PYTHONWARNINGS": "ignore"}
        self.scheduler: subprocess.Popen[bytes] | None = None
        self.workers: list[subprocess.Popen[bytes]] = []

    @property
    def address(self) -> str:
        """That of the scheduler."""
        return str(json.loads(self.file.read_bytes())["address"])

    def start_scheduler(self) -> None:
        """Starts one on a free port, and waits until it listens."""
        self.file.unlink(missing_ok=True)
        self.scheduler = self._start(
            "scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(self.file)
        )
        wait_for(lambda: self.file.exists() and self.file.read_bytes().strip().endswith(b"}"))

    def start_foreign_worker(self, packages: Path) -> None:
        """Starts a worker whose Python has the packages of a folder alone."""
        self._python = (sys.executable, "-S")  # no site: the development install is not on its path
        self._environment = self._environment | {"PYTHONPATH": str(packages)}
        self.start_workers(1)

    def start_workers(self, count: int) -> None:
        """Starts workers of the scheduler."""
        self.workers += [
            self._start(
                "worker", "--scheduler-file", str(self.file), "--host", "127.0.0.1", "--nthreads", "1", "--no-nanny",
                "--no-dashboard", "--death-timeout", "30", "--local-directory", str(self._folder),
            )
            for _ in range(count)
        ]  # fmt: skip

    def start_limited_worker(self, memory: str) -> None:
        """Starts a worker that a nanny ends and starts again when it takes more memory than so much."""
        options = ("--nthreads", "1", "--no-dashboard", "--death-timeout", "30", "--memory-limit", memory)
        place = ("--scheduler-file", str(self.file), "--host", "127.0.0.1", "--local-directory", str(self._folder))
        self.workers.append(self._start("worker", *place, *options))

    def stop(self) -> None:
        """Ends whatever still runs."""
        for process in [*self.workers, *([self.scheduler] if self.scheduler else [])]:
            if process.poll() is None:
                process.kill()
            process.wait(timeout=DEADLINE)

    def _start(self, *arguments: str) -> subprocess.Popen[bytes]:
        with open(self._folder / "log.txt", "ab") as log:
            return subprocess.Popen(
                [*self._python, "-m", "dask", *arguments], cwd=self._folder, env=self._environment, stdout=log,
                stderr=log,
            )  # fmt: skip


@contextmanager
def process_cluster(
    folder: Path, workers: int, python: tuple[str, ...] = (sys.executable,), path: Path = PROJECT
) -> Iterator[ProcessCluster]:
    """A cluster of so many workers, which has ended afterwards. python: what runs them, with a PYTHONPATH."""
    folder.mkdir(parents=True, exist_ok=True)
    cluster = ProcessCluster(folder, python, path)
    try:
        cluster.start_scheduler()
        cluster.start_workers(workers)
        yield cluster
    finally:
        cluster.stop()
