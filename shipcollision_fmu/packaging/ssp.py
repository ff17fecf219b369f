"""Writes a system as SSP 1.0 (System Structure and Parameterization): one .ssp file.

    SystemStructure.ssd         components, connectors, connections, units
    resources/NAME.fmu          an FMU for each instance, with the scenario's values as its start values
    resources/NAME.ssv          the same values as a parameter set, bound to the component

SSP 1.0, Modelica Association, 2019. Values of enumerations are left out of the parameter sets: SSP writes a name, FMI
2.0 a number, and libcosim ends the process over the difference. SSP has no events in time: orders after time 0 are
refused, or left out on request.
"""

from __future__ import annotations

import zipfile
from collections.abc import Mapping
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement

from .. import __version__
from ..files import check_writable, refuse_other_origin, write_file
from ..fmi.builder.zip_archive import zip_bytes
from ..fmi.names import ORDERS, SURROUNDINGS
from ..fmi.units import UNITS
from ..scenario.scenario import Scenario
from .foreign_ship import ForeignShip
from .instance import Instance
from .left_out import check_orders_fit, describe_left_out
from .system_structure import SystemStructure, build_system_structure
from .xml_file import format_document, format_value

__all__ = ["build_ssp", "write_ssp"]

NAMESPACES = {
    "ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
    "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
    "osp": "http://opensimulationplatform.com/SSP/OSPAnnotations",
    "oms": "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd",
}
_KINDS = ("Real", "Integer", "Boolean")
_TOOL = f"shipcollision_fmu {__version__}"


def write_ssp(
    scenario: Scenario,
    out: Path,
    *,
    initial_orders: bool = False,
    fmi: int = 2,
    inputs: bool = False,
    foreign: Mapping[str, ForeignShip] | None = None,
    native: tuple[str, ...] = (),
    overwrite: bool = False,
) -> tuple[str, ...]:
    """Write the scenario as the file `out` (NAME.ssp); returns sentences on what the file does not hold.

    With `initial_orders` the orders of time 0 are held and everything that a helm does later is left out. Otherwise a
    scenario with later orders, an autopilot, a route or an evasion is refused. With fmi = 3 the FMUs are for FMI 3.0.
    `inputs`: see build_ssp; `foreign` and `native`: see build_system_structure. An earlier package is replaced, a file
    of other origin only with `overwrite`. Raises ScenarioError, and HostError when the file cannot be written.
    """
    check_writable(out.parent)
    if out.is_file() and not (overwrite or _is_of_a_package(out)):
        refuse_other_origin(out.parent, (out.name,), "it is no package of this program", "file")
    system = build_system_structure(scenario, fmi, foreign, native)
    if not initial_orders:
        check_orders_fit(system, "an .ssp file", system.orders)
    left_out = describe_left_out(system, system.orders)
    write_file(out, build_ssp(system, left_out, inputs=inputs))
    return left_out


def _is_of_a_package(file: Path) -> bool:
    try:
        with zipfile.ZipFile(file) as archive:
            return b'generationTool="shipcollision_fmu ' in archive.read("SystemStructure.ssd")
    except (OSError, KeyError, zipfile.BadZipFile):
        return False


def build_ssp(system: SystemStructure, left_out: tuple[str, ...] = (), *, inputs: bool = False) -> bytes:
    """The .ssp file; the same system gives the same bytes.

    With `inputs` the orders, wind and current of each ship have connectors as well, for a host that sets or connects
    them; FMPy fails on connectors without a connection. Connectors of the system itself are refused by libcosim
    and Ecos, and confuse FMPy.
    """
    files = {"SystemStructure.ssd": _build_ssd(system, left_out, inputs)}
    for instance in system.instances:
        files[f"resources/{instance.name}.fmu"] = instance.build_fmu()
        if instance.shown:
            files[f"resources/{instance.name}.ssv"] = _build_ssv(instance)
    return zip_bytes(files)


def _build_ssd(system: SystemStructure, left_out: tuple[str, ...], inputs: bool) -> bytes:
    header = system.scenario.scenario
    root = Element("ssd:SystemStructureDescription", {
        "version": "1.0",
        "name": header.name,
        "description": " ".join((system.title, *left_out)),
        "generationTool": _TOOL,
    })  # fmt: skip
    node = SubElement(root, "ssd:System", {"name": header.name, "description": header.description})
    elements = SubElement(node, "ssd:Elements")
    for instance in system.instances:
        _add_component(elements, instance, system, inputs)
    connections = SubElement(node, "ssd:Connections")
    for c in system.connections:
        SubElement(connections, "ssd:Connection", {
            "startElement": c.source, "startConnector": c.output, "endElement": c.target, "endConnector": c.input,
        })  # fmt: skip
    _add_master(node, system.scenario)
    _add_units(root, system)
    _add_experiment(root, system.scenario)
    return format_document(root, (system.title, "", *left_out), NAMESPACES)


