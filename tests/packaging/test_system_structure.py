"""Packages: SSP 1.0 against its schema, OSP against its rules, and what of a scenario they hold."""

from __future__ import annotations

import json
import re
import zipfile
from collections.abc import Callable
from itertools import pairwise
from math import radians
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from fmpy import extract, read_model_description
from fmpy.ssp.ssd import read_ssd, read_ssv
from fmpy.validation import validate_fmu

from shipcollision_fmu.errors import HostError, InputError, ScenarioError, ShipError
from shipcollision_fmu.fmi.builder import native_fmus
from shipcollision_fmu.fmi.interface import Interface
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from shipcollision_fmu.packaging.osp import build_osp_files, write_osp
from shipcollision_fmu.packaging.osp_groups import KINDS, list_collision_groups, list_ship_groups
from shipcollision_fmu.packaging.packed_ship import pack_ship
from shipcollision_fmu.packaging.ssp import build_ssp, write_ssp
from shipcollision_fmu.packaging.system_structure import TimedOrder, build_system_structure
from shipcollision_fmu.scenario.scenario import list_scenario_names, load_scenario
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.loading.library import find_models, load_ship
from shipcollision_fmu.toolchain.fmu_binaries import Binary

Write = Callable[..., Path]
OSP = "{http://opensimulationplatform.com/MSMI/OSPSystemStructure}"
GROUPS = "{https://open-simulation-platform.com/OspModelDescription/1.0.1}"
AWAY = ("position = [0.0, 0.0]", "position = [0.0, 300.0]")
"""For a target that is longer than a barge."""


def started(fmu: Path) -> dict[str, str]:
    """Start values in an FMU's modelDescription.xml."""
    return {v.name: v.start for v in read_model_description(fmu, validate=False).modelVariables if v.start is not None}


# What is in it. ------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("name", list_scenario_names())
def test_every_shipped_scenario_can_be_packaged(tmp_path: Path, name: str) -> None:
    scenario = load_scenario(name)
    write_ssp(scenario, tmp_path / "it.ssp", initial_orders=True)
    system = read_ssd(str(tmp_path / "it.ssp")).system  # validates against the schema of SSP 1.0
    assert [c.name for c in system.elements] == [*scenario.ships, "collision"]
    for component in system.elements:
        assert component.parameterBindings[0].parameterValues[0].parameters  # read_ssv validates too
    with zipfile.ZipFile(tmp_path / "it.ssp") as archive:
        archive.extractall(tmp_path)
    for instance in [*scenario.ships, "collision"]:
        if name == "guan2014":
            assert validate_fmu(str(tmp_path / "resources" / f"{instance}.fmu")) == []
        assert read_ssv(str(tmp_path / "resources" / f"{instance}.ssv")).name == "scenario"


def test_start_values_are_those_of_the_scenario(scenario_file: Write, tmp_path: Path) -> None:
    environment = "\n[environment]\ncurrent = [0.5, -0.25]\nwind = { speed = 12.0, from_deg = 270.0 }\n"
    orders = "speed = 1.0\norders = [{ time = 0.0, rudder_deg = 10.0, rev_per_s = 1.5 }]"
    ship = ('[ships.target]\nship = "./barge.toml"', '[ships.target]\nship = "kcs"\nhydrodynamics = true')
    friction = ("friction = 0.3", 'friction = 0.125\nresponse = "closed_form"\nfeedback = "force"')
    path = scenario_file(ship, AWAY, ("speed = 1.0", orders), friction, added=environment)
    assert write_osp(load_scenario(path), tmp_path / "osp")
    target, collision = started(tmp_path / "osp" / "target.fmu"), started(tmp_path / "osp" / "collision.fmu")
    assert (target["ship"], target["hydrodynamics"], target["degrees_of_freedom"]) == ("kcs", "true", "3")
    assert float(target["rudder_order"]) == radians(10.0)
    assert [float(target[v]) for v in ("propeller_order", "current.north", "current.east")] == [1.5, 0.5, -0.25]
    assert [float(target[v]) for v in ("wind.speed", "wind.direction")] == [12.0, radians(270.0)]
    assert float(target["initial.velocity.surge"]) == 1.0
    assert (float(collision["friction"]), collision["response"]) == (0.125, "2")
    assert float(collision["own.position.east"]) == -64.0  # for hosts that send nothing before the first step
    assert [collision[f"{name}.ship"] for name in ("own", "target")] == ["ships/own.toml", "kcs"]


