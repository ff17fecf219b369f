"""Random calls on native FMUs from Python, and restored states after them: tests/fmi/fuzz.py, as on the Python FMUs."""

from __future__ import annotations

import base64
import json
import subprocess
import sys
from pathlib import Path

import pytest
from fmpy import extract

from tests.fmi import fuzz

FUZZ = Path(fuzz.__file__)


def save_states(folder: Path) -> list[bytes]:
    """States of an FMU at its start and after some steps."""
    fmu = fuzz.Fmu(folder)
    one = fmu.instantiate(False)
    assert fmu.enter(one, 0.0, 1e6) == fuzz.OK
    assert fmu.call("ExitInitializationMode")(one) == fuzz.OK
    states = []
    for k in range(4):
        handle = fmu.saved(one)
        states.append(fmu.to_bytes(one, handle))
        assert fmu.step(one, k * 0.05, 0.05) == fuzz.OK
    fmu.free(one)  # and the states with it
    return states


def run(folder: Path, states: Path, seed: int, count: int) -> None:
    states.write_text(json.dumps([base64.b64encode(data).decode() for data in save_states(folder)]))
    done = subprocess.run(
        [sys.executable, "-X", "faulthandler", FUZZ, folder, states, "--seed", str(seed), "--count", str(count)],
        capture_output=True, text=True, timeout=7200, check=False,
    )  # fmt: skip
    said = done.stdout.splitlines()
    print(*said[-3:], done.stderr[-3000:], sep="\n")  # noqa: T201 - the seed
    assert done.returncode == 0
    assert f"done: {count} sequences" in said[-2]


@pytest.mark.parametrize(
    ("flavour", "count"),
    [("2", 100), *(pytest.param(flavour, 1000, marks=pytest.mark.slow) for flavour in ("2", "3", "3-scalar"))],
)
def test_random_calls_on_the_dummy(native_dummies: dict[str, Path], tmp_path: Path, flavour: str, count: int) -> None:
    run(native_dummies[flavour], tmp_path / "states.json", 0, count)


@pytest.mark.slow
@pytest.mark.parametrize("flavour", ["2", "3", "3-scalar"])
def test_random_calls_on_the_ship(native_fmus: dict[str, Path], tmp_path: Path, flavour: str) -> None:
    run(Path(extract(native_fmus[flavour], tmp_path / "unpacked")), tmp_path / "states.json", 0, 300)
