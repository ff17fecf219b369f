"""Ships by name, by path and from tables: the shipped ones under models/ships, a user's own by path or as a dict.

A ship file may start with `extends = "other"`. The other file's tables are then laid under this one's, key by key,
before anything is validated: a variant states only what differs. `other` is looked up beside the file, then among the
shipped ships.

A ship is made once for one content, which is that of its file, of all files that it extends and of its mesh file. A
file is read again only when it has changed, so each run reads each file once.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

from ...errors import ShipError
from ...files import is_file
from ..file_stamp import Stamp, digest_content, take_stamp
from ..ship import Ship
from .assembly import assemble_ship
from .messages import suggest_or_list
from .obstacle_tables import are_obstacles
from .ship_file import validate_ship_file
from .toml import read_toml

__all__ = ["Ship", "find_models", "list_ship_names", "load_ship", "read_ship_tables"]

SHIPS_KEPT = 64
"""Ships and ship files that are kept in memory. With fewer than a run has ships, they are read and made again."""

DICT = "ship given as a dict"
"""Stands for the file's name in messages."""


def find_models() -> Path:
    """Folder of the shipped models: inside an installed package, beside the package in a working copy."""
    package = Path(__file__).resolve().parents[2]
    inside = package / "models"
    return inside if inside.is_dir() else package.parent / "models"


def list_ship_names() -> list[str]:
    """Names of the shipped ships, sorted."""
    return sorted(path.stem for path in (find_models() / "ships").glob("*.toml"))


def load_ship(source: str | Path | Mapping[str, Any], directory: Path | None = None) -> Ship:
    """The ship of a shipped name (`kvlcc2`), of a file (`my/ship.toml`), or of the tables of a ship file as a dict.

    Text with the suffix .toml or a path separator names a file; one without a root is looked for in `directory`, when
    given, before the current folder. A dict may extend ships and name a mesh, by paths from `directory` or else from
    the current folder. The same content gives the same ship, which cannot be changed. Raises ShipError when the ship is
    not found or refused.
    """
    if isinstance(source, Mapping):
        return _make_ship(_overlay(_convert_to_toml(source), directory or Path(), DICT, ()), DICT)
    _check_source(source)
    if directory is not None and _is_path(source) and is_file(directory / source):
        source = directory / source
    path = _locate(source, also=directory)
    return _make_ship(_read_with_base(path, ()), path.name)


def read_ship_tables(name_or_path: str | Path) -> dict[str, Any]:
    """The tables of a ship file as load_ship reads them: those of the files that it extends laid under its own, the
    mesh file of [hull] findable from the current folder."""
    _check_source(name_or_path)
    return _read_with_base(_locate(name_or_path), ())


def _check_source(source: str | Path) -> None:
    """Raise ShipError for a source that is neither a name nor a path, and for no text."""
    if not isinstance(source, str | Path) or source == "":
        raise ShipError(f"ship = {source!r} is no ship: give a name, a path or the tables as a dict")


@dataclass(frozen=True)
class _Content:
    """The tables of a ship, compared by `key`: their text, and a digest of the mesh file."""

    key: str
    tables: dict[str, Any] = field(compare=False)
    source: str = field(compare=False)


def _make_ship(tables: dict[str, Any], source: str) -> Ship:
    """The ship of these tables; `source` names them in messages."""
    hull = tables.get("hull")
    mesh = hull.get("file") if isinstance(hull, dict) else None
    try:
        digest = digest_content(Path(mesh)) if isinstance(mesh, str) else ""
    except OSError:  # build_hull refuses the file
        digest = ""
    return _assemble_once(_Content(json.dumps([tables, digest], sort_keys=True, default=repr), tables, source))


@lru_cache(maxsize=SHIPS_KEPT)
def _assemble_once(content: _Content) -> Ship:
    return assemble_ship(validate_ship_file(content.tables, content.source), content.source)


def _is_path(name_or_path: str | Path) -> bool:
    text = str(name_or_path)
    return isinstance(name_or_path, Path) or text.endswith(".toml") or "/" in text or "\\" in text


def _locate(name_or_path: str | Path, beside: Path | None = None, also: Path | None = None) -> Path:
    """The path of a ship file. `also` is the folder where a caller has looked for it before, for the message."""
    text = str(name_or_path)
    if _is_path(name_or_path):
        path = Path(text)
        if beside is not None and not path.is_absolute():
            path = beside / path
        if not is_file(path):
            known = ", ".join(list_ship_names())
            where = "" if Path(text).is_absolute() else f" (looked for in {_list_folders(also, beside or Path())})"
            raise ShipError(f"ship file {text} does not exist: give the path of a TOML file or one of {known}{where}")
        return path
    folders = [find_models() / "ships"] if beside is None else [beside, find_models() / "ships"]
    for folder in folders:
        path = folder / f"{text}.toml"
        if is_file(path):
            return path
    known = suggest_or_list(text, list_ship_names(), "give the path of a TOML file")
    raise ShipError(f"unknown ship {text!r}:{known}")


def _list_folders(*folders: Path | None) -> str:
    return " and ".join(dict.fromkeys(str(folder.absolute()) for folder in folders if folder is not None))


def _convert_to_toml(value: Any) -> Any:
    """The same in dicts with text as keys and in lists, as a TOML file has it."""
    if isinstance(value, Mapping):
        return {str(key): _convert_to_toml(below) for key, below in value.items()}
    return [_convert_to_toml(below) for below in value] if isinstance(value, list | tuple) else value


def _read_tables(path: Path) -> dict[str, Any]:
    """Content of a ship file, the caller's own."""
    stamp = take_stamp(path)
    tables = read_toml(path, ShipError) if stamp is None else deepcopy(_read_unchanged(stamp))
    if "ships" in tables and "particulars" not in tables:
        raise ShipError(f"{path.name} is a scenario, not a ship: name one of the ship files in it")
    if are_obstacles(tables):
        raise ShipError(f"{path.name} has obstacles, and no ship: name a ship file")
    return tables


@lru_cache(maxsize=SHIPS_KEPT)
def _read_unchanged(stamp: Stamp) -> dict[str, Any]:
    return read_toml(Path(stamp[0]), ShipError)


def _read_with_base(path: Path, above: tuple[Path, ...]) -> dict[str, Any]:
    """Tables of the file, those of its base under its own. `above`: the files that led here."""
    if path.resolve() in above:
        chain = " extends ".join(p.stem for p in (*above, path))
        raise ShipError(f"{path.name}: extends goes round in a circle ({chain}): remove one extends")
    return _overlay(_read_tables(path), path.parent, path.name, (*above, path.resolve()))


def _overlay(own: dict[str, Any], folder: Path, source: str, above: tuple[Path, ...]) -> dict[str, Any]:
    """The tables `own` with those of their base under them. Paths in them start at `folder`."""
    hull = own.get("hull")
    if isinstance(hull, dict) and isinstance(hull.get("file"), str) and hull["file"]:
        hull["file"] = str(folder / hull["file"])
    base_name = own.pop("extends", None)
    if base_name is None:
        return own
    if not isinstance(base_name, str):
        raise ShipError(f"{source}: extends = {base_name!r} must be a ship's name or path in quotes")
    try:
        base_path = _locate(base_name, folder)
    except ShipError as error:
        raise ShipError(f"{source}: extends: {error}") from None
    base = _read_with_base(base_path, above)
    for key, value in own.items():
        both_tables = isinstance(value, dict) and isinstance(base.get(key), dict)
        base[key] = {**base[key], **value} if both_tables else value
    return base
