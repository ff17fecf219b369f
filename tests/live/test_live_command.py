"""`shipcollision live`: refusals in one line, and a whole run that Ctrl-C ends."""

from __future__ import annotations

import json
import signal
import socket
import subprocess
import sys
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from websockets.sync.client import connect

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.cli import main
from shipcollision_fmu.cosim.folder_lock import hold_folder
from shipcollision_fmu.errors import HostError
from shipcollision_fmu.live import extra

from .live_command import live_command
from .live_server import PATIENCE, eventually, receive


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def called(*arguments: str) -> Result:
    return CliRunner().invoke(main, ["live", *arguments])


@pytest.fixture
def taken_port() -> Iterator[int]:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        yield taken.getsockname()[1]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--ship", "ownn"], "--ship ownn: kvlcc2_crossing has no such ship: did you mean own?"),
        (
            ["guan2014"],
            "guan2014 has no ship that takes orders, all coast: take one such as kvlcc2_crossing, or a ship with "
            "[manoeuvring] and hydrodynamics = true",
        ),
        (["--rate", "50"], "rate = 50.0 must be from 0.25 to 20: give one such as 1"),
        (["--duration", "-1"], "--duration -1 s must be greater than 0: give one such as 600"),
        (["--port", "70000"], "--port 70000 must be from 0 to 65535: give one such as 8750, or 0 for any that is free"),
        (["--host", "203.0.113.7"], "--port 8750 at 203.0.113.7: Cannot assign requested address; give another"),
        (["--host", "no such host"], "--host no such host: "),
        (["nowhere"], "unknown scenario 'nowhere': known: "),
    ],
)
def test_refusals_are_one_line(arguments: list[str], message: str) -> None:
    result = called(*arguments)
    assert result.exit_code == (1 if "--host" in arguments else 2)  # an address may be right elsewhere
    assert result.stderr.startswith(f"error: {message}")
    assert result.stderr.count("\n") == 1
    assert result.stdout == ""
    assert list(Path().iterdir()) == []


def test_a_port_in_use_is_said(taken_port: int) -> None:
    result = called("--port", str(taken_port))
    assert result.exit_code == 1
    assert result.stderr == (
        f"error: --port {taken_port} at 127.0.0.1: Address already in use; give another with --port, or --port 0 for "
        "any that is free\n"
    )


def test_a_ship_that_coasts_cannot_be_chosen(tmp_path: Path) -> None:
    text = """
        [scenario]
        name = "mine"
        duration = 5.0
        [ships.own]
        ship = "kvlcc2"
        position = [0.0, 0.0]
        heading_deg = 0.0
        [ships.log]
        ship = "floating_log"
        position = [900.0, 0.0]
        heading_deg = 0.0
        speed = 0.0
        hydrodynamics = false
    """
    (tmp_path / "mine.toml").write_text(text, encoding="utf-8")
    result = called("mine.toml", "--ship", "log")
    assert result.stderr == "error: --ship log takes no orders, it coasts: take own\n"


def test_a_missing_extra_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(extra, "find_spec", lambda name: None)
    result = called()
    assert result.exit_code == 1
    assert result.stderr.startswith(
        "error: a live run needs starlette, uvicorn, websockets, pyais, pynmeagps, which is missing: run `"
    )
    assert "shipcollision-fmu[live]" in result.stderr


def test_files_of_other_origin_are_kept(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "scenario.toml").write_text("mine", encoding="utf-8")
    result = called("--out", "mine")
    assert result.exit_code == 1
    assert "mine holds scenario.toml of other origin" in result.stderr


def test_a_stored_run_is_free_while_pages_go_to_its_replay(tmp_path: Path) -> None:
    """The run begins once there is a page: without one the command would end with it."""

    def is_free() -> bool:
        try:
            with hold_folder(tmp_path / "run"):
                return True
        except HostError:  # the end is told before the command says where the run is
            return False

    options = "--rate", "20", "--duration", "1", "--paused"
    with live_command(tmp_path, *options) as live, connect(live.socket, open_timeout=PATIENCE) as client:
        client.send('{"type": "pause", "paused": false}')
        while receive(client)["type"] != "end":
            pass
        eventually(is_free)
        assert live.process.poll() is None


COMMAND = """
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell that starts the tests may have it ignored
from shipcollision_fmu.__main__ import main
sys.argv = ["shipcollision", "live", "--no-browser", "--port", "0", "--rate", "20", "--out", "run"]
main()
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_and_sigterm_end_and_store_the_run(tmp_path: Path, number: signal.Signals) -> None:
    """It is done then, so the exit status is 0. Meanwhile its folder is its own."""
    command = [sys.executable, "-c", COMMAND]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            bridge = process.stdout.readline().partition(": ")[2].strip()
            assert process.stdout.readline().startswith("instructor: http://127.0.0.1:")
            assert process.stdout.readline() == "Ctrl-C ends the run and stores it\n"
            assert b"live.js" in urllib.request.urlopen(bridge, timeout=PATIENCE).read()
            (tmp_path / "run" / "unfinished.toml").touch()  # as after half a minute
            for other in (["live", "--port", "0"], ["run", "kvlcc2_crossing", "--in-process", "--overwrite"]):
                refused = CliRunner().invoke(main, [*other, "--out", "run"])
                assert (refused.exit_code, refused.stdout) == (1, "")
                assert refused.stderr == (
                    "error: run is being written by another run: wait until it has ended, or give another folder with "
                    "--out\n"
                )
            process.send_signal(number)
            out, errors = process.communicate(timeout=PATIENCE)
        finally:
            process.kill()
        assert (process.returncode, errors) == (0, "")
    assert out == (
        "stored in run: run/scenario.toml gives the same run again\n"
        "debriefing: `shipcollision show run --open`, or open run/replay.html in a browser\n"
    )
    assert (tmp_path / "run" / "replay.html").is_file()
    simulate(load_scenario(tmp_path / "run" / "scenario.toml"), in_process=True, out=tmp_path / "again")
    for name in ("states.csv", "events.json", "summary.json"):
        assert (tmp_path / "run" / name).read_bytes() == (tmp_path / "again" / name).read_bytes()
    assert json.loads((tmp_path / "run" / "timing.json").read_bytes())["mode"] == "live"
