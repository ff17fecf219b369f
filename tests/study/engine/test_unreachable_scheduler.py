"""A scheduler that does not answer is refused in one line, in bounded time, before anything is written."""

from __future__ import annotations

import json
import socket
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from shipcollision_fmu.errors import HostError
from shipcollision_fmu.study.engine.run import run_study
from tests.study.engine.folders import STUDY
from tests.study.engine.stand_in import compute_stand_in


@pytest.fixture
def patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """Half a second instead of ten."""
    monkeypatch.setattr("shipcollision_fmu.study.engine.dask_executor.ANSWER", 0.5)


@pytest.fixture
def port() -> Iterator[socket.socket]:
    """A port that is taken and does not listen."""
    with closing(socket.socket()) as taken:
        taken.bind(("127.0.0.1", 0))
        yield taken


def refused(tmp_path: Path, address: str, **options: str | Path) -> str:
    """The message about a scheduler."""
    with pytest.raises(HostError) as caught:
        run_study(STUDY, tmp_path / "study", engine="python", compute=compute_stand_in, **options)  # type: ignore[arg-type]
    assert not (tmp_path / "study").exists()
    text = str(caught.value)
    assert text.startswith(f"no scheduler of Dask answers at {address or repr(address)} within 0.5 s (")
    assert text.endswith("start one with `dask scheduler`, or run without --scheduler on this machine's cores")
    return text


@pytest.mark.usefixtures("patience")
def test_nobody_listens(tmp_path: Path, port: socket.socket) -> None:
    address = f"tcp://127.0.0.1:{port.getsockname()[1]}"
    refused(tmp_path, address, scheduler=address)


@pytest.mark.usefixtures("patience")
def test_somebody_listens_and_says_nothing(tmp_path: Path, port: socket.socket) -> None:
    port.listen()
    address = f"tcp://127.0.0.1:{port.getsockname()[1]}"
    refused(tmp_path, address, scheduler=address)


@pytest.mark.usefixtures("patience")
def test_the_file_of_a_scheduler_that_has_ended(tmp_path: Path, port: socket.socket) -> None:
    address = f"tcp://127.0.0.1:{port.getsockname()[1]}"
    (tmp_path / "scheduler.json").write_text(json.dumps({"address": address}), encoding="utf-8")
    refused(tmp_path, address, scheduler_file=tmp_path / "scheduler.json")


@pytest.mark.usefixtures("patience")
@pytest.mark.parametrize("address", ["nowhere", "http://127.0.0.1:1", "tcp://127.0.0.1:x", ""])
def test_what_is_no_address(tmp_path: Path, address: str) -> None:
    refused(tmp_path, address, scheduler=address)
