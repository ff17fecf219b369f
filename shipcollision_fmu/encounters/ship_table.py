"""The table [ships.NAME] of a generated scenario file, in the same order and form for every generator."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from ..errors import ScenarioError
from ..ship.loading.library import load_ship

__all__ = ["build_ship_table", "refer_to_ship", "require_manoeuvring", "round_off"]


def build_ship_table(
    ship: str, position: tuple[float, float], heading_deg: float, surge: float, sway: float = 0.0, **others: Any
) -> dict[str, Any]:
    """Keys and values of [ships.NAME]; a value None is left out of the file.

    `ship` as the file names it, position north and east [m], surge and sway [m/s]; `others` follow as they are. A ship
    without sway gets the key `speed` in place of `surge` and `sway`.
    """
    ahead = sway == 0.0
    return {
        "ship": ship,
        "position": list(position),
        "heading_deg": heading_deg,
        "speed": surge if ahead else None,
        "surge": None if ahead else surge,
        "sway": None if ahead else sway,
        **others,
    }


def refer_to_ship(ship: str, directory: Path) -> str:
    """The value of `ship` in a scenario file in `directory`: a shipped name as given, a path relative to the file."""
    if ship.endswith(".toml") or "/" in ship or "\\" in ship:
        return Path(os.path.relpath(Path(ship).resolve(), directory.resolve())).as_posix()
    return ship


def require_manoeuvring(ship: str, remedy: str) -> None:
    """Raise ScenarioError, ending with the remedy, for a ship that can only coast; ShipError for an unknown ship."""
    if load_ship(ship).manoeuvring is None:
        raise ScenarioError(f"ship {ship!r} can only coast, it has no [manoeuvring]: {remedy}")


def round_off(value: float, digits: int) -> float:
    """The value rounded to decimal digits, with zero for -0.0."""
    return round(float(value), digits) + 0.0
