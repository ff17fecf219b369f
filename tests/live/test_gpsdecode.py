"""Decoders of others read every sentence of a whole run, with the values of its states within their resolution.

gpsdecode of gpsd 3.22 (Debian) reports RMC, GGA, HDT and AIS. It takes VTG, ROT, RSA, RPM and MWV for sentences with a
right checksum and shows no values of them: these are read by pynmea2, and AIS by pyais as well.
"""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Iterator
from functools import lru_cache
from math import atan2, cos, degrees, hypot, radians, sin
from pathlib import Path
from typing import Any, NamedTuple

import pyais
import pynmea2
import pytest

from shipcollision_fmu import simulate
from shipcollision_fmu.live.protocols.feeds import Fleet, NmeaFeed
from shipcollision_fmu.live.protocols.run_log import list_samples, make_fleet, write_log
from shipcollision_fmu.live.protocols.sample import Sample
from shipcollision_fmu.scenario.scenario import parse_scenario
from shipcollision_fmu.scenario.tracks.tangent_plane import TangentPlane
from shipcollision_fmu.show.scene.run_folder import read_run_folder

KNOT = 1852.0 / 3600.0
ORDERS = "  { time = 60.0, rudder_deg = 35.0 },\n  { time = 80.0, rudder_deg = -12.3, rev_per_s = 0.517 },\n"
ENVIRONMENT = """
[environment]
wind = {speed = 9.7, from_deg = 250.0}
changes = [{time = 70.0, wind = {speed = 14.2, from_deg = 10.0}}]
"""
SCENARIOS = Path(__file__).parents[2] / "models" / "scenarios"
LATITUDE, LONGITUDE = 54.0, 7.0


class Sent(NamedTuple):
    """A sentence, and the sample that it is of."""

    sample: Sample
    sentence: bytes


class Log(NamedTuple):
    folder: Path
    fleet: Fleet
    sent: list[Sent]

    def of(self, kind: str) -> list[Sent]:
        return [one for one in self.sent if one.sentence[3:6] == kind.encode()]


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Log:
    """The shipped crossing in a wind that changes; own's rudder and revolutions change after the impact, too."""
    folder = tmp_path_factory.mktemp("crossing")
    text = (SCENARIOS / "kvlcc2_crossing.toml").read_text(encoding="utf-8")
    astern = "  { time = 10.0, rev_per_s = -0.8 },\n"
    assert astern in text
    simulate(parse_scenario(text.replace(astern, astern + ORDERS) + ENVIRONMENT, "windy"), in_process=True, out=folder)
    run = read_run_folder(folder)
    fleet = make_fleet(run)
    feed, sent = NmeaFeed(fleet), list[Sent]()
    for sample in list_samples(run):
        sent += [Sent(sample, sentence) for sentence in feed.take(sample)]
    return Log(folder, fleet, sent)


@lru_cache(maxsize=1)
def decode(sentences: bytes) -> tuple[str, ...]:
    return tuple(
        subprocess.run(["gpsdecode", "-j", "-v"], input=sentences, capture_output=True, check=True)
        .stdout.decode().splitlines()
    )  # fmt: skip


def course(v_north: float, v_east: float) -> float:
    return degrees(atan2(v_east, v_north)) % 360.0


def apart(a: float, b: float) -> float:
    """Difference of two angles [deg]."""
    return abs((a - b + 180.0) % 360.0 - 180.0)


def turned(sample: Sample, ship: str) -> float:
    """North of the ship's meridian against that of n [deg]: within 10 km, that of a sphere is right to 0.001 deg."""
    return degrees(sample.ships[ship].state.east / 6.39e6) * 1.3764  # tan 54 deg


def where(sample: Sample, ship: str) -> tuple[float, float]:
    state = sample.ships[ship].state
    return TangentPlane(LATITUDE, LONGITUDE).geographic(state.north, state.east)


@pytest.mark.needs("gpsdecode")
def test_gpsdecode_takes_every_sentence(log: Log) -> None:
    echoed = [line for line in decode(b"".join(one.sentence for one in log.sent)) if line[0] in "$!"]
    assert echoed == [one.sentence.decode().rstrip() for one in log.sent]
    kinds = {line[3:6] for line in echoed}
    assert kinds == {"RMC", "GGA", "VTG", "HDT", "ROT", "RSA", "RPM", "MWV", "VDM", "VDO"}


