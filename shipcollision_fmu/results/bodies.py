"""bodies.json: shapes and inertias of ships and obstacles. With it a run can be shown from its folder alone.

    ships        by name: the model's name and kind, L_pp, L_oa, B, T [m], the hull's shape ("parametric" | "box" |
                 "mesh"), the inertia M_RB + M_A about CO (6, 6) [kg, kg m, kg m2], the degrees of freedom (3 | 4 | 6:
                 the inertia is in level axes for 3 and 4, else in b), the hull's surface
    obstacles    by name: kind, position of its b in n [m], heading [rad], the surface in its b

A surface is vertices (n, 3) [m], z down, and triangles (m, 3), indices from 0, counter-clockwise from outside.
It is that of the solid of the contact computation, before it is cut into convex parts.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..collision.obstacles import ObstacleTable, build_obstacle
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
    body = build_obstacle(name, table)
    return {
        "kind": body.kind,
        "position": body.position.tolist(),
        "heading": body.heading,
        **_surface(body.solid),
    }


def _surface(hull: HullMesh) -> dict[str, Any]:
    return {"vertices": hull.vertices.tolist(), "triangles": hull.triangles.tolist()}
