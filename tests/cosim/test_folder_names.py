"""FMUs run from a folder of any name. A bracket or an umlaut ended the process without a word."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from shipcollision_fmu.cosim.fmu_files import ready_fmus
from tests.conftest import Write

NAMES = ["a(1)", "a{b}", "a+b", "a&b", "it's", "a,b", "a#b", "a?b", "Müller", "船", "a b", "%41"]
CODE = """
import sys, tempfile
from pathlib import Path
from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.cosim import fmu_files
scenario, fmi, fmus, *folders = sys.argv[1:]
fmu_files.fmu_directory = lambda ships=(): Path(fmus)
for folder in folders:
    Path(folder).mkdir()
    tempfile.tempdir = folder
    print(simulate(load_scenario(scenario), fmi=int(fmi)).summary["collisions"])
"""


@pytest.mark.slow
@pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.slow)])
def test_an_fmu_runs_from_a_folder_of_any_name(scenario_file: Write, tmp_path: Path, fmi: int) -> None:
    file = scenario_file(("duration = 3.0", "duration = 1.2"))
    fmus = ready_fmus(fmi=fmi)["ShipCollision"].parent
    folders = [str(tmp_path / name) for name in NAMES]
    done = subprocess.run(
        [sys.executable, "-c", CODE, str(file), str(fmi), str(fmus), *folders],
        capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stdout.split()) == (0, ["1"] * len(NAMES)), done.stderr
