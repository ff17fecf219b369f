"""The impact that a request describes: the place on the target, own's heading, and the sections in plan."""

from __future__ import annotations

from math import degrees, radians
from typing import NamedTuple

from ..ship.frames import Array
from ..ship.hull.hull import build_hull
from ..ship.loading.library import load_ship
from ..ship.ship import Ship
from .plan_contact import Place, cut_section, find_contact_height, locate_place
from .request import Kind, Request, value_or_default

__all__ = ["PlannedImpact", "describe_impact", "plan_impact"]


class PlannedImpact(NamedTuple):
    """An impact in the target's b.

    place      struck point with its normals          s          the same, as a fraction of the length, -0.5 to 0.5
    heading    own's, relative to the target [rad]    sections   in plan, by ship (n, 2) [m]
    deck       height of the sections, down [m]       ships      by role
    """

    place: Place
    s: float
    heading: float
    sections: dict[str, Array]
    deck: float
    ships: dict[str, Ship]


def plan_impact(request: Request, kind: Kind) -> PlannedImpact:
    """The impact of a request. Raises ShipError for a ship that cannot be loaded."""
    ships = {"own": load_ship(request.own), "target": load_ship(request.target)}
    hulls = {name: build_hull(ship.L_oa, ship.B, ship.T, ship.hull) for name, ship in ships.items()}
    deck = find_contact_height(hulls["own"], hulls["target"])
    sections = {name: cut_section(hull, deck) for name, hull in hulls.items()}
    s, angle = value_or_default(request.at, kind.at), radians(value_or_default(request.angle_deg, kind.angle_deg))
    x = ships["target"].hull.trim_x + s * ships["target"].L_oa
    place = locate_place(sections["target"], x, request.side)
    return PlannedImpact(place, s, -angle if request.side == "starboard" else angle, sections, deck, ships)


def describe_impact(request: Request, impact: PlannedImpact) -> str:
    """The beginning of a refusal: which ship does not meet which, at which place and angle."""
    where = f"s = {impact.s:g} of its" + (" end" if abs(impact.s) == 0.5 else f" {request.side} side")
    own, target = (impact.ships[role].name for role in ("own", "target"))
    return f"encounter {request.kind}: at {degrees(abs(impact.heading)):g} deg {own} does not meet {target} at {where}"
