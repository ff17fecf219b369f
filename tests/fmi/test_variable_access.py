"""Access to variables in process: refusals, state. What a host gets of them is in test_slave."""

from __future__ import annotations

import json
import math
from types import ModuleType
from typing import Any

import pytest

from shipcollision_fmu.errors import InputError, StepError
from shipcollision_fmu.fmi.variable_access import VariableAccess
from shipcollision_fmu.fmi.variables import boolean, enumeration, integer, real


def at(access: VariableAccess, *names: str) -> list[int]:
    return access.references(names)


def test_value_references_are_positions_in_the_table(access: VariableAccess) -> None:
    assert at(access, *(variable.name for variable in access.table)) == list(range(len(access.table)))
    with pytest.raises(InputError, match="Dummy has no variable 'plaice'"):
        at(access, "plaice")


def test_set_reaches_the_model_and_get_what_it_computed(access: VariableAccess, dummy: ModuleType) -> None:
    access.set_real(at(access, "push.z", "push.x"), [3.0, 1.0])
    access.set_boolean(at(access, "open"), [True])
    access.set_string(at(access, "word"), ["hm"])
    access.set_integer(at(access, "number", "method"), [5, 2])
    model: Any = access.model
    assert model.inputs == dummy.Inputs([1.0, 0.0, 3.0], 5, True, "hm")
    assert model.parameters.method == "closed_form"
    access.initialise()
    access.do_step(0.0, 1.0)
    assert access.get_real(at(access, "place.z", "place.x")) == [model.outputs.place[2], model.outputs.place[0]]
    assert access.get_integer(at(access, "steps", "phase", "method")) == [4, 3, 2]
    assert access.get_boolean(at(access, "moving")) == [True]
    assert access.get_string(at(access, "said")) == ["hm 0.0"]


def test_the_model_is_initialised_once_unless_something_was_set(access: VariableAccess) -> None:
    model: Any = access.model
    access.get_real(at(access, "push.x", "gain.first"))
    assert model.initialised == 0
    access.get_real(at(access, "place.x"))
    access.get_integer(at(access, "steps"))
    assert model.initialised == 1
    access.set_real(at(access, "push.x"), [1.0])
    access.get_string(at(access, "said"))
    assert model.initialised == 2
    access.initialise()
    assert model.initialised == 2
    access.set_real(at(access, "push.x"), [2.0])
    access.get_real(at(access, "place.x"))
    assert model.initialised == 2
    with pytest.raises(InputError, match="Dummy is initialised already"):
        access.initialise()


def test_an_error_of_initialisation_can_be_corrected(access: VariableAccess) -> None:
    access.set_string(at(access, "name"), ["bad"])
    for _ in range(2):
        with pytest.raises(InputError, match="name = 'bad' is 100% wrong"):
            access.initialise()
    assert not access.running
    access.set_string(at(access, "name"), ["good"])
    access.initialise()
    assert access.running


def test_values_and_references_must_match(access: VariableAccess) -> None:
    with pytest.raises(InputError, match="Dummy: 1 values for 2 variables"):
        access.set_real(at(access, "push.x", "push.y"), [1.0])


def test_a_fixed_parameter_is_refused_also_after_it_was_set_the_same_way(access: VariableAccess) -> None:
    gain = at(access, "gain.first")
    access.set_real(gain, [0.5])
    access.initialise()
    with pytest.raises(InputError, match=r"parameter gain\.first is fixed since initialisation; reset to set it"):
        access.set_real(gain, [0.6])
    assert access.get_real(gain) == [0.5]


def test_ever_new_sets_of_variables(access: VariableAccess) -> None:
    """The plans that are kept are limited; what is read does not change with that."""
    access.initialise()
    reals = at(access, "place.x", "push.x", "push.y", "gain.first")
    for k in range(2500):
        chosen = [reals[(k >> shift) % 4] for shift in range(0, 12, 2)]
        access.set_real([reals[1 + k % 2]], [float(k)])
        assert access.get_real(chosen) == [access.get_real([reference])[0] for reference in chosen]


def test_a_refused_step_leaves_everything(access: VariableAccess) -> None:
    access.initialise()
    access.do_step(0.0, 0.1)
    before = access.save()
    for bad in (math.nan, math.inf):
        access.set_real(at(access, "push.x"), [bad])
        with pytest.raises(StepError, match="push"):
            access.do_step(0.1, 0.1)
    access.set_real(at(access, "push.x"), [0.0])
    assert access.save() == before


