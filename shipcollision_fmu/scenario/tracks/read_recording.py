"""read_recording(): a file of recorded AIS, by its content a CSV table or a log of NMEA sentences."""

from __future__ import annotations

from pathlib import Path

from ...errors import ScenarioError
from ...files import is_file
from .csv_recording import read_csv
from .nmea_recording import read_nmea
from .recording import Recording

__all__ = ["read_recording"]

LARGEST_FILE = 200_000_000
"""[bytes] A day of a busy sea; a larger file would fill the memory."""


def read_recording(path: Path) -> Recording:
    """The recording in a file. Raises ScenarioError, in one line, for a file that is missing or holds no report."""
    if not is_file(path):
        raise ScenarioError(f"track file {path} does not exist: give the path of a CSV file or an NMEA log of AIS")
    size = path.stat().st_size
    if size > LARGEST_FILE:
        raise ScenarioError(
            f"{path.name} has {size / 1e6:.0f} MB, the limit is {LARGEST_FILE / 1e6:.0f}: cut out the ship and the hour"
        )
    text = path.read_text(encoding="utf-8", errors="replace").removeprefix("\ufeff")
    is_log = any("VDM," in line or "VDO," in line for line in text.splitlines()[:1000])
    recording = (read_nmea if is_log else read_csv)(text, path.name)
    if not recording.reports:
        raise ScenarioError(f"{path.name} holds no position report of AIS: give a log that does")
    return recording
