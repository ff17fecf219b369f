"""The reports of one ship in order of time, without repetitions; and what is refused.

several ships, none chosen      refused, with their MMSI
out of order                    sorted
the same time                   the first is taken, if the positions agree within SAME_PLACE; else refused
a jump                          refused, if it takes more than FASTEST
a gap                           noted above NOTED_GAP, refused above LONGEST_GAP
beginning or end                refused, if the scenario begins earlier or ends later
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import hypot
from typing import NamedTuple

from ...errors import ScenarioError
from .recording import Recording, Report
from .tangent_plane import TangentPlane
from .time_stamps import format_time

__all__ = ["LONGEST_GAP", "Fix", "Period", "choose_ship", "clean_reports"]

SAME_PLACE = 30.0
"""[m] Difference between positions that receivers give one time: noise, and time stamps rounded to seconds."""
FASTEST = 50.0
"""[m/s] Limit of speed over ground, as for ships of a scenario. A faster one is a jump of the positions."""
NOTED_GAP, LONGEST_GAP = 60.0, 900.0
"""[s] A ship under way reports every 2 to 10 s, one at anchor every 180 s. In a longer gap it may be anywhere."""
MARGIN = 600.0
"""[s] Reports this long before and after the scenario still count; what is beyond is not looked at."""
FARTHEST = 100e3
"""[m] Limit of the distance from [place]; farther away the tangent plane is 4 m short."""
MOST_LISTED = 8


class Period(NamedTuple):
    """Beginning and end of a scenario, in seconds since 1970 UTC."""

    begin: float
    end: float


class Fix(NamedTuple):
    """A report in n: time from the scenario's start [s], north, east [m], the report."""

    time: float
    north: float
    east: float
    report: Report


def choose_ship(recording: Recording, mmsi: int | None) -> int:
    """The MMSI of the ship, which may be left out where the file has one. Raises ScenarioError for one not there."""
    there = sorted(recording.reports)
    listed = ", ".join(map(str, there[:MOST_LISTED])) + (f" and {len(there) - MOST_LISTED} more"
                                                         if len(there) > MOST_LISTED else "")  # fmt: skip
    if mmsi is None:
        if len(there) > 1:
            raise ScenarioError(f"{recording.file} has {len(there)} ships: choose one by mmsi = ..., it has {listed}")
        return there[0]
    if mmsi not in recording.reports:
        raise ScenarioError(f"{recording.file} has no position of mmsi = {mmsi}: it has {listed}")
    return mmsi


def clean_reports(
    recording: Recording, mmsi: int, plane: TangentPlane, period: Period
) -> tuple[list[Fix], list[str]]:  # fmt: skip
    """The fixes around a period, in order of time, and notes. Raises ScenarioError, with the row of the report."""
    file, notes = recording.file, list[str]()
    reports = recording.reports[mmsi]
    in_order = sorted(reports, key=lambda report: report.time)  # stable: of one time the first stays first
    moved = [b for a, b in pairwise(reports) if a.time > b.time]
    if moved:
        notes.append(
            f"{file}: row {moved[0].row} and {len(moved) - 1} more of MMSI {mmsi} are earlier than the row before; "
            "they are sorted by time."
        )
    _check_cover(file, mmsi, in_order, period)
    near = [r for r in in_order if period.begin - MARGIN <= r.time <= period.end + MARGIN]
    fixes = [Fix(r.time - period.begin, *plane.position(r.latitude, r.longitude), r) for r in near]
    kept, repeated = _drop_repeated(file, fixes)
    if repeated:
        notes.append(
            f"{file}: row {repeated[0].report.row} and {len(repeated) - 1} more of MMSI {mmsi} repeat a time; the "
            "first of each is taken."
        )
    _check_steps(file, kept, period, notes)
    for fix in kept:
        if hypot(fix.north, fix.east) > FARTHEST:
            raise ScenarioError(
                f"{file} row {fix.report.row}: {hypot(fix.north, fix.east) / 1e3:.0f} km from [place], the limit is "
                f"{FARTHEST / 1e3:.0f} km: set latitude and longitude of [place] near the track, which is at "
                f"{fix.report.latitude:.4f}, {fix.report.longitude:.4f}"
            )
    return kept, notes


def _check_cover(file: str, mmsi: int, reports: Sequence[Report], period: Period) -> None:
    first, last = reports[0], reports[-1]
    if first.time <= period.begin and last.time >= period.end and last.time > first.time:
        return
    raise ScenarioError(
        f"{file}: MMSI {mmsi} has reports from {format_time(first.time)} (row {first.row}) to {format_time(last.time)} "
        f"(row {last.row}), but the scenario runs from {format_time(period.begin)} to {format_time(period.end)}: move "
        "start of [place] or shorten duration, so that it lies within them"
    )


def _drop_repeated(file: str, fixes: Sequence[Fix]) -> tuple[list[Fix], list[Fix]]:
    """The fixes of different times, and those that repeat one."""
    kept, repeated = list(fixes[:1]), list[Fix]()
    for fix in fixes[1:]:
        last = kept[-1]
        if fix.time > last.time:
            kept.append(fix)
            continue
        apart = hypot(fix.north - last.north, fix.east - last.east)
        if apart > SAME_PLACE:
            raise ScenarioError(
                f"{file} row {fix.report.row}: {format_time(fix.report.time)} is also the time of row "
                f"{last.report.row}, {apart:.0f} m away, the limit is {SAME_PLACE:g} m: remove one of the rows"
            )
        repeated.append(fix)
    return kept, repeated


def _check_steps(file: str, fixes: Sequence[Fix], period: Period, notes: list[str]) -> None:
    """Refuse jumps and long gaps, and note gaps, within the period."""
    longest = 0.0
    for a, b in pairwise(fixes):
        if b.time < 0.0 or a.time > period.end - period.begin:
            continue
        took, way = b.time - a.time, hypot(b.north - a.north, b.east - a.east)
        if took > LONGEST_GAP:
            raise ScenarioError(
                f"{file} row {b.report.row}: {took:.0f} s after row {a.report.row}, the limit is {LONGEST_GAP:g} s: "
                "move start of [place] or shorten duration, so that the gap lies outside"
            )
        if max(0.0, way - SAME_PLACE) > FASTEST * took:
            raise ScenarioError(
                f"{file} row {b.report.row}: {way:.0f} m from row {a.report.row} in {took:g} s, which takes "
                f"{way / took:.0f} m/s, the limit is {FASTEST:g} m/s: remove the row that is misplaced"
            )
        longest = max(longest, took)
    for fix in fixes:
        sog = fix.report.sog
        if sog is not None and sog > FASTEST:
            raise ScenarioError(
                f"{file} row {fix.report.row}: sog = {sog / (1852 / 3600):.1f} kn, the limit is "
                f'{FASTEST / (1852 / 3600):.0f} kn: write 102.3 for "not available"'
            )
    if longest > NOTED_GAP:
        notes.append(f"{file}: the longest gap between reports is {longest:.0f} s; in it the ship's motion is a guess.")
