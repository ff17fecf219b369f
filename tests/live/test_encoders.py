"""Sentences and messages at their limits, and when they are due."""

from __future__ import annotations

from datetime import datetime, timedelta, timezone
from functools import reduce
from itertools import pairwise
from math import pi, radians
from operator import xor
from typing import Any

import pyais
import pytest

from shipcollision_fmu.live.protocols import ais, nmea
from shipcollision_fmu.live.protocols.fix import Fix, find_fix
from shipcollision_fmu.live.protocols.identity import FIRST_MMSI, Hull, make_identity
from shipcollision_fmu.live.protocols.sample import ShipSample, Wind
from shipcollision_fmu.live.protocols.schedule import AisSchedule, Every
from shipcollision_fmu.scenario.tracks.tangent_plane import TangentPlane
from shipcollision_fmu.ship.ship_state import ShipState

KNOT = 1852.0 / 3600.0
NOON = datetime(2026, 1, 1, 12, tzinfo=timezone.utc)
FERRY = Hull("ferry", 161.3, 25.0, 6.25, 1.2e7)
OWN = make_identity(0, "own", FERRY, {}, None)
LYING = Fix(-54.5, -179.99999999, 0.0, None, 359.96, 0.0)


def line(body: str) -> bytes:
    """The sentence with its checksum."""
    return f"${body}*{reduce(xor, body.encode()):02X}\r\n".encode()


def test_a_ship_that_lies_still_has_no_course() -> None:
    assert nmea.rmc(LYING, NOON) == line("GPRMC,120000.00,A,5430.00000,S,18000.00000,W,0.00,,010126,,,A,V")
    assert nmea.vtg(LYING) == line("GPVTG,,T,,M,0.00,N,0.00,K,A")
    message: Any = pyais.decode(*ais.position_report(OWN, LYING, NOON, own=True))
    assert (message.course, message.speed) == (360.0, 0.0)


def test_angles_are_rounded_within_a_turn() -> None:
    """359.96 deg is 0.0 in tenths, and 0 in whole degrees: neither 360."""
    assert nmea.hdt(LYING) == line("IIHDT,000.0,T")
    going = LYING._replace(cog=359.96, sog=5.0)
    message: Any = pyais.decode(*ais.position_report(OWN, going, NOON, own=False))
    assert (message.course, message.heading) == (0.0, 0)


@pytest.mark.parametrize(
    ("rate", "turn"),
    [(0.0, 0.0), (10.0, 10.0), (-10.0, -10.0), (500.0, 500.0), (1000.0, 708.0), (-1000.0, -708.0)],
)
def test_rates_of_turn_are_those_of_an_indicator(rate: float, turn: float) -> None:
    """[deg/min], in steps of its root: within 6 of 500; 708 and more are one value."""
    fix = LYING._replace(rate_of_turn=rate / 60.0)
    message: Any = pyais.decode(*ais.position_report(OWN, fix, NOON, own=True))
    assert float(message.turn) == pytest.approx(turn, abs=6.0)


def test_a_time_is_rounded_before_it_is_cut() -> None:
    """0.9999 s is the next second, also of the next minute, day and year."""
    late = datetime(2026, 12, 31, 23, 59, 59, 999_900, tzinfo=timezone.utc)
    sentence = nmea.rmc(LYING, late)
    assert sentence.startswith(b"$GPRMC,000000.00,A,")
    assert b",010127," in sentence
    message: Any = pyais.decode(*ais.position_report(OWN, LYING, late, own=True))
    assert message.second == 0


def test_a_disabled_ship_is_not_under_command() -> None:
    message: Any = pyais.decode(*ais.position_report(OWN, LYING, NOON, own=True, disabled=True))
    assert message.status == 2


def test_wind_is_felt_against_the_bow() -> None:
    """Steering east at 5 m/s in a northerly of 5 m/s: true wind on the port beam, felt on the port bow."""
    ship = ShipSample(ShipState.upright(0.0, 0.0, 0.5 * pi, surge=5.0))
    felt, true = nmea.mwv(ship, Wind(5.0, 0.0))
    assert felt == line("WIMWV,315.0,R,7.1,M,A")
    assert true == line("WIMWV,270.0,T,5.0,M,A")


