"""Recorded AIS of the tests: reports of a motion in closed form, around a place, as CSV or as an NMEA log."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from datetime import datetime, timezone
from math import atan2, cos, degrees, hypot, pi, sin
from typing import Any

from shipcollision_fmu.scenario.tracks.tangent_plane import TangentPlane

__all__ = [
    "KNOT",
    "LATITUDE",
    "LONGITUDE",
    "MMSI",
    "PLACE",
    "START",
    "Motion",
    "csv_text",
    "report",
    "straight",
    "turn",
]

KNOT = 1852.0 / 3600.0
LATITUDE, LONGITUDE, START, MMSI = 54.0, 8.0, 1767225600, 211000001
PLACE = f"\n[place]\nlatitude = {LATITUDE}\nlongitude = {LONGITUDE}\nstart = 2026-01-01T00:00:00Z\n"
_PLANE = TangentPlane(LATITUDE, LONGITUDE)

Motion = Callable[[float], tuple[float, float, float, float]]
"""North, east [m] and their rates [m/s] at a time [s]."""


def straight(north: float, east: float, speed: float, course: float) -> Motion:
    """From a position, along a course [rad]."""
    v_n, v_e = speed * cos(course), speed * sin(course)
    return lambda t: (north + v_n * t, east + v_e * t, v_n, v_e)


def turn(radius: float, speed: float) -> Motion:
    """Round the origin, to starboard, from the west of it."""
    rate = speed / radius
    return lambda t: (
        radius * sin(rate * t), -radius * cos(rate * t), speed * cos(rate * t), speed * sin(rate * t)
    )  # fmt: skip


def report(motion: Motion, t: float, mmsi: int = MMSI, **changed: Any) -> dict[str, Any]:
    """A row of a table at a time; values may be `changed`."""
    north, east, v_n, v_e = motion(t)
    latitude, longitude = _PLANE.geographic(north, east)
    course = degrees(_PLANE.true_course(latitude, longitude, atan2(v_e, v_n)) % (2.0 * pi))
    time = datetime.fromtimestamp(START + t, timezone.utc).isoformat()
    return {
        "time": time, "mmsi": mmsi, "lat": f"{latitude:.9f}", "lon": f"{longitude:.9f}",
        "sog": f"{hypot(v_n, v_e) / KNOT:.6f}", "cog": f"{course:.6f}", "heading": f"{course:.6f}", **changed,
    }  # fmt: skip


def csv_text(rows: Iterable[Mapping[str, Any]]) -> str:
    """A table of rows."""
    listed = list(rows)
    return "\n".join([",".join(listed[0]), *(",".join(map(str, row.values())) for row in listed)]) + "\n"
