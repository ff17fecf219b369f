"""Writes a system as a folder for the Open Simulation Platform (libcosim, cosim).

    OspSystemStructure.xml              simulators, initial values, connections of variable groups
    NAME.fmu                            an FMU for each instance, with the scenario's values as its start values
    MODEL_OspModelDescription.xml       the variable groups of both models
    scenario.json                       orders after time 0, where there are any: for libcosim's scenario manager

Initial values of enumerations are left out because libcosim refuses them; the FMU's start values hold them. An OSP
system has no place for a heading autopilot, a route or an evasion: a scenario with one of these is refused, or packaged
without it on request.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from xml.etree.ElementTree import Comment, Element, SubElement

from ..errors import HostError
from ..files import check_writable, refuse_other_origin, write_files
from ..fmi.ship_collision import INTERFACE as COLLISION_INTERFACE
from ..fmi.ship_manoeuvring import INTERFACE as SHIP_INTERFACE
from ..scenario.scenario import Scenario
from .foreign_ship import ForeignShip
from .instance import COLLISION, Instance
from .left_out import check_orders_fit, describe_left_out
from .osp_groups import NAMESPACE, build_model_description, connect_groups
from .system_structure import SystemStructure, build_system_structure
from .xml_file import format_document, format_value

__all__ = ["build_osp_files", "write_osp"]

SYSTEM_NAMESPACE = "http://opensimulationplatform.com/MSMI/OSPSystemStructure"
SYSTEM_FILE = "OspSystemStructure.xml"
SCENARIO_FILE = "scenario.json"
SIGN = "Written by shipcollision_fmu."
"""Line of the system's comment by which a folder of this program is known, which may be replaced."""


def write_osp(
    scenario: Scenario,
    out: Path,
    *,
    initial_orders: bool = False,
    fmi: int = 2,
    foreign: Mapping[str, ForeignShip] | None = None,
    native: tuple[str, ...] = (),
    overwrite: bool = False,
) -> tuple[str, ...]:
    """Write the scenario into the folder `out`; returns sentences on what the folder does not hold.

    With `initial_orders` the orders of time 0 are held and everything that a helm does later is left out. Otherwise
    later orders go into scenario.json, and an autopilot, a route or an evasion is refused. With fmi = 3 the FMUs are
    for FMI 3.0; `foreign` and `native`: see build_system_structure. Files of an earlier package are replaced, files of
    other origin only with `overwrite`. Raises ScenarioError, and HostError when the folder cannot be written.
    """
    if out.is_file():
        raise HostError(f"cannot write to {out}: it is a file; give the name of a folder with --out")
    check_writable(out)
    system = build_system_structure(scenario, fmi, foreign, native)
    if not initial_orders:
        check_orders_fit(system, "an OSP system", ())
    left_out = list(describe_left_out(system, system.orders if initial_orders else ()))
    if fmi == 3:
        left_out.insert(0, "libcosim 0.0.6 loads FMUs of FMI 2.0 alone; these are for hosts that read both.")
    if system.orders and not initial_orders:
        left_out.insert(0, f"Orders after time 0 are in {SCENARIO_FILE}: load it into the host as its scenario.")
    files = build_osp_files(system, tuple(left_out), with_orders=not initial_orders)
    if not (overwrite or _is_of_a_package(out / SYSTEM_FILE)):
        refuse_other_origin(out, files, f"no package of this program has its {SYSTEM_FILE} there")
    write_files(out, files)
    return tuple(left_out)


def build_osp_files(
    system: SystemStructure, left_out: tuple[str, ...] = (), *, with_orders: bool = True
) -> dict[str, str | bytes]:
    """The files of the folder by name; the same system gives the same bytes."""
    files: dict[str, str | bytes] = {SYSTEM_FILE: _build_system(system, left_out)}
    for instance in system.instances:
        files[f"{instance.name}.fmu"] = instance.build_fmu()
        if instance.model not in (SHIP_INTERFACE.name, COLLISION_INTERFACE.name):
            continue  # a foreign ship has no groups
        files[f"{instance.model}_OspModelDescription.xml"] = format_document(
            build_model_description(instance.model, instance.ships),
            (f"Variable groups of {instance.model}.fmu after OSP-IS.",),
            {"": NAMESPACE},
        )
    if system.orders and with_orders:
        files[SCENARIO_FILE] = _format_orders(system)
    return files


def _is_of_a_package(file: Path) -> bool:
    try:
        return SIGN.encode() in file.read_bytes()
    except OSError:
        return False


def _build_system(system: SystemStructure, left_out: tuple[str, ...]) -> bytes:
    scenario = system.scenario
    root = Element("OspSystemStructure", {"version": "0.1"})
    SubElement(root, "StartTime").text = "0.0"
    SubElement(root, "EndTime").text = format_value(scenario.scenario.duration)
    SubElement(root, "BaseStepSize").text = format_value(scenario.step)
    SubElement(root, "Algorithm").text = "fixedStep"
    simulators = SubElement(root, "Simulators")
    for instance in system.instances:
        _add_simulator(simulators, instance)
    connections = SubElement(root, "Connections")
    grouped = [name for name in scenario.ships if name not in system.replaced]
    for c in system.connections:
        if not {c.source, c.target} & set(grouped):
            node = SubElement(connections, "VariableConnection")
            SubElement(node, "Variable", {"simulator": c.source, "name": c.output})
            SubElement(node, "Variable", {"simulator": c.target, "name": c.input})
    for name in grouped:
        for group in connect_groups(scenario.collision.feedback or "ledger"):
            node = SubElement(connections, "VariableGroupConnection")
            SubElement(node, "VariableGroup", {"simulator": name, "name": group})
            SubElement(node, "VariableGroup", {"simulator": COLLISION, "name": f"{name}.{group}"})
    return format_document(root, (system.title, SIGN, "", *left_out), {"": SYSTEM_NAMESPACE})


def _add_simulator(simulators: Element, instance: Instance) -> None:
    node = SubElement(simulators, "Simulator", {"name": instance.name, "source": f"{instance.name}.fmu"})
    values = SubElement(node, "InitialValues")
    for variable, value in instance.list_shown_values():
        if variable.items:
            values.append(Comment(f" {variable.name} = {value}: in the FMU alone "))
        else:
            initial = SubElement(values, "InitialValue", {"variable": variable.name})
            SubElement(initial, variable.kind, {"value": format_value(value)})


def _format_orders(system: SystemStructure) -> str:
    """libcosim's scenario in JSON: an override holds until the next override of the same variable."""
    events = [
        {"time": o.time, "model": o.ship, "variable": o.variable, "action": "override", "value": o.value}
        for o in system.orders
    ]
    scenario = {"description": system.title, "events": events, "end": system.scenario.scenario.duration}
    return json.dumps(scenario, indent=1) + "\n"
