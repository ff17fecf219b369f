"""What the live page draws: the ships at the start as scene.glb, and their data as the replay page has it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ...fmi.names import STATE
from ...results.bodies import build_bodies
from ...scenario.scenario import Scenario
from ...ship.ship import Ship
from ...show.gltf.gltf import build_glb
from ...show.page import describe_ship
from ...show.scene.run_folder import Bodies, Events, RunFolder, Summary
from ...show.scene.scene import Scene, build_scene
from ..session.ship_limits import find_limits

__all__ = ["build_live_scene", "describe_ships", "write_glb"]


def build_live_scene(scenario: Scenario, ships: dict[str, Ship]) -> Scene:
    """The scene of a run in which nothing has moved yet."""
    starts = [table.start for table in scenario.ships.values()]
    state = np.array([[*s.position, *s.attitude, *s.velocity, *s.rate] for s in starts]).reshape(1, -1, len(STATE))
    free = {name: table.free for name, table in scenario.ships.items()}
    times = np.array([0.0, 1.0])
    still = {"clearance": np.zeros(2), "energy.dissipated": np.zeros(2)}
    return build_scene(
        RunFolder(
            Path(), times, np.repeat(state, 2, axis=0), still,
            {name: np.zeros(0) for name in ("time", "scratch", "impulse_normal", "impulse_tangential", "energy")},
            Events(collisions=[], scratches=[]),
            Bodies.model_validate(build_bodies(ships, free, scenario.obstacles)),
            Summary(scenario=scenario.name, description=scenario.scenario.description, steps=1),
        )
    )  # fmt: skip


def write_glb(scene: Scene) -> bytes:
    """The bytes of scene.glb."""
    return build_glb(scene)


def describe_ships(scenario: Scenario, ships: dict[str, Ship], scene: Scene) -> list[dict[str, Any]]:
    """A ship each: what the replay page knows of it, what it can be ordered to do (`limits`, None: nothing), and
    whether it follows a recording."""
    return [
        {
            **describe_ship(i, ship),
            "L_pp": ship.L_pp,
            "B": ship.B,
            "T": ship.T,
            "limits": _limits(scenario, ships, ship.name),
            "recorded": scenario.ships[ship.name].track is not None,
        }
        for i, ship in enumerate(scene.ships)
    ]


def _limits(scenario: Scenario, ships: dict[str, Ship], name: str) -> dict[str, Any] | None:
    limits = find_limits(ships[name], bool(scenario.ships[name].hydrodynamics))
    if limits is None:
        return None
    return {
        "rudder_deg": limits.rudder_deg,
        "ahead": limits.ahead,
        "astern": limits.astern,
        "telegraph": limits.list_telegraph(),
    }
