"""Sentences of NMEA 0183 of own ship, written by pynmeagps.

    RMC, GGA, VTG    GP   position, SOG, COG; the quality 8 of GGA says "simulator"
    HDT              II   true heading. The gyro's own talker would be HE, which gpsd 3.22 drops
    ROT              TI   rate of turn [deg/min], to starboard positive
    RSA, RPM         II   rudder [deg], to starboard positive, and revolutions [1/min]
    MWV              WI   wind against the bow: R as felt on board, T as over ground

An unknown value is an empty field or, where it is the only one, no sentence. pynmeagps (BSD, kept) was preferred to
pynmea2 (MIT), whose last release is of 2023 and which has no fields by name for RSA and MWV of a writer.
"""

from __future__ import annotations

from datetime import datetime, timedelta
from math import atan2, cos, degrees, hypot, sin
from typing import Any

from ...ship.ship_type import KNOT
from .fix import Fix
from .sample import ShipSample, Wind

__all__ = ["gga", "hdt", "mwv", "rmc", "rot", "rpm", "rsa", "vtg"]

MODE, SIMULATOR_QUALITY = "A", 8
"""Mode S would mean "simulator", but OpenCPN drops a position with it; the quality of GGA says so."""
SATELLITES = 12
"""Zero would mean "no fix" to gpsd and charting programs."""
KMH = 1.0 / 3.6
POSITION = 6_000_000
"""Steps to a degree."""


def rmc(fix: Fix, time: datetime) -> bytes:
    """Recommended minimum: time, position, SOG, COG, date."""
    return _write(
        "GP", "RMC", time=_time(time), lat=_position(fix.latitude), lon=_position(fix.longitude), status="A",
        spd=f"{fix.sog / KNOT:.2f}",
        cog=_course(fix.cog), date=_round(time).date(), mv="", mvEW="", posMode=MODE, navStatus="V",
    )  # fmt: skip


def gga(fix: Fix, time: datetime) -> bytes:
    """Fix: time, position, quality; height above the ellipsoid is that of the sea, zero."""
    return _write(
        "GP", "GGA", time=_time(time), lat=_position(fix.latitude), lon=_position(fix.longitude),
        quality=SIMULATOR_QUALITY, numSV=SATELLITES, HDOP="", alt=0.0, altUnit="M", sep=0.0, sepUnit="M",
        diffAge="", diffStation="",
    )  # fmt: skip


def vtg(fix: Fix) -> bytes:
    """Course and speed over ground [kn, km/h]."""
    return _write(
        "GP", "VTG", cogt=_course(fix.cog), cogtUnit="T", cogm="", cogmUnit="M", sogn=f"{fix.sog / KNOT:.2f}",
        sognUnit="N", sogk=f"{fix.sog / KMH:.2f}", sogkUnit="K", posMode=MODE,
    )  # fmt: skip


def hdt(fix: Fix) -> bytes:
    """True heading."""
    return _write("II", "HDT", headingT=_course(fix.heading), headingTu="T")


def rot(fix: Fix) -> bytes:
    """Rate of turn [deg/min], positive to starboard."""
    return _write("TI", "ROT", rot=f"{60.0 * fix.rate_of_turn + 0.0:.1f}", valid="A")


def rsa(rudder: float) -> bytes:
    """Angle of the only rudder [rad], in the field of the starboard one; positive to starboard."""
    return _write(
        "II", "RSA", stbdangle=f"{degrees(rudder) + 0.0:.1f}", stbdstatus="A", portangle="", portstatus="V"
    )  # fmt: skip


def rpm(rev_per_s: float) -> bytes:
    """Revolutions of the only shaft [1/s], positive ahead; the pitch is not stated."""
    return _write("II", "RPM", source="S", engineshaftnum=0, rpm=f"{60.0 * rev_per_s + 0.0:.1f}", pitch="", status="A")


def mwv(ship: ShipSample, wind: Wind) -> list[bytes]:
    """Wind against the bow, apparent (R) and true (T): angle from which it comes, and speed [m/s]."""
    over_ground = -wind.speed * cos(wind.comes_from), -wind.speed * sin(wind.comes_from)
    own = ship.state.plan_velocity
    felt = over_ground[0] - own[0], over_ground[1] - own[1]
    return [
        _write(
            "WI", "MWV", angle=_course(degrees(atan2(-v[1], -v[0]) - ship.state.heading)), reference=reference,
            speed=f"{hypot(*v):.1f}", speedu="M", status="A",
        )
        for reference, v in (("R", felt), ("T", over_ground))
    ]  # fmt: skip


def _write(talker: str, sentence: str, **fields: Any) -> bytes:
    from pynmeagps import GET, NMEAMessage

    return bytes(NMEAMessage(talker, sentence, GET, **fields).serialize())


def _course(angle: float | None) -> str:
    """An angle [deg] in tenths, 000.0 to 359.9; empty where it is unknown."""
    return "" if angle is None else f"{round(10.0 * angle) % 3600 / 10.0:05.1f}"


def _position(angle: float) -> float:
    """A latitude or longitude [deg] in 1/100 000 of a minute. pynmeagps would write 7 deg 59.999999' as 7 deg 60'."""
    return round(angle * POSITION) / POSITION


def _round(time: datetime) -> datetime:
    """The time in hundredths of a second, as sentences have it."""
    return time + timedelta(microseconds=round(time.microsecond, -4) - time.microsecond)


def _time(time: datetime) -> Any:
    return _round(time).time()
