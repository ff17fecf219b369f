"""The scenario file of an encounter: its comment and its tables."""

from __future__ import annotations

from math import degrees
from pathlib import Path
from typing import Any, NamedTuple

from ..scenario.tables.environment import Environment
from ..scenario.toml_writer import format_toml
from ..ship.ship_state import ShipState
from .approaching_ship import ApproachingShip
from .plan_contact import PlanContact
from .planned_impact import PlannedImpact
from .request import Kind, Request, count_steps, value_or_default
from .ship_table import build_ship_table, refer_to_ship, round_off

__all__ = ["CONTACT_LAW", "Approach", "write_encounter"]

CONTACT_LAW = {"friction": 0.3, "restitution": 0.0}
"""The table [collision] of every generated encounter: a plastic impact with friction."""


class Approach(NamedTuple):
    """Both ships with their tracks to the impact, the contact in plan and the closing speed along its normal [m/s]."""

    own: ApproachingShip
    target: ApproachingShip
    own_track: list[ShipState]
    target_track: list[ShipState]
    contact: PlanContact
    closing_speed: float


def write_encounter(
    request: Request, kind: Kind, impact: PlannedImpact, steps: int, around: Environment, approach: Approach,
    sailed: bool, directory: Path,
) -> str:  # fmt: skip
    """The text of the scenario file, in which paths of ships are relative to `directory`."""
    T, end = steps * request.step, (steps + count_steps(request.after, request.step)) * request.step
    s, angle = impact.s, f"{degrees(abs(impact.heading)):g}"
    where = (
        "target's stem" if s == 0.5 else "target's stern" if s == -0.5 else f"target's {request.side} side, s = {s:g}"
    )
    predicate = kind.words if s == kind.at or not kind.elsewhere else kind.elsewhere
    if kind.moving and request.target_speed:
        predicate = kind.moving
    comment = [
        f"Made by `shipcollision encounter {request.kind}`, backwards from the impact.",
        f"Own {predicate}.",
        *_describe_order(kind, request),
        f"Impact: at {T:g} s at n's origin, at {where}, {angle} deg between the headings,",
        f"closing at {approach.closing_speed:.3g} m/s along the normal of the target's hull.",
    ]
    tables: dict[str, dict[str, Any]] = {
        "scenario": {
            "name": request.name or f"{request.kind}-{angle}".replace("-", "_").replace(".", "_"),
            "description": f"own {predicate}: {angle} deg, at {where}.",
            "duration": round(end, 9),
            "step": request.step,
        },
        "ships.own": _ship_table(approach.own, approach.own_track[0], request.step, sailed, directory),
        "ships.target": _ship_table(approach.target, approach.target_track[0], request.step, sailed, directory),
        "collision": CONTACT_LAW,
    }
    environment = {
        "current": around.current if any(around.current) else None,
        "wind": None if around.wind is None else around.wind.model_dump(),
    }
    if any(environment.values()):
        tables["environment"] = environment
    return format_toml(comment, tables)


def _ship_table(ship: ApproachingShip, start: ShipState, step: float, sailed: bool, directory: Path) -> dict[str, Any]:
    return build_ship_table(
        refer_to_ship(ship.file, directory),
        (round_off(start.north, 5), round_off(start.east, 5)),
        round_off(degrees(start.heading), 7) % 360.0,
        round_off(start.surge, 9),
        round_off(start.sway, 9),
        hydrodynamics=sailed,
        coasting=ship.coasting,
        degrees_of_freedom=ship.degrees_of_freedom,
        orders=None if ship.orders is None else [
            {"time": round(order.k * step, 9), "rudder_deg": order.rudder_deg, "rev_per_s": order.rev_per_s}
            for order in ship.orders
        ],
    )  # fmt: skip


def _describe_order(kind: Kind, request: Request) -> list[str]:
    if not kind.helm:
        return []
    before = value_or_default(request.before, kind.before)
    rudder_deg = value_or_default(request.rudder_deg, kind.rudder_deg)
    return [f"Its rudder is ordered to {rudder_deg:g} deg {before:g} s before the impact."]
