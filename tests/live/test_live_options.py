"""`shipcollision live` with protocols: it says where they are, sends from the start, and refuses what is no address."""

from __future__ import annotations

import json
import re
import shlex
import shutil
import socket
import threading
import webbrowser
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from shipcollision_fmu.cli import main
from shipcollision_fmu.errors import StepError
from shipcollision_fmu.live.protocols import order_port
from shipcollision_fmu.live.protocols.outlets import Outlets
from shipcollision_fmu.live.server.host_names import find_hosts
from shipcollision_fmu.live.server.serve import bind
from shipcollision_fmu.live.session import run_folder
from shipcollision_fmu.live.session import session as session_module
from shipcollision_fmu.live.session.commands import End
from shipcollision_fmu.live.session.live_run import LiveRun
from shipcollision_fmu.live.session.session import Session
from shipcollision_fmu.scenario.scenario import Scenario
from tests.free_port import hold_free_port
from tests.live.live_server import PATIENCE, eventually


@pytest.fixture(autouse=True)
def _stand_in_for_the_page(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is in the page of a run is not these tests' matter, and writing it takes half of their time;
    test_server.py opens one that a live run has written."""
    monkeypatch.setattr(run_folder, "write_page", lambda folder: (folder / "replay.html").write_text("a page"))


def live(folder: Path, *arguments: str) -> Result:
    common = ["live", "kvlcc2_crossing", "--no-browser", "--port", "0", "--out", str(folder / "run"), "--rate", "20"]
    return CliRunner().invoke(main, [*common, *arguments])


@pytest.mark.parametrize(
    ("arguments", "code", "line"),
    [
        (("--nmea", "here"), 2, "--nmea 'here' is no address: give one such as udp://127.0.0.1:10110, or 10110"),
        (("--dis", "tcp://127.0.0.1:3000"), 2, "--dis 'tcp://127.0.0.1:3000' is no address: give one such as udp://"),
        (("--orders", "99999"), 2, "--orders '99999': port 99999 must be 1 to 65535"),
        (("--nmea-tcp", "no.such.host.invalid:4000"), 1, "--nmea-tcp no.such.host.invalid:4000: "),
    ],
)
def test_what_is_no_address_is_refused(tmp_path: Path, arguments: tuple[str, ...], code: int, line: str) -> None:
    result = live(tmp_path, *arguments)
    assert result.exit_code == code, result.output
    assert line in result.output
    assert result.output.count("\n") == 1
    assert not (tmp_path / "run").exists()


def steered(monkeypatch: pytest.MonkeyPatch, steer: Callable[[], None]) -> None:
    """Lets a program steer the next live run, in a thread, and ends the run after it."""
    monkeypatch.setattr(order_port, "LONGEST_ANSWER", PATIENCE)
    monkeypatch.setattr(order_port, "ADMISSION", PATIENCE)
    started = Outlets.start

    def steer_and_end(session: Session) -> None:
        try:
            steer()
            before = session.snapshot.step_count
            eventually(lambda: session.snapshot.step_count > before)  # an order is that of the step after it
        finally:
            session.submit(End())

    def start(outlets: Outlets) -> None:
        started(outlets)
        threading.Thread(target=steer_and_end, args=(outlets._session,), daemon=True).start()

    monkeypatch.setattr(Outlets, "start", start)


def send_order(port: int, **line: object) -> dict[str, object]:
    """The answer to the first line of a client."""
    with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE) as bridge:
        bridge.sendall(json.dumps(line).encode() + b"\n")
        answer: dict[str, object] = json.loads(bridge.makefile().readline())
    return answer


def test_a_live_run_is_steered_by_a_program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its order is in the scenario that the run leaves behind; the sentences came to a receiver meanwhile."""
    answers: list[object] = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver, hold_free_port() as port:
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(PATIENCE)

        def steer() -> None:
            receiver.recv(1000)  # it runs
            answers.append(send_order(port, ship="own", rudder_deg=12.5))

        steered(monkeypatch, steer)
        nmea = f"udp://127.0.0.1:{receiver.getsockname()[1]}"
        result = live(tmp_path, "--nmea", nmea, "--orders", str(port))
    assert result.exit_code == 0, result.output
    assert f"NMEA of own and AIS to {nmea}" in result.output
    assert f"orders at TCP port {port}" in result.output
    assert answers == [{"ok": True}]
    assert "rudder_deg = 12.5" in (tmp_path / "run" / "scenario.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("address", "asks"),
    [("0.0.0.0", True), ("[::]", True), ("127.0.0.1", False), ("localhost", False), (None, False)],
)
def test_an_order_port_for_other_machines_has_a_token(tmp_path: Path, address: str | None, asks: bool) -> None:
    with hold_free_port() as port:
        orders = str(port) if address is None else f"{address}:{port}"
        result = live(tmp_path, "--orders", orders, "--duration", "0.1")
    assert result.exit_code == 0, result.output
    found = re.search(rf"^orders at TCP port {re.escape(orders)}(?:, with the token (\S+))?$", result.stdout, re.M)
    assert found is not None
    assert (found[1] is not None) == asks
    assert found[1] is None or len(found[1]) >= 32


def test_the_order_port_asks_for_the_token_that_is_given(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    answers: list[object] = []
    with hold_free_port() as port:

        def steer() -> None:
            answers.append(send_order(port, ship="own", rudder_deg=5)["ok"])
            answers.append(send_order(port, token="open sesame", ship="own", rudder_deg=6)["ok"])

        steered(monkeypatch, steer)
        result = live(tmp_path, "--orders", str(port), "--order-token", "open sesame")
    assert result.exit_code == 0, result.output
    assert f"orders at TCP port {port}, with the token open sesame" in result.output
    assert answers == [False, True]


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (
            ("--order-token", "open sesame"),
            "--order-token is that of --orders, which is missing: give both, or neither",
        ),
        (
            ("--orders", "4711", "--order-token", "short"),
            "--order-token has 5 characters: give 8 to 256 printable ones",
        ),
        (
            ("--orders", "4711", "--order-token", "two\nlines"),
            "--order-token has 9 characters: give 8 to 256 printable",
        ),
    ],
)
def test_a_token_that_cannot_be_is_refused(tmp_path: Path, arguments: tuple[str, ...], line: str) -> None:
    result = live(tmp_path, *arguments)
    assert result.exit_code == 2, result.output
    assert line in result.stderr
    assert result.stderr.count("\n") == 1
    assert not (tmp_path / "run").exists()


