"""A cluster to compute with: a local one of worker processes, or one that exists and is reached by its scheduler.

Scheduler and workers import this package, so each must have the client's version of it.
"""

from __future__ import annotations

import asyncio
import json
import logging
import socket
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import dask
from dask.system import CPU_COUNT
from distributed import Client, LocalCluster, Security
from distributed.comm import connect

from ... import __version__
from ...errors import HostError, InputError
from .main_guard import explain_missing_guard
from .versions import DISTRIBUTION, describe_other_version

__all__ = ["ANSWER", "Cluster", "check_versions", "quiet_dask", "start_local_cluster", "use_scheduler"]

WRITER = "`dask scheduler --scheduler-file FILE` writes it"
ANSWER = 10.0
"""Time [s] within which a scheduler answers. A scheduler that is busy with others takes some seconds."""

LESS_WORK = {
    "distributed.admin.tick.interval": "1s",
    "distributed.worker.profile.enabled": False,
    "distributed.nanny.pre-spawn-environ": {
        **dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), 1),
        **dict.fromkeys(("MALLOC_TRIM_THRESHOLD_", "MALLOC_MMAP_THRESHOLD_"), 2**30),
    },
}
"""Settings of a local cluster that spare its cores, which client and workers share. Without them each event loop looks
50 times per second at its own delay, and workers are sampled 100 times per second. Dask's own threshold makes malloc
give memory back after each batch; keeping it saves 6 % of a worker's time."""
CLOSING = 5.0
"""Time [s] that workers have to end. Ctrl-C waits so long at most for those that are in the middle of a batch."""


@dataclass(frozen=True)
class Cluster:
    """A way to reach a scheduler, again after it was restarted as well."""

    name: str
    """As messages call it."""
    connect: Callable[[float], Client]
    """A new client, within a time [s]. Raises HostError."""
    can_return: bool
    """Whether the scheduler may come back after it went away: it is another process."""


@contextmanager
def start_local_cluster(workers: int | None) -> Iterator[Cluster]:
    """A cluster of so many worker processes, by default as many as there are cores, that listens on loopback alone."""
    with _this_copy_first(), dask.config.set(LESS_WORK):
        yield from _run_local_cluster(workers)


@contextmanager
def _this_copy_first() -> Iterator[None]:
    """Meanwhile this package is found before other copies of it. FMUs that ran in this process have put theirs, which
    are not the whole, first on sys.path, and worker processes begin with that path."""
    before = list(sys.path)
    sys.path.insert(0, str(Path(__file__).resolve().parents[3]))
    try:
        yield
    finally:
        sys.path[:] = before


def _run_local_cluster(workers: int | None) -> Iterator[Cluster]:
    with explain_missing_guard():
        cluster = LocalCluster(
            n_workers=CPU_COUNT if workers is None else workers,
            threads_per_worker=1,
            processes=True,
            host="127.0.0.1",
            dashboard_address="127.0.0.1:0",
            silence_logs=logging.CRITICAL,
            preload=f"{__package__}.local_worker",
        )
    try:
        yield Cluster(
            "the local cluster", lambda timeout: Client(cluster, timeout=timeout, set_as_default=False), False
        )
    finally:
        with suppress(TimeoutError, asyncio.TimeoutError):  # a busy worker ends with this process at the latest
            cluster.close(timeout=CLOSING)


@contextmanager
def use_scheduler(address: str | None, file: Path | None) -> Iterator[Cluster]:
    """A cluster that exists, by its scheduler's address or by the file that the scheduler writes."""
    name = f"the scheduler at {address}" if file is None else f"the scheduler of {file}"

    def reach(timeout: float) -> Client:
        where = str(address) if file is None else _read_address(file)
        try:
            with ThreadPoolExecutor(1) as aside:  # not in this thread: a notebook has a loop there
                aside.submit(lambda: asyncio.run(_greet(where, timeout))).result()
            return Client(where, timeout=timeout, set_as_default=False)
        except (OSError, ValueError, ImportError, TimeoutError, asyncio.TimeoutError) as error:
            _refuse_unknown_host(where)
            raise HostError(
                f"no scheduler of Dask answers at {where or repr(where)} within {timeout:g} s ({_first_line(error)}): "
                "start one with `dask scheduler`, or run without --scheduler on this machine's cores"
            ) from None

    yield Cluster(name, reach, True)


def check_versions(client: Client) -> None:
    """Raises HostError when the scheduler or a worker has another version of this package, or none."""
    found = client.get_versions(packages=[DISTRIBUTION])
    members = {"the scheduler": found["scheduler"], **{f"worker {name}": at for name, at in found["workers"].items()}}
    for name, info in members.items():
        version = (info or {}).get("packages", {}).get(DISTRIBUTION)
        if version != __version__:
            raise HostError(describe_other_version(name, version, __version__))


@contextmanager
def quiet_dask() -> Iterator[None]:
    """A context in which Dask logs nothing: whatever matters reaches the user as one line of this package."""
    loggers = [
        logging.getLogger(name) for name in list(logging.root.manager.loggerDict) if name.startswith("distributed")
    ]
    before = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for logger, level in zip(loggers, before, strict=True):
            logger.setLevel(level)


async def _greet(address: str, timeout: float) -> None:
    """Returns when a scheduler has greeted. A client of Dask waits for the greeting without limit."""
    connection = Security().get_connection_args("client")
    comm = await asyncio.wait_for(connect(address, timeout=timeout, **connection), timeout)
    await comm.close()


def _refuse_unknown_host(address: str) -> None:
    """Raises HostError where the host of an address has a name that does not resolve: Dask tries until its time ends,
    and does not say why."""
    try:
        host = urlsplit(address if "://" in address else f"//{address}").hostname
    except ValueError:
        return
    try:
        socket.getaddrinfo(host, None)
    except OSError as error:
        raise HostError(
            f"no scheduler of Dask answers at {address}: no host of the name {host!r} is found ({error.strerror}): "
            "correct the name, or give the host's number"
        ) from None


def _read_address(file: Path) -> str:
    """The address in a scheduler file. Raises InputError."""
    try:
        content: Any = json.loads(file.read_bytes())
        return str(content["address"])
    except OSError as error:
        raise InputError(f"cannot read the scheduler file {file}: {error.strerror}; {WRITER}") from None
    except (ValueError, KeyError, TypeError):
        raise InputError(f"{file} is no scheduler file: it has no address; {WRITER}") from None


def _first_line(error: BaseException) -> str:
    return str(error).partition("\n")[0] or type(error).__name__