def _add_component(elements: Element, instance: Instance, system: SystemStructure, inputs: bool) -> None:
    """Connectors are all outputs, so that a host can show and connect them, and the connected inputs: FMPy fails on
    others. A String has no place in FMPy's SSP, an enumeration none in libcosim's."""
    node = SubElement(elements, "ssd:Component", {
        "name": instance.name,
        "description": instance.interface.description,
        "type": "application/x-fmu-sharedlibrary",
        "source": f"resources/{instance.name}.fmu",
        "implementation": "CoSimulation",
    })  # fmt: skip
    connectors = SubElement(node, "ssd:Connectors")
    used = _find_connected(instance, system)
    if inputs:
        used |= {*ORDERS, *SURROUNDINGS}
    for variable in instance.table:
        if variable.name in used or (variable.causality == "output" and variable.kind in _KINDS):
            connector = SubElement(connectors, "ssd:Connector", {"name": variable.name, "kind": variable.causality})
            unit = {} if variable.unit is None else {"unit": variable.unit}
            SubElement(connector, f"ssc:{variable.kind}", unit)
    if not instance.shown:
        return
    bindings = SubElement(node, "ssd:ParameterBindings")
    SubElement(bindings, "ssd:ParameterBinding", {
        "type": "application/x-ssp-parameter-set", "source": f"resources/{instance.name}.ssv",
    })  # fmt: skip


def _find_connected(instance: Instance, system: SystemStructure) -> set[str]:
    return {c.output for c in system.connections if c.source == instance.name} | {
        c.input for c in system.connections if c.target == instance.name
    }


def _add_units(root: Element, system: SystemStructure) -> None:
    used = {
        variable.unit
        for instance in system.instances
        for variable in instance.table
        if variable.unit is not None and variable.causality != "parameter"
    }
    units = SubElement(root, "ssd:Units")
    for name in sorted(used):
        node = SubElement(units, "ssc:Unit", {"name": name})
        SubElement(node, "ssc:BaseUnit", UNITS[name].base)


def _add_master(node: Element, scenario: Scenario) -> None:
    """OMSimulator takes a system for one of FMUs with a fixed step only with this annotation of its own."""
    annotations = SubElement(node, "ssd:Annotations")
    annotation = SubElement(annotations, "ssc:Annotation", {"type": "org.openmodelica"})
    information = SubElement(SubElement(annotation, "oms:Annotations"), "oms:SimulationInformation")
    SubElement(information, "oms:FixedStepMaster", {
        "description": "oms-ma", "stepSize": format_value(scenario.step), "absoluteTolerance": "0.0001",
        "relativeTolerance": "0.0001",
    })  # fmt: skip


def _add_experiment(root: Element, scenario: Scenario) -> None:
    """SSP has no place for a communication step; libcosim reads it from an annotation of its own."""
    experiment = SubElement(root, "ssd:DefaultExperiment", {
        "startTime": "0.0", "stopTime": format_value(scenario.scenario.duration),
    })  # fmt: skip
    annotations = SubElement(experiment, "ssd:Annotations")
    annotation = SubElement(annotations, "ssc:Annotation", {"type": "com.opensimulationplatform"})
    algorithm = SubElement(annotation, "osp:Algorithm")
    SubElement(algorithm, "osp:FixedStepAlgorithm", {"baseStepSize": format_value(scenario.step)})


def _build_ssv(instance: Instance) -> bytes:
    root = Element("ssv:ParameterSet", {"version": "1.0", "name": "scenario", "generationTool": _TOOL})
    parameters = SubElement(root, "ssv:Parameters")
    for variable, value in instance.list_shown_values():
        if not variable.items:
            parameter = SubElement(parameters, "ssv:Parameter", {"name": variable.name})
            SubElement(parameter, f"ssv:{variable.kind}", {"value": format_value(value)})
    only_there = [f"{variable.name} = {value}" for variable, value in instance.list_shown_values() if variable.items]
    comment = [f"Start values of {instance.name}. Its FMU has the same start values, for hosts that ignore this file."]
    if only_there:
        comment.append(f"Enumerations are in the FMU alone, as numbers: {', '.join(only_there)}.")
    return format_document(root, comment, {key: NAMESPACES[key] for key in ("ssv", "ssc")})
