"""Variable groups of the FMUs after OSP-IS, the interface specification of the Open Simulation Platform.

A group gives its variables a common kind: a Force, a LinearVelocity, or a port of two groups. Groups of the same kind
connect in one line and in the right order. OSP-IS has no kind for an impulse, which is Generic here.

    linear_port     Force against LinearVelocity     angular_port     Torque against AngularVelocity

Schema: https://open-simulation-platform.com/OspModelDescription/1.0.1 (a name, not an address). It fixes the order of
the kinds. The axes x, y, z are forward, starboard, down in b, and north, east, down in n.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal
from xml.etree.ElementTree import Element, SubElement

from ..collision.interface import contact_point_count
from ..fmi.names import (
    APPLIED,
    ATTITUDE,
    CLEARANCE,
    CONTACT,
    CONTACT_POINT,
    CONTACT_START,
    CURRENT,
    ENERGY,
    FENDER,
    FORCE,
    HULL,
    IMPACT_EVENT,
    IMPACT_POINT,
    IMPULSE,
    MOMENT,
    NED,
    ORDERS,
    POSITION,
    POST,
    PROPELLER,
    RATE,
    RUDDER,
    STEERING,
    VELOCITY,
    WIND,
    WIND_DIRECTION,
    WIND_SPEED,
    contact_point,
    named,
)
from ..fmi.ship_collision import INTERFACE as COLLISION_INTERFACE
from ..fmi.ship_manoeuvring import INTERFACE as SHIP_INTERFACE
from ..fmi.variables import Table

__all__ = ["KINDS", "Group", "build_model_description", "connect_groups", "list_collision_groups", "list_ship_groups"]

Kind = Literal[
    "Generic", "Force", "Torque", "LinearVelocity", "AngularVelocity", "LinearDisplacement", "AngularDisplacement",
    "LinearMechanicalPort", "AngularMechanicalPort",
]  # fmt: skip
KINDS: tuple[Kind, ...] = (
    "Generic", "Force", "Torque", "LinearVelocity", "AngularVelocity", "LinearDisplacement", "AngularDisplacement",
    "LinearMechanicalPort", "AngularMechanicalPort",
)  # fmt: skip
"""All kinds, in the order that the schema requires."""
NAMESPACE = "https://open-simulation-platform.com/OspModelDescription/1.0.1"
_AXES = ("x", "y", "z")


@dataclass(frozen=True)
class Group:
    """A named group: of variables, or of groups in a port."""

    kind: Kind
    name: str
    variables: tuple[str, ...] = ()
    groups: tuple[Group, ...] = ()


def list_ship_groups() -> list[Group]:
    """The groups of ShipManoeuvring."""
    forces = {"hull": HULL, "propeller": PROPELLER, "rudder": RUDDER, "wind": WIND}
    return [
        *_list_ports("", FORCE, MOMENT, VELOCITY, RATE),
        Group("LinearDisplacement", "position", POSITION),
        Group("AngularDisplacement", "attitude", ATTITUDE),
        Group("Generic", "impulse", IMPULSE),
        Group("Generic", "impulse_applied", APPLIED),
        Group("Generic", "orders", ORDERS),
        Group("Generic", "steering", STEERING),
        Group("LinearVelocity", "current", CURRENT),
        Group("Generic", "wind", (WIND_SPEED, WIND_DIRECTION)),
        *(Group("Force", f"{origin}.force", wrench[:3]) for origin, wrench in forces.items()),
        *(Group("Torque", f"{origin}.moment", wrench[3:]) for origin, wrench in forces.items()),
    ]


def list_collision_groups(ships: Sequence[str]) -> list[Group]:
    """The groups of ShipCollision built for these ships."""
    groups = [
        Group("LinearDisplacement", "impact", IMPACT_POINT),
        Group("Generic", "impact.event", IMPACT_EVENT),
        Group("Generic", "contact", CONTACT),
        Group("Generic", "energy", (*ENERGY, *FENDER)),
        Group("Generic", "clearance", CLEARANCE),
    ]
    for k in range(1, contact_point_count(len(ships)) + 1):
        point = contact_point(k)
        groups.append(Group("LinearDisplacement", point, named(point, NED)))
        groups.append(Group("Generic", f"{point}.contact", named(point, CONTACT_POINT)))
        groups.append(Group("Generic", f"{point}.start", named(point, CONTACT_START)))
    for s in ships:
        post = f"{s}.{POST}"
        groups += [
            *_list_ports(f"{s}.", *(named(s, group) for group in (FORCE, MOMENT, VELOCITY, RATE))),
            Group("LinearDisplacement", f"{s}.position", named(s, POSITION)),
            Group("AngularDisplacement", f"{s}.attitude", named(s, ATTITUDE)),
            Group("Generic", f"{s}.impulse", named(s, IMPULSE)),
            Group("Generic", f"{s}.impulse_applied", named(s, APPLIED)),
            Group("LinearDisplacement", f"{post}.position", named(post, POSITION)),
            Group("AngularDisplacement", f"{post}.attitude", named(post, ATTITUDE)),
            Group("LinearVelocity", f"{post}.velocity", named(post, VELOCITY)),
            Group("AngularVelocity", f"{post}.rate", named(post, RATE)),
        ]
    return groups


def connect_groups(feedback: str) -> tuple[str, ...]:
    """Names of a ship's groups that connect with the collision's group SHIP.name, for a feedback."""
    if feedback == "force":
        return ("position", "attitude", "impulse_applied", "linear_port", "angular_port")
    state = ("position", "attitude", "velocity", "rate", "impulse_applied")
    return (*state, "impulse") if feedback == "ledger" else state


def build_model_description(model: str, ships: tuple[str, ...]) -> Element:
    """OspModelDescription of ShipManoeuvring or ShipCollision."""
    of_a_ship = model == SHIP_INTERFACE.name
    groups = list_ship_groups() if of_a_ship else list_collision_groups(ships)
    table = (SHIP_INTERFACE if of_a_ship else COLLISION_INTERFACE).table(ships)
    root = Element("OspModelDescription", {"version": "1.0"})
    parent = SubElement(root, "VariableGroups")
    for kind in KINDS:
        for group in groups:
            if group.kind == kind:
                _add_group(parent, group, table)
    return root


def _list_ports(
    prefix: str, force: tuple[str, ...], moment: tuple[str, ...], velocity: tuple[str, ...], rate: tuple[str, ...]
) -> list[Group]:
    return [
        Group("LinearMechanicalPort", f"{prefix}linear_port", groups=(
            Group("Force", f"{prefix}force", force), Group("LinearVelocity", f"{prefix}velocity", velocity),
        )),
        Group("AngularMechanicalPort", f"{prefix}angular_port", groups=(
            Group("Torque", f"{prefix}moment", moment), Group("AngularVelocity", f"{prefix}rate", rate),
        )),
    ]  # fmt: skip


def _add_group(parent: Element, group: Group, table: Table) -> None:
    units = {variable.name: variable.unit for variable in table}
    node = SubElement(parent, group.kind, {"name": group.name})
    for i, name in enumerate(group.variables):
        attributes = {"ref": name} if units[name] is None else {"ref": name, "unit": str(units[name])}
        if group.kind != "Generic":
            attributes["axis"] = _AXES[i]
        SubElement(node, "Variable", attributes)
    for inner in group.groups:
        _add_group(node, inner, table)