@pytest.mark.needs("gpsdecode")
def test_gpsdecode_reads_position_course_speed_and_heading(log: Log) -> None:
    lines = decode(b"".join(one.sentence for one in log.sent))
    read = (json.loads(line) for line in lines if line.startswith('{"class":"TPV"'))
    fixes = {fix["time"]: fix for fix in read if "lat" in fix}
    sent = log.of("RMC")
    assert len(fixes) >= len(sent) - 1  # gpsd learns from the first second how a second ends
    for sample, _ in sent[1:]:
        time = f"{log.fleet.time(sample.time):%Y-%m-%dT%H:%M:%S}.000Z"
        fix, state = fixes[time], sample.ships["own"].state
        latitude, longitude = where(sample, "own")
        assert fix["lat"] == pytest.approx(latitude, abs=0.5e-5 / 60.0 + 1e-9)
        assert fix["lon"] == pytest.approx(longitude, abs=0.5e-5 / 60.0 + 1e-9)
        assert fix["speed"] == pytest.approx(hypot(*state.plan_velocity), abs=0.005 * KNOT + 0.0005)
        assert apart(fix["track"], course(*state.plan_velocity) + turned(sample, "own")) <= 0.051
    headings = [float(found[1]) for line in lines if (found := re.search(r'"class":"ATT".*"heading":([\d.]+)', line))]
    assert len(headings) == len(log.of("HDT"))
    for heading, (sample, _) in zip(headings, log.of("HDT"), strict=True):
        assert apart(heading, degrees(sample.ships["own"].state.heading) + turned(sample, "own")) <= 0.051


@pytest.mark.needs("gpsdecode")
def test_gpsdecode_reads_ais(log: Log) -> None:
    lines = decode(b"".join(one.sentence for one in log.sent))
    read = [json.loads(line) for line in lines if line.startswith('{"class":"AIS"')]
    reports = [one for one in read if one["type"] == 1]
    sent = [one for kind in ("VDM", "VDO") for one in log.of(kind) if one.sentence[7:8] == b"1"]
    sent.sort(key=log.sent.index)
    assert len(reports) == len(sent)
    for report, (sample, sentence) in zip(reports, sent, strict=True):
        ship = "own" if b"VDO" in sentence else "target"
        state = sample.ships[ship].state
        latitude, longitude = where(sample, ship)
        assert report["mmsi"] == log.fleet.identities[ship].mmsi
        assert report["lat"] == pytest.approx(latitude, abs=0.5 / 600_000 + 0.5e-6)
        assert report["lon"] == pytest.approx(longitude, abs=0.5 / 600_000 + 0.5e-6)
        assert report["speed"] == pytest.approx(hypot(*state.plan_velocity) / KNOT, abs=0.0501)
        assert apart(report["course"], course(*state.plan_velocity) + turned(sample, ship)) <= 0.0511
        assert apart(report["heading"], degrees(state.heading) + turned(sample, ship)) <= 0.501
        assert float(report["turn"]) == pytest.approx(60.0 * degrees(state.yaw_rate), abs=0.5 + 0.05 * 60.0)
        assert report["second"] == int(sample.time + 0.5) % 60
        assert report["status"] == 0
    static = {one["shipname"]: one for one in read if one["type"] == 5}
    assert set(static) == {"OWN", "TARGET"}
    for one in static.values():
        assert (one["to_bow"] + one["to_stern"], one["to_port"] + one["to_starboard"]) == (320, 58)
        assert (one["shiptype"], one["draught"]) == (80, 20.8)


