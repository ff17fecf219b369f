"""The command `study`: lines on stdout and stderr, exit statuses, and what a mistake leaves behind: nothing."""

from __future__ import annotations

import json
import os
import pty
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pyarrow.parquet as pq
import pytest
from click.testing import CliRunner, Result

from shipcollision_fmu.cli import main, row_progress
from shipcollision_fmu.study.definition.distributions import DISTRIBUTIONS
from shipcollision_fmu.study.definition.variables import NUMBERS, WORDS
from shipcollision_fmu.study.engine import run as run_module
from shipcollision_fmu.study.rows.columns import COLLISIONS, ENCOUNTERS
from tests.study.engine.cluster import DEADLINE, PROJECT
from tests.study.engine.folders import digest

SMALL = """
[study]
name = "small"
level = "impact"
rows = 40

[own]
ships = ["kvlcc2"]

[encounter]
kind = "crossing"
angle_deg = { distribution = "uniform", least = 60.0, most = 120.0 }
own_speed = 5.0
target_speed = 3.0
"""
OPTIONS = ("--workers", "0", "--engine", "python")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working folder with a small study in it."""
    (tmp_path / "small.toml").write_text(SMALL, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


TOUCHING = """
[study]
name = "touching"
level = "encounter"
rows = 40
[own]
ships = ["kvlcc2"]
[run]
after = 10.0
[encounter]
at = { distribution = "uniform", least = -0.45, most = 0.45 }
angle_deg = { distribution = "uniform", least = 20.0, most = 160.0 }
"""


def called(*arguments: str) -> Result:
    return CliRunner().invoke(main, ["study", *arguments])


def test_a_study_is_stored_and_said_in_two_lines(folder: Path) -> None:
    result = called("small.toml", *OPTIONS)
    assert result.exit_code == 0, result.stderr
    first, last = result.stdout.splitlines()
    assert first.startswith("40 rows: 0 refused, 40 collisions; 40 computed in ")
    assert first.endswith(", engine python")
    assert (
        last
        == "stored in studies/small: studies/small/encounters and studies/small/collisions are tables in Parquet files"
    )
    assert (folder / "studies" / "small" / "study.toml").read_text(encoding="utf-8") == SMALL


def test_resume_and_another_engine(folder: Path) -> None:
    assert called("small.toml", *OPTIONS, "--out", "a").exit_code == 0
    again = called("small.toml", "--workers", "0", "--out", "a", "--resume")
    assert ("; 0 computed in " in again.stdout, again.exit_code) == (True, 0)
    for arguments, message in (
        (OPTIONS, "error: a holds a study already: go on with it with --resume, or give another folder with --out"),
        (
            ("--workers", "0", "--resume", "--engine", "native"),
            "error: a holds rows of engine 'python': go on with --engine python",
        ),
    ):
        result = called("small.toml", *arguments, "--out", "a")
        assert result.exit_code == 2
        assert result.stderr.startswith(message)
        assert len(result.stderr.splitlines()) == 1


@pytest.mark.parametrize(
    ("arguments", "status", "message"),
    [
        (["quik"], 2, "unknown study 'quik': did you mean quick?"),
        (["small.toml", "--scheduler", "tcp://h:1", "--workers", "2"], 2, "a cluster that exists has its own workers"),
        (["small.toml", "--workers", "-1"], 2, "--workers -1 must be 0 or more"),
        (["small.toml", "--workers", "two"], 2, "'two' is not a whole number: give one such as 3"),
        (["small.toml", "--engine", "nativ"], 2, "'nativ': did you mean native?"),
        (["small.toml", "--scheduler-file", "none.json"], 2, "cannot read the scheduler file none.json: No such file"),
        (["small.toml", "--scheduler-file", "small.toml"], 2, "small.toml is no scheduler file: it has no address"),
        (["small.toml", "--out", "small.toml/x"], 1, "cannot write to small.toml/x: small.toml is not a folder"),
        (["small.toml", "--out", "."], 1, ". holds small.toml, and no study.json of a study: give a new or an empty"),
    ],
)
def test_a_mistake_is_one_line_and_leaves_nothing(
    folder: Path, arguments: list[str], status: int, message: str
) -> None:
    result = called(*arguments)
    assert message in result.stderr
    lines = [line for line in result.stderr.splitlines() if not line.startswith("note: ")]  # of the first compilation
    assert len(lines) == 1
    assert (result.exit_code, result.stdout) == (status, "")
    assert [path.name for path in folder.iterdir()] == ["small.toml"]


def test_contact_that_the_end_cuts_off_is_counted(folder: Path) -> None:
    """In the lines of the command, in study.json and on the page."""
    (folder / "touching.toml").write_text(TOUCHING, encoding="utf-8")
    said = called("touching.toml", "--workers", "0", "--out", "t").stdout.splitlines()
    table = pq.read_table(folder / "t" / "encounters")
    count = sum(map(bool, table["contact_at_end"].to_pylist()))
    assert 0 < count < 40
    line = (
        f"{count} rows end with hulls that touch, column contact_at_end: a longer `after` in [run] gives more of thei"
    )
    assert said[1].startswith(line)
    assert json.loads((folder / "t" / "study.json").read_text())["counts"]["contact_at_end"] == count
    assert CliRunner().invoke(main, ["show", "t", "--no-replays"]).exit_code == 0
    assert (
        f"{count} cases end with hulls that touch (column <code>contact_at_end</code>)"
        in (folder / "t/report.html").read_text()
    )


def read_reasons(folder: Path) -> list[str | None]:
    reasons: list[str | None] = pq.read_table(folder / "encounters")["reason"].to_pylist()
    return reasons


def refuse(folder: Path, rows: int, most_speed: float) -> tuple[list[str], list[str | None]]:
    """Lines on stderr, and the reasons in the table, of a study whose ships do not close at low speeds of own."""
    speed = f'{{ distribution = "uniform", least = 0.0, most = {most_speed} }}'
    text = SMALL.replace("rows = 40", f"rows = {rows}").replace("own_speed = 5.0", f"own_speed = {speed}")
    text = text.replace('angle_deg = { distribution = "uniform", least = 60.0, most = 120.0 }', "angle_deg = 20.0")
    (folder / "few.toml").write_text(text, encoding="utf-8")
    out = f"{rows}_{most_speed}"
    result = called("few.toml", *OPTIONS, "--out", out)
    assert result.exit_code == 0
    assert "refused; the" not in result.stdout
    return result.stderr.splitlines(), read_reasons(folder / out)


def test_many_refused_rows_are_said_with_the_commonest_reason(folder: Path) -> None:
    """On stderr, once; none where half of the rows or more are done."""
    lines, reasons = refuse(folder, 30, 0.1)
    assert None not in reasons
    (line,) = lines
    assert line.startswith("warning: all 30 rows are refused; the commonest reason, 30 times: ")
    assert line.partition(" times: ")[2] in reasons
    lines, reasons = refuse(folder, 30, 0.4)
    refused = 30 - reasons.count(None)
    assert 15 < refused < 30
    assert lines[-1].startswith(f"warning: {refused} of 30 rows are refused; the commonest reason, {refused} times: ")
    lines, reasons = refuse(folder, 1, 0.1)
    assert lines == [f"warning: the only row is refused: {reasons[0]}"]
    lines, reasons = refuse(folder, 30, 4.0)
    assert 0 < 30 - reasons.count(None) <= 15
    assert lines == []


def test_keys_and_columns_are_printed() -> None:
    """All of them, with the words that refusals and the schema have."""
    result = called("--keys")
    assert (result.exit_code, result.stderr) == (0, "")
    words = " ".join(result.stdout.split())
    for text in (
        "sampler latin-hypercube how the numbers fill the range: latin-hypercube, random or sobol",
        "level required the level of detail: impact",
        "[[own.sampled]], [[target.sampled]]", "L_over_B length over breadth, 4 to 9 for most ships",
        "angle_deg 0 to 180 deg all of the kind the angle between the headings; 0 is overtaking, 180 head-on",
        "kind head-on, crossing,",
        'distribution = "lognormal": A value whose logarithm is normal', "median required the median, before anything",
        "energy double J kinetic energy lost to contact", "contact_at_end bool", "ship_a string",
    ):  # fmt: skip
        assert text in words
    shown = set(words.split())
    for columns in (ENCOUNTERS, COLLISIONS):
        assert {column.name for column in columns} <= shown
    assert {*NUMBERS, *WORDS, *DISTRIBUTIONS} - {"constant"} <= {word.strip('":') for word in shown}


def test_without_the_extra_the_remedy_is_a_command(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shipcollision_fmu.study.extra.find_spec", lambda name: None)
    result = called("small.toml", "--engine", "python")
    assert "studies on many cores need Dask, which is missing: run `" in result.stderr
    assert "'shipcollision-fmu[study]'" in result.stderr
    assert result.stderr.rstrip().endswith("or give --workers 0")
    assert called("small.toml", *OPTIONS).exit_code == 0, run_module.__doc__


def test_lines_of_progress_in_a_pipe(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(row_progress, "PLAIN_PAUSE", 0.0)
    lines = called("small.toml", *OPTIONS).stderr.splitlines()
    assert lines[0] == "small: 0 of 40 rows"
    assert lines[-1].startswith("small: 40 of 40 rows, ")
    assert lines[-1].endswith(" rows/s, 0:00:00 left")


def test_rate_and_time_left_are_of_the_rows_of_this_call() -> None:
    assert row_progress.describe_pace(1_000, 1_000, 9_000, 0.5) == ""
    assert row_progress.describe_pace(3_000, 1_000, 9_000, 4.0) == ", 500 rows/s, 0:00:12 left"
    assert row_progress.describe_pace(1, 0, 10_000, 1.0) == ", 1 rows/s, 2:46:39 left"


def test_the_pace_begins_with_the_first_answer() -> None:
    """Workers that take a minute to start do not count, nor rows of an earlier call."""
    clock = iter([0.0, 60.0, 62.0, 64.0])
    pace = row_progress.Pace(lambda: next(clock))
    said = [pace.measure(done, 9_000) for done in (1_000, 1_004, 2_004, 3_004)]
    assert said == ["", "", ", 500 rows/s, 0:00:14 left", ", 500 rows/s, 0:00:12 left"]


def test_a_terminal_has_a_bar_that_is_gone_at_the_end(folder: Path) -> None:
    """In a terminal of its own: rows and pace are drawn, notes stand above the bar, and results alone are left."""
    leader, follower = pty.openpty()
    code = "from shipcollision_fmu.cli import main; main()"
    with open(leader, "rb", buffering=0) as drawn:
        process = subprocess.Popen(
            [sys.executable, "-c", code, "study", "small.toml", *OPTIONS], cwd=folder, stderr=follower,
            stdout=subprocess.PIPE, env=os.environ | {"PYTHONPATH": str(PROJECT), "TERM": "xterm", "COLUMNS": "120"},
        )  # fmt: skip
        os.close(follower)
        text = b""
        with suppress(OSError):  # the end of a terminal
            while piece := drawn.read(4096):
                text += piece
        stdout, _ = process.communicate(timeout=DEADLINE)
    assert process.returncode == 0
    assert b"of 40 rows" in text
    assert text.rstrip().endswith((b"\x1b[2K", b"\x1b[?25h", b"\x1b[1A\x1b[2K"))
    assert stdout.startswith(b"40 rows: 0 refused")


STOPPED = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell that starts the tests may have it ignored
from shipcollision_fmu.study.engine import folder
write = folder.StudyFolder.write
def write_and_stop(self, part):
    write(self, part)
    os.kill(os.getpid(), {number})
folder.StudyFolder.write = write_and_stop
from shipcollision_fmu.study.engine import parts
parts.PART_ROWS["impact"] = 10
from shipcollision_fmu.cli import main
main()
"""


@pytest.mark.parametrize(
    ("number", "status"), [(signal.SIGINT, 130), pytest.param(signal.SIGTERM, 143, marks=pytest.mark.slow)]
)
def test_an_interrupt_leaves_a_study_that_goes_on(
    folder: Path, monkeypatch: pytest.MonkeyPatch, number: signal.Signals, status: int
) -> None:
    monkeypatch.setattr("shipcollision_fmu.study.engine.parts.PART_ROWS", {"impact": 10})
    assert called("small.toml", *OPTIONS, "--out", "whole").exit_code == 0
    done = subprocess.run(
        [sys.executable, "-c", STOPPED.format(number=int(number)), "study", "small.toml", *OPTIONS, "--out", "a"],
        cwd=folder, env=os.environ | {"PYTHONPATH": str(PROJECT)}, capture_output=True, text=True, timeout=DEADLINE,
    )  # fmt: skip
    assert done.stderr == "error: interrupted; 10 of 40 rows are in a: go on with --resume\n"
    assert (done.returncode, done.stdout) == (status, "")
    result = called("small.toml", *OPTIONS, "--out", "a", "--resume")
    assert "; 30 computed in " in result.stdout
    assert digest(folder / "a") == digest(folder / "whole")
