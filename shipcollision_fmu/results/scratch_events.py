"""One scratch of events.json: a line of points on both hulls, where paint keeps it.

A scratch has one point per step, that of the largest impulse, in both ships' b.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..fmi.names import AXES, NED
from .contact_rows import Rows, pick_strongest, row_vector

__all__ = ["build_scratch"]


def build_scratch(number: int, rows: Rows) -> dict[str, Any]:
    """The scratch of that number as JSON-able data, from its contact rows."""
    line = [pick_strongest(rows[rows["time"] == time]) for time in np.unique(rows["time"])]
    first, last = line[0], line[-1]
    b_a, b_b = ([row_vector(row, group, AXES).tolist() for row in line] for group in "ab")
    return {
        "id": number,
        "collision": int(first["impact"]),
        "ship_a": str(first["ship_a"]),
        "ship_b": str(first["ship_b"]),
        "start": float(first["time"]),
        "end": float(last["time"]),
        "first_point": {"n": row_vector(first, None, NED).tolist(), "b_a": b_a[0], "b_b": b_b[0]},
        "time": [float(row["time"]) for row in line],
        "b_a": b_a,
        "b_b": b_b,
    }
