"""Runs through FMUs without Python beside runs of the same scenario with it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.cosim import native_fmu_files
from shipcollision_fmu.cosim.prepared_files import prepare_files
from shipcollision_fmu.cosim.run import Run
from shipcollision_fmu.errors import HostError, ScenarioError
from shipcollision_fmu.scenario.scenario import parse_scenario
from shipcollision_fmu.toolchain import libraries
from shipcollision_fmu.toolchain.load import FETCHING
from shipcollision_fmu.toolchain.sources import COLLISION
from tests.conftest import NATIVE_CACHE
from tests.cosim.test_obstacles import AHEAD, AWAY, FENDER, QUAY

SCENARIOS = Path(__file__).parents[2] / "models" / "scenarios"
Write = Callable[..., Path]


@pytest.fixture
def native(native_fmus: object, native_collisions: object, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Run]:
    """simulate() with native FMUs, whose libraries were compiled for these tests."""
    monkeypatch.setattr(libraries, "native_cache", lambda: NATIVE_CACHE)
    return lambda scenario, **options: simulate(scenario, engine="native", **options)


def differ(run: Run, other: Run, rows: slice = slice(None)) -> float:
    """The largest difference of a state, as a share of the largest of its kind; of 1e-3 where that is rounding."""
    names = [name for name in run.states.dtype.names or () if run.states.dtype[name].kind == "f"]
    found = 0.0
    for name in names:
        kind = name.rpartition(".")[0]
        size = max(np.abs(other.states[one]).max() for one in names if one.rpartition(".")[0] == kind)
        off = np.abs(run.states[name][rows] - other.states[name][rows]).max()
        found = max(found, float(off / max(size, 1e-3)))
    return found


def list_collisions(run: Run) -> list[tuple[Any, ...]]:
    return [(one["ship_a"], one["ship_b"], round(one["start"], 6)) for one in run.events["collisions"]]


@pytest.mark.parametrize(
    ("options", "line"),
    [
        ({"engine": "C"}, "engine = 'C' must be one of 'python', 'native'"),
        ({"engine": "native", "in_process": True}, "engine = 'native' with in_process = True: in process Python runs"),
        (
            {"engine": "native"},
            r"^\[collision\] response = 'bullet' needs Python, and native code has 'pgs' alone: take 'pgs', as the "
            r"scenarios guan2014_added_mass and kvlcc2_crossing do, or engine = 'python'$",
        ),
    ],
)
def test_what_does_not_fit_is_said_first(options: dict[str, Any], line: str, tmp_path: Path) -> None:
    with pytest.raises(ScenarioError, match=line):
        simulate("guan2014", out=tmp_path / "run", **options)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["guan2014_added_mass", "kvlcc2_crossing"])
def test_scenarios_that_a_refusal_names_are_native(name: str) -> None:
    assert prepare_files(load_scenario(name)).ships


def test_compilation_is_announced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    """It takes a minute, in which nothing else is said."""

    def compile_nothing(name: str, platforms: object, report: Callable[[int, int], None]) -> None:
        report(1, 9)
        report(2, 9)
        raise HostError(name)

    monkeypatch.setattr(native_fmu_files, "must_fetch_bullet", lambda name, platforms: name == COLLISION)
    monkeypatch.setattr(native_fmu_files, "build_binaries", compile_nothing)
    with pytest.raises(HostError, match=COLLISION):
        simulate("kvlcc2_crossing", engine="native")
    assert capfd.readouterr().err == (
        f"{FETCHING}\n"
        "note: native code of ShipCollision is compiled, once; this takes half a minute, on a busy machine two\n"
    )


@pytest.mark.slow
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
def test_a_published_encounter_is_the_same(native: Callable[..., Run], algorithm: str) -> None:
    scenario = load_scenario("guan2014_added_mass").changed(algorithm=algorithm)
    run, again = native(scenario), native(scenario, fmi=3)
    python = simulate(scenario, in_process=True)
    assert (run.timing["mode"], again.timing["mode"]) == ("native FMU", "native FMU, FMI 3.0")
    assert run.summary["engine"] == "native"
    assert set(run.summary["versions"]) == {"shipcollision_fmu", "numpy", "fmpy"}  # neither of the others took part
    assert "engine" not in python.summary
    assert run.states.tolist() == again.states.tolist()
    assert differ(run, python) < 1e-9
    assert list_collisions(run) == list_collisions(python) != []
    assert run.contacts["ship_a"].tolist() == python.contacts["ship_a"].tolist()


@pytest.mark.slow
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
def test_a_long_scrape_is_the_same_to_its_end(native: Callable[..., Run], algorithm: str) -> None:
    """Where two decks are level, the last bit of a pose must not choose the normal (test_last_bits.py)."""
    scenario = load_scenario("kvlcc2_crossing").changed(algorithm=algorithm)
    run, python = native(scenario), simulate(scenario, in_process=True)
    assert differ(run, python) < 1e-8
    assert list_collisions(run) == list_collisions(python) != []
    assert len(run.contacts) == len(python.contacts) > 200


@pytest.mark.slow
@pytest.mark.parametrize("fmi", [2, 3])
def test_wind_and_current_that_change_are_the_same(native: Callable[..., Run], fmi: int) -> None:
    """Before the impact, and while the ships touch. Without the changes the run is another."""
    text = (SCENARIOS / "kvlcc2_crossing.toml").read_text(encoding="utf-8")
    changes = (
        "\n[environment]\nwind = {speed = 12.0, from_deg = 300.0}\nchanges = [\n"
        "  {time = 8.0, current = {speed = 0.5, towards_deg = 200.0}},\n"
        "  {time = 35.0, wind = {speed = 18.0, from_deg = 80.0}},\n]\n"
    )
    scenario = parse_scenario(text + changes, "blown")
    run, python = native(scenario, fmi=fmi), simulate(scenario, in_process=True)
    assert differ(run, python) < 1e-8
    assert list_collisions(run) == list_collisions(python) != []
    assert run.surroundings.tolist() == python.surroundings.tolist()
    for column in python.machinery.dtype.names or ():
        np.testing.assert_allclose(run.machinery[column], python.machinery[column], rtol=0.0, atol=1e-12)
    calm = parse_scenario(text + changes.partition("changes")[0], "calm")
    assert differ(simulate(calm, in_process=True), python) > 1e-3


@pytest.mark.slow
@pytest.mark.parametrize("fender", ["", FENDER])
def test_ships_and_obstacles_of_the_users_are_prepared(
    native: Callable[..., Run], scenario_file: Write, fender: str
) -> None:
    scenario = load_scenario(scenario_file(AHEAD, AWAY, added=QUAY + fender))
    run, python = native(scenario), simulate(scenario, in_process=True)
    assert differ(run, python) < 1e-9
    assert list_collisions(run) == list_collisions(python)
    assert {str(one) for one in run.contacts["ship_b"]} == {"quay"}
    assert run.summary["obstacles"]["quay"]["impulse"] == pytest.approx(
        python.summary["obstacles"]["quay"]["impulse"], rel=1e-9, abs=1.0
    )
