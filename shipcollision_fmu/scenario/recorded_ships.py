"""Ships of a scenario that follow recorded tracks: the recordings are read, and ship files estimated.

A recording that several ships name is read once.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..errors import ScenarioError
from .tables.place import Place
from .tables.ship_start import ShipStart
from .tracks.cleaning import Period, choose_ship
from .tracks.estimated_ship import keep_estimated_ship
from .tracks.read_recording import read_recording
from .tracks.recording import Recording
from .tracks.tangent_plane import TangentPlane
from .tracks.time_stamps import format_time
from .tracks.track import build_track

__all__ = ["follow_tracks"]


def follow_tracks(
    ships: Mapping[str, ShipStart], place: Place | None, directory: Path, duration: float
) -> dict[str, str]:  # fmt: skip
    """Give the ships with a track their motion; returns paths of estimated ship files, by name, where none is named.

    Paths of recordings are relative to `directory`; duration: of the scenario [s]. Raises ScenarioError.
    """
    recordings: dict[str, Recording] = {}
    estimated: dict[str, str] = {}
    for name, ship in ships.items():
        if ship.track is None:
            continue
        try:
            if ship.track.file not in recordings:
                recordings[ship.track.file] = read_recording(directory / ship.track.file)
            recording = recordings[ship.track.file]
            at = _require_place(place, recording, ship.track.mmsi)
            begin, until = at.start.timestamp(), ship.track.until or duration
            if until < duration:
                raise ScenarioError(f"until = {until:g} s is before the end: must be >= duration = {duration:g} s")
            track = build_track(
                recording, ship.track.mmsi, TangentPlane(at.latitude, at.longitude), Period(begin, begin + until)
            )
            ship.follow(track)
            if ship.ship is None:
                estimated[name] = str(keep_estimated_ship(track, recording.file))
        except ScenarioError as error:
            raise ScenarioError(f"[ships.{name}] track: {error}") from None
    return estimated


def _require_place(place: Place | None, recording: Recording, mmsi: int | None) -> Place:
    """The table [place]. Raises ScenarioError, with a table that fits the recording, where there is none."""
    if place is not None:
        return place
    first = min(recording.reports[choose_ship(recording, mmsi)], key=lambda report: report.time)
    raise ScenarioError(
        f"{recording.file} needs the table [place]: give it, such as latitude = {first.latitude:.5f}, longitude = "
        f"{first.longitude:.5f}, start = {format_time(first.time)}, where the track begins"
    )
