r"""A recording of NMEA 0183 sentences VDM (or VDO) with time stamps, decoded by pyais.

The time of a sentence stands in front of it or behind it, or in its TAG block:

    \s:station,c:1767225600*4E\!AIVDM,1,1,,A,...      TAG block of NMEA 4.10, seconds or milliseconds since 1970
    2026-01-01T00:00:00Z !AIVDM,1,1,,A,...            any form of time_stamps.py, followed by a space, comma or tab
    !AIVDM,1,1,,A,...*5C,1767225600                   as some receivers append it

Other sentences are passed over. Read are the position reports (types 1 to 3, 18, 19) and static data (types 5, 19, 24).
"""

from __future__ import annotations

import re
from math import radians
from typing import Any, NamedTuple

from ...errors import HostError, ScenarioError
from ...ship.ship_type import KNOT
from .ais_codes import COG, HEADING, LATITUDE, LONGITUDE, SOG
from .recording import Antenna, Recording, Report
from .ship_size import ShipSize
from .time_stamps import parse_time

__all__ = ["read_nmea"]

_SENTENCE = re.compile(r"!\w{2}VD[MO],(\d),(\d),(\d?),([AB12]?),[^*,]*,\d\*[0-9A-Fa-f]{2}")
_TAG_TIME = re.compile(r"\bc:(\d+)")
POSITIONS, STATIC = (1, 2, 3, 18, 19), (5, 19, 24)
MOST_PARTS_OPEN = 64
"""Messages of several sentences of which some are still missing; older ones are forgotten."""


class _Line(NamedTuple):
    row: int
    time: float | None
    sentence: str


class _Reader:
    """What was read so far."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.reports: dict[int, list[Report]] = {}
        self.sizes: dict[int, ShipSize] = {}
        self.antennas: dict[int, Antenna] = {}
        self.unread, self.nowhere, self.untimed = 0, 0, 0
        self._parts: dict[tuple[str, ...], list[_Line]] = {}

    def take(self, line: _Line, found: re.Match[str]) -> None:
        """Take a sentence; of a message of several sentences the time is that of the first."""
        count, number = int(found[1]), int(found[2])
        if count <= 1:
            self._decode([line])
            return
        key = (found[1], found[3], found[4])
        if number == 1:
            self._parts[key] = []
            if len(self._parts) > MOST_PARTS_OPEN:
                del self._parts[next(iter(self._parts))]
        parts = self._parts.get(key)
        if parts is None or len(parts) != number - 1:
            self.unread += 1
            return
        parts.append(line)
        if number == count:
            self._decode(self._parts.pop(key))

    def _decode(self, lines: list[_Line]) -> None:
        message = _decode([line.sentence for line in lines])
        if message is None:
            self.unread += 1
            return
        kind, mmsi = int(message.get("msg_type", 0)), int(message.get("mmsi", 0))
        if kind in POSITIONS:
            self._take_position(lines[0], mmsi, message)
        if kind in STATIC:
            self._take_static(mmsi, message)

    def _take_position(self, line: _Line, mmsi: int, message: dict[str, Any]) -> None:
        latitude, longitude = float(message["lat"]), float(message["lon"])
        if abs(latitude - LATITUDE) < 1e-6 or abs(longitude - LONGITUDE) < 1e-6:
            self.nowhere += 1
            return
        if line.time is None:
            self.untimed = self.untimed or line.row
            return
        if abs(latitude) > 90.0 or abs(longitude) > 180.0:
            raise ScenarioError(
                f"{self.file} row {line.row}: position {latitude:g}, {longitude:g} is not on earth: remove the row"
            )
        sog, cog, heading = (
            None if abs(value - gone) < 1e-6 else value
            for value, gone in ((float(message["speed"]), SOG), (float(message["course"]), COG),
                                (float(message["heading"]), HEADING))
        )  # fmt: skip
        report = Report(
            line.row, line.time, latitude, longitude, None if sog is None else sog * KNOT,
            None if cog is None else radians(cog), None if heading is None else radians(heading),
        )  # fmt: skip
        self.reports.setdefault(mmsi, []).append(report)

    def _take_static(self, mmsi: int, message: dict[str, Any]) -> None:
        a, b, c, d = (float(message.get(f"to_{side}") or 0) for side in ("bow", "stern", "port", "starboard"))
        if a + b <= 0.0 or c + d <= 0.0:
            return
        name, draught = str(message.get("shipname") or "").strip() or None, float(message.get("draught") or 0.0)
        self.sizes[mmsi] = ShipSize(name, int(message.get("ship_type") or 0) or None, a + b, c + d, draught or None)
        if a > 0.0 and c > 0.0:  # else the file gives dimensions without a reference point
            self.antennas[mmsi] = Antenna(0.5 * (b - a), 0.5 * (c - d))


def read_nmea(text: str, file: str) -> Recording:
    """The recording in a log of sentences.

    Raises ScenarioError for a log without times, and for a position that is not on earth; HostError without pyais.
    """
    reader = _Reader(file)
    for row, line in enumerate(text.splitlines(), 1):
        found = _SENTENCE.search(line)
        if found is not None:
            reader.take(_Line(row, _find_time(line, found), found[0]), found)
        elif "VDM," in line or "VDO," in line:
            reader.unread += 1
    if reader.untimed and not reader.reports:
        raise ScenarioError(
            f"{file} row {reader.untimed}: no time beside the sentence: log it with TAG blocks, \\c:1767225600*5E\\ in "
            "front of !AIVDM, or with the time in front, 2026-01-01T00:00:00Z !AIVDM"
        )
    counts = {
        f"sentences that cannot be decoded: {reader.unread}": reader.unread,
        f'reports whose position is "not available": {reader.nowhere}': reader.nowhere,
        f"reports without a time, from row {reader.untimed} on": reader.untimed,
    }
    notes = tuple(f"{file}: left out are {said}." for said, count in counts.items() if count)
    return Recording(file, reader.reports, reader.sizes, reader.antennas, notes)


def _find_time(line: str, found: re.Match[str]) -> float | None:
    """The time beside a sentence; None where there is none."""
    before, after = line[: found.start()].strip(), line[found.end() :].strip(" ,\t\r\n")
    if "\\" in before:
        tag = _TAG_TIME.search(before)
        if tag is not None:
            return parse_time(tag[1])
        before = before.partition("\\")[0].strip()
    for text in (before.rstrip(" ,;\t"), after):
        time = parse_time(text) if text else None
        if time is not None:
            return time
    return None


def _decode(sentences: list[str]) -> dict[str, Any] | None:
    """The message in sentences; None for one that cannot be decoded, or whose checksum is wrong."""
    try:
        from pyais.exceptions import AISBaseException
        from pyais.messages import AISSentence
    except ModuleNotFoundError as error:
        raise HostError(
            "a log of NMEA sentences needs pyais, which is not installed: pip install 'shipcollision-fmu[live]', "
            "or give a CSV file"
        ) from error
    try:
        parts = [AISSentence.from_string(sentence) for sentence in sentences]
        if not all(part.is_valid for part in parts):
            return None
        whole = parts[0] if len(parts) == 1 else AISSentence.assemble_from_iterable(parts)
        return dict(whole.decode().asdict())
    except (AISBaseException, ValueError, IndexError, KeyError, TypeError):
        return None
