"""A recording in CSV: the columns of MarineCadastre, of the Danish archive, and others of the same meaning.

    time        time, timestamp, basedatetime, base_date_time, datetime, utc
    mmsi        MMSI of the ship
    latitude    lat, latitude [deg], 91 is "not available"
    longitude   lon, longitude [deg], 181 is "not available"
    sog         speed over ground [kn], 102.3 is "not available"
    cog         course over ground [deg], 360 is "not available"
    heading     true_heading, trueheading [deg], 511 is "not available"
    length, width, draught, name, type      of the ship, once or in each row; also draft, vesselname, vesseltype
    a, b, c, d  (size a, ...)      distances of the antenna from bow, stern, port and starboard [m]

Only time, mmsi, latitude and longitude must be there. Letters may be of either case.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping
from math import isfinite, radians

from ...errors import ScenarioError
from ...ship.ship_type import KNOT
from .ais_codes import COG, HEADING, LATITUDE, LONGITUDE, SOG
from .recording import Antenna, Recording, Report
from .ship_size import ShipSize
from .time_stamps import parse_time

__all__ = ["read_csv"]

_NAMES = {
    "time": ("time", "timestamp", "# timestamp", "basedatetime", "base_date_time", "datetime", "date_time", "utc"),
    "mmsi": ("mmsi",),
    "latitude": ("latitude", "lat"),
    "longitude": ("longitude", "lon", "long"),
    "sog": ("sog",),
    "cog": ("cog",),
    "heading": ("heading", "true_heading", "trueheading", "hdg"),
    "length": ("length",),
    "width": ("width", "beam"),
    "draught": ("draught", "draft"),
    "name": ("name", "vesselname", "vessel_name", "shipname"),
    "type": ("type", "vesseltype", "vessel_type", "shiptype", "ship type", "ship_type"),
    **{key: (key, f"size {key}", f"to_{side}") for key, side in zip(
        "abcd", ("bow", "stern", "port", "starboard"), strict=True)},
}  # fmt: skip
REQUIRED = ("time", "mmsi", "latitude", "longitude")
LARGEST = {"latitude": 90.0, "longitude": 180.0, "sog": SOG, "cog": 360.0, "heading": 360.0}
"""Largest values; the least is minus the same for a position, else zero."""
NOT_AVAILABLE = {"latitude": LATITUDE, "longitude": LONGITUDE, "sog": SOG, "cog": COG, "heading": HEADING}
_UNITS = {"latitude": "deg", "longitude": "deg", "sog": "kn", "cog": "deg", "heading": "deg"}


def read_csv(text: str, file: str) -> Recording:
    """The recording in CSV text. Raises ScenarioError, with the row, for a value that is none, or is out of range."""
    rows = csv.reader(text.splitlines())
    columns = _find_columns(next(rows, []), file)
    reports: dict[int, list[Report]] = {}
    sizes: dict[int, ShipSize] = {}
    antennas: dict[int, Antenna] = {}
    nowhere: list[int] = []
    for number, cells in enumerate(rows, 2):
        if not any(cell.strip() for cell in cells):
            continue
        values = {key: cells[i].strip() if i < len(cells) else "" for key, i in columns.items()}
        mmsi = _read_mmsi(values["mmsi"], file, number)
        report = _read_report(values, file, number)
        if report is None:
            nowhere.append(number)
        else:
            reports.setdefault(mmsi, []).append(report)
        _read_ship(values, mmsi, sizes, antennas)
    notes = [
        f"{file}: row {row} and {len(nowhere) - 1} more without a position, which AIS calls not "
        "available, are left out."
        for row in nowhere[:1]
    ]
    return Recording(file, reports, sizes, antennas, tuple(notes))


def _find_columns(header: Iterable[str], file: str) -> dict[str, int]:
    """Numbers of the columns, from 0, by what they mean."""
    given = [name.strip().lower().removeprefix("\ufeff") for name in header]
    columns = {key: given.index(name) for key, names in _NAMES.items() for name in names if name in given}
    for key in REQUIRED:
        if key not in columns:
            raise ScenarioError(
                f"{file} row 1: no column {key}: call one of the columns {' or '.join(_NAMES[key])}; there are "
                f"{', '.join(given) or 'none'}"
            )
    return columns


def _read_mmsi(text: str, file: str, row: int) -> int:
    if not (text.isdecimal() and len(text) <= 9):
        raise ScenarioError(f"{file} row {row}: mmsi = {text!r} must be a number of up to nine digits: correct the row")
    return int(text)


def _read_report(values: Mapping[str, str], file: str, row: int) -> Report | None:
    """The report of a row; None for one without a position."""
    time = parse_time(values["time"])
    if time is None:
        raise ScenarioError(
            f"{file} row {row}: time = {values['time']!r} is no time: write UTC such as 2026-01-01T00:00:00Z, or "
            "seconds since 1970"
        )
    latitude, longitude, sog, cog, heading = (_read_number(values, key, file, row) for key in NOT_AVAILABLE)
    if latitude is None or longitude is None:
        return None
    return Report(
        row, time, latitude, longitude, None if sog is None else sog * KNOT, None if cog is None else radians(cog),
        None if heading is None else radians(heading),
    )  # fmt: skip


def _read_number(values: Mapping[str, str], key: str, file: str, row: int) -> float | None:
    """The value of a column; None where there is none, or "not available"."""
    text = values.get(key, "")
    if not text:
        return None
    unit, gone, most = _UNITS[key], NOT_AVAILABLE[key], LARGEST[key]
    least = -most if key in ("latitude", "longitude") else 0.0
    remedy = f'give {least:g} to {most:g} {unit}, or {gone:g} for "not available"'
    try:
        value = float(text)
    except ValueError:
        raise ScenarioError(f"{file} row {row}: {key} = {text!r} is not a number: {remedy}") from None
    if abs(value - gone) < 1e-6:
        return None
    if not (isfinite(value) and least <= value <= most):
        raise ScenarioError(f"{file} row {row}: {key} = {value:g} is out of range: {remedy}")
    return value


def _read_ship(
    values: Mapping[str, str], mmsi: int, sizes: dict[int, ShipSize], antennas: dict[int, Antenna]
) -> None:  # fmt: skip
    """Take the particulars of a row where it has any; those of a later row count."""
    a, b, c, d = (_size(values, key) for key in "abcd")
    length = _size(values, "length") or ((a or 0.0) + (b or 0.0))
    width = _size(values, "width") or ((c or 0.0) + (d or 0.0))
    if length and width:
        kind = values.get("type", "")
        sizes[mmsi] = ShipSize(
            values.get("name") or None, int(kind) if kind.isdecimal() else kind or None, length, width,
            _size(values, "draught"),
        )  # fmt: skip
    if a and b:
        antennas[mmsi] = Antenna(0.5 * (b - a), 0.5 * (c - d) if c and d else 0.0)


def _size(values: Mapping[str, str], key: str) -> float | None:
    """A dimension [m]; None where there is none, or zero, which is "not available"."""
    try:
        value = float(values.get(key, ""))
    except ValueError:
        return None
    return value if isfinite(value) and value > 0.0 else None
