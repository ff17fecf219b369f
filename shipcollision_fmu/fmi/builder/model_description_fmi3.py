"""modelDescription.xml of FMI 3.0 for co-simulation, from the same table of variables.

What differs from FMI 2.0 (model_description_fmi2.py): FMI 3.0 has arrays, the time is a variable, every variable is an
element of its type, and unknowns are named by value references, not by positions.

Types that pythonfmu3 cannot serve (Float32, Int8, Int16, UInt8, UInt16, UInt32, Binary, Clock) are not used, and
capabilities that it does not have are declared false. It ends the host's process when such a call comes all the same;
a host that keeps to this description has no reason to make one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any
from xml.etree.ElementTree import Element, SubElement

from ..arrays import TIME, TYPES, ArrayVariable, gather_arrays
from ..interface import Interface
from ..units import UNITS
from ..variable_access import VariableAccess
from ..variables import Kind, Table
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

_SECOND = "s"  # the unit of the time, which is not in the table
_CAPABILITIES = {
    "needsExecutionTool": True,  # a Python interpreter with the packages of resources/requirements.txt
    "canBeInstantiatedOnlyOncePerProcess": False,
    "canGetAndSetFMUState": True,
    "canSerializeFMUState": True,
    "providesDirectionalDerivatives": False,
    "providesAdjointDerivatives": False,
    "providesPerElementDependencies": False,
    "canHandleVariableCommunicationStepSize": True,
    "providesIntermediateUpdate": False,
    "mightReturnEarlyFromDoStep": False,
    "canReturnEarlyAfterIntermediateUpdate": False,
    "hasEventMode": False,
    "providesEvaluateDiscreteStates": False,
}


def model_description(
    interface: Interface,
    ships: tuple[str, ...],
    token: str,
    starts: Mapping[str, Any] | None = None,
    scalar: bool = False,
    *,
    native: bool = False,
) -> Element:
    """The whole document. `starts` are start values in place of the model's own; `scalar`: without arrays; `native`:
    the FMU runs no Python."""
    access = interface.make_access(ships, starts)
    table, gathered = access.table, gather_arrays(access.table, scalar)
    root, variables = open_document(_NATIVE if native else _VERSION, interface, token, access)
    SubElement(variables, "Float64", {
        "name": "time",
        "valueReference": str(TIME),
        "description": "End of the last step; before the first step the start of the default experiment",
        "causality": "independent",
        "variability": "continuous",
        "declaredType": UNITS[_SECOND].quantity,
        "unit": _SECOND,
    })  # fmt: skip
    for reference, array in enumerate(gathered, TIME + 1):
        _variable(variables, reference, array, access)
    _structure(root, gathered, table)
    return root


def _declare_type(
    definitions: Element, name: str, kind: Kind, attributes: Mapping[str, str], description: str
) -> Element:
    said = {"description": description} if description else {}
    return SubElement(definitions, f"{TYPES[kind]}Type", {"name": name, **said, **attributes})


_VERSION = Version(
    "3.0", "instantiationToken", _CAPABILITIES, _declare_type, (_SECOND,), fixed_step="fixedInternalStepSize"
)
_NATIVE = replace(_VERSION, capabilities=_CAPABILITIES | {"needsExecutionTool": False})


def _variable(variables: Element, reference: int, array: ArrayVariable, access: VariableAccess) -> None:
    line = array.line
    attributes = describe_variable(array.name, reference, array.description, line)
    settable, string = line.causality != "output", line.kind == "String"
    # Not of outputs: they would be computed, from ship files that may be in the FMU alone.
    starts = [format_start(access.table[scalar], scalar, access) for scalar in array.references if settable]
    if settable and not string:
        attributes["start"] = " ".join(starts)
    node = SubElement(variables, TYPES[line.kind], attributes | list_limits(line))
    for extent in array.shape:
        SubElement(node, "Dimension", {"start": str(extent)})
    if settable and string:
        for value in starts:
            SubElement(node, "Start", {"value": value})


def _structure(root: Element, gathered: tuple[ArrayVariable, ...], table: Table) -> None:
    structure = SubElement(root, "ModelStructure")
    outputs = [(i, array) for i, array in enumerate(gathered, TIME + 1) if array.line.causality == "output"]
    for reference, _ in outputs:
        SubElement(structure, "Output", {"valueReference": str(reference), "dependencies": ""})
    sources = list_sources(table)
    within = {scalar: reference for reference, array in enumerate(gathered, TIME + 1) for scalar in array.references}
    for reference, array in outputs:
        node = SubElement(structure, "InitialUnknown", {"valueReference": str(reference)})
        if array.line.depends_on is not None:
            references = sorted({within[scalar] for scalar in find_dependencies(array.line, sources)})
            node.set("dependencies", " ".join(map(str, references)))
