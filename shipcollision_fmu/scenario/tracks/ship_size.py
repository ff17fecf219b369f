"""ShipSize: what a foreign file tells of a ship."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["ShipSize"]


class ShipSize(NamedTuple):
    """Name, type (a word or an AIS code), length, width, draught [m] and largest speed [m/s] of a ship.

    None where the file is silent.
    """

    name: str | None = None
    kind: str | int | None = None
    length: float | None = None
    width: float | None = None
    draught: float | None = None
    top_speed: float | None = None
