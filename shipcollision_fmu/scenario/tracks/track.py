"""Track: a recorded ship as prescribed motion, by the smoothing spline of its reports.

    position     of the antenna: reported positions, and SOG along COG as their rate; moved to midship by a, b, c, d
    heading      true heading where it is reported, else COG of a ship that makes way; unwrapped
    down, roll, pitch    zero

Position and heading are continuous with their rates, so that speed never jumps. The constants are standard deviations:
they say what of a report is noise, and q how fast a ship can change its motion.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, cos, pi, remainder, sin
from typing import NamedTuple

from ...errors import ScenarioError
from ...ship.ship_state import ShipState
from .cleaning import Fix, Period, choose_ship, clean_reports
from .recording import NO_REFERENCE_POINT, Antenna, Recording
from .ship_size import ShipSize
from .smoothing import Spline, smooth
from .tangent_plane import TangentPlane

__all__ = ["Track", "build_track"]

POSITION_ERROR = 5.0
"""[m] Of GNSS without differential correction; reports are in steps of 0.2 m."""
VELOCITY_ERROR = 0.2
"""[m/s] Of SOG and COG; reports are in steps of 0.05 m/s and 0.1 deg. With much more, noise of positions becomes speed;
with much less, a late COG bends the track in turns."""
ACCELERATION = 0.1
"""[m^2/s^3] q of positions: a change of 1 m/s in 10 s, as in a hard turn. With much less, turns are cut short."""
HEADING_ERROR, COURSE_ERROR = 1.0 * pi / 180.0, 3.0 * pi / 180.0
"""[rad] Of the gyro's heading, in steps of 1 deg; and of COG taken for it, which leeway turns off."""
ANGULAR_ACCELERATION = 0.01 * (pi / 180.0) ** 2
"""[rad^2/s^3] q of headings: a change of 0.5 deg/s in 25 s. With much more, steps of 1 deg swing the bow."""
STEERAGE = 0.5
"""[m/s] Slower, the course says nothing about the heading."""


class Track(NamedTuple):
    """The motion of a recorded ship.

    mmsi: of the ship; size: from static data, or None; notes: sentences on what was done to the reports.
    """

    mmsi: int
    north: Spline
    east: Spline
    heading: Spline
    antenna: Antenna
    size: ShipSize | None
    notes: tuple[str, ...]

    def state(self, t: float) -> ShipState:
        """The state of CO at t [s] from the scenario's start."""
        (north, v_north), (east, v_east), (psi, r) = (s.evaluate(t) for s in (self.north, self.east, self.heading))
        c, s = cos(psi), sin(psi)
        ahead, starboard = self.antenna
        u, v = c * v_north + s * v_east + r * starboard, c * v_east - s * v_north - r * ahead
        return ShipState(
            north - c * ahead + s * starboard, east - s * ahead - c * starboard, 0.0, 0.0, 0.0, psi,
            u, v, 0.0, 0.0, 0.0, r,
        )  # fmt: skip


def build_track(recording: Recording, mmsi: int | None, plane: TangentPlane, period: Period) -> Track:
    """The track of a ship through a period. Raises ScenarioError, in one line, for what cleaning.py refuses, and for a
    ship without heading and course."""
    chosen = choose_ship(recording, mmsi)
    fixes, notes = clean_reports(recording, chosen, plane, period)
    times = [fix.time for fix in fixes]
    velocities = [_find_velocity(fix, plane) for fix in fixes]
    errors = [POSITION_ERROR] * len(fixes)
    north, east = (
        smooth(times, values, errors, rates, VELOCITY_ERROR, ACCELERATION)
        for values, rates in (
            ([fix.north for fix in fixes], [None if v is None else v[0] for v in velocities]),
            ([fix.east for fix in fixes], [None if v is None else v[1] for v in velocities]),
        )
    )
    heading = _smooth_heading(recording, chosen, fixes, velocities, plane, notes)
    return Track(
        chosen, north, east, heading, recording.antennas.get(chosen, NO_REFERENCE_POINT), recording.sizes.get(chosen),
        (*recording.notes, *notes),
    )  # fmt: skip


def _find_velocity(fix: Fix, plane: TangentPlane) -> tuple[float, float] | None:
    """Velocity over ground, north and east in n [m/s]; None where SOG or COG is not available."""
    report = fix.report
    if report.sog == 0.0:
        return 0.0, 0.0
    if report.sog is None or report.cog is None:
        return None
    course = plane.direction(report.latitude, report.longitude, report.cog)
    return report.sog * cos(course), report.sog * sin(course)


def _smooth_heading(
    recording: Recording, mmsi: int, fixes: Sequence[Fix], velocities: Sequence[tuple[float, float] | None],
    plane: TangentPlane, notes: list[str],
) -> Spline:  # fmt: skip
    times, values, errors, by_course = list[float](), list[float](), list[float](), 0
    for fix, velocity in zip(fixes, velocities, strict=True):
        report, error = fix.report, HEADING_ERROR
        if report.heading is not None:
            angle = plane.direction(report.latitude, report.longitude, report.heading)
        elif velocity is not None and report.sog is not None and report.sog >= STEERAGE:
            angle, error, by_course = atan2(velocity[1], velocity[0]), COURSE_ERROR, by_course + 1
        else:
            continue
        times.append(fix.time)
        values.append(values[-1] + remainder(angle - values[-1], 2.0 * pi) if values else angle)
        errors.append(error)
    if not values:
        first = fixes[0].report
        raise ScenarioError(
            f"{recording.file} row {first.row}: MMSI {mmsi} has neither heading nor, at {STEERAGE:g} m/s or more, a "
            "course: give a column heading"
        )
    if by_course:
        notes.append(
            f"{recording.file}: {by_course} of {len(fixes)} reports of MMSI {mmsi} have no heading; the course is "
            "taken."
        )
    if len(values) == 1:
        times, values, errors = [times[0], times[0] + 1.0], values * 2, errors * 2
    return smooth(times, values, errors, [None] * len(times), 1.0, ANGULAR_ACCELERATION)
