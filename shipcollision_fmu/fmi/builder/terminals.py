"""terminalsAndIcons/terminalsAndIcons.xml of FMI 3.0: what belongs together, so that a host connects it in one line.

    ShipCollision       a terminal for each ship, by its name
    ShipManoeuvring     the terminal `collision`

Both ends have members of the same names: the state of the ship one way, impulse, force and moment the other. An
integrator of a ship model of his own takes the members that `feedback` needs.
"""

from __future__ import annotations

from collections.abc import Mapping
from xml.etree.ElementTree import Element, SubElement

from ..arrays import gather_arrays
from ..names import APPLIED, FORCE, IMPULSE, MOMENT, STATE
from ..variables import Table

__all__ = ["describe_terminals"]

_MEMBERS = (*STATE, *APPLIED, *IMPULSE, *FORCE, *MOMENT)
_SIZE = "100"
"""Half the side of the icon in units of its coordinate system."""


def describe_terminals(table: Table, terminals: Mapping[str, str], scalar: bool = False) -> Element:
    """The document. terminals: how the names of a terminal's variables begin, by its name; `scalar`: without arrays."""
    root = Element("fmiTerminalsAndIcons", {"fmiVersion": "3.0"})
    graphics = SubElement(root, "GraphicalRepresentation")
    corners = {"x1": f"-{_SIZE}", "y1": f"-{_SIZE}", "x2": _SIZE, "y2": _SIZE}
    SubElement(graphics, "CoordinateSystem", {**corners, "suggestedScalingFactorTo_mm": "0.1"})
    SubElement(graphics, "Icon", corners)
    if terminals:
        parent = SubElement(root, "Terminals")
        for name, prefix in terminals.items():
            _add_terminal(parent, table, name, prefix, scalar)
    return root


def _add_terminal(parent: Element, table: Table, name: str, prefix: str, scalar: bool) -> None:
    node = SubElement(parent, "Terminal", {
        "name": name, "matchingRule": "plug", "terminalKind": "shipcollision.ship",
        "description": "State of a ship, and what contact does to it",
    })  # fmt: skip
    names = {f"{prefix}{member}" for member in _MEMBERS}
    for variable in gather_arrays(table, scalar):
        if names.issuperset(table[reference].name for reference in variable.references):
            member = variable.name.removeprefix(prefix)
            SubElement(node, "TerminalMemberVariable", {
                "variableName": variable.name, "memberName": member, "variableKind": "signal",
            })  # fmt: skip
