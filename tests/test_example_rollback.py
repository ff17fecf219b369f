"""examples/rollback.py: the instant of impact, against the time that distance and speed give."""

from __future__ import annotations

import importlib.util
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest
from fmpy import extract

from shipcollision_fmu import build_fmus
from tests.ship_files import BARGE_ADDED_MASS, ship_toml

EXAMPLE = Path(__file__).parent.parent / "examples" / "rollback.py"

BOX = ship_toml(ship={"name": "Box", "kind": "box"}, added_mass=BARGE_ADDED_MASS)


@pytest.fixture(scope="module")
def example() -> ModuleType:
    spec = importlib.util.spec_from_file_location("example_rollback", EXAMPLE)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def unpacked(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, Path]]:
    folder, before = tmp_path_factory.mktemp("fmus"), list(sys.path)
    yield {name: Path(extract(file, folder / name)) for name, file in build_fmus(folder).items()}
    sys.path[:] = before


@pytest.fixture
def box(tmp_path: Path) -> str:
    (tmp_path / "box.toml").write_text(BOX, encoding="utf-8")
    return str(tmp_path / "box.toml")


@pytest.mark.parametrize("longest", [0.3, pytest.param(7.0, marks=pytest.mark.slow)])
def test_the_impact_is_found_within_the_finest_step(
    example: ModuleType, unpacked: dict[str, Path], box: str, longest: float
) -> None:
    """A box of 100 m whose end is 13.7 m from the other's side, at 3 m/s."""
    found = example.run(unpacked, ship=box, speed=3.0, gap=13.7, end=8.0, longest=longest, finest=1e-5)
    assert found.impact <= 13.7 / 3.0 <= found.impact + 1e-5 + 1e-9
    assert found.taken_back > 0
    assert sum(found.steps) == pytest.approx(8.0, abs=1e-9)
    assert found.kept < 80
    assert max(found.steps) == pytest.approx(min(longest, found.impact, 8.0 - found.impact), rel=1.0)


def test_what_was_taken_back_left_no_trace(example: ModuleType, unpacked: dict[str, Path], box: str) -> None:
    """The same steps without any that was taken back end in the same bits."""
    found = example.run(unpacked, ship=box, speed=3.0, gap=2.0, end=2.0, finest=1e-3)
    encounter, t = example.Encounter(unpacked, box, 3.0, 2.0), 0.0
    for h in found.steps:
        encounter.step(t, h)
        t += h
    speeds = {name: one.get(["velocity.surge"])[0] for name, one in encounter.ships.items()}
    encounter.close()
    assert speeds == found.speeds
    assert speeds["own"] < 2.9  # she was stopped, partly


@pytest.mark.slow
def test_the_command() -> None:
    done = subprocess.run(
        [sys.executable, "-W", "error", EXAMPLE, "--finest", "0.001"],
        capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    said = re.match(r"impact at t = (\S+) s\n", done.stdout)
    assert said is not None
    assert float(said[1]) <= 20.3 / 4.0 <= float(said[1]) + 0.001 + 1e-4  # as printed, with four decimals
    wrong = subprocess.run([sys.executable, EXAMPLE, "--finest", "2"], capture_output=True, text=True, check=False)
    assert wrong.returncode == 2
    assert "--finest must be greater than 0 and at most --step" in wrong.stderr
