"""A user's ship file as files inside an FMU: one TOML file, and its mesh beside it.

A shipped ship keeps its name because every FMU holds all of them. A user's file may extend others and name a mesh
anywhere. It becomes ships/NAME.toml in the FMU's resources, with the tables of all its files merged, and the mesh
becomes ships/NAME.obj. The ship loaded from there is the same to the bit. A native FMU reads no TOML: see
cosim/prepared_files.py.
"""

from __future__ import annotations

from pathlib import Path, PurePosixPath

from ..cosim.prepared_files import FOLDER
from ..errors import ShipError
from ..scenario.toml_writer import format_toml
from ..ship.loading.library import list_ship_names, read_ship_tables

__all__ = ["pack_ship"]


def pack_ship(name: str, ship: str) -> tuple[str, dict[str, bytes]]:
    """The value of the parameter `ship` inside the FMU for the ship called `name`, and the files it needs there.

    ship: the argument of load_ship. Raises ShipError when a file cannot be read.
    """
    if ship in list_ship_names():
        return ship, {}
    content, source = read_ship_tables(ship), Path(ship).name
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
    files[place] = format_toml([f"From {source}, with the tables that it extends."], content).encode()
    return place, files
