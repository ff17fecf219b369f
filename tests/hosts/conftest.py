"""The encounters that all hosts run, packaged once, and what our own master makes of them."""

from __future__ import annotations

import numpy as np
import pytest

from shipcollision_fmu.encounters.encounter import encounter
from shipcollision_fmu.scenario.scenario import load_scenario, parse_scenario
from shipcollision_fmu.toolchain import libraries
from tests.conftest import NATIVE_CACHE

from .encounter import Encounter, Rows

NATIVE = "under_way, native"
NAMES = ("guan2014", "under_way", NATIVE)


@pytest.fixture(scope="session")
def encounters(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Encounter]:
    """guan2014 coasts, answered by Bullet; under_way sails two VLCCs into each other, answered by pgs, and they part;
    NATIVE is the same in FMUs that run without Python.

    Not at a right angle amidships: there both corners of the stem touch at once, and the last bit decides which first.
    """
    place = {"angle_deg": 70.0, "at": 0.15, "time": 2.0, "after": 3.0}
    text = encounter("t-bone", hydrodynamics=True, name="under_way", **place).text
    assert "restitution = 0.0" in text
    text = text.replace("restitution = 0.0", "restitution = 0.3")
    scenarios = {"guan2014": load_scenario("guan2014"), "under_way": parse_scenario(text, "under_way.toml")}
    made = {name: Encounter.packaged(told, tmp_path_factory.mktemp(name)) for name, told in scenarios.items()}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(libraries, "native_cache", lambda: NATIVE_CACHE)
        folder = tmp_path_factory.mktemp("native FMUs")
        made[NATIVE] = Encounter.packaged(scenarios["under_way"], folder, native=("linux64",))
    return made


@pytest.fixture(scope="session")
def ours(encounters: dict[str, Encounter]) -> dict[str, tuple[Rows, int, dict[str, list[float]]]]:
    """Rows, number of collisions and all exchanged values of our own parallel master; of native FMUs through FMI."""
    made = {name: encounters[name].ours() for name in NAMES if name != NATIVE}
    made[NATIVE] = encounters[NATIVE].ours(through_fmi=True)
    assert all(np.isfinite(rows).all() and impacts == 1 for rows, impacts, _ in made.values())
    return made
