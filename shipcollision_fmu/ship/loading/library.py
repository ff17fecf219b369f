"""Ships by name: the shipped ones under models/ships, a user's own by path.

A ship file may start with `extends = "other"`. The other file's tables are then laid under this one's, key by key,
before anything is validated: a variant states only what differs. `other` is looked up beside the file, then among the
shipped ships.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ...errors import ShipError
from ..ship import Ship
from .assembly import assembled
from .messages import suggestion
from .ship_file import ship_file
from .toml import read_toml

__all__ = ["Ship", "load_ship", "models_directory", "ship_content", "ship_names"]


def models_directory() -> Path:
    """Folder of the shipped models: inside an installed package, beside the package in a working copy."""
    package = Path(__file__).resolve().parents[2]
    inside = package / "models"
    return inside if inside.is_dir() else package.parent / "models"


def ship_names() -> list[str]:
    """Names of the shipped ships, sorted."""
    return sorted(path.stem for path in (models_directory() / "ships").glob("*.toml"))


def load_ship(name_or_path: str | Path, directory: Path | None = None) -> Ship:
    """The ship of a shipped name (`kvlcc2`) or of a file (`my/ship.toml`).

    Anything with the suffix .toml or a path separator is a file; one without a root is looked for in `directory`, when
    given, before the current folder. Raises ShipError when it is not found or refused.
    """
    if directory is not None and _is_path(name_or_path) and (directory / name_or_path).is_file():
        name_or_path = directory / name_or_path
    path = _located(name_or_path)
    return assembled(ship_file(_overlaid(path, ()), path.name), path.name)


def ship_content(name_or_path: str | Path) -> dict[str, Any]:
    """The tables of a ship file as load_ship reads them: those of the files that it extends laid under its own, the
    mesh file of [hull] findable from the current folder."""
    return _overlaid(_located(name_or_path), ())


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


def _find_mesh(content: dict[str, Any], path: Path) -> None:
    """Make the mesh file of [hull] findable from anywhere: it is named relative to the ship file at `path`."""
    hull = content.get("hull")
    if isinstance(hull, dict) and isinstance(hull.get("file"), str) and hull["file"]:
        hull["file"] = str(path.parent / hull["file"])


def _overlaid(path: Path, above: tuple[Path, ...]) -> dict[str, Any]:
    """Content of the file with its base's tables under its own. `above`: the files that led here."""
    if path.resolve() in above:
        chain = " extends ".join(p.stem for p in (*above, path))
        raise ShipError(f"{path.name}: extends goes round in a circle ({chain}): remove one extends")
    own = read_toml(path, ShipError)
    _find_mesh(own, path)
    base_name = own.pop("extends", None)
    if base_name is None:
        return own
    if not isinstance(base_name, str):
        raise ShipError(f"{path.name}: extends = {base_name!r} must be a ship's name or path in quotes")
    try:
        base_path = _located(base_name, path.parent)
    except ShipError as error:
        raise ShipError(f"{path.name}: extends: {error}") from None
    base = _overlaid(base_path, (*above, path.resolve()))
    for key, value in own.items():
        both_tables = isinstance(value, dict) and isinstance(base.get(key), dict)
        base[key] = {**base[key], **value} if both_tables else value
    return base
