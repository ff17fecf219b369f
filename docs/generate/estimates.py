"""The estimates that fill the ship file of fewest numbers in the guide."""

from __future__ import annotations

import re
from pathlib import Path

from shipcollision_fmu import ShipError, load_ship
from shipcollision_fmu.ship.loading.toml import parse_toml

from .markdown import plain

__all__ = ["estimates"]

_PAGE = Path(__file__).parents[1] / "guide" / "ships.md"
_LEAST = re.compile(r"^## The fewest numbers$.*?^```toml\n(.*?)^```", re.DOTALL | re.MULTILINE)


def estimates() -> str:
    """A list: what stands for values that the file leaves out."""
    found = _LEAST.search(_PAGE.read_text(encoding="utf-8"))
    assert found is not None, f"{_PAGE} has no ship of the fewest numbers"
    return _items(load_ship(parse_toml(found[1], _PAGE.name, ShipError)).estimated)


def _items(lines: tuple[str, ...]) -> str:
    return "".join(f"- {plain(line)}\n" for line in lines)
