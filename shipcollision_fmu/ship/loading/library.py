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
from ..file_stamp import Stamp, content_digest, file_stamp
from ..ship import Ship
from .assembly import assembled
from .messages import suggestion
from .ship_file import ship_file
from .toml import read_toml

__all__ = ["Ship", "load_ship", "models_directory", "ship_content", "ship_names"]

SHIPS_KEPT = 64
"""Ships and ship files that are kept in memory. With fewer than a run has ships, they are read and made again."""

DICT = "ship given as a dict"
"""Stands for the file's name in messages."""


def models_directory() -> Path:
    """Folder of the shipped models: inside an installed package, beside the package in a working copy."""
    package = Path(__file__).resolve().parents[2]
    inside = package / "models"
    return inside if inside.is_dir() else package.parent / "models"


def ship_names() -> list[str]:
    """Names of the shipped ships, sorted."""
    return sorted(path.stem for path in (models_directory() / "ships").glob("*.toml"))


def load_ship(source: str | Path | Mapping[str, Any], directory: Path | None = None) -> Ship:
    """The ship of a shipped name (`kvlcc2`), of a file (`my/ship.toml`), or of the tables of a ship file as a dict.

    Text with the suffix .toml or a path separator names a file; one without a root is looked for in `directory`, when
    given, before the current folder. A dict may extend ships and name a mesh, by paths from `directory` or else from
    the current folder. The same content gives the same ship, which cannot be changed. Raises ShipError when the ship is
    not found or refused.
    """
    if isinstance(source, Mapping):
        return _ship(_overlay(_plain(source), directory or Path(), DICT, ()), DICT)
    if directory is not None and _is_path(source) and (directory / source).is_file():
        source = directory / source
    path = _located(source)
    return _ship(_file_content(path, ()), path.name)


def ship_content(name_or_path: str | Path) -> dict[str, Any]:
    """The tables of a ship file as load_ship reads them: those of the files that it extends laid under its own, the
    mesh file of [hull] findable from the current folder."""
    return _file_content(_located(name_or_path), ())


@dataclass(frozen=True)
class _Content:
    """The tables of a ship, compared by `key`: their text, and a digest of the mesh file."""

    key: str
    tables: dict[str, Any] = field(compare=False)
    source: str = field(compare=False)


def _ship(tables: dict[str, Any], source: str) -> Ship:
    """The ship of these tables; `source` names them in messages."""
    hull = tables.get("hull")
    mesh = hull.get("file") if isinstance(hull, dict) else None
    try:
        digest = content_digest(Path(mesh)) if isinstance(mesh, str) else ""
    except OSError:  # build_hull says so
        digest = ""
    return _assembled(_Content(json.dumps([tables, digest], sort_keys=True, default=repr), tables, source))


@lru_cache(maxsize=SHIPS_KEPT)
def _assembled(content: _Content) -> Ship:
    return assembled(ship_file(content.tables, content.source), content.source)


def _is_path(name_or_path: str | Path) -> bool:
    text = str(name_or_path)
    return isinstance(name_or_path, Path) or text.endswith(".toml") or "/" in text or "\\" in text


def _located(name_or_path: str | Path, beside: Path | None = None) -> Path:
    text = str(name_or_path)
    if _is_path(name_or_path):
        path = Path(text)
        if beside is not None and not path.is_absolute():
            path = beside / path
        if not path.is_file():
            known = ", ".join(ship_names())
            raise ShipError(f"ship file {text} does not exist: give the path of a TOML file or one of {known}")
        return path
    folders = [models_directory() / "ships"] if beside is None else [beside, models_directory() / "ships"]
    for folder in folders:
        path = folder / f"{text}.toml"
        if path.is_file():
            return path
    names = ship_names()
    raise ShipError(
        f"unknown ship {text!r}:{suggestion(text, names)} known: {', '.join(names)}; or give the path of a TOML file"
    )


def _plain(value: Any) -> Any:
    """The same in dicts with text as keys and in lists, as a TOML file has it."""
    if isinstance(value, Mapping):
        return {str(key): _plain(below) for key, below in value.items()}
    return [_plain(below) for below in value] if isinstance(value, list | tuple) else value


def _toml(path: Path) -> dict[str, Any]:
    """Content of a ship file, the caller's own."""
    stamp = file_stamp(path)
    return read_toml(path, ShipError) if stamp is None else deepcopy(_unchanged_toml(stamp))


@lru_cache(maxsize=SHIPS_KEPT)
def _unchanged_toml(stamp: Stamp) -> dict[str, Any]:
    return read_toml(Path(stamp[0]), ShipError)


def _file_content(path: Path, above: tuple[Path, ...]) -> dict[str, Any]:
    """Tables of the file, those of its base under its own. `above`: the files that led here."""
    if path.resolve() in above:
        chain = " extends ".join(p.stem for p in (*above, path))
        raise ShipError(f"{path.name}: extends goes round in a circle ({chain}): remove one extends")
    return _overlay(_toml(path), path.parent, path.name, (*above, path.resolve()))


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
        base_path = _located(base_name, folder)
    except ShipError as error:
        raise ShipError(f"{source}: extends: {error}") from None
    base = _file_content(base_path, above)
    for key, value in own.items():
        both_tables = isinstance(value, dict) and isinstance(base.get(key), dict)
        base[key] = {**base[key], **value} if both_tables else value
    return base