def test_addresses_for_this_machine_and_for_others_are_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:  # fmt: skip
    """0.0.0.0 is an address to listen at, and none to open."""
    monkeypatch.setattr("shipcollision_fmu.live.server.host_names.list_own_addresses", lambda family: ["192.0.2.7"])
    result = live(tmp_path, "--host", "0.0.0.0", "--duration", "0.1")
    assert result.exit_code == 0, result.output
    said = re.sub(r"(:)\d+(/\S*token=)\S+", r"\1PORT\2T", result.stdout).splitlines()[:4]
    assert said == [
        "bridge of own: http://127.0.0.1:PORT/?token=T",
        "instructor: http://127.0.0.1:PORT/instructor?token=T",
        "bridge of own, from other machines: http://192.0.2.7:PORT/?token=T",
        "instructor, from other machines: http://192.0.2.7:PORT/instructor?token=T",
    ]


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "127.0.0.1"])
def test_the_hosts_that_are_found_lead_to_the_server(host: str) -> None:
    with bind(host, 0) as listening:
        here, elsewhere = find_hosts(listening)
        for one in (here, *elsewhere):
            with socket.create_connection((one.strip("[]"), listening.getsockname()[1]), timeout=PATIENCE):
                pass
    assert here in ("127.0.0.1", "[::1]")
    assert not elsewhere or host != "127.0.0.1"
    assert not {"127.0.0.1", "0.0.0.0", "[::1]", "[::]"} & set(elsewhere)


def test_a_finished_run_is_replaced_with_its_pictures(tmp_path: Path) -> None:
    """As by `shipcollision run`."""
    assert live(tmp_path, "--duration", "0.1").exit_code == 0
    (tmp_path / "run" / "scene.glb").write_bytes(b"of the older run")
    (tmp_path / "run" / "notes.txt").write_text("of the user", encoding="utf-8")
    assert live(tmp_path, "--duration", "0.2").exit_code == 0
    assert not (tmp_path / "run" / "scene.glb").exists()
    assert (tmp_path / "run" / "notes.txt").is_file()
    assert json.loads((tmp_path / "run" / "summary.json").read_bytes())["steps"] == 4


