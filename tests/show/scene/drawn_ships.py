"""Ships from main dimensions alone, as they are drawn."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
import trimesh

from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.show.scene.looks import Looks, make_looks
from shipcollision_fmu.show.scene.run_folder import ShipBody
from shipcollision_fmu.show.scene.surface import Surface

__all__ = ["KINDS", "Drawn", "draw_ship", "to_solid"]

KINDS = ("ferry", "tanker", "bulk carrier", "container ship", "tug", "naval ship", "cargo vessel", "car carrier")


class Drawn(NamedTuple):
    """The hull that touches, its length over all and breadth [m], and what is drawn."""

    hull: Surface
    L: float
    B: float
    looks: Looks

    @property
    def z_deck(self) -> float:
        return float(self.hull.vertices[:, 2].min())

    @property
    def points(self) -> Array:
        """All vertices that are drawn (n, 3)."""
        surfaces = [surface for _, surface in self.looks.shell] + [f.surface for f in self.looks.fittings]
        return np.vstack([surface.vertices for surface in surfaces])


@cache
def draw_ship(kind: str, L: float = 120.0, name: str = "Åse-Marie 2", breadth: float = 1.0 / 6.0) -> Drawn:
    size = {"L_pp": L, "B": L * breadth, "T": L * breadth / 3.0, "C_b": 0.65}
    ship = load_ship({"ship": {"name": kind, "kind": kind, "source": "a sketch"}, "particulars": size})
    hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
    surface = Surface(hull.vertices, hull.triangles)
    body = ShipBody(
        vertices=hull.vertices.tolist(), triangles=hull.triangles.tolist(), kind=kind, L_pp=L, L_oa=L, B=ship.B,
        T=ship.T, shape="parametric", inertia=ship.M.tolist(),
    )  # fmt: skip
    return Drawn(surface, ship.L_oa, ship.B, make_looks(name, body, surface))


def to_solid(surface: Surface) -> trimesh.Trimesh:
    """The surface with vertices at one place joined."""
    return trimesh.Trimesh(np.round(surface.vertices, 6), surface.triangles, process=True)
