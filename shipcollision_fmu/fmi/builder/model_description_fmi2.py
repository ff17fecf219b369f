"""modelDescription.xml of FMI 2.0 for co-simulation, from the table of variables.

An output of these slaves is computed in doStep and depends on no input at the same instant, so `dependencies=""`: a
master that looks for algebraic loops finds none, rightly. At the start an output does depend on parameters:
InitialUnknowns. They are named by their position among the variables, counted from 1.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any
from xml.etree.ElementTree import Element, SubElement

from ..interface import Interface
from ..variable_access import VariableAccess
from ..variables import Kind, Table, Variable
from .model_description import (
    Version,
    describe_variable,
    find_dependencies,
    format_start,
    list_limits,
    list_sources,
    open_document,
)

__all__ = ["model_description"]


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
    interface: Interface,
    ships: tuple[str, ...],
    guid: str,
    starts: Mapping[str, Any] | None = None,
    *,
    native: bool = False,
    sources: tuple[str, ...] = (),
) -> Element:
    """The whole document. `starts` are start values in place of the model's own; `native`: the FMU runs no Python, and
    may bring the files `sources` below its folder sources/."""
    access = interface.make_access(ships, starts)
    root, variables = open_document(_NATIVE if native else _VERSION, interface, guid, access)
    if sources:
        node = SubElement(next(root.iter("CoSimulation")), "SourceFiles")
        for name in sources:
            SubElement(node, "File", {"name": name})
    for reference, variable in enumerate(access.table):
        _variable(variables, reference, variable, access)
    _structure(root, access.table)
    return root


def _declare_type(
    definitions: Element, name: str, kind: Kind, attributes: Mapping[str, str], description: str
) -> Element:
    said = {"description": description} if description else {}
    return SubElement(SubElement(definitions, "SimpleType", {"name": name, **said}), kind, dict(attributes))


_VERSION = Version("2.0", "guid", _CAPABILITIES, _declare_type)
_NATIVE = replace(_VERSION, capabilities=_CAPABILITIES | {"needsExecutionTool": False})


def _variable(variables: Element, reference: int, variable: Variable, access: VariableAccess) -> None:
    attributes = describe_variable(variable.name, reference, variable.description, variable)
    node = SubElement(variables, "ScalarVariable", attributes)
    value = list_limits(variable)
    if variable.causality != "output":
        value["start"] = format_start(variable, reference, access)
    SubElement(node, variable.kind, value)


def _structure(root: Element, table: Table) -> None:
    structure = SubElement(root, "ModelStructure")
    unknowns = [(position, variable) for position, variable in enumerate(table, 1) if variable.causality == "output"]
    if not unknowns:
        return
    sources = list_sources(table)
    outputs = SubElement(structure, "Outputs")
    for position, _ in unknowns:
        SubElement(outputs, "Unknown", {"index": str(position), "dependencies": ""})
    initial = SubElement(structure, "InitialUnknowns")
    for position, variable in unknowns:
        node = SubElement(initial, "Unknown", {"index": str(position)})
        if variable.depends_on is not None:
            node.set("dependencies", " ".join(str(reference + 1) for reference in find_dependencies(variable, sources)))
