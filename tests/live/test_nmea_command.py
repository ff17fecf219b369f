"""`shipcollision nmea DIR`: the log of a finished run, and what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from shipcollision_fmu import simulate
from shipcollision_fmu.cli import main
from tests.conftest import Write

PLACE = "\n[place]\nlatitude = 1.25\nlongitude = 103.8\nstart = 2026-03-04T05:06:07Z\n"


def nmea(*arguments: object) -> Result:
    return CliRunner().invoke(main, ["nmea", *map(str, arguments)])


@pytest.fixture
def folder(scenario_file: Write, tmp_path: Path) -> Path:
    """Two barges that meet off Singapore; own has an identity."""
    ais = 'speed = 4.0\nais = {mmsi = 211234560, name = "ALFA", call_sign = "DABC", ship_type = 33}'
    simulate(scenario_file(("speed = 4.0", ais), added=PLACE), in_process=True, out=tmp_path / "run")
    return tmp_path / "run"


def test_the_log_has_place_time_and_identity(folder: Path) -> None:
    result = nmea(folder)
    assert result.exit_code == 0, result.output
    log = (folder / "run.nmea").read_bytes()
    assert (
        result.output.splitlines()[0]
        == f"{folder / 'run.nmea'}: {log.count(b'!') + log.count(b'$')} sentences of own, and AIS of 2 ships"
    )
    assert log.startswith(b"$GPRMC,050607.00,A,0115.0")
    assert b",040326," in log.splitlines()[0]
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    assert summary["place"] == {"latitude": 1.25, "longitude": 103.8, "start": "2026-03-04T05:06:07Z"}
    assert summary["ships"]["own"]["ais"]["mmsi"] == 211234560
    assert "ais" not in summary["ships"]["target"]


def test_rudder_revolutions_and_wind_are_those_of_the_folder(tmp_path: Path) -> None:
    simulate("kvlcc2_crossing", in_process=True, out=tmp_path)
    result = nmea(tmp_path, "--ship", "target")
    assert result.output.count("\n") == 1
    log = (tmp_path / "run.nmea").read_bytes()
    assert b"$IIRSA,-20.0,A,,V*" in log  # ordered at 45 s
    assert b"$IIRPM,S,0,46.1,,A*" in log  # 0.769 1/s
    assert log.count(b"MWV,") == 2 * log.count(b"RPM,") == 2 * 151


def test_what_the_folder_does_not_hold_is_left_out_and_said(folder: Path) -> None:
    """Barges that coast have no rudder; another master need not write the wind."""
    assert nmea(folder).output.splitlines()[1:] == [
        "left out: rudder and revolutions (RSA, RPM), which machinery.csv does not have of this ship"
    ]
    (folder / "surroundings.csv").unlink()
    assert nmea(folder).output.splitlines()[2:] == ["left out: wind (MWV), as the folder has no surroundings.csv"]
    (folder / "surroundings.csv").write_text("time,wind.speed,wind.direction\n")
    result = nmea(folder)
    assert result.exit_code == 2
    assert "surroundings.csv: has no row for the start of the run: give a folder that `shipcollision" in result.output


def test_another_ship_may_be_own_and_tags_give_the_time(folder: Path, tmp_path: Path) -> None:
    assert nmea(folder, "--ship", "target", "--tags", "--out", tmp_path / "log.txt").exit_code == 0
    first = (tmp_path / "log.txt").read_bytes().splitlines()[0]
    assert first.startswith(b"\\c:1772600767000*")
    assert b"\\$GPRMC," in first


def test_what_is_no_run_or_no_ship_is_refused(folder: Path, tmp_path: Path) -> None:
    result = nmea(folder, "--ship", "third")
    assert (result.exit_code, result.output.count("\n")) == (2, 1)
    assert "has no ship 'third': the ships are own, target" in result.output
    assert nmea(tmp_path / "none").exit_code == 2


def test_without_the_packages_one_line_says_what_to_install(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shipcollision_fmu.live.extra.find_spec", lambda name: None)
    result = nmea(folder)
    assert result.exit_code == 1
    assert result.output.startswith("error: NMEA and AIS need pyais, pynmeagps, which are missing: ")
