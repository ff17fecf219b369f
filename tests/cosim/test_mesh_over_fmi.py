"""A mesh hull that is cut in a process before its first FMU: the run ends. It waited for ever, for the interpreter."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from shipcollision_fmu.errors import HostError
from tests.conftest import Write

CODE = """
import sys
from shipcollision_fmu import load_scenario, simulate
run = simulate(load_scenario(sys.argv[1]), fmi=int(sys.argv[2]), out=sys.argv[3])
print(run.summary["collisions"])
"""


@pytest.mark.slow
@pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.slow)])
def test_a_mesh_is_cut_before_the_first_fmu(scenario_file: Write, tmp_path: Path, fmi: int) -> None:
    file = scenario_file(('"./barge.toml"\nposition = [0.0, 0.0]', '"mesh_example"\nposition = [0.0, 0.0]'))
    done = subprocess.run(
        [sys.executable, "-c", CODE, str(file), str(fmi), str(tmp_path / "run")],
        env={**os.environ, "XDG_CACHE_HOME": str(tmp_path / "cache")},
        capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "example.obj is cut into convex parts, once for this file" in done.stderr
    assert done.stdout.strip() == "1"


def test_the_library_that_cuts_imported_by_the_user_is_refused(scenario_file: Write, tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-c", f"import coacd\n{CODE}", str(scenario_file()), "2", str(tmp_path / "run")],
        capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1] == (
        f"{HostError.__module__}.HostError: coacd is imported in this process, after which the first FMU of a Python "
        "wrapper waits for ever: import coacd in a process of its own or after the first run, or run the models with "
        "in_process=True"
    )
