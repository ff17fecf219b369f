"""keep_estimated_ship(): the ship file of a recorded ship, estimated from its dimensions, in the user's cache.

FMUs read ships by path, so the file must lie somewhere. Its name is a digest of its text: two ships never share one.
"""

from __future__ import annotations

from hashlib import sha256
from pathlib import Path

from ...errors import ScenarioError
from ...files import user_cache, write_file
from .ship_file import write_ship_file
from .track import Track

__all__ = ["keep_estimated_ship"]


def keep_estimated_ship(track: Track, file: str) -> Path:
    """The path of the ship file of a track from the recording `file`.

    Raises ScenarioError for a track without dimensions, HostError when the file cannot be written.
    """
    if track.size is None:
        raise ScenarioError(
            f"{file} has no dimensions of MMSI {track.mmsi}, in columns length and width or in messages of type 5: "
            "give ship = ..., a shipped model's name or the path of a ship file"
        )
    text = write_ship_file(f"MMSI {track.mmsi}", track.size, file, "give ship = ...", sails=False)
    path = user_cache() / "recorded-ships" / f"{sha256(text.encode()).hexdigest()[:32]}.toml"
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        write_file(path, text, "make the user's cache writable, or give ship = ...")
    return path
