"""Tables of obstacles, told from those of ships for the sake of messages: collision/obstacles.py reads them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

__all__ = ["are_obstacles", "is_obstacle"]

_OF_OBSTACLES = frozenset({"kind", "shape", "position", "heading_deg"})
"""Keys of which no table of a ship has two."""
_OF_OTHERS = ("ship", "particulars", "extends", "ships")
"""Keys that only files of ships and scenarios have."""


def is_obstacle(table: object) -> bool:
    """Whether a table is meant as an obstacle, be it right or wrong."""
    return isinstance(table, Mapping) and len(_OF_OBSTACLES & table.keys()) >= 2


def are_obstacles(content: Mapping[str, Any]) -> bool:
    """Whether the content of a file is meant as obstacles: the table [obstacles] alone, or a table that is_obstacle(),
    wherever it stands."""
    if any(key in content for key in _OF_OTHERS):
        return False
    below = [inner for table in content.values() if isinstance(table, Mapping) for inner in table.values()]
    return set(content) == {"obstacles"} or any(map(is_obstacle, (content, *content.values(), *below)))
