"""Finished runs to show: two shipped scenarios, and small ones made up for one thing each."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from shipcollision_fmu import load_scenario, simulate
from tests.conftest import ENCOUNTER
from tests.ship_files import ship_toml

BARGE = ship_toml(particulars={"r_bg": [2.0, 0.0, -1.0]})

MEETING = (
    ENCOUNTER.replace('name = "encounter"', 'name = "meeting"').replace(
        "target's side", "a barge and on towards a quay"
    )
    + """
[obstacles.quay]
kind = "quay"
shape = "box"
length = 200.0
breadth = 20.0
position = [0.0, 60.0]
"""
)

MakeRun = Callable[..., Path]

GUAN2014 = pytest.param("guan2014", marks=pytest.mark.needs("pybullet"))
"""The run whose response is PyBullet's own, as a parameter."""


@pytest.fixture(scope="session")
def guan2014(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the paper's run."""
    return _ran("guan2014", tmp_path_factory)


@pytest.fixture(scope="session")
def kvlcc2_crossing(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the run of two tankers, 3000 steps."""
    return _ran("kvlcc2_crossing", tmp_path_factory)


@pytest.fixture
def meeting(tmp_path: Path) -> MakeRun:
    """Runs the meeting of two barges before a quay, with some of its text replaced; the run's folder."""

    def make(*replaced: tuple[str, str]) -> Path:
        text = MEETING
        for old, new in replaced:
            assert old in text, f"{old!r} is not in the scenario"
            text = text.replace(old, new)
        (tmp_path / "barge.toml").write_text(BARGE, encoding="utf-8")
        (tmp_path / "meeting.toml").write_text(text, encoding="utf-8")
        simulate(load_scenario(tmp_path / "meeting.toml"), in_process=True, out=tmp_path / "run")
        return tmp_path / "run"

    return make


def _ran(name: str, factory: pytest.TempPathFactory) -> Path:
    out = factory.mktemp(name) / "run"
    simulate(name, in_process=True, out=out)
    return out
