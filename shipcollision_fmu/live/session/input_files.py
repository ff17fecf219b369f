"""InputFiles: what a scenario reads besides itself, to lie beside its copy in the folder of a live run.

    ships/NAME.toml, ships/NAME.obj     a user's ship file, with the tables that it extends, and its mesh
    recordings/NAME.csv                 a recording that a ship follows; one for all ships that follow the same

They are read when the run begins: what the run was made from is stored, whatever happens to the files meanwhile.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ...errors import HostError
from ...files import write_files
from ...packaging.packed_ship import pack_ship
from ...scenario.scenario import Scenario

__all__ = ["FOLDERS", "InputFiles", "read_input_files"]

RECORDINGS = "recordings"
FOLDERS = ("ships", RECORDINGS)
"""Folders beside the scenario."""


@dataclass(frozen=True)
class InputFiles:
    """`ships` and `recordings`: the value of `ship` and of `track.file` by ship; `files`: their content by path."""

    ships: Mapping[str, str]
    recordings: Mapping[str, str]
    files: Mapping[str, bytes]

    def write(self, out: Path) -> None:
        """Write the files below the folder `out`. Raises HostError."""
        for place, content in self.files.items():
            path = out / place
            write_files(path.parent, {path.name: content})


def read_input_files(scenario: Scenario) -> InputFiles:
    """The files that a scenario reads. Raises ShipError, HostError for one that cannot be read."""
    ships: dict[str, str] = {}
    recordings: dict[str, str] = {}
    files: dict[str, bytes] = {}
    copied: dict[str, str] = {}
    for name, start in scenario.ships.items():
        if start.ship is not None:
            ships[name], packed = pack_ship(name, scenario.ship_file(name))
            files |= packed
        if start.track is not None:
            source = Path(scenario.track_file(name))
            if str(source) not in copied:
                copied[str(source)] = f"{RECORDINGS}/{name}{source.suffix}"
                files[copied[str(source)]] = _read(source)
            recordings[name] = copied[str(source)]
    return InputFiles(ships, recordings, files)


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise HostError(f"{path} cannot be read ({error.strerror}): run the scenario where it can be read") from None
