"""Report and Recording: what every reader of recorded AIS gives."""

from __future__ import annotations

from typing import NamedTuple

from .ship_size import ShipSize

__all__ = ["NO_REFERENCE_POINT", "Antenna", "Recording", "Report"]


class Report(NamedTuple):
    """A position report.

    row: of the file, from 1; time: seconds since 1970 UTC; latitude, longitude [deg]; sog [m/s]; cog, heading: true
    [rad]. None is AIS's "not available".
    """

    row: int
    time: float
    latitude: float
    longitude: float
    sog: float | None
    cog: float | None
    heading: float | None


class Antenna(NamedTuple):
    """Where the antenna, to which positions refer, stands against midship: ahead and to starboard [m]."""

    ahead: float = 0.0
    starboard: float = 0.0


NO_REFERENCE_POINT = Antenna()
"""Of a ship whose recording does not tell."""


class Recording(NamedTuple):
    """The content of a file: reports, sizes and antennas of ships by MMSI, and what was left out."""

    file: str
    reports: dict[int, list[Report]]
    sizes: dict[int, ShipSize]
    antennas: dict[int, Antenna]
    notes: tuple[str, ...] = ()
