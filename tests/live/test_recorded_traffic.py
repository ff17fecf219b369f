"""A live run among recorded ships: they keep their tracks, take no orders, and speak AIS with their own MMSI."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.live.protocols.feeds import DisFeed, NmeaFeed
from shipcollision_fmu.live.protocols.outlets import make_fleet, make_sample
from shipcollision_fmu.live.session.live_run import LiveRun
from shipcollision_fmu.live.session.run_folder import write_run
from shipcollision_fmu.live.session.session import Session
from tests.ais_tracks import MMSI
from tests.cosim.test_recorded_tracks import write_scenario


def test_a_live_run_with_a_track_gives_the_same_bytes_again(tmp_path: Path) -> None:
    scenario = load_scenario(write_scenario(tmp_path))
    with closing(LiveRun(scenario, tmp_path)) as run:
        for _ in range(300):
            run.advance()
        write_run(run, tmp_path / "live")
    simulate(load_scenario(tmp_path / "live" / "scenario.toml"), in_process=True, out=tmp_path / "again")
    for name in ("states.csv", "contacts.csv", "events.json"):
        assert (tmp_path / "live" / name).read_bytes() == (tmp_path / "again" / name).read_bytes(), name


def test_a_recorded_ship_speaks_as_itself(tmp_path: Path) -> None:
    scenario = load_scenario(write_scenario(tmp_path))
    fleet = make_fleet(scenario, "own")
    assert fleet.identities["target"].mmsi == MMSI
    assert fleet.time(1.5).isoformat() == "2026-01-01T00:00:01.500000+00:00"
    sample = make_sample(Session(scenario).snapshot)
    assert sample.ships["target"].state.surge == pytest.approx(5.0, abs=1e-3)
    assert sum(line.startswith(b"!AIVDM") for line in NmeaFeed(fleet).take(sample)) == 3  # type 1, and two of type 5
    assert len(DisFeed(fleet).take(sample)) == 2
