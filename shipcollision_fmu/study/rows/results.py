"""Results: what became of some cases of a study, by column, in the words of columns.py."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array
from .cases import Cases

__all__ = ["MOTION", "Results"]

MOTION = {"surge": 0, "sway": 1, "yaw_rate": 5}
"""Places of the motions in plan in a twist (6,)."""

Values = npt.NDArray[Any]


@dataclass
class Results:
    """Results of the cases.

    reasons      why a case was refused, empty for one that was not
    numbers      by column of the encounters (n,), NaN where there is none
    collisions   by column of the collisions (m,), with `case`: the place of its case, from 0
    """

    cases: Cases
    engine: str
    reasons: list[str] = field(default_factory=list)
    numbers: dict[str, Array] = field(default_factory=dict)
    collisions: list[dict[str, Values]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.reasons = [""] * len(self.cases)

    def put(self, name: str, places: Values, values: Any) -> None:
        """Set a column at the places of some cases."""
        if name not in self.numbers:
            self.numbers[name] = np.full(len(self.cases), np.nan)
        self.numbers[name][places] = values

    def refuse(self, place: int, reason: str) -> None:
        """Refuse the case at a place."""
        self.reasons[place] = reason or "the case was refused without a reason"