@pytest.mark.slow
def test_a_system_can_be_packaged_twice_with_the_same_bytes(scenario_file: Write) -> None:
    scenario = load_scenario(scenario_file())
    assert build_ssp(build_system_structure(scenario)) == build_ssp(build_system_structure(scenario))


def test_three_ships_and_obstacles(scenario_file: Write, tmp_path: Path) -> None:
    third = '\n[ships.tug]\nship = "buoy"\nposition = [300.0, 0.0]\nheading_deg = 0.0\n'
    quay = '\n[obstacles.quay]\nkind = "quay"\nshape = "box"\nposition = [0.0, 400.0]\nlength = 90.0\nbreadth = 9.0\n'
    write_ssp(load_scenario(scenario_file(added=third + quay)), tmp_path / "it.ssp")
    with zipfile.ZipFile(tmp_path / "it.ssp") as archive:
        archive.extractall(tmp_path)
    start = started(tmp_path / "resources" / "collision.fmu")
    assert start["tug.ship"] == "buoy"
    assert "[quay]\n" in start["obstacles"]  # line breaks survive XML
    ssv = read_ssv(str(tmp_path / "resources" / "collision.ssv"))
    assert {p.name: p.value for p in ssv.parameters}["obstacles"] == start["obstacles"]


# Ships of the user's own. ------------------------------------------------------------------------------


def test_a_ship_file_travels_with_what_it_extends(scenario_file: Write, tmp_path: Path) -> None:
    path = scenario_file(barge=("L_pp = 100.0", "L_pp = 100.25"))
    (path.parent / "longer.toml").write_text('extends = "barge"\n[particulars]\nmass = 8.3e6\n')
    place, files = pack_ship("own", str(path.parent / "longer.toml"))
    assert list(files) == [place] == ["ships/own.toml"]
    (tmp_path / "elsewhere" / "ships").mkdir(parents=True)
    (tmp_path / "elsewhere" / place).write_bytes(files[place])
    here, there = load_ship(path.parent / "longer.toml"), load_ship(place, tmp_path / "elsewhere")
    np.testing.assert_array_equal(here.M, there.M)
    assert (there.mass, there.L_pp, there.name) == (8.3e6, 100.25, "Barge")
    assert pack_ship("own", "kcs") == ("kcs", {})


QUAY = """
[obstacles.quay]
kind = "quay"
shape = "box"
length = 400.0
breadth = 30.0
position = [0.0, 700.0]
"""


