"""Recorded AIS becomes motion: rows cleaned, gaps and values "not available" handled and said, bad rows refused."""

from __future__ import annotations

from math import pi
from pathlib import Path
from typing import Any

import pytest

from shipcollision_fmu.errors import ScenarioError
from shipcollision_fmu.scenario.tracks.cleaning import Period
from shipcollision_fmu.scenario.tracks.read_recording import read_recording
from shipcollision_fmu.scenario.tracks.tangent_plane import TangentPlane
from shipcollision_fmu.scenario.tracks.track import Track, build_track
from tests.ais_tracks import LATITUDE, LONGITUDE, MMSI, START, csv_text, report, straight, turn

EAST = straight(100.0, -500.0, 6.0, 0.5 * pi)
TIMES = [6.0 * k for k in range(21)]
Rows = list[dict[str, Any]]


def rows(**changed: Any) -> Rows:
    return [report(EAST, t, **changed) for t in TIMES]


def build(folder: Path, text: str | Rows, mmsi: int | None = MMSI, end: float = 120.0) -> Track:
    path = folder / "ais.csv"
    path.write_text(text if isinstance(text, str) else csv_text(text), encoding="utf-8")
    return build_track(read_recording(path), mmsi, TangentPlane(LATITUDE, LONGITUDE), Period(START, START + end))


def check_east(track: Track, abs_: float = 0.01) -> None:
    for t in (0.0, 31.7, 120.0):
        state = track.state(t)
        assert state[:3] == pytest.approx((100.0, -500.0 + 6.0 * t, 0.0), abs=abs_)
        assert (state.heading, state.surge, state.sway) == pytest.approx((0.5 * pi, 6.0, 0.0), abs=0.002)


def test_a_straight_track_is_met(tmp_path: Path) -> None:
    track = build(tmp_path, rows())
    check_east(track)
    assert track.notes == ()


def test_a_turn_has_its_rate_and_its_leeway_from_headings(tmp_path: Path) -> None:
    """5 deg between heading and course: sway is -v sin(5 deg), and the rate of turn is v/R."""
    motion, drift = turn(400.0, 6.0), 5.0
    made = [report(motion, t) for t in TIMES]
    track = build(tmp_path, [{**row, "heading": f"{(float(row['cog']) + drift) % 360.0:.6f}"} for row in made])
    state = track.state(60.0)
    assert state.yaw_rate == pytest.approx(6.0 / 400.0, rel=1e-3)
    assert state.sway == pytest.approx(-6.0 * 0.08716, abs=0.01)


def test_rounding_of_ais_is_smoothed(tmp_path: Path) -> None:
    """Headings in whole degrees, SOG in tenths of a knot, positions in 1/10 000 of a minute: the bow does not swing."""
    motion = straight(0.0, 0.0, 6.13, 0.7105)
    made = [report(motion, t) for t in TIMES]
    for i, row in enumerate(made):
        row["heading"] = f"{round(float(row['heading']) + (0.4 if i % 2 else -0.4)):d}"
        row["sog"], row["cog"] = f"{float(row['sog']):.1f}", f"{float(row['cog']):.1f}"
        row["lat"], row["lon"] = (f"{round(float(row[key]) * 6e5) / 6e5:.8f}" for key in ("lat", "lon"))
    track = build(tmp_path, made)
    for k in range(1200):
        state = track.state(0.1 * k)
        assert abs(state.yaw_rate) < 0.5 / 6.0 * pi / 180.0  # half of a degree from report to report
        assert state.surge == pytest.approx(6.13, abs=0.05)


def test_the_antenna_is_moved_to_midship(tmp_path: Path) -> None:
    """30 m from the bow, 90 m from the stern, 4 m from port, 12 m from starboard: midship is 30 m astern, 4 m to
    starboard, which is south of a ship that steers east."""
    state = build(tmp_path, rows(a=30, b=90, c=4, d=12)).state(10.0)
    assert state[:2] == pytest.approx((100.0 - 4.0, -500.0 + 60.0 - 30.0), abs=0.02)
    track = build(tmp_path, rows(a=30, b=90, c=4, d=12, name="ALFA", type=70, draught=6.5))
    assert track.size is not None
    assert track.size[:5] == ("ALFA", 70, 120.0, 16.0, 6.5)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"heading": 511}, "21 of 21 reports of MMSI 211000001 have no heading; the course is taken"),
        ({"heading": ""}, "21 of 21 reports of MMSI 211000001 have no heading; the course is taken"),
        ({"sog": 102.3}, None),
        ({"cog": 360}, None),
    ],
)
def test_what_is_not_available_is_found_otherwise(tmp_path: Path, changed: dict[str, Any], said: str | None) -> None:
    track = build(tmp_path, rows(**changed))
    check_east(track, 0.05)
    assert track.notes == (() if said is None else (f"ais.csv: {said}.",))


