"""A system as a folder for the Open Simulation Platform (libcosim, cosim).

    OspSystemStructure.xml              simulators, initial values, connections of variable groups
    NAME.fmu                            an FMU for each instance, with the scenario's values as its start values
    MODEL_OspModelDescription.xml       the variable groups of both models
    scenario.json                       orders after time 0, where there are any: for libcosim's scenario manager

Initial values of enumerations are left out, libcosim refuses them; the FMU's start values hold them. A heading
autopilot, a route or an evasion has no place in it: such a scenario is refused, or that is left out on request.
"""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree.ElementTree import Comment, Element, SubElement

from ..errors import HostError
from ..files import check_writable, write_files
from ..scenario.scenario import Scenario
from .left_out import notes, refuse_orders
from .osp_groups import NAMESPACE, group_pairs, model_description
from .system_structure import COLLISION, Instance, SystemStructure, system_structure
from .xml_file import xml_bytes, xml_value

__all__ = ["osp_files", "write_osp"]

SYSTEM_NAMESPACE = "http://opensimulationplatform.com/MSMI/OSPSystemStructure"
SCENARIO_FILE = "scenario.json"


def write_osp(scenario: Scenario, out: Path, *, initial_orders: bool = False) -> tuple[str, ...]:
    """Write the scenario into the folder `out`, and return what it does not hold, a line each.

    With `initial_orders` the orders of time 0 are held and everything that a helm does later is left out; else orders
    in time go into scenario.json, and a scenario with more than that is refused. Raises ScenarioError, and HostError
    when the folder cannot be written.
    """
    if out.is_file():
        raise HostError(f"cannot write to {out}: it is a file; give the name of a folder with --out")
    check_writable(out)
    system = system_structure(scenario)
    if not initial_orders:
        refuse_orders(system, "an OSP system", ())
    left_out = list(notes(system, system.orders if initial_orders else ()))
    if system.orders and not initial_orders:
        left_out.insert(0, f"Orders after time 0 are in {SCENARIO_FILE}: load it into the host as its scenario.")
    write_files(out, osp_files(system, tuple(left_out), with_orders=not initial_orders))
    return tuple(left_out)


def osp_files(
    system: SystemStructure, left_out: tuple[str, ...] = (), *, with_orders: bool = True
) -> dict[str, str | bytes]:
    """The files of the folder by name; the same system gives the same bytes."""
    files: dict[str, str | bytes] = {"OspSystemStructure.xml": _system(system, left_out)}
    for instance in system.instances:
        files[f"{instance.name}.fmu"] = instance.fmu()
        files[f"{instance.model}_OspModelDescription.xml"] = xml_bytes(
            model_description(instance.model, instance.ships),
            (f"Variable groups of {instance.model}.fmu after OSP-IS.",),
            {"": NAMESPACE},
        )
    if system.orders and with_orders:
        files[SCENARIO_FILE] = _orders(system)
    return files


def _system(system: SystemStructure, left_out: tuple[str, ...]) -> bytes:
    scenario = system.scenario
    root = Element("OspSystemStructure", {"version": "0.1"})
    SubElement(root, "StartTime").text = "0.0"
    SubElement(root, "EndTime").text = xml_value(scenario.scenario.duration)
    SubElement(root, "BaseStepSize").text = xml_value(scenario.step)
    SubElement(root, "Algorithm").text = "fixedStep"
    simulators = SubElement(root, "Simulators")
    for instance in system.instances:
        _simulator(simulators, instance)
    connections = SubElement(root, "Connections")
    for name in scenario.ships:
        for group in group_pairs(scenario.collision.feedback or "ledger"):
            node = SubElement(connections, "VariableGroupConnection")
            SubElement(node, "VariableGroup", {"simulator": name, "name": group})
            SubElement(node, "VariableGroup", {"simulator": COLLISION, "name": f"{name}.{group}"})
    return xml_bytes(root, (system.title, "", *left_out), {"": SYSTEM_NAMESPACE})


def _simulator(simulators: Element, instance: Instance) -> None:
    node = SubElement(simulators, "Simulator", {"name": instance.name, "source": f"{instance.name}.fmu"})
    values = SubElement(node, "InitialValues")
    for variable, value in instance.shown_values():
        if variable.items:
            values.append(Comment(f" {variable.name} = {value}: in the FMU alone "))
        else:
            initial = SubElement(values, "InitialValue", {"variable": variable.name})
            SubElement(initial, variable.kind, {"value": xml_value(value)})


def _orders(system: SystemStructure) -> str:
    """libcosim's scenario: an override holds until the next one of the same variable."""
    events = [
        {"time": o.time, "model": o.ship, "variable": o.variable, "action": "override", "value": o.value}
        for o in system.orders
    ]
    scenario = {"description": system.title, "events": events, "end": system.scenario.scenario.duration}
    return json.dumps(scenario, indent=1) + "\n"
