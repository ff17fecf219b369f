"""The rooms of the package: their floors from the import rules, their maps from their docstrings."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from importlib import import_module
from inspect import getdoc
from pathlib import Path
from pkgutil import walk_packages

import shipcollision_fmu

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

__all__ = ["rooms"]

_PROJECT = Path(__file__).parents[2] / "pyproject.toml"


def rooms() -> str:
    """The floors, top to bottom, and the map of every room."""
    floors = "".join(f"    {layer}\n" for layer in _layers())
    maps = "\n".join(f"### {name}\n\n```text\n{_map(name)}\n```\n" for name in _names())
    return f"## Floors\n\n{floors}\n## Rooms\n\n{maps}"


def _layers() -> list[str]:
    contracts = tomllib.loads(_PROJECT.read_text(encoding="utf-8"))["tool"]["importlinter"]["contracts"]
    layers: list[str] = next(contract["layers"] for contract in contracts if contract["type"] == "layers")
    return layers


def _names() -> Iterator[str]:
    prefix = f"{shipcollision_fmu.__name__}."
    for module in walk_packages(shipcollision_fmu.__path__, prefix):
        if module.ispkg:
            yield module.name.removeprefix(prefix)


def _map(name: str) -> str:
    return (getdoc(import_module(f"{shipcollision_fmu.__name__}.{name}")) or "").strip()