def test_rows_are_cleaned_and_the_user_is_told(tmp_path: Path) -> None:
    made = rows()
    made[4:6] = [made[5], made[4]]  # out of order
    made.insert(8, dict(made[7]))  # twice
    made.append({**made[3], "lat": 91, "lon": 181})
    made.append({**report(EAST, 3.0, mmsi=244000000), "lat": 53.0})
    track = build(tmp_path, made)
    check_east(track)
    assert [note.partition(": ")[2] for note in track.notes] == [
        "row 24 and 0 more without a position, which AIS calls not available, are left out.",
        "row 7 and 0 more of MMSI 211000001 are earlier than the row before; they are sorted by time.",
        "row 10 and 0 more of MMSI 211000001 repeat a time; the first of each is taken.",
    ]


def test_a_gap_is_said(tmp_path: Path) -> None:
    track = build(tmp_path, [row for t, row in zip(TIMES, rows(), strict=True) if not 20.0 < t < 100.0])
    check_east(track)
    assert track.notes == ("ais.csv: the longest gap between reports is 84 s; in it the ship's motion is a guess.",)


def test_other_columns_and_times_are_read(tmp_path: Path) -> None:
    """MarineCadastre's, and those of the Danish archive."""
    cadastre = csv_text(
        {"MMSI": MMSI, "BaseDateTime": row["time"][:19], "LAT": row["lat"], "LON": row["lon"], "SOG": row["sog"],
         "COG": row["cog"], "Heading": row["heading"], "VesselName": "ALFA", "Length": 120, "Width": 16}
        for row in rows()
    )  # fmt: skip
    check_east(build(tmp_path, cadastre))
    danish = csv_text(
        {"# Timestamp": f"01/01/2026 00:{int(t) // 60:02d}:{int(t) % 60:02d}", "MMSI": MMSI, "Latitude": row["lat"],
         "Longitude": row["lon"], "SOG": row["sog"], "COG": row["cog"], "Heading": row["heading"]}
        for t, row in zip(TIMES, rows(), strict=True)
    )  # fmt: skip
    check_east(build(tmp_path, danish))


def replaced(number: int, **changed: Any) -> Rows:
    made = rows()
    made[number] = {**made[number], **changed}
    return made


def gap() -> Rows:
    return [report(EAST, t) for t in (0.0, 6.0, 950.0, 1000.0)]


@pytest.mark.parametrize(
    ("text", "mmsi", "end", "line"),
    [
        (rows(), 1, 120.0, r"ais.csv has no position of mmsi = 1: it has 211000001"),
        ([*rows(), *rows(mmsi=5)], None, 120.0, r"has 2 ships: choose one by mmsi = ..., it has 5, 211000001"),
        (rows(), None, 121.0, r"from 2026-01-01T00:00:00Z \(row 2\) to 2026-01-01T00:02:00Z \(row 22\), but"),
        (replaced(5, lat=54.01), MMSI, 120.0, r"row 7: 1\d{3} m from row 6 in 6 s, which takes \d+ m/s, the limit"),
        (replaced(5, lat=94), MMSI, 120.0, r"row 7: latitude = 94 is out of range: give -90 to 90 deg, or 91 for"),
        (replaced(5, sog="fast"), MMSI, 120.0, r"row 7: sog = 'fast' is not a number: give 0 to 102.3 kn, or 102.3"),
        (replaced(5, sog=101), MMSI, 120.0, r"row 7: sog = 101.0 kn, the limit is 97 kn: write 102.3"),
        (replaced(5, cog="nan"), MMSI, 120.0, r"row 7: cog = nan is out of range"),
        (replaced(5, time="noon"), MMSI, 120.0, r"row 7: time = 'noon' is no time: write UTC such as"),
        (replaced(5, mmsi="A1"), MMSI, 120.0, r"row 7: mmsi = 'A1' must be a number of up to nine digits"),
        (replaced(5, time=rows()[4]["time"]), MMSI, 120.0, r"row 7: .* is also the time of row 6, 36 m away"),
        (gap(), MMSI, 1000.0, r"row 4: 944 s after row 3, the limit is 900 s: move start of \[place\]"),
        (rows(heading=511, sog=0), MMSI, 120.0, r"has neither heading nor, at 0.5 m/s or more, a course"),
        ("mmsi,lat,lon\n1,2,3\n", MMSI, 120.0, r"row 1: no column time: call one of the columns time or timestamp"),
        ("", MMSI, 120.0, r"row 1: no column time: .*there are none"),
    ],
)  # fmt: skip
def test_bad_recordings_are_refused(
    tmp_path: Path, text: str | Rows, mmsi: int | None, end: float, line: str
) -> None:  # fmt: skip
    with pytest.raises(ScenarioError, match=line):
        build(tmp_path, text, mmsi, end)


def test_a_track_that_is_elsewhere_is_refused(tmp_path: Path) -> None:
    (tmp_path / "ais.csv").write_text(csv_text(rows()), encoding="utf-8")
    with pytest.raises(
        ScenarioError, match=r"row 2: \d+ km from \[place\], the limit is 100 km: .* which is at 54.0009"
    ):
        build_track(read_recording(tmp_path / "ais.csv"), MMSI, TangentPlane(52.0, 8.0), Period(START, START + 60.0))
