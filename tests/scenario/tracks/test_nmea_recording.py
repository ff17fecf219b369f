"""Logs of sentences VDM: where the time stands, messages of several sentences, and what is passed over."""

from __future__ import annotations

from math import radians
from pathlib import Path
from typing import Any

import pyais
import pytest

from shipcollision_fmu.errors import HostError, ScenarioError
from shipcollision_fmu.scenario.tracks.nmea_recording import read_nmea
from shipcollision_fmu.scenario.tracks.read_recording import read_recording
from shipcollision_fmu.scenario.tracks.recording import Antenna

MMSI, T = 211234560, 1767225600


def position(kind: int = 1, **changed: Any) -> str:
    """A sentence of another encoder than ours."""
    data = {"type": kind, "mmsi": MMSI, "lat": 54.0, "lon": 8.0, "speed": 10.0, "course": 90.0, "heading": 91} | changed
    (line,) = pyais.encode_dict(data, talker_id="AI", sentence_type="VDM")
    return line


def static(**changed: Any) -> list[str]:
    data = {
        "type": 5, "mmsi": MMSI, "shipname": "NORDSTERN", "ship_type": 70, "to_bow": 30, "to_stern": 90, "to_port": 4,
        "to_starboard": 12, "draught": 6.5,
    } | changed  # fmt: skip
    return list(pyais.encode_dict(data, talker_id="AI", sentence_type="VDM", seq_id=3))


@pytest.mark.parametrize(
    "line",
    [
        f"\\c:{T}*5E\\{{}}", f"\\s:station 3,c:{T}000*00\\{{}}", f"{T} {{}}", f"{T}.0,{{}}", "2026-01-01T00:00:00Z {}",
        "2026-01-01 00:00:00\t{}", "2026-01-01T01:00:00+01:00 {}", "01/01/2026 00:00:00; {}", f"{{}},{T}",
        f"{{}} {T}000",
    ],
)  # fmt: skip
def test_the_time_stands_where_receivers_write_it(line: str) -> None:
    recording = read_nmea(line.format(position()) + "\n", "a.nmea")
    (report,) = recording.reports[MMSI]
    assert (report.row, report.time) == (1, T)
    assert (report.latitude, report.longitude) == pytest.approx((54.0, 8.0), abs=1e-6)
    assert (report.sog, report.cog, report.heading) == pytest.approx((10.0 * 1852 / 3600, radians(90), radians(91)))
    assert recording.notes == ()


@pytest.mark.parametrize("kind", [1, 2, 3, 18])
def test_both_classes_are_read(kind: int) -> None:
    assert len(read_nmea(f"{T} {position(kind)}", "a.nmea").reports[MMSI]) == 1


def test_parts_of_a_message_are_put_together() -> None:
    """Between them are those of other ships, and other sentences."""
    first, second = static()
    text = f"{T} {first}\n{T} {position()}\n{T} $GPZDA,000000,01,01,2026,,*48\n{T} {second}\n"
    recording = read_nmea(text, "a.nmea")
    assert recording.sizes[MMSI][:5] == ("NORDSTERN", 70, 120.0, 16.0, 6.5)
    assert recording.antennas[MMSI] == Antenna(30.0, -4.0)
    assert recording.notes == ()


def test_dimensions_without_a_reference_point_have_no_antenna() -> None:
    text = "\n".join(f"{T} {line}" for line in [*static(to_bow=0, to_port=0), position()])
    recording = read_nmea(text, "a.nmea")
    assert recording.sizes[MMSI][2:4] == (90.0, 12.0)
    assert MMSI not in recording.antennas


def test_what_cannot_be_used_is_counted() -> None:
    good = position()
    broken = good[:20] + ("0" if good[20] != "0" else "1") + good[21:]
    nowhere = position(lat=91.0, lon=181.0)
    lonely = static()[1]
    text = "\n".join(f"{T} {line}" for line in (good, broken, nowhere, lonely, "!AIVDM,1,1,,A,???")) + f"\n{good}\n"
    assert read_nmea(text, "a.nmea").notes == (
        "a.nmea: left out are sentences that cannot be decoded: 3.",
        'a.nmea: left out are reports whose position is "not available": 1.',
        "a.nmea: left out are reports without a time, from row 6 on.",
    )


def test_values_that_are_not_available_are_none() -> None:
    text = f"{T} {position(speed=102.3, course=360.0, heading=511)}"
    (report,) = read_nmea(text, "a.nmea").reports[MMSI]
    assert (report.sog, report.cog, report.heading) == (None, None, None)


def test_a_log_without_times_is_refused() -> None:
    with pytest.raises(ScenarioError, match=r"a.nmea row 2: no time beside the sentence: log it with TAG blocks"):
        read_nmea(f"# log\n{position()}\n", "a.nmea")


def test_a_file_without_reports_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.nmea"
    path.write_text("\n".join(f"{T} {line}" for line in static()), encoding="utf-8")
    with pytest.raises(ScenarioError, match=r"a\.nmea holds no position report of AIS"):
        read_recording(path)


def test_without_pyais_one_line_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pyais.exceptions", None)
    with pytest.raises(
        HostError, match=r"needs pyais, which is not installed: pip install 'shipcollision-fmu\[live\]'"
    ):
        read_nmea(f"{T} {position()}", "a.nmea")
