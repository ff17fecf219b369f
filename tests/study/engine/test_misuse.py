"""Misuse of run_study() from Python: one line of this package each, and nothing is written."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from shipcollision_fmu.errors import StudyError
from shipcollision_fmu.study.engine.run import run_study
from shipcollision_fmu.study.rows.compute import compute_rows
from tests.study.engine.cluster import DEADLINE, PROJECT


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        ((5, "x"), {}, "study = 5 is no study: give a name or the path of a TOML file"),
        (({"study": {}}, "x"), {}, "study = {'study': {}} is no study: give a name or the path of a TOML file"),
        (("quick", None), {}, "out = None is no folder: give its path"),
        (("quick", ["a"]), {}, "out = ['a'] is no folder: give its path"),
        (("quick", ""), {}, "out = '' is no folder: give its path"),
        (("quick", "x"), {"workers": "2"}, "workers = '2' must be a whole number of processes, or None for one on"),
        (("quick", "x"), {"workers": 1.5}, "workers = 1.5 must be a whole number of processes, or None for one on"),
        (("quick", "x"), {"workers": True}, "workers = True must be a whole number of processes, or None for one"),
        (("quick", "x"), {"resume": "yes"}, "resume = 'yes' must be True or False"),
        (("quick", "x"), {"csv": 1}, "csv = 1 must be True or False"),
        (("quick", "x"), {"scheduler": 8786}, "scheduler = 8786 is no address of a scheduler of Dask: give tcp:/"),
        (("quick", "x"), {"scheduler_file": 1}, "scheduler_file = 1 is no file: give its path"),
    ],
)  # fmt: skip
def test_what_is_of_another_type(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: Any, options: Any, message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(StudyError) as caught:
        run_study(*arguments, **{"workers": 0, "engine": "python", **options})
    assert str(caught.value).startswith(message)
    assert not list(tmp_path.iterdir())


def test_rows_of_what_is_no_study() -> None:
    with pytest.raises(StudyError, match=r"study = 'quick' is no Study: give what read_study\(\) returns"):
        compute_rows("quick", 0, 5)  # type: ignore[arg-type]


@pytest.mark.slow
def test_a_script_without_the_guard_ends_with_one_line(tmp_path: Path) -> None:
    call = 'run_study("quick", "x", workers=1, engine="python")'
    (tmp_path / "script.py").write_text(f"from shipcollision_fmu import run_study\n{call}\n")
    ended = subprocess.run(
        [sys.executable, "script.py"], cwd=tmp_path, env=os.environ | {"PYTHONPATH": str(PROJECT)},
        capture_output=True, text=True, timeout=DEADLINE, check=False,
    )  # fmt: skip
    lines = ended.stderr.splitlines()
    assert ended.returncode == 1
    assert lines[-1].endswith(
        "HostError: no worker process has started (Nanny failed to start.): put the call of run_study() below `if "
        '__name__ == "__main__":`, as each worker imports the script, or give workers=0'
    )
    assert sum(line.startswith("Traceback") for line in lines) == 1
    assert "distributed/" not in ended.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["script.py"]