def test_identities_follow_from_the_ship_unless_given() -> None:
    assert OWN[:5] == (FIRST_MMSI, "OWN", "", 60, "")
    assert (OWN.to_bow, OWN.to_stern, OWN.to_port, OWN.to_starboard, OWN.draught) == (81, 80, 13, 12, 6.25)
    assert make_identity(2, "ship_3", Hull("thing", 20.0, 5.0, 1.0, 1e5), {}, 211000001)[:4] == (
        211000001, "SHIP 3", "", 90,
    )  # fmt: skip
    given = {"mmsi": 211234560, "name": "NORDSTERN", "call_sign": "DABC", "ship_type": 37, "destination": "DEHAM"}
    assert make_identity(0, "own", FERRY, given, 5)[:5] == (211234560, "NORDSTERN", "DABC", 37, "DEHAM")
    message: Any = pyais.decode(*ais.static_report(make_identity(0, "own", FERRY, given, 5), own=False))
    assert (message.callsign, message.shipname, message.destination) == ("DABC", "NORDSTERN", "DEHAM")
    assert (message.draught, message.to_bow, message.ship_type) == (6.3, 81, 37)


def test_headings_refer_to_north_where_the_ship_is() -> None:
    """50 km east of 54 N, meridians have converged by 50/6390 tan 54 rad = 0.617 deg."""
    fix = find_fix(ShipState.upright(0.0, 50_000.0, 0.0, surge=5.0), TangentPlane(54.0, 8.0))
    assert fix.heading == pytest.approx(0.617, abs=0.003)
    assert fix.cog == pytest.approx(fix.heading)


def count_reports(sog: float, rate: float, seconds: float = 120.0) -> int:
    schedule, fix = AisSchedule(), Fix(0.0, 0.0, sog * KNOT, 0.0, 0.0, rate)
    return sum(
        schedule.is_due(0.05 * k, fix._replace(heading=rate * 0.05 * k % 360.0)) for k in range(int(seconds / 0.05))
    )


@pytest.mark.parametrize(("sog", "interval"), [(0.0, 10.0), (13.9, 10.0), (14.1, 6.0), (22.9, 6.0), (23.1, 2.0)])
def test_position_reports_come_by_speed(sog: float, interval: float) -> None:
    assert count_reports(sog, 0.0) == 120.0 / interval


@pytest.mark.parametrize(("sog", "interval"), [(10.0, 10.0 / 3.0), (20.0, 2.0), (25.0, 2.0)])
def test_a_ship_that_changes_course_reports_more_often(sog: float, interval: float) -> None:
    """1 deg/s is 5 deg off the mean after 10 s at the latest."""
    assert abs(count_reports(sog, 1.0) - 120.0 / interval) <= 4


def test_changes_of_course_end() -> None:
    """20 s after the last of them the interval is 10 s again."""
    schedule, fix = AisSchedule(), Fix(0.0, 0.0, 5.0, 0.0, 0.0, 0.0)
    sent = [
        t for t in (0.05 * k for k in range(4000)) if schedule.is_due(t, fix._replace(heading=20.0 if t > 50 else 0.0))
    ]
    assert min(b - a for a, b in pairwise(sent)) == pytest.approx(10.0 / 3.0, abs=0.06)
    assert all(b - a == pytest.approx(10.0, abs=0.06) for a, b in pairwise(sent) if a > 105.0)


def test_a_time_that_goes_back_begins_anew() -> None:
    every, schedule, fix = Every(1.0), AisSchedule(), LYING
    assert [every.is_due(t) for t in (0.0, 0.5, 1.0, 1.95, 3.2, 0.4)] == [True, False, True, False, True, True]
    assert [schedule.is_due(t, fix) for t in (50.0, 55.0, 60.0, 10.0)] == [True, False, True, True]


def test_sentences_have_at_most_82_characters() -> None:
    """IEC 61162-1, with $ and the end of line."""
    fix = Fix(-89.999999, -179.999999, 50.0, 359.9, 359.9, -12.0)
    ship = ShipSample(ShipState.upright(0.0, 0.0, 3.0, surge=50.0), radians(-35.0), -20.0)
    sentences = [
        nmea.rmc(fix, NOON + timedelta(seconds=1.23)), nmea.gga(fix, NOON), nmea.vtg(fix), nmea.hdt(fix), nmea.rot(fix),
        nmea.rsa(-0.6), nmea.rpm(-20.0), *nmea.mwv(ship, Wind(60.0, 3.0)),
        *ais.position_report(OWN, fix, NOON, own=True), *ais.static_report(OWN, own=True),
    ]  # fmt: skip
    assert max(map(len, sentences)) <= 82
