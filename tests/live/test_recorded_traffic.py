"""A live run among recorded ships: they keep their tracks, take no orders, and speak AIS with their own MMSI."""

from __future__ import annotations

import shutil
from contextlib import closing
from math import pi
from pathlib import Path

import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.cosim.run import RUN_FILES
from shipcollision_fmu.live.protocols.feeds import DisFeed, NmeaFeed
from shipcollision_fmu.live.protocols.outlets import make_fleet, make_sample
from shipcollision_fmu.live.session.live_run import LiveRun
from shipcollision_fmu.live.session.run_folder import write_run
from shipcollision_fmu.live.session.session import Session
from tests.ais_tracks import MMSI, PLACE, csv_text, report, straight
from tests.cosim.test_recorded_tracks import CROSSING, HEADER, OWN, TRACKED, write_scenario


def test_a_live_run_with_a_track_gives_the_same_bytes_again(tmp_path: Path) -> None:
    scenario = load_scenario(write_scenario(tmp_path))
    with closing(LiveRun(scenario, tmp_path)) as run:
        for _ in range(300):
            run.advance()
        write_run(run, tmp_path / "live")
    assert_same_when_moved(tmp_path / "live", tmp_path)


def test_two_ships_of_one_recording_one_of_them_estimated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The recording is copied once. The estimated ship file, in the user's cache, is made again."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    third = f'[ships.third]\ntrack = {{file = "ais.csv", mmsi = {MMSI + 1}}}\n'
    source = tmp_path / "source"
    source.mkdir()
    path = write_scenario(source, HEADER + OWN + TRACKED + third + PLACE)
    sized = {"length": 90, "width": 14, "draught": 5, "type": 70, "name": "BETA"}
    away = straight(0.0, -400.0, 2.0, 0.5 * pi)
    rows = [report(CROSSING, 2.0 * k, **sized) for k in range(-3, 14)]
    rows += [report(away, 2.0 * k, MMSI + 1, **sized) for k in range(-3, 14)]
    (source / "ais.csv").write_text(csv_text(rows), encoding="utf-8")
    with closing(LiveRun(load_scenario(path), tmp_path)) as run:
        shutil.rmtree(source)
        shutil.rmtree(tmp_path / "cache")
        for _ in range(300):
            run.advance()
        write_run(run, tmp_path / "live")
    assert [path.name for path in (tmp_path / "live" / "recordings").iterdir()] == ["target.csv"]
    assert_same_when_moved(tmp_path / "live", tmp_path)


def assert_same_when_moved(live: Path, folder: Path) -> None:
    """The run's folder, elsewhere and without what it was made from, gives its files again."""
    moved = folder / "elsewhere" / "moved"
    shutil.copytree(live, moved)
    for path in (*folder.glob("*.toml"), *folder.glob("*.csv")):
        path.unlink()
    shutil.rmtree(live)
    simulate(load_scenario(moved / "scenario.toml"), in_process=True, out=folder / "again")
    assert str(folder) not in (moved / "scenario.toml").read_text(encoding="utf-8")
    for name in set(RUN_FILES) - {"timing.json"}:
        assert (moved / name).read_bytes() == (folder / "again" / name).read_bytes(), name


def test_a_recorded_ship_speaks_as_itself(tmp_path: Path) -> None:
    scenario = load_scenario(write_scenario(tmp_path))
    fleet = make_fleet(scenario, "own")
    assert fleet.identities["target"].mmsi == MMSI
    assert fleet.time(1.5).isoformat() == "2026-01-01T00:00:01.500000+00:00"
    sample = make_sample(Session(scenario).snapshot)
    assert sample.ships["target"].state.surge == pytest.approx(5.0, abs=1e-3)
    assert sum(line.startswith(b"!AIVDM") for line in NmeaFeed(fleet).take(sample)) == 3  # type 1, and two of type 5
    assert len(DisFeed(fleet).take(sample)) == 2