def test_what_a_killed_run_has_left_is_not_replaced(tmp_path: Path) -> None:
    """Not even beside a finished run, whose files may be."""
    assert live(tmp_path, "--duration", "0.1").exit_code == 0
    shutil.copy(tmp_path / "run" / "scenario.toml", tmp_path / "run" / "unfinished.toml")
    refused = live(tmp_path, "--duration", "0.2")
    assert refused.exit_code == 1
    assert "holds unfinished.toml of a live run that was killed: give another folder with --out" in refused.output
    remedy = re.search(r"`shipcollision (run .*)` runs it again", refused.output)
    assert remedy is not None
    assert CliRunner().invoke(main, [*shlex.split(remedy[1]), "--out", str(tmp_path / "again")]).exit_code == 0
    assert json.loads((tmp_path / "again" / "summary.json").read_bytes())["steps"] == 2


def test_where_no_page_was_written_a_command_writes_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a run that is too long for its page at once."""
    folder = tmp_path / "run"
    assert live(tmp_path, "--duration", "0.1").exit_code == 0  # an older run, whose page must not stand for the later
    assert (folder / "replay.html").exists()
    monkeypatch.setattr("shipcollision_fmu.live.session.run_folder.LARGEST_PAGE", 1)
    result = live(tmp_path, "--duration", "0.1", "--overwrite")
    assert result.output.splitlines()[-1] == f"no page yet: `shipcollision show {folder}` writes it"
    assert not (folder / "replay.html").exists()
    assert CliRunner().invoke(main, ["show", str(folder)]).exit_code == 0
    assert (folder / "replay.html").is_file()


def test_a_run_that_could_not_be_written_is_not_said_to_be_stored(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:  # fmt: skip
    def fail(run: object, out: Path) -> list[str]:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(session_module, "write_run", fail)
    result = live(tmp_path, "--duration", "0.1")
    assert result.exit_code == 1
    assert "stored" not in result.output
    assert result.stderr == "error: cannot write the run: [Errno 28] No space left on device\n"


def test_what_a_model_that_failed_has_left_is_stored_and_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    advance = LiveRun.advance

    def fail(run: LiveRun) -> None:
        if run.k > 0:
            raise StepError("own: the motion diverges in the step at t = 0.05 s")
        advance(run)

    monkeypatch.setattr(LiveRun, "advance", fail)
    result = live(tmp_path)
    assert result.exit_code == 1
    assert result.stdout.splitlines()[-1] == f"stored in {tmp_path / 'run'}"
    assert result.stderr == "error: own: the motion diverges in the step at t = 0.05 s\n"


def test_notes_of_the_scenario_are_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Scenario, "notes", property(lambda _: ["gap.csv: the longest gap is 200 s"]))
    result = live(tmp_path, "--duration", "0.1")
    assert result.stdout.startswith("note: gap.csv: the longest gap is 200 s\nbridge of own: ")


def hold_until(monkeypatch: pytest.MonkeyPatch, happened: threading.Event) -> None:
    """Lets live runs make no step but the first, with which they are made, before something has happened."""
    advance = LiveRun.advance

    def wait_and_advance(run: LiveRun) -> None:
        assert run.k == 0 or happened.wait(PATIENCE)
        advance(run)

    monkeypatch.setattr(LiveRun, "advance", wait_and_advance)


def test_a_browser_of_the_terminal_does_not_hold_the_run_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is there until somebody leaves it; the run goes on and ends meanwhile."""
    left, is_open, opened, ended = threading.Event(), threading.Event(), list[str](), list[bool]()

    def open_and_stay(address: str) -> bool:
        opened.append(address)
        is_open.set()
        ended.append(left.wait(PATIENCE))
        return True

    monkeypatch.setattr(webbrowser, "open", open_and_stay)
    hold_until(monkeypatch, is_open)
    try:
        result = live(tmp_path, "--browser", "--duration", "0.1")
        assert ended == []
    finally:
        left.set()
    assert (result.exit_code, len(opened)) == (0, 1)
    assert f"bridge of own: {opened[0]}\n" in result.stdout


def test_without_a_browser_the_address_is_left_to_the_reader(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    said, command = threading.Event(), import_module("shipcollision_fmu.cli.live")
    say = command.say

    def note(text: str, **options: bool) -> None:
        say(text, **options)
        if text.startswith("found no browser"):
            said.set()

    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    monkeypatch.setattr(command, "say", note)
    hold_until(monkeypatch, said)
    result = live(tmp_path, "--browser", "--duration", "0.1")
    assert result.stderr == "found no browser: open the address of the bridge yourself\n"
