"""A stand-in study of six parts, and its folder as one process writes it."""

from __future__ import annotations

from pathlib import Path

import pytest

from shipcollision_fmu.study.engine.run import run_study
from tests.study.engine.folders import STUDY
from tests.study.engine.stand_in import compute_stand_in


@pytest.fixture(scope="session")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of STUDY, computed in this process without a break."""
    out = tmp_path_factory.mktemp("whole") / "study"
    run_study(STUDY, out, workers=0, engine="python", compute=compute_stand_in)
    return out