def test_pynmea2_reads_what_gpsdecode_does_not_show(log: Log) -> None:
    seen = dict.fromkeys(("VTG", "ROT", "RSA", "RPM", "MWV", "RMC", "GGA", "HDT"), 0)
    rudders: list[float] = []
    for sample, sentence in log.sent:
        kind = sentence[3:6].decode()
        if kind not in seen:
            continue
        read: Any = pynmea2.parse(sentence.decode(), check=True)
        ship = sample.ships["own"]
        v = ship.state.plan_velocity
        seen[kind] += 1
        if kind == "VTG":
            assert float(read.spd_over_grnd_kts) == pytest.approx(hypot(*v) / KNOT, abs=0.00501)
            assert float(read.spd_over_grnd_kmph) == pytest.approx(hypot(*v) * 3.6, abs=0.00501)
            assert apart(float(read.true_track), course(*v) + turned(sample, "own")) <= 0.051
        elif kind == "ROT":
            assert float(read.rate_of_turn) == pytest.approx(60.0 * degrees(ship.state.yaw_rate), abs=0.0501)
        elif kind == "RSA":
            assert ship.rudder is not None
            rudders.append(ship.rudder)
            assert float(read.rsa_starboard) == pytest.approx(degrees(ship.rudder), abs=0.0501)
        elif kind == "RPM":
            assert ship.rev_per_s is not None
            assert float(read.speed) == pytest.approx(60.0 * ship.rev_per_s, abs=0.0501)
        elif kind == "MWV":
            check_wind(read, sample)
        elif kind == "HDT":
            assert apart(float(read.heading), degrees(ship.state.heading) + turned(sample, "own")) <= 0.051
        else:
            assert (read.latitude, read.longitude) == pytest.approx(where(sample, "own"), abs=1e-7)
    assert min(rudders) == pytest.approx(radians(-12.3))
    assert max(rudders) == pytest.approx(radians(35.0))
    assert seen["HDT"] == seen["ROT"] >= 10 * seen["RMC"] - 10
    assert seen["RMC"] == seen["GGA"] == seen["VTG"] == seen["RPM"] == seen["MWV"] // 2
    assert seen["RSA"] >= 2 * seen["RMC"] - 1


def check_wind(read: Any, sample: Sample) -> None:
    """Felt wind is the wind over ground less the ship's velocity; angles are where it comes from, against the bow."""
    state = sample.ships["own"].state
    assert sample.wind is not None
    assert sample.wind == ((9.7, radians(250.0)) if sample.time < 70.0 else (14.2, radians(10.0)))
    over_ground = -sample.wind.speed * cos(sample.wind.comes_from), -sample.wind.speed * sin(sample.wind.comes_from)
    v = over_ground
    if read.reference == "R":
        v = over_ground[0] - state.plan_velocity[0], over_ground[1] - state.plan_velocity[1]
    assert float(read.wind_speed) == pytest.approx(hypot(*v), abs=0.0501)
    assert apart(float(read.wind_angle), course(-v[0], -v[1]) - degrees(state.heading)) <= 0.051


def parts(log: Log) -> Iterator[list[Sent]]:
    """AIS sentences, those of one message together."""
    whole: list[Sent] = []
    for one in log.sent:
        if one.sentence[3:6] in (b"VDM", b"VDO"):
            whole.append(one)
            if one.sentence[7:8] == one.sentence[9:10]:
                yield whole
                whole = []


def test_pyais_reads_our_ais(log: Log) -> None:
    kinds = set()
    for whole in parts(log):
        read: Any = pyais.decode(*(one.sentence for one in whole))
        kinds.add(read.msg_type)
        if read.msg_type == 1:
            sample = whole[0].sample
            ship = "own" if read.mmsi == log.fleet.identities["own"].mmsi else "target"
            assert (read.lat, read.lon) == pytest.approx(where(sample, ship), abs=0.5 / 600_000 + 0.5e-6)
    assert kinds == {1, 5}


def test_a_log_with_tags_is_a_track(log: Log, tmp_path: Path) -> None:
    """The target, as own ship receives it, follows its track within the rounding of AIS, until it is struck."""
    from shipcollision_fmu.scenario.tracks.cleaning import Period
    from shipcollision_fmu.scenario.tracks.read_recording import read_recording
    from shipcollision_fmu.scenario.tracks.track import build_track

    text, fleet = write_log(log.folder, tags=True)
    (tmp_path / "run.nmea").write_bytes(text)
    recording = read_recording(tmp_path / "run.nmea")
    mmsi = fleet.identities["target"].mmsi
    end = max(report.time for report in recording.reports[mmsi]) - fleet.start.timestamp()
    begin = fleet.start.timestamp()
    track = build_track(recording, mmsi, TangentPlane(LATITUDE, LONGITUDE), Period(begin, begin + end))
    struck = read_run_folder(log.folder).events.collisions[0].start
    for sample, _ in log.of("RMC"):
        state = sample.ships["target"].state
        if sample.time < struck - 20.0:  # reports come every 10 s: a blow is smoothed over as much
            assert track.state(sample.time)[:2] == pytest.approx(state[:2], abs=0.3)
    assert track.size is not None
    assert track.size[:5] == ("TARGET", 80, 320.0, 58.0, 20.8)
