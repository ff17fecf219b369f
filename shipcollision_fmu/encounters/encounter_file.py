"""An encounter as a scenario file."""

from __future__ import annotations

import os
from math import degrees
from pathlib import Path
from typing import Any, NamedTuple

from ..scenario.toml_writer import scenario_text
from ..ship.frames import Array
from ..ship.ship import Ship
from .approach_track import Mover, Pose
from .plan_contact import Place, Touch
from .request import Kind, Wanted, either, whole_steps

__all__ = ["Coming", "Impact", "encounter_text", "ship_reference"]


class Coming(NamedTuple):
    """What leads to the impact: own and target, their tracks, how own touches, her closing speed [m/s]."""

    own: Mover
    target: Mover
    own_track: list[Pose]
    target_track: list[Pose]
    contact: Touch
    closing_speed: float


class Impact(NamedTuple):
    """The impact seen from the target: its place, s, own's heading [rad], sections in plan by ship, their height."""

    at: Place
    s: float
    heading: float
    sections: dict[str, Array]
    deck: float
    ships: dict[str, Ship]


def ship_reference(ship: str, directory: Path) -> str:
    """How a scenario file in `directory` names a ship: a shipped name as it is, a path relative to the file."""
    if ship.endswith(".toml") or "/" in ship or "\\" in ship:
        return Path(os.path.relpath(Path(ship).resolve(), directory.resolve())).as_posix()
    return ship


def encounter_text(
    wanted: Wanted, kind: Kind, impact: Impact, steps: int, current: tuple[float, float], coming: Coming,
    sailed: bool, directory: Path,
) -> str:  # fmt: skip
    """The scenario file of an encounter for a directory."""
    T, end = steps * wanted.step, (steps + whole_steps(wanted.after, wanted.step)) * wanted.step
    s, angle = impact.s, f"{degrees(abs(impact.heading)):g}"
    where = "at her stem" if s == 0.5 else "at her stern" if s == -0.5 else f"on her {wanted.side} side, s = {s:g}"
    comment = [
        f"Made by `shipcollision encounter {wanted.kind}`, backwards from the impact.",
        *_sentence(kind, wanted).splitlines(),
        f"Impact wanted: at {T:g} s at n's origin, {where}, {angle} deg between the headings,",
        f"closing at {coming.closing_speed:.3g} m/s along the normal of the target's hull.",
    ]
    tables: dict[str, dict[str, Any]] = {
        "scenario": {
            "name": wanted.name or f"{wanted.kind}-{angle}".replace("-", "_").replace(".", "_"),
            "description": f"own {kind.words}: {angle} deg, {where}.",
            "duration": round(end, 9),
            "step": wanted.step,
        },
        "ships.own": _ship_table(coming.own, coming.own_track[0], wanted, sailed, directory),
        "ships.target": _ship_table(coming.target, coming.target_track[0], wanted, sailed, directory),
        "collision": {"friction": 0.3, "restitution": 0.0},
    }
    if any(current):
        tables["environment"] = {"current": [*current]}
    return scenario_text(comment, tables)


def _ship_table(mover: Mover, pose: Pose, wanted: Wanted, sailed: bool, directory: Path) -> dict[str, Any]:
    ahead = abs(pose.sway) < 1e-12
    orders = None
    if mover.orders is not None:
        orders = [
            {"time": round(order.k * wanted.step, 9), "rudder_deg": order.rudder_deg, "rev_per_s": order.rev_per_s}
            for order in mover.orders
        ]
    return {
        "ship": ship_reference(mover.file, directory),
        "position": [_rounded(pose.north, 5), _rounded(pose.east, 5)],
        "heading_deg": _rounded(degrees(pose.heading), 7) % 360.0,
        "speed": _rounded(pose.surge, 9) if ahead else None,
        "surge": None if ahead else _rounded(pose.surge, 9),
        "sway": None if ahead else _rounded(pose.sway, 9),
        "hydrodynamics": sailed or None,
        "degrees_of_freedom": mover.degrees_of_freedom,
        "orders": orders,
    }


def _sentence(kind: Kind, wanted: Wanted) -> str:
    helm = ""
    if kind.helm:
        before, rudder = either(wanted.before, kind.before), either(wanted.rudder_deg, kind.rudder_deg)
        helm = f"\nHer rudder is ordered to {rudder:g} deg {before:g} s before the impact."
    return f"Own {kind.words}.{helm}"


def _rounded(value: float, digits: int) -> float:
    return round(float(value), digits) + 0.0  # no -0.0
