"""A user's ship file, made ready to travel inside an FMU: one file, and its mesh beside it.

A ship of the library goes by its name, every FMU carries all of them. A file of the user's own, which may extend others
and name a mesh anywhere, becomes ships/NAME.toml in the FMU's resources, the tables of all its files laid over each
other, with the mesh as ships/NAME.obj. The ship loaded from there is the same to the bit.
"""

from __future__ import annotations

from pathlib import Path, PurePosixPath

from ..errors import ShipError
from ..scenario.toml_writer import format_toml
from ..ship.loading.library import ship_content, ship_names

__all__ = ["FOLDER", "packed_ship"]

FOLDER = "ships"
"""Of ship files, in an FMU's resources."""


def packed_ship(name: str, ship: str) -> tuple[str, dict[str, bytes]]:
    """What the parameter `ship` of the ship called `name` says in a package, and the files that it needs there.

    `ship` is what load_ship takes. Raises ShipError when a file cannot be read.
    """
    if ship in ship_names():
        return ship, {}
    content, source = ship_content(ship), Path(ship).name
    files: dict[str, bytes] = {}
    hull = content.get("hull")
    if isinstance(hull, dict) and isinstance(hull.get("file"), str):
        mesh = Path(hull["file"])
        try:
            data = mesh.read_bytes()
        except OSError as error:
            raise ShipError(f"{source}: mesh file {mesh} cannot be read: {error.strerror}") from None
        hull["file"] = f"{name}{mesh.suffix.lower()}"
        files[f"{FOLDER}/{hull['file']}"] = data
    place = str(PurePosixPath(FOLDER, f"{name}.toml"))
    files[place] = format_toml([f"From {source}, with all that it extends."], content).encode()
    return place, files
