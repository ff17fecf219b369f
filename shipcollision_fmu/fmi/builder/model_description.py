"""What modelDescription.xml has in common in FMI 2.0 and 3.0: everything before the variables, and how values are
written.

What pythonfmu leaves out and importers want: units with their SI exponents, enumerations, limits, which output depends
on what. No document has a date, so that the same sources give the same file.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import accumulate
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from ... import __version__
from ..interface import Interface
from ..slave_base import LOG_CATEGORIES
from ..units import UNITS
from ..variable_access import VariableAccess
from ..variables import Kind, Table, Variable

__all__ = [
    "Version",
    "describe_variable",
    "find_dependencies",
    "format_number",
    "format_start",
    "list_limits",
    "list_sources",
    "open_document",
    "to_bytes",
]


@dataclass(frozen=True)
class Version:
    """What a version of FMI writes in its own way before the variables: its number, the attribute with the identity of
    the build, its capabilities, and how a type begins. `units` are in use beside the table's.

    declare_type(definitions, name, kind, attributes, description) adds a type; its return value takes the items.
    """

    number: str
    identity: str
    capabilities: Mapping[str, bool]
    declare_type: Callable[[Element, str, Kind, Mapping[str, str], str], Element]
    units: tuple[str, ...] = ()
    fixed_step: str | None = None
    """Name of the attribute for the fixed internal step, if this version has one."""


def open_document(
    version: Version, interface: Interface, identity: str, access: VariableAccess
) -> tuple[Element, Element]:
    """The document up to its variables, and the empty element ModelVariables."""
    root = Element("fmiModelDescription", {
        "fmiVersion": version.number,
        "modelName": interface.name,
        version.identity: identity,
        "description": interface.description,
        "version": __version__,
        "author": "The shipcollision-fmu authors",
        "copyright": "Copyright (c) 2026 The shipcollision-fmu authors",
        "license": "MIT",
        "generationTool": f"shipcollision_fmu {__version__}",
        "variableNamingConvention": "structured",
    })  # fmt: skip
    capabilities = {name: str(able).lower() for name, able in version.capabilities.items()}
    capabilities |= _describe_internal_step(version, access)
    SubElement(root, "CoSimulation", {"modelIdentifier": interface.name, **capabilities})
    _add_units(root, access.table, *version.units)
    _add_types(root, access.table, version)
    _add_categories(root)
    SubElement(root, "DefaultExperiment", {
        "startTime": "0",
        "stopTime": format_number(interface.stop_time),
        "tolerance": format_number(interface.tolerance),
        "stepSize": format_number(interface.step_size),
    })  # fmt: skip
    return root, SubElement(root, "ModelVariables")


def to_bytes(description: Element) -> bytes:
    """The document as a file, indented."""
    indent(description)
    text = tostring(description, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'.encode()


def _add_units(root: Element, table: Table, *others: str) -> None:
    """UnitDefinitions of the units in use, and of `others`."""
    used = sorted({variable.unit for variable in table if variable.unit is not None} | set(others))
    if not used:
        return
    definitions = SubElement(root, "UnitDefinitions")
    for name in used:
        unit = UNITS[name]
        node = SubElement(definitions, "Unit", {"name": name})
        SubElement(node, "BaseUnit", unit.base)
        if unit.display is not None:
            SubElement(node, "DisplayUnit", {"name": unit.display.name, "factor": format_number(unit.display.factor)})


def _describe_internal_step(version: Version, access: VariableAccess) -> dict[str, str]:
    """The parameter `substep` at the start: a communication step that is a multiple of it is divided evenly."""
    found = [reference for reference, variable in enumerate(access.table) if variable.name == "substep"]
    if version.fixed_step is None or not found:
        return {}
    return {version.fixed_step: format_number(access.get_real(found)[0])}


def _add_categories(root: Element) -> None:
    """LogCategories."""
    categories = SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        SubElement(categories, "Category", {"name": name, "description": description})


def _add_types(root: Element, table: Table, version: Version) -> None:
    """TypeDefinitions: one for the quantity of each unit in use, one for each enumeration."""
    definitions = SubElement(root, "TypeDefinitions")
    for name in sorted({variable.unit for variable in table if variable.unit is not None} | set(version.units)):
        unit = UNITS[name]
        attributes = {"quantity": unit.quantity, "unit": name}
        if unit.display is not None:
            attributes["displayUnit"] = unit.display.name
        attributes["nominal"] = format_number(unit.nominal)
        version.declare_type(definitions, unit.quantity, "Real", attributes, "")
    for name, variable in {_type_name(variable): variable for variable in table if variable.items}.items():
        items = version.declare_type(definitions, name, "Enumeration", {}, variable.description)
        for value, item in enumerate(variable.items, 1):
            SubElement(items, "Item", {"name": item, "value": str(value)})
    if not len(definitions):
        root.remove(definitions)


def _type_name(variable: Variable) -> str:
    """`own.response` -> `OwnResponse`: a type may not be called like a variable."""
    return "".join(word[:1].upper() + word[1:] for word in variable.name.replace(".", "_").split("_"))


def describe_variable(name: str, reference: int, description: str, line: Variable) -> dict[str, str]:
    """The attributes that say what a variable is; `line` is its line of the table, or any line of an array."""
    attributes = {
        "name": name,
        "valueReference": str(reference),
        "description": description,
        "causality": line.causality,
        "variability": line.variability,
    }
    if line.causality != "input":  # FMI 2.0.4, section 2.2.7: an input has no `initial`
        attributes["initial"] = "calculated" if line.causality == "output" else "exact"
    return attributes


def list_limits(variable: Variable) -> dict[str, str]:
    """Type, unit and limits of a variable as attributes."""
    value: dict[str, str] = {}
    if variable.items:
        value["declaredType"] = _type_name(variable)
    if variable.unit is not None:  # some hosts read no types: the unit is said here as well
        value["declaredType"], value["unit"] = UNITS[variable.unit].quantity, variable.unit
        display = UNITS[variable.unit].display
        if display is not None:
            value["displayUnit"] = display.name
    for name, limit in (("min", variable.minimum), ("max", variable.maximum), ("nominal", variable.nominal)):
        if limit is not None:
            value[name] = format_number(limit) if variable.kind == "Real" else str(int(limit))
    return value


def format_start(variable: Variable, reference: int, access: VariableAccess) -> str:
    """What a fresh model holds there."""
    if variable.kind == "Real":
        return format_number(access.get_real([reference])[0])
    if variable.kind == "Boolean":
        return str(access.get_boolean([reference])[0]).lower()
    if variable.kind == "String":
        return access.get_string([reference])[0]
    return str(access.get_integer([reference])[0])


def list_sources(table: Table) -> dict[str, list[int]]:
    """Value references of parameters and inputs by name, and by each begin of a name that a dot ends."""
    found: dict[str, list[int]] = defaultdict(list)
    for reference, line in enumerate(table):
        if line.causality != "output":
            for name in accumulate(line.name.split("."), "{}.{}".format):
                found[name].append(reference)
    return dict(found)


def find_dependencies(variable: Variable, sources: Mapping[str, list[int]]) -> list[int]:
    """Value references, in order, of what an output depends on at the start; sources: those of its table. Raises
    ValueError for a name that is nowhere in the table."""
    found: set[int] = set()
    for source in variable.depends_on or ():
        if source not in sources:
            raise ValueError(f"variable {variable.name} depends on {source!r}, which is no parameter or input")
        found.update(sources[source])
    return sorted(found)


def format_number(value: float) -> str:
    """Shortest text that reads back as the same double, in the spelling of XML Schema."""
    if math.isnan(value):
        return "NaN"
    if math.isinf(value):
        return "INF" if value > 0 else "-INF"
    return repr(float(value))
