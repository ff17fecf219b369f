"""Ships that follow recorded AIS: they hit where and when the track says so, push, and are not pushed."""

from __future__ import annotations

from math import pi
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.cli.run_table import summarise_run
from shipcollision_fmu.cosim.run import RUN_FILES
from shipcollision_fmu.errors import ScenarioError
from shipcollision_fmu.packaging.system_structure import build_system_structure
from tests.ais_tracks import MMSI, PLACE, csv_text, report, straight
from tests.ship_files import BARGE_ADDED_MASS, ship_toml

SPEED, AWAY = 5.0, 120.0
OWN = '[ships.own]\nship = "./barge.toml"\nposition = [0.0, 0.0]\nheading_deg = 0.0\nspeed = 0.0\n'
TRACKED = f'[ships.target]\nship = "./barge.toml"\ntrack = {{file = "ais.csv", mmsi = {MMSI}}}\n'
HEADER = '[scenario]\nname = "recorded"\nduration = 20.0\nstep = 0.05\n\n'
CROSSING = straight(0.0, -AWAY, SPEED, 0.5 * pi)
"""East, towards the middle of own, which lies heading north: two barges of 100 m by 20 m."""


def write_scenario(folder: Path, text: str = HEADER + OWN + TRACKED + PLACE) -> Path:
    (folder / "barge.toml").write_text(ship_toml(added_mass=BARGE_ADDED_MASS), encoding="utf-8")
    (folder / "ais.csv").write_text(csv_text(report(CROSSING, 2.0 * k) for k in range(-3, 14)), encoding="utf-8")
    path = folder / "recorded.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_recorded_ship_hits_where_its_track_says_so(tmp_path: Path) -> None:
    """Its bow is 50 m ahead of midship, own's side 10 m from its own: contact after (120 - 60) / 5 = 12 s."""
    run = simulate(load_scenario(write_scenario(tmp_path)), in_process=True)
    (collision,) = run.events["collisions"]
    assert collision["start"] == pytest.approx((AWAY - 60.0) / SPEED, abs=0.02)
    np.testing.assert_allclose(collision["first_point"]["n"][:2], [0.0, -10.0], atol=0.2)
    assert collision["closing_speed"] == pytest.approx(SPEED, abs=1e-3)
    t = run.states["time"]
    for variable, expected in (("north", 0.0), ("east", SPEED * t - AWAY), ("yaw", pi / 2), ("surge", SPEED)):
        (column,) = [name for name in run.states.dtype.names if name.startswith("target.") and variable in name][:1]
        np.testing.assert_allclose(run.states[column], expected, atol=2e-3)
    assert collision["delta_v"]["target"] == [0.0, 0.0, 0.0]
    gained = collision["delta_v"]["own"]
    assert gained[1] == pytest.approx(SPEED, abs=0.05)  # plastic, and the other gives way by nothing
    assert run.summary["momentum"]["closed"] is False
    ledger = run.summary["ledger"]["target"]
    assert ledger["applied"] == ledger["issued"] != [0.0] * 6 == ledger["pending"]
    assert any(line.endswith("MJ from coasting and from recorded tracks") for line in summarise_run(run))
    assert run.summary["ships"]["target"]["track"] == {"mmsi": MMSI}


def test_without_a_ship_file_the_ship_is_estimated_from_its_dimensions(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """110 m by 18 m, draught 6 m, cargo: its bow is 55 m ahead, 5 m more than that of a barge."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    path = write_scenario(tmp_path, HEADER + OWN + TRACKED.replace('ship = "./barge.toml"\n', "") + PLACE)
    sized = {"length": 110, "width": 18, "draught": 6, "type": 70, "name": "ALFA"}
    rows = [report(CROSSING, 2.0 * k, **sized) for k in range(-3, 14)]
    (tmp_path / "ais.csv").write_text(csv_text(rows), encoding="utf-8")
    scenario = load_scenario(path)
    ship = scenario.load_ships()["target"]
    assert (ship.name, ship.L_oa, ship.B, ship.T) == ("ALFA", 110.0, 18.0, 6.0)
    assert scenario.ship_file("target").startswith(str(tmp_path / "cache"))
    run = simulate(scenario, in_process=True)
    assert run.events["collisions"][0]["start"] == pytest.approx((AWAY - 65.0) / SPEED, abs=0.05)
    assert scenario.changed(step=0.1).ship_file("target") == scenario.ship_file("target")


def test_own_evades_a_recorded_ship(tmp_path: Path) -> None:
    """A ship that follows a track is observed as any other: at 350 m own, a tanker, puts its rudder over."""
    own = (
        '[ships.own]\nship = "kvlcc2"\nposition = [0.0, 400.0]\nheading_deg = 270.0\nspeed = 4.0\n'
        'evasion = {of = "target", distance = 450.0, rudder_deg = 35.0}\n'
    )
    run = simulate(load_scenario(write_scenario(tmp_path, HEADER + own + TRACKED + PLACE)), in_process=True)
    assert run.states["own.rate.yaw"][-1] > 0.0 == run.states["own.rate.yaw"][0]


@pytest.mark.parametrize("fmi", [2, 3])
def test_a_run_of_fmus_gives_the_same_bytes(tmp_path: Path, fmi: int) -> None:
    scenario = load_scenario(write_scenario(tmp_path))
    simulate(scenario, in_process=True, out=tmp_path / "a")
    simulate(scenario, fmi=fmi, out=tmp_path / "b")
    for name in set(RUN_FILES) - {"timing.json"}:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes(), name


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (HEADER + OWN + TRACKED, r"\[ships.target\] track: ais.csv needs the table \[place\]: give it, such as"),
        (HEADER + TRACKED + TRACKED.replace("target", "own") + PLACE, r"\[ships\] all follow tracks"),
        (HEADER + OWN + TRACKED + "heading_deg = 0.0\n" + PLACE, r"its motion, and heading_deg: remove heading_deg"),
        (HEADER + OWN + TRACKED.replace("ais.csv", "no.csv") + PLACE, r"track file .*no.csv does not exist"),
        (HEADER + OWN + TRACKED.replace('ship = "./barge.toml"\n', "") + PLACE, r"no dimensions of MMSI .*: give ship"),
        (HEADER + OWN + TRACKED + PLACE + '[collision]\nresponse = "bullet"\n', r"target follows a track: take 'pgs'"),
        (HEADER + OWN.replace('ship = "./barge.toml"\n', "") + TRACKED + PLACE, r"\[ships.own\] ship is missing: give"),
    ],
)  # fmt: skip
def test_what_cannot_follow_is_refused(tmp_path: Path, text: str, line: str) -> None:
    with pytest.raises(ScenarioError, match=line):
        load_scenario(write_scenario(tmp_path, text))


def test_the_remedy_of_a_missing_place_works(tmp_path: Path) -> None:
    with pytest.raises(ScenarioError) as refused:
        load_scenario(write_scenario(tmp_path, HEADER + OWN + TRACKED))
    keys = str(refused.value).partition("such as ")[2].partition(", where")[0].replace(", ", "\n")
    away = OWN.replace("[0.0, 0.0]", "[900.0, 0.0]")  # the track begins at the place
    load_scenario(write_scenario(tmp_path, f"{HEADER}{away}{TRACKED}\n[place]\n{keys}\n"))


def test_a_recorded_ship_cannot_be_packaged(tmp_path: Path) -> None:
    with pytest.raises(ScenarioError, match=r"\[ships.target\] follows a recorded track, which only our own master"):
        build_system_structure(load_scenario(write_scenario(tmp_path)))
