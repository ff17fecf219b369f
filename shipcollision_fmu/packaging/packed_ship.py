"""A user's ship file as files inside an FMU: one TOML file, and its mesh beside it.

A shipped ship keeps its name because every FMU holds all of them. A user's file may extend others and name a mesh
anywhere. It becomes ships/NAME.toml in the FMU's resources, with the tables of all its files merged, and the mesh
becomes ships/NAME.obj. The ship loaded from there is the same to the bit. A native FMU reads no TOML: there the ship
becomes ships/NAME.ship, a prepared file.
"""

from __future__ import annotations

from pathlib import Path, PurePosixPath

from ..errors import ShipError
from ..manoeuvring.prepared_ship import SUFFIX, prepare_ship
from ..scenario.toml_writer import format_toml
from ..ship.loading.library import list_ship_names, read_ship_tables

__all__ = ["FOLDER", "pack_prepared_ship", "pack_ship"]

FOLDER = "ships"
"""Folder of ship files in an FMU's resources; the slave resolves the parameter `ship` from there."""


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


def pack_prepared_ship(name: str, ship: str) -> tuple[str, dict[str, bytes]]:
    """The same for a native FMU."""
    if ship in list_ship_names():
        return ship, {}
    place = str(PurePosixPath(FOLDER, f"{name}{SUFFIX}"))
    return place, {place: prepare_ship(ship)}
