"""OrderLog: what was ordered to a ship in a live run, by communication point, in memory or in a temporary file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import isnan, nan
from pathlib import Path

import numpy as np

from ...cosim.row_log import RowLog

__all__ = ["Logged", "OrderLog"]


@dataclass(frozen=True)
class Logged:
    """An order at a communication point, as in a scenario: keys that are None stay as before."""

    rudder_deg: float | None = None
    heading_deg: float | None = None
    rev_per_s: float | None = None

    def followed_by(self, later: Logged) -> Logged:
        """Both orders as one: those of `later` count."""
        rudder, heading = self.rudder_deg, self.heading_deg
        if later.rudder_deg is not None or later.heading_deg is not None:
            rudder, heading = later.rudder_deg, later.heading_deg
        return Logged(rudder, heading, self.rev_per_s if later.rev_per_s is None else later.rev_per_s)


class OrderLog:
    """Orders by communication point, in their order. With `spool`, a folder, a temporary file there holds them.

    Without a file a bridge that orders at every step would fill the memory.
    """

    def __init__(self, spool: Path | None = None) -> None:
        self._rows = RowLog(np.float64, 4, spool=spool)

    def __len__(self) -> int:
        return len(self._rows)

    def append(self, k: int, order: Logged) -> None:
        """Add the order of communication point k, after those before."""
        keys = (order.rudder_deg, order.heading_deg, order.rev_per_s)
        self._rows.append((k, *(nan if value is None else value for value in keys)))

    def truncate(self, length: int) -> None:
        """Forget the orders from number `length` on."""
        self._rows.truncate(length)

    def list_orders(self) -> Iterator[tuple[int, Logged]]:
        """The orders with their communication points."""
        for k, *values in self._rows.build_array():
            yield int(k), Logged(*(None if isnan(value) else float(value) for value in values))

    def close(self) -> None:
        """Remove the file."""
        self._rows.close()
