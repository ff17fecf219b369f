"""A scheduler that does not answer is refused in one line, in bounded time, before anything is written."""

from __future__ import annotations

import json
import re
import socket
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from shipcollision_fmu.errors import HostError, StudyError
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


@pytest.mark.parametrize(
    "address", ["nowhere", "127.0.0.1", "http://127.0.0.1:8787", "tcp://127.0.0.1:x", "tcp://:8786", ""]
)
def test_what_is_no_address(tmp_path: Path, address: str) -> None:
    with pytest.raises(StudyError) as caught:
        run_study(STUDY, tmp_path / "study", engine="python", compute=compute_stand_in, scheduler=address)
    assert str(caught.value) == (
        f"scheduler = {address!r} is no address of a scheduler of Dask: give tcp://HOST:8786, as `dask scheduler` "
        "prints it"
    )
    assert not (tmp_path / "study").exists()


@pytest.mark.usefixtures("patience")
def test_an_address_without_a_protocol(tmp_path: Path, port: socket.socket) -> None:
    address = f"127.0.0.1:{port.getsockname()[1]}"
    refused(tmp_path, address, scheduler=address)


@pytest.mark.usefixtures("patience")
def test_a_host_that_is_not_known(tmp_path: Path) -> None:
    with pytest.raises(HostError) as caught:
        run_study(
            STUDY, tmp_path / "study", engine="python", compute=compute_stand_in, scheduler="tcp://no-host.invalid:8786"
        )
    assert re.fullmatch(
        r"no scheduler of Dask answers at tcp://no-host\.invalid:8786: no host of the name 'no-host\.invalid' is found "
        r"\(.+\): correct the name, or give the host's number",
        str(caught.value),
    )
