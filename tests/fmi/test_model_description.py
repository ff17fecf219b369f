"""modelDescription.xml, as an importer reads it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import ModuleType
from xml.etree import ElementTree

import fmpy
import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu
from lxml import etree

from shipcollision_fmu.fmi.arrays import gather_arrays
from shipcollision_fmu.fmi.builder.model_description import to_bytes
from shipcollision_fmu.fmi.builder.model_description_fmi2 import model_description
from shipcollision_fmu.fmi.builder.package import VERSIONS
from shipcollision_fmu.fmi.builder.terminals import describe_terminals
from shipcollision_fmu.fmi.interface import SHIPS, Interface
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from shipcollision_fmu.fmi.variables import real


def test_fmpy_reports_no_problem(dummy_fmu: Path) -> None:
    assert validate_fmu(str(dummy_fmu)) == []


def test_capabilities(dummy_fmu: Path) -> None:
    able = read_model_description(str(dummy_fmu)).coSimulation
    assert able.canGetAndSetFMUstate
    assert able.canSerializeFMUstate
    assert able.canHandleVariableCommunicationStepSize
    assert able.needsExecutionTool
    assert not able.canBeInstantiatedOnlyOncePerProcess


def test_variables_are_those_of_the_table(dummy_fmu: Path, dummy: ModuleType) -> None:
    seen = read_model_description(str(dummy_fmu)).modelVariables
    assert [(v.name, v.valueReference, v.type, v.causality, v.unit) for v in seen] == [
        (line.name, reference, line.kind, line.causality, line.unit) for reference, line in enumerate(dummy.TABLE)
    ]
    assert {v.name: [item.name for item in v.declaredType.items] for v in seen if v.type == "Enumeration"} == {
        "phase": ["rest", "roll", "slide"],
        "method": ["pgs", "closed_form", "bullet"],
    }
    gain = next(v for v in seen if v.name == "gain.first")
    assert (gain.min, gain.nominal, gain.displayUnit) == ("-1e+300", "0.1", "deg/s")
    count = next(v for v in seen if v.name == "count")
    assert (count.min, count.max) == ("0", "99")


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("interface", [COLLISION, MANOEUVRING], ids=lambda i: i.name)
def test_every_real_has_a_type_with_quantity_unit_and_nominal(interface: Interface, fmi: int) -> None:
    root = VERSIONS[fmi].description(interface, SHIPS, "", None)
    types = {
        simple.get("name"): (simple if fmi == 3 else simple[0]).attrib for simple in next(root.iter("TypeDefinitions"))
    }
    reals = (
        list(root.iter("Float64")) if fmi == 3 else [v[0] for v in root.iter("ScalarVariable") if v[0].tag == "Real"]
    )
    assert len(reals) > 30
    for one in reals:
        declared = types[one.get("declaredType")]
        assert (declared["unit"], declared.get("displayUnit")) == (one.get("unit"), one.get("displayUnit"))
        assert float(declared["nominal"]) > 0.0
        assert declared["quantity"]


def test_units_as_people_read_them() -> None:
    root = VERSIONS[2].description(COLLISION, SHIPS, "", None)
    units = {unit.get("name"): unit for unit in root.iter("Unit")}
    assert units["1"][0].attrib == {"factor": "1.0"}  # importers take a BaseUnit without attributes for unknown
    shown = {name: display.get("name") for name, unit in units.items() for display in unit.findall("DisplayUnit")}
    assert shown == {
        "m/s": "kn", "N": "MN", "N.s": "MN.s", "J": "MJ", "rad": "deg", "N.m": "MN.m", "N.m.s": "MN.m.s",
        "rad/s": "deg/s",
    }  # fmt: skip


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("interface", [COLLISION, MANOEUVRING], ids=lambda i: i.name)
def test_experiment_author_and_log_categories(interface: Interface, fmi: int) -> None:
    root = VERSIONS[fmi].description(interface, SHIPS, "", None)
    assert root.get("author") == "The shipcollision-fmu authors"
    assert "Copyright (c)" in str(root.get("copyright"))
    experiment = next(root.iter("DefaultExperiment")).attrib
    assert {name: float(value) for name, value in experiment.items()} == {
        "startTime": 0.0, "stopTime": interface.stop_time, "tolerance": interface.tolerance,
        "stepSize": interface.step_size,
    }  # fmt: skip
    assert [one.get("name") for one in root.iter("Category")] == ["logEvents", "logStatusError", "logStatusWarning"]
    step = next(root.iter("CoSimulation")).get("fixedInternalStepSize")  # FMI 3.0 alone
    (substep,) = interface.make_access(SHIPS).get_real(interface.make_access(SHIPS).references(["substep"]))
    assert step == (None if fmi == 2 else repr(substep))


def test_degrees_of_freedom_stay_an_integer_with_limits() -> None:
    """libcosim drops enumerations, and its users must be able to set them."""
    for interface, name in ((COLLISION, "own.degrees_of_freedom"), (MANOEUVRING, "degrees_of_freedom")):
        (line,) = (line for line in interface.table(SHIPS) if line.name == name)
        assert (line.kind, line.minimum, line.maximum) == ("Integer", 3, 6)


@pytest.mark.parametrize("scalar", [False, True])
def test_terminals_of_both_fmus_match_each_other(scalar: bool) -> None:
    """FMI 3.0, section 2.4.9.2: by the rule "plug" terminals connect whose members have the same names."""
    schema = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
    members = []
    for interface in (COLLISION, MANOEUVRING):
        root = describe_terminals(interface.table(SHIPS), interface.terminals(SHIPS), scalar)
        etree.XMLSchema(file=str(schema)).assertValid(etree.fromstring(to_bytes(root)))
        known = {array.name: array.line.causality for array in gather_arrays(interface.table(SHIPS), scalar)}
        for terminal in root.iter("Terminal"):
            found = [(m.get("memberName"), known[str(m.get("variableName"))]) for m in terminal]
            members.append((terminal.get("name"), dict(found)))
    assert [name for name, _ in members] == [*SHIPS, "collision"]
    own, target, ship = (found for _, found in members)
    assert own == target
    assert set(own) == set(ship)
    assert len(own) == (30 if scalar else 10)
    assert all({own[name], ship[name]} == {"input", "output"} for name in own)


def test_no_output_depends_on_an_input_at_the_same_instant(dummy_fmu: Path) -> None:
    outputs = read_model_description(str(dummy_fmu)).outputs
    assert len(outputs) == 7
    assert all(unknown.dependencies == [] for unknown in outputs)


def test_what_an_output_depends_on_at_the_start(dummy_fmu: Path) -> None:
    unknowns = read_model_description(str(dummy_fmu)).initialUnknowns
    depends = {u.variable.name: None if u.dependencies is None else [v.name for v in u.dependencies] for u in unknowns}
    assert depends == {
        "place.x": ["gain.first", "gain.second"],  # the group "gain"
        "place.y": ["gain.first", "gain.second"],
        "place.z": ["gain.first", "gain.second"],
        "steps": ["count"],
        "moving": [],
        "said": None,  # may depend on all of them
        "phase": None,
    }


def test_a_dependency_must_be_in_the_table(dummy: ModuleType) -> None:
    line = real("output", "a", "m", "outputs.place", 0, "", depends_on=("place",))
    wrong: Interface = replace(dummy.INTERFACE, table=lambda ships: (line,))
    with pytest.raises(ValueError, match="variable a depends on 'place', which is no parameter or input"):
        model_description(wrong, (), "")


def test_without_a_date(dummy: ModuleType) -> None:
    text = ElementTree.tostring(model_description(dummy.INTERFACE, (), "the guid"), encoding="unicode")
    assert "generationDateAndTime" not in text
    assert 'guid="the guid"' in text


def test_numbers_read_back_as_the_same_double(dummy: ModuleType) -> None:
    def model(ships: tuple[str, ...]) -> object:
        made = dummy.Model()
        made.parameters.gain[:] = [5e-324, float("-inf")]
        return made

    root = model_description(replace(dummy.INTERFACE, model=model), (), "")
    starts = {v.get("name"): v[0].get("start", "") for v in root.iter("ScalarVariable")}
    assert float(starts["gain.first"]) == 5e-324
    assert starts["gain.second"] == "-INF"
