"""Ship files of the tests: a barge of 100 m with CG at CO, and what differs from it."""

from __future__ import annotations

import copy
import json
from typing import Any

__all__ = ["BARGE_ADDED_MASS", "NO_ADDED_MASS", "estimated_toml", "ship_tables", "ship_toml"]

_BARGE: dict[str, dict[str, Any]] = {
    "ship": {"name": "Barge", "kind": "barge", "source": "made up for the tests"},
    "particulars": {"L_pp": 100.0, "B": 20.0, "T": 5.0, "mass": 8.2e6, "r_bg": [0.0, 0.0, 0.0]},
    "hull": {"shape": "box", "depth": 8.0},
}
BARGE_ADDED_MASS = {"m_x": 0.05, "m_y": 0.85, "m_z": 1.0, "j_x": 0.2, "j_y": 1.0, "j_z": 0.21}
NO_ADDED_MASS = {**dict.fromkeys(BARGE_ADDED_MASS, 0.0), "z_y": 0.0}


def ship_tables(**tables: dict[str, Any] | None) -> dict[str, Any]:
    """Tables of the barge with keys of tables added or replaced; None removes a key or a table."""
    data: dict[str, Any] = copy.deepcopy(_BARGE)
    for table, keys in tables.items():
        if keys is None:
            del data[table]
            continue
        data[table] = {k: v for k, v in {**data.get(table, {}), **keys}.items() if v is not None}
    return data


def ship_toml(**tables: dict[str, Any] | None) -> str:
    """Text of a ship file with these tables; `ship_toml()` is the barge."""
    lines = []
    for name, table in ship_tables(**tables).items():
        lines += [f"[{name}]", *(f"{key} = {json.dumps(value)}" for key, value in table.items())]
    return "\n".join(lines) + "\n"


def estimated_toml(
    L: float, B: float, T: float, C_b: float, *, kind: str = "cargo", **tables: dict[str, Any] | None
) -> str:
    """Text of the file of a ship from four numbers."""
    return ship_toml(
        ship={"name": "Four numbers", "kind": kind}, hull={"depth": 1.5 * T}, manoeuvring={"estimate": True},
        particulars={"L_pp": L, "B": B, "T": T, "mass": 1025.0 * L * B * T * C_b, "r_bg": None}, **tables,
    )  # fmt: skip
