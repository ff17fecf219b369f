"""A collision of ships from a published case: the files of the ships, and a run of the collision model."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.collision.conftest import World
from tests.ship_files import ship_toml

Collide = Callable[..., World]
"""collide(ships, start, duration, **parameters): tables of each ship and its start; the world after the run."""


@pytest.fixture
def collide(tmp_path: Path) -> Iterator[Collide]:
    """Runs of ShipCollision with ships from tables of ship files (ship_files.py), at a step of 0.05 s."""
    worlds: list[World] = []

    def run(ships: list[dict[str, Any]], start: list[dict[str, Any]], duration: float, **parameters: Any) -> World:
        paths = []
        for number, tables in enumerate(ships):
            paths.append(tmp_path / f"ship{number}.toml")
            paths[-1].write_text(ship_toml(**tables), encoding="utf-8")
        worlds.append(World([str(path) for path in paths], start, **parameters))
        return worlds[-1].run(duration, 0.05)

    yield run
    for world in worlds:
        world.model.close()


def box_ship(L: float, B: float, T: float, mass: float, **added_mass: float) -> dict[str, Any]:
    """Tables of a box-shaped ship [m], [kg] with CG at CO, so that a blow in line with the centre does not turn it.

    Added masses that are not given are zero.
    """
    none = dict.fromkeys(("m_x", "m_y", "m_z", "j_x", "j_y", "j_z", "z_y"), 0.0)
    return {
        "particulars": {
            "L_pp": L, "B": B, "T": T, "mass": mass, "r_bg": [0.0, 0.0, 0.0],
            "allow_inconsistent": "the published case gives the mass, this test the hull",
        },
        "added_mass": none | added_mass,
        "hull": {"depth": 2.0 * T},
    }  # fmt: skip
