"""modelDescription.xml of FMI 2.0 for co-simulation, from the table of variables.

What pythonfmu leaves out and importers want: units with their SI exponents, enumerations, limits, which output
depends on what. An output of these slaves is computed in doStep and depends on no input at the same instant, so
`dependencies=""`: a master that looks for algebraic loops finds none, rightly. At the start an output does depend on
parameters: InitialUnknowns.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from ... import __version__
from ..interface import Interface
from ..slave_base import LOG_CATEGORIES
from ..units import UNITS
from ..variable_access import Ports
from ..variables import Table, Variable

__all__ = [
    "add_categories", "add_types", "add_units", "known", "limits", "model_description", "number",
    "start", "to_bytes", "type_name",
]  # fmt: skip

_CAPABILITIES = {
    "needsExecutionTool": True,  # a Python interpreter with the packages of resources/requirements.txt
    "canHandleVariableCommunicationStepSize": True,
    "canInterpolateInputs": False,
    "canBeInstantiatedOnlyOncePerProcess": False,
    "canNotUseMemoryManagementFunctions": True,
    "canGetAndSetFMUstate": True,
    "canSerializeFMUstate": True,
}


def model_description(
    interface: Interface, ships: tuple[str, ...], guid: str, starts: Mapping[str, Any] | None = None
) -> Element:
    """The whole document. Without a date, so that the same sources give the same file.

    `starts` are start values in place of the model's own.
    """
    ports = interface.ports(ships, starts)
    table = ports.table
    root = Element("fmiModelDescription", {
        "fmiVersion": "2.0",
        "modelName": interface.name,
        "guid": guid,
        "description": interface.description,
        "version": __version__,
        "license": "MIT",
        "generationTool": f"shipcollision_fmu {__version__}",
        "variableNamingConvention": "structured",
    })  # fmt: skip
    capabilities = {name: str(able).lower() for name, able in _CAPABILITIES.items()}
    SubElement(root, "CoSimulation", {"modelIdentifier": interface.name, **capabilities})
    add_units(root, table)
    add_types(root, table, _enumeration)
    add_categories(root)
    SubElement(root, "DefaultExperiment", {"startTime": "0", "stepSize": number(interface.step_size)})
    variables = SubElement(root, "ModelVariables")
    for reference, variable in enumerate(table):
        _variable(variables, reference, variable, ports)
    _structure(root, table)
    return root


def to_bytes(description: Element) -> bytes:
    """The document as a file, indented."""
    indent(description)
    text = tostring(description, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'.encode()


def add_units(root: Element, table: Table, *others: str) -> None:
    """UnitDefinitions of the units in use, and of `others`; the same in FMI 2.0 and 3.0."""
    used = sorted({variable.unit for variable in table if variable.unit is not None} | set(others))
    if not used:
        return
    definitions = SubElement(root, "UnitDefinitions")
    for name in used:
        unit = UNITS[name]
        node = SubElement(definitions, "Unit", {"name": name})
        base = {exponent: str(power) for exponent, power in unit.exponents.items()}
        SubElement(node, "BaseUnit", base if unit.factor == 1.0 else {**base, "factor": number(unit.factor)})
        for display in unit.display:
            SubElement(node, "DisplayUnit", {"name": display.name, "factor": number(display.factor)})


def add_categories(root: Element) -> None:
    """LogCategories; the same in FMI 2.0 and 3.0."""
    categories = SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        SubElement(categories, "Category", {"name": name, "description": description})


def add_types(root: Element, table: Table, enumeration: Callable[[Element, str, Variable], Element]) -> None:
    """TypeDefinitions of the enumerations; `enumeration` adds one and returns the element that takes its items."""
    enumerations = {type_name(variable): variable for variable in table if variable.items}
    if not enumerations:
        return
    definitions = SubElement(root, "TypeDefinitions")
    for name, variable in enumerations.items():
        items = enumeration(definitions, name, variable)
        for value, item in enumerate(variable.items, 1):
            SubElement(items, "Item", {"name": item, "value": str(value)})


def _enumeration(definitions: Element, name: str, variable: Variable) -> Element:
    simple = SubElement(definitions, "SimpleType", {"name": name, "description": variable.description})
    return SubElement(simple, "Enumeration")


def type_name(variable: Variable) -> str:
    """`own.response` -> `OwnResponse`: a type may not be called like a variable."""
    return "".join(word[:1].upper() + word[1:] for word in variable.name.replace(".", "_").split("_"))


def _variable(variables: Element, reference: int, variable: Variable, ports: Ports) -> None:
    attributes = {
        "name": variable.name,
        "valueReference": str(reference),
        "description": variable.description,
        "causality": variable.causality,
        "variability": variable.variability,
    }
    if variable.causality != "input":  # FMI 2.0.4, section 2.2.7: an input has no `initial`
        attributes["initial"] = "calculated" if variable.causality == "output" else "exact"
    node = SubElement(variables, "ScalarVariable", attributes)
    value = limits(variable)
    if variable.causality != "output":
        value["start"] = start(variable, reference, ports)
    SubElement(node, variable.kind, value)


def limits(variable: Variable) -> dict[str, str]:
    """Type, unit and limits of a variable as attributes; the same in FMI 2.0 and 3.0."""
    value: dict[str, str] = {}
    if variable.items:
        value["declaredType"] = type_name(variable)
    if variable.unit is not None:
        value["unit"] = variable.unit
        if UNITS[variable.unit].display:
            value["displayUnit"] = UNITS[variable.unit].display[0].name
    for name, limit in (("min", variable.minimum), ("max", variable.maximum), ("nominal", variable.nominal)):
        if limit is not None:
            value[name] = number(limit) if variable.kind == "Real" else str(int(limit))
    return value


def start(variable: Variable, reference: int, ports: Ports) -> str:
    """What a fresh model holds there."""
    if variable.kind == "Real":
        return number(ports.get_real([reference])[0])
    if variable.kind == "Boolean":
        return str(ports.get_boolean([reference])[0]).lower()
    if variable.kind == "String":
        return ports.get_string([reference])[0]
    return str(ports.get_integer([reference])[0])


def _structure(root: Element, table: Table) -> None:
    structure = SubElement(root, "ModelStructure")
    unknowns = [(position, variable) for position, variable in enumerate(table, 1) if variable.causality == "output"]
    if not unknowns:
        return
    outputs = SubElement(structure, "Outputs")
    for position, _ in unknowns:
        SubElement(outputs, "Unknown", {"index": str(position), "dependencies": ""})
    initial = SubElement(structure, "InitialUnknowns")
    for position, variable in unknowns:
        node = SubElement(initial, "Unknown", {"index": str(position)})
        if variable.depends_on is not None:
            node.set("dependencies", " ".join(map(str, known(variable, table))))


def known(variable: Variable, table: Table) -> Iterable[int]:
    """Positions, from 1, of what a variable depends on at the start. Raises ValueError for a name that is nowhere in
    the table."""
    known: set[int] = set()
    for wanted in variable.depends_on or ():
        found = {
            position
            for position, other in enumerate(table, 1)
            if other.causality != "output" and (other.name == wanted or other.name.startswith(f"{wanted}."))
        }
        if not found:
            raise ValueError(f"variable {variable.name} depends on {wanted!r}, which is no parameter or input")
        known |= found
    return sorted(known)


def number(value: float) -> str:
    """Shortest text that reads back as the same double, in the spelling of XML Schema."""
    if math.isnan(value):
        return "NaN"
    if math.isinf(value):
        return "INF" if value > 0 else "-INF"
    return repr(float(value))