def test_ships_and_obstacles_of_a_native_system_are_prepared(
    scenario_file: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    library = Binary("linux64", ".so", b"ELF")
    monkeypatch.setattr(native_fmus, "build_binaries", lambda name, platforms: {2: [library]})
    monkeypatch.setattr(native_fmus, "list_ship_names", lambda: ["buoy"])
    monkeypatch.setattr(native_fmus, "read_bullet_licence", lambda: "zlib")
    scenario = load_scenario(str(scenario_file(added=QUAY)))
    own, _, collision = build_system_structure(scenario, native=("linux64",)).instances
    (tmp_path / "own.fmu").write_bytes(own.build_fmu())
    assert started(tmp_path / "own.fmu")["ship"] == "ships/own.ship"
    assert started(tmp_path / "own.fmu")["initial.position.east"] == repr(scenario.ships["own"].start.position[1])
    with zipfile.ZipFile(tmp_path / "own.fmu") as archive:
        names = archive.namelist()
        assert archive.read("resources/ships/own.ship") == prepare_ship(scenario.ship_file("own"))
    assert "binaries/linux64/ShipManoeuvring.so" in names
    assert not any(name.endswith((".py", ".toml")) for name in names)
    (tmp_path / "collision.fmu").write_bytes(collision.build_fmu())
    start = started(tmp_path / "collision.fmu")
    assert (start["own.ship"], start["obstacles"]) == ("ships/own.ship", "scenario.obstacles")
    with zipfile.ZipFile(tmp_path / "collision.fmu") as archive:
        names = archive.namelist()
        assert b"presets 0 1 2" in archive.read("resources/variables.txt")
        assert b'name "quay"' in archive.read("resources/scenario.obstacles")
    assert {"binaries/linux64/ShipCollision.so", "resources/ships/target.ship"} <= set(names)
    assert not any(name.endswith((".py", ".toml")) for name in names)


def test_a_response_that_needs_python_is_not_packaged_without_it() -> None:
    with pytest.raises(
        ScenarioError, match=r"\[collision\] response = 'bullet' needs Python, .*, or packages whose FMUs run Python$"
    ):
        build_system_structure(load_scenario("guan2014"), native=("linux64",))


@pytest.mark.slow
def test_a_mesh_travels_with_its_ship(tmp_path: Path) -> None:
    source = find_models() / "ships" / "mesh_example.toml"
    place, files = pack_ship("own", str(source))
    assert sorted(files) == ["ships/own.obj", "ships/own.toml"]
    for name, data in files.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(data)
    hulls = [build_hull(s.L_oa, s.B, s.T, s.hull) for s in (load_ship(source), load_ship(place, tmp_path))]
    np.testing.assert_array_equal(hulls[0].vertices, hulls[1].vertices)
    assert len(hulls[0].parts) == len(hulls[1].parts)


def test_a_mesh_that_is_missing_is_refused(tmp_path: Path) -> None:
    text = (find_models() / "ships" / "mesh_example.toml").read_text().replace("../hulls/example.obj", "gone.obj")
    (tmp_path / "ship.toml").write_text(text)
    with pytest.raises(ShipError, match=r"ship.toml: mesh file .*gone.obj cannot be read: No such file"):
        pack_ship("own", str(tmp_path / "ship.toml"))


# What it cannot hold. ------------------------------------------------------------------------------


def helm(scenario_file: Write, lines: str) -> Path:
    ship = ('[ships.target]\nship = "./barge.toml"', '[ships.target]\nship = "kcs"\nhydrodynamics = true')
    return scenario_file(ship, AWAY, ("speed = 1.0", f"speed = 1.0\n{lines}"))


@pytest.mark.parametrize(
    ("lines", "why", "in_osp"),
    [
        ("orders = [{ time = 1.0, rudder_deg = 5.0 }]", r"\[ships.target\] gives orders at 1 s", True),
        ("orders = [{ time = 0.0, heading_deg = 5.0 }]", r"\[ships.target\] steers a heading by autopilot", False),
        ("route = { waypoints = [[900.0, 0.0]] }", r"\[ships.target\] follows a route", False),
        ('evasion = { of = "own", distance = 9.0, rudder_deg = 35.0 }', r"\[ships.target\] evades own", False),
    ],
)
def test_what_a_helm_does_later_is_refused_or_left_out(
    scenario_file: Write, tmp_path: Path, empty_fmus: None, lines: str, why: str, in_osp: bool
) -> None:
    scenario = load_scenario(helm(scenario_file, lines))
    refused = f"encounter cannot be packaged whole: {why}; only our own master does this, and an .ssp file has no place"
    with pytest.raises(ScenarioError, match=refused + " for it. Take --initial-orders to hold the orders of time 0"):
        write_ssp(scenario, tmp_path / "it.ssp")
    assert not (tmp_path / "it.ssp").exists()
    if in_osp:
        assert write_osp(scenario, tmp_path / "osp")[0].startswith("Orders after time 0 are in scenario.json")
    else:
        with pytest.raises(ScenarioError, match=why):
            write_osp(scenario, tmp_path / "osp")
        assert not (tmp_path / "osp").exists()
    left_out = write_ssp(scenario, tmp_path / "it.ssp", initial_orders=True)
    assert re.fullmatch(f"Left out: {why}; the orders of time 0 are held.", left_out[0])
    with zipfile.ZipFile(tmp_path / "it.ssp") as archive:
        assert left_out[0] in archive.read("SystemStructure.ssd").decode()


def test_orders_in_time_are_a_scenario_of_libcosim(scenario_file: Write, tmp_path: Path, empty_fmus: None) -> None:
    lines = (
        "orders = [{ time = 0.0, rev_per_s = 1.0 }, { time = 0.52, rudder_deg = 5.0 }, { time = 1.0, rev_per_s = 2.0 }]"
    )
    scenario = load_scenario(helm(scenario_file, lines))
    assert build_system_structure(scenario).orders == (
        TimedOrder(0.55, "target", "rudder_order", radians(5.0)),  # the next communication point
        TimedOrder(1.0, "target", "propeller_order", 2.0),
    )
    write_osp(scenario, tmp_path)
    written = json.loads((tmp_path / "scenario.json").read_text())
    assert written["end"] == 3.0
    assert [event["time"] for event in written["events"]] == [0.55, 1.0]
    assert "scenario.json" not in build_osp_files(build_system_structure(scenario), with_orders=False)


def test_places_that_cannot_be_written(scenario_file: Write, tmp_path: Path) -> None:
    scenario = load_scenario(scenario_file())
    (tmp_path / "a_file").write_text("")
    with pytest.raises(HostError, match="it is a file; give the name of a folder"):
        write_osp(scenario, tmp_path / "a_file")
    with pytest.raises(HostError, match=r"cannot write to .*a_file"):
        write_ssp(scenario, tmp_path / "a_file" / "it.ssp")
    renamed = load_scenario(scenario_file(("[ships.own]", "[ships.collision]")))
    with pytest.raises(ScenarioError, match=r"\[ships.collision\] cannot be packaged: that is the name of the"):
        write_ssp(renamed, tmp_path / "it.ssp")


@pytest.mark.parametrize(
    ("start", "message"),
    [
        ({"friktion": 0.1}, "has no variable 'friktion'"),
        ({"friction": "high"}, "friction = 'high' is not a value of Real"),
        ({"response": "bulet"}, "response = 'bulet' is not a value of Enumeration"),
        ({"clearance": 1.0}, "clearance is an output and cannot be set"),
    ],
)
def test_start_values_that_cannot_be(start: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        COLLISION.make_access(start=start)


# What a host can see and set. ------------------------------------------------------------------------------


def connectors(ssp: Path) -> dict[str, dict[str, str]]:
    """Kind of each connector, by component."""
    system = read_ssd(str(ssp)).system
    return {one.name: {connector.name: connector.kind for connector in one.connectors} for one in system.elements}


def test_every_output_that_a_host_can_read_has_a_connector(tmp_path: Path, empty_fmus: None) -> None:
    """FMPy's SSP has no Strings, libcosim's no enumerations."""
    write_ssp(load_scenario("guan2014"), tmp_path / "it.ssp")
    found = connectors(tmp_path / "it.ssp")
    for name, interface in (("own", MANOEUVRING), ("target", MANOEUVRING), ("collision", COLLISION)):
        readable = {
            line.name for line in interface.table(("own", "target"))
            if line.causality == "output" and line.kind in ("Real", "Integer", "Boolean")
        }  # fmt: skip
        assert {one for one, kind in found[name].items() if kind == "output"} == readable
    for name in ("impact.time", "contact.count", "contact[1].gap", "energy.dissipated", "clearance"):
        assert name in found["collision"]
    for name in ("rudder_angle", "propeller_speed", "rudder.sway", "propeller.surge", "wind.sway"):
        assert name in found["own"]


def test_inputs_have_connectors_on_request(tmp_path: Path, empty_fmus: None) -> None:
    given = {"rudder_order", "propeller_order", "current.north", "current.east", "wind.speed", "wind.direction"}
    for inputs in (False, True):
        write_ssp(load_scenario("guan2014"), tmp_path / "it.ssp", inputs=inputs)
        for ship in ("own", "target"):
            assert ((connectors(tmp_path / "it.ssp")[ship].keys() & given) == given) == inputs


def test_omsimulator_finds_its_annotation_in_the_system(tmp_path: Path, empty_fmus: None) -> None:
    """Without it OMSimulator answers "[NewSystem] internal error"."""
    scenario = load_scenario("guan2014")
    write_ssp(scenario, tmp_path / "it.ssp")
    with zipfile.ZipFile(tmp_path / "it.ssp") as archive:
        text = archive.read("SystemStructure.ssd").decode()
    system = text[text.index("<ssd:System ") : text.index("</ssd:System>")]
    assert '<ssc:Annotation type="org.openmodelica">' in system
    assert f'<oms:FixedStepMaster description="oms-ma" stepSize="{scenario.step!r}"' in system
    assert 'xmlns:oms="https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd"' in text


@pytest.mark.parametrize("fmi", [2, 3])
def test_packages_of_both_versions_have_the_same_names_and_the_scenarios_experiment(
    scenario_file: Write, tmp_path: Path, fmi: int
) -> None:
    scenario = load_scenario(scenario_file())
    left_out = write_osp(scenario, tmp_path, fmi=fmi)
    assert any("libcosim" in line for line in left_out) == (fmi == 3)
    for name, interface in (("own", MANOEUVRING), ("collision", COLLISION)):
        description = read_model_description(str(tmp_path / f"{name}.fmu"))
        assert description.fmiVersion == f"{fmi}.0"
        names = [line.name for line in interface.table(("own", "target"))]
        assert [v.name for v in description.modelVariables if v.name != "time"] == names
        assert float(description.defaultExperiment.stopTime) == scenario.scenario.duration
        assert float(description.defaultExperiment.stepSize) == scenario.step


def test_what_a_user_of_osp_wants_to_plot_is_in_a_group() -> None:
    groups = [*list_ship_groups(), *list_collision_groups(("own", "target"))]
    shown = {name for group in groups for part in (group, *group.groups) for name in part.variables}
    for name in (
        "rudder_angle", "propeller_speed", "current.north", "wind.speed", "impact.count", "impact.time", "impact.angle",
        "contact.active", "contact[8].gap", "contact[8].start", "energy.dissipated", "fender.stored", "clearance",
    ):  # fmt: skip
        assert name in shown


# OSP-IS. ------------------------------------------------------------------------------


@pytest.mark.parametrize("interface", [MANOEUVRING, COLLISION], ids=lambda i: i.name)
def test_variable_groups_follow_the_rules_of_osp_is(interface: Interface, tmp_path: Path, empty_fmus: None) -> None:
    """Kinds in the schema's order, unique names, at most three variables, ports of two groups of opposite causality;
    one causality in a group; variables that there are, with their units, once each."""
    write_osp(load_scenario("guan2014"), tmp_path)
    root = ElementTree.parse(tmp_path / f"{interface.name}_OspModelDescription.xml").getroot()
    assert root.attrib == {"version": "1.0"}
    table = {variable.name: variable for variable in interface.table(("own", "target"))}
    (groups,) = root
    order = [KINDS.index(group.tag.removeprefix(GROUPS)) for group in groups]  # type: ignore[arg-type]  # XML text
    assert all(a <= b for a, b in pairwise(order))
    plain = []
    for group in groups:
        if group.tag.endswith("Port"):
            linear = "Linear" in group.tag
            first, second = group
            kinds = ("Force", "LinearVelocity") if linear else ("Torque", "AngularVelocity")
            assert (first.tag, second.tag) == tuple(GROUPS + kind for kind in kinds)
            sides = {table[part[0].attrib["ref"]].causality for part in (first, second)}
            assert sides == {"input", "output"}
            plain += [first, second]
        else:
            plain.append(group)
    names = [group.attrib["name"] for group in (*groups, *plain) if not group.tag.endswith("Port") or group in groups]
    assert len(set(names)) == len({id(group) for group in (*groups, *plain)})
    refs = [variable.attrib["ref"] for group in plain for variable in group]
    assert len(set(refs)) == len(refs)
    for group in plain:
        assert {table[v.attrib["ref"]].causality for v in group} in ({"input"}, {"output"})
        assert [v.attrib.get("unit") for v in group] == [table[v.attrib["ref"]].unit for v in group]
        if group.tag != GROUPS + "Generic":
            assert [v.attrib["axis"] for v in group] == ["x", "y", "z"][: len(group)]


@pytest.mark.parametrize("feedback", ["ledger", "force", "none"])
def test_groups_connect_what_the_system_connects(
    scenario_file: Write, tmp_path: Path, empty_fmus: None, feedback: str
) -> None:
    scenario = load_scenario(scenario_file(("friction = 0.3", f'feedback = "{feedback}"')))
    write_osp(scenario, tmp_path)
    groups = {
        "collision": list_collision_groups(tuple(scenario.ships)),
        **dict.fromkeys(scenario.ships, list_ship_groups()),
    }
    members = {
        (simulator, group.name): [v for part in (group, *group.groups) for v in part.variables]
        for simulator, found in groups.items()
        for outer in found
        for group in (outer, *outer.groups)
    }
    root = ElementTree.parse(tmp_path / "OspSystemStructure.xml").getroot()
    connected = set()
    for pair in root.findall(f"{OSP}Connections/{OSP}VariableGroupConnection"):
        (one, other) = ((end.attrib["simulator"], end.attrib["name"]) for end in pair)
        connected |= {
            frozenset(((one[0], a), (other[0], b))) for a, b in zip(members[one], members[other], strict=True)
        }
    wanted = {
        frozenset(((c.source, c.output), (c.target, c.input))) for c in build_system_structure(scenario).connections
    }
    assert connected == wanted


def test_the_fmu_runs_where_no_ship_file_is(scenario_file: Write, tmp_path: Path) -> None:
    """The barge's file travels inside: unpacked elsewhere, with the scenario gone, the FMU starts."""
    path = scenario_file()
    write_osp(load_scenario(path), tmp_path / "osp")
    (path.parent / "barge.toml").unlink()
    unpacked = Path(extract(str(tmp_path / "osp" / "own.fmu"), str(tmp_path / "unpacked")))
    start = json.loads((unpacked / "resources" / "start.json").read_text())
    access = MANOEUVRING.make_access(start=start, files=unpacked / "resources")
    access.initialise()
    access.do_step(0.0, 0.05)
    state = json.loads(json.dumps(access.save()))
    again = MANOEUVRING.make_access(files=unpacked / "resources")
    again.restore(state)
    assert again.save() == state