def test_a_fault_names_its_place(access: VariableAccess) -> None:
    access.set_string(at(access, "word"), ["divide"])
    access.initialise()
    with pytest.raises(StepError, match=r"Dummy failed at t = 0\.0 s: ZeroDivisionError: .* \(Dummy\.py, line \d+\)"):
        access.do_step(0.0, 0.1)
    saved = access.save()
    with pytest.raises(InputError, match="this state was saved after a fault"):
        access.restore(saved)


# State. -------------------------------------------------------------------------------------------------------------


def run(access: VariableAccess, first: int, last: int) -> list[Any]:
    seen = []
    for k in range(first, last):
        access.do_step(0.1 * k, 0.1)
        seen.append(access.save())
    return seen


def test_state_through_json_repeats_to_the_bit(access: VariableAccess, dummy: ModuleType) -> None:
    access.set_real(at(access, "gain.first", "gain.second"), [0.1 + 0.2, 5e-324])
    access.initialise()
    run(access, 0, 5)
    text = json.dumps(access.save())
    expected = run(access, 5, 10)
    for other in (access, dummy.INTERFACE.make_access()):
        other.restore(json.loads(text))
        assert json.dumps(other.save()) == text
        assert run(other, 5, 10) == expected


def test_a_saved_state_does_not_change_with_the_model(access: VariableAccess) -> None:
    access.initialise()
    saved = access.save()
    text = json.dumps(saved)
    run(access, 0, 3)
    assert json.dumps(saved) == text
    access.restore(saved)
    run(access, 0, 3)
    assert json.dumps(saved) == text


def test_restoring_reads_the_parameters_again(access: VariableAccess) -> None:
    """What a model derives from its parameters is not in its state."""
    model: Any = access.model
    access.initialise()
    one = access.save()
    access.restore(one)
    assert model.initialised == 1  # the same parameters: nothing to read
    changed = json.loads(json.dumps(one).replace('"good"', '"fine"'))
    access.restore(changed)
    assert model.initialised == 2
    assert access.save() == changed


@pytest.mark.parametrize(
    ("spoil", "reason"),
    [
        (lambda state: state.update(of="Other 01"), r"not a saved state of it \(of 'Other 01', want 'Dummy "),
        (lambda state: state.update(build="0.0.1 0123"), r"saved by another build .*\(0.0.1 0123; this one is \d"),
        (lambda state: state.pop("build"), r"saved by another build .*\(an older one, without its name; this one is"),
        (lambda state: state.update(of="Dummy 0123", build="0"), "saved by another build"),  # with another table
        (lambda state: state["model"].clear(), "this saved state cannot be read: KeyError: 'hidden'"),
        (lambda state: state["values"].pop(), "this saved state cannot be read: ValueError"),
    ],
)
def test_a_state_that_is_none_changes_nothing(access: VariableAccess, spoil: Any, reason: str) -> None:
    access.initialise()
    run(access, 0, 2)
    before = access.save()
    state = json.loads(json.dumps(before))
    state["values"][0] = 77.0
    spoil(state)
    with pytest.raises(InputError, match=reason):
        access.restore(state)
    assert access.save() == before


def test_a_state_whose_parameters_are_refused_changes_nothing(access: VariableAccess) -> None:
    access.initialise()
    run(access, 0, 2)
    before = access.save()
    with pytest.raises(InputError, match="name = 'bad'"):
        access.restore(json.loads(json.dumps(before).replace('"good"', '"bad"')))
    assert access.save() == before
    run(access, 2, 3)


# A table that does not fit. -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        (real("input", "a", "m", "inputs.pull", 0, ""), "no value at inputs.pull"),
        (real("input", "a", "m", "inputs.push", 3, ""), r"no value at inputs.push\[3\]"),
        (real("input", "a", "m", "inputs.number", None, ""), "7 at inputs.number is not a value of Real"),
        (integer("input", "a", "inputs.open", ""), "False at inputs.open is not a value of Integer"),
        (boolean("input", "a", "inputs.number", ""), "7 at inputs.number is not a value of Boolean"),
        (enumeration("parameter", "a", ("x", "y"), "parameters.method", ""), "'pgs' at .* not a value of Enumeration"),
    ],
)
def test_a_table_must_fit_the_model(dummy: ModuleType, line: Any, reason: str) -> None:
    with pytest.raises(ValueError, match=f"variable a: {reason}"):
        VariableAccess("Dummy", (line,), dummy.Model())


def test_a_name_may_stand_once(dummy: ModuleType) -> None:
    line = integer("input", "a", "inputs.number", "")
    with pytest.raises(ValueError, match="the table names a variable twice"):
        VariableAccess("Dummy", (line, line), dummy.Model())
