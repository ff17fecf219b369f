"""A consumer's script under `mypy --strict` has the real types of the package's names, and a wrong use is an error."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from hatchling.builders.wheel import WheelBuilder

import shipcollision_fmu

PROJECT = Path(__file__).parents[1]
CONSUMER = """
from pathlib import Path
import shipcollision_fmu
from shipcollision_fmu import (
    Run, Scenario, ScenarioError, Ship, ShipCollision, ShipManoeuvring, build_fmus, encounter, load_scenario, load_ship,
    simulate,
)

scenario = load_scenario("guan2014")
run = simulate(scenario, in_process=True)
ship = load_ship("kvlcc2")
reveal_type(scenario)
reveal_type(run)
reveal_type(ship)
reveal_type(run.page())
reveal_type(run.to_pandas())
reveal_type(build_fmus)
reveal_type(encounter("t-bone", own="kcs", own_speed=4.0).scenario)
reveal_type(ShipCollision)
reveal_type(ShipManoeuvring)
reveal_type(ScenarioError("no").exit_status)
simulate(Path("my.toml"))


def energy(run: Run, scenario: Scenario, ship: Ship) -> float:
    return float(run.summary["energy"]["dissipated"]) + ship.mass + scenario.step


energy(run, scenario, ship)
energy(run, ship, scenario)  # line 30: two ships mixed up
simulate(scenario, in_proces=True)  # line 31: a misspelt option
shipcollision_fmu.load_shp("kvlcc2")  # line 32: a misspelt name
"""
REVEALED = [
    "shipcollision_fmu.scenario.scenario.Scenario",
    "shipcollision_fmu.cosim.run.Run",
    "shipcollision_fmu.ship.ship.Ship",
    "shipcollision_fmu.cosim.run_page.RunPage",
    "shipcollision_fmu.cosim.run_frames.RunFrames",
    "dict[str, pathlib",
    "shipcollision_fmu.scenario.scenario.Scenario",
    "shipcollision_fmu.collision.model.ShipCollision",
    "shipcollision_fmu.manoeuvring.model.ShipManoeuvring",
    "int",
]
LIGHT = """
import sys, shipcollision_fmu
shipcollision_fmu.ShipCollisionError
assert set(shipcollision_fmu.__all__) <= set(dir(shipcollision_fmu))
heavy = {"numpy", "pydantic", "fmpy", "pybullet", "matplotlib", "pandas"} & set(sys.modules)
assert not heavy, heavy
shipcollision_fmu.ShipCollision, shipcollision_fmu.ShipManoeuvring
rooms = [name for name in sys.modules if name.startswith(("shipcollision_fmu.cosim", "shipcollision_fmu.show"))]
assert not rooms and "fmpy" not in sys.modules, rooms
"""


@pytest.fixture(scope="module")
def reported(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[str]]:
    """mypy's notes and errors on the consumer's script."""
    folder = tmp_path_factory.mktemp("consumer")
    (folder / "script.py").write_text(CONSUMER, encoding="utf-8")
    (folder / "mypy.ini").write_text("[mypy]\nstrict = true\n", encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--no-error-summary", "script.py"],
        cwd=folder, capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert done.returncode == 1, done.stdout + done.stderr
    lines = done.stdout.splitlines()
    return {kind: [line for line in lines if f": {kind}: " in line] for kind in ("note", "error")}


@pytest.mark.slow
def test_the_types_are_the_real_ones(reported: dict[str, list[str]]) -> None:
    revealed = [line for line in reported["note"] if "Revealed type" in line]
    assert len(revealed) == len(REVEALED)
    for line, expected in zip(revealed, REVEALED, strict=True):
        assert expected in line
        assert "Any" not in line or "RunFrames" in line  # pandas has its types in a package of its own


@pytest.mark.slow
def test_a_wrong_use_is_an_error_and_a_right_one_is_none(reported: dict[str, list[str]]) -> None:
    numbers = {int(re.search(r"script.py:(\d+):", line)[1]) for line in reported["error"]}  # type: ignore[index]  # mypy's own lines
    texts = "\n".join(reported["error"])
    assert numbers == {30, 31, 32}
    assert 'Argument 2 to "energy" has incompatible type "Ship"; expected "Scenario"' in texts
    assert 'Unexpected keyword argument "in_proces" for "simulate"' in texts
    assert 'Module has no attribute "load_shp"' in texts


def test_every_exported_name_has_one_module_and_a_type() -> None:
    lazy = [name for names in shipcollision_fmu._MODULES.values() for name in names]
    assert sorted([*lazy, "__version__"]) == sorted(shipcollision_fmu.__all__)
    source = Path(shipcollision_fmu.__file__).read_text(encoding="utf-8")
    block = source.partition("if TYPE_CHECKING:\n")[2].partition("\n\n")[0]
    typed = re.findall(r"^    from \.(\S+) import (.+)$", block, flags=re.MULTILINE)
    assert {module: tuple(names.split(", ")) for module, names in typed} == shipcollision_fmu._MODULES


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="module 'shipcollision_fmu' has no attribute 'simulat'"):
        shipcollision_fmu.simulat  # noqa: B018  # the access is what is tested


def test_the_package_is_light_until_a_name_is_used() -> None:
    subprocess.run([sys.executable, "-c", LIGHT], check=True, timeout=600)


def test_the_wheel_says_that_the_package_is_typed() -> None:
    files = {file.distribution_path for file in WheelBuilder(str(PROJECT)).recurse_included_files()}
    assert "shipcollision_fmu/py.typed" in files
    assert "shipcollision_fmu/results/events.schema.json" in files
