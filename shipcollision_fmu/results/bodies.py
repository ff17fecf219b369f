"""bodies.json: what the ships and obstacles of a run look like and weigh, so that the run's folder needs nothing else.

    ships        by name: the model's name and kind, L_pp, L_oa, B, T [m], the hull's shape ("parametric" | "box" |
                 "mesh"), the inertia M_RB + M_A about CO in b (6, 6) [kg, kg m, kg m2], the degrees of freedom
                 (3 | 4 | 6) that say of which motions it is (ship/kinetic_energy.py), the hull's surface
    obstacles    by name: kind, position of its b in n [m], heading [rad], its surface in its b

A surface is vertices (n, 3) [m], z down, and triangles (m, 3), indices from 0, counter-clockwise seen from outside:
that of the very solid which contact is computed with, before it is cut into convex parts.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..collision.obstacles import ObstacleTable, obstacle
from ..ship.hull.hull import build_hull
from ..ship.hull.solid import HullMesh
from ..ship.ship import Ship

__all__ = ["build_bodies"]


def build_bodies(
    ships: Mapping[str, Ship], free: Mapping[str, int], obstacles: Mapping[str, ObstacleTable]
) -> dict[str, Any]:
    """{"ships": {...}, "obstacles": {...}} as JSON-able data; `free` are the ships' degrees of freedom."""
    return {
        "ships": {name: _ship(ship, free[name]) for name, ship in ships.items()},
        "obstacles": {name: _obstacle(name, table) for name, table in obstacles.items()},
    }


def _ship(ship: Ship, degrees_of_freedom: int) -> dict[str, Any]:
    return {
        "ship": ship.name,
        "kind": ship.kind,
        **{key: float(getattr(ship, key)) for key in ("L_pp", "L_oa", "B", "T")},
        "shape": ship.hull.shape,
        "inertia": ship.M.tolist(),
        "degrees_of_freedom": degrees_of_freedom,
        **_surface(build_hull(ship.L_oa, ship.B, ship.T, ship.hull)),
    }


def _obstacle(name: str, table: ObstacleTable) -> dict[str, Any]:
    body = obstacle(name, table)
    return {
        "kind": body.kind,
        "position": body.position.tolist(),
        "heading": body.heading,
        **_surface(body.solid),
    }


def _surface(hull: HullMesh) -> dict[str, Any]:
    return {"vertices": hull.vertices.tolist(), "triangles": hull.triangles.tolist()}
