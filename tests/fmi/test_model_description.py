"""modelDescription.xml, as an importer reads it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import ModuleType
from xml.etree import ElementTree

import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu

from shipcollision_fmu.fmi.builder.model_description_fmi2 import model_description
from shipcollision_fmu.fmi.interface import Interface
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
    assert {v.name: [item.name for item in v.declaredType.items] for v in seen if v.declaredType} == {
        "phase": ["rest", "roll", "slide"],
        "method": ["pgs", "closed_form", "bullet"],
    }
    gain = next(v for v in seen if v.name == "gain.first")
    assert (gain.min, gain.nominal, gain.displayUnit) == ("-1e+300", "0.1", "deg/s")
    count = next(v for v in seen if v.name == "count")
    assert (count.min, count.max) == ("0", "99")


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
