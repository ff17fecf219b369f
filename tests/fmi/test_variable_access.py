"""Ports in process: access, refusals, state. What a host sees of them is in test_slave."""

from __future__ import annotations

import json
import math
from types import ModuleType
from typing import Any

import pytest

from shipcollision_fmu.errors import InputError, StepError
from shipcollision_fmu.fmi.variable_access import Ports
from shipcollision_fmu.fmi.variables import boolean, enumeration, integer, real


def at(ports: Ports, *names: str) -> list[int]:
    return ports.references(names)


def test_value_references_are_positions_in_the_table(ports: Ports) -> None:
    assert at(ports, *(variable.name for variable in ports.table)) == list(range(len(ports.table)))
    with pytest.raises(InputError, match="Dummy has no variable 'plaice'"):
        at(ports, "plaice")


def test_set_reaches_the_model_and_get_what_it_computed(ports: Ports, dummy: ModuleType) -> None:
    ports.set_real(at(ports, "push.z", "push.x"), [3.0, 1.0])
    ports.set_boolean(at(ports, "open"), [True])
    ports.set_string(at(ports, "word"), ["hm"])
    ports.set_integer(at(ports, "number", "method"), [5, 2])
    model: Any = ports.model
    assert model.inputs == dummy.Inputs([1.0, 0.0, 3.0], 5, True, "hm")
    assert model.parameters.method == "closed_form"
    ports.initialise()
    ports.do_step(0.0, 1.0)
    assert ports.get_real(at(ports, "place.z", "place.x")) == [model.outputs.place[2], model.outputs.place[0]]
    assert ports.get_integer(at(ports, "steps", "phase", "method")) == [4, 3, 2]
    assert ports.get_boolean(at(ports, "moving")) == [True]
    assert ports.get_string(at(ports, "said")) == ["hm 0.0"]


def test_the_model_is_initialised_once_unless_something_was_set(ports: Ports) -> None:
    model: Any = ports.model
    ports.get_real(at(ports, "push.x", "gain.first"))
    assert model.initialised == 0
    ports.get_real(at(ports, "place.x"))
    ports.get_integer(at(ports, "steps"))
    assert model.initialised == 1
    ports.set_real(at(ports, "push.x"), [1.0])
    ports.get_string(at(ports, "said"))
    assert model.initialised == 2
    ports.initialise()
    assert model.initialised == 2
    ports.set_real(at(ports, "push.x"), [2.0])
    ports.get_real(at(ports, "place.x"))
    assert model.initialised == 2
    with pytest.raises(InputError, match="Dummy is initialised already"):
        ports.initialise()


def test_an_error_of_initialisation_can_be_corrected(ports: Ports) -> None:
    ports.set_string(at(ports, "name"), ["bad"])
    for _ in range(2):
        with pytest.raises(InputError, match="name = 'bad' is 100% wrong"):
            ports.initialise()
    assert not ports.running
    ports.set_string(at(ports, "name"), ["good"])
    ports.initialise()
    assert ports.running


def test_values_and_references_must_match(ports: Ports) -> None:
    with pytest.raises(InputError, match="Dummy: 1 values for 2 variables"):
        ports.set_real(at(ports, "push.x", "push.y"), [1.0])


def test_a_fixed_parameter_is_refused_also_after_it_was_set_the_same_way(ports: Ports) -> None:
    gain = at(ports, "gain.first")
    ports.set_real(gain, [0.5])
    ports.initialise()
    with pytest.raises(InputError, match=r"parameter gain\.first is fixed since initialisation; reset to set it"):
        ports.set_real(gain, [0.6])
    assert ports.get_real(gain) == [0.5]


def test_ever_new_sets_of_variables(ports: Ports) -> None:
    """The plans that are kept are limited; what is read does not change with that."""
    ports.initialise()
    reals = at(ports, "place.x", "push.x", "push.y", "gain.first")
    for k in range(2500):
        chosen = [reals[(k >> shift) % 4] for shift in range(0, 12, 2)]
        ports.set_real([reals[1 + k % 2]], [float(k)])
        assert ports.get_real(chosen) == [ports.get_real([reference])[0] for reference in chosen]


def test_a_refused_step_leaves_everything(ports: Ports) -> None:
    ports.initialise()
    ports.do_step(0.0, 0.1)
    before = ports.save()
    for bad in (math.nan, math.inf):
        ports.set_real(at(ports, "push.x"), [bad])
        with pytest.raises(StepError, match="push"):
            ports.do_step(0.1, 0.1)
    ports.set_real(at(ports, "push.x"), [0.0])
    assert ports.save() == before


def test_a_fault_names_its_place(ports: Ports) -> None:
    ports.set_string(at(ports, "word"), ["divide"])
    ports.initialise()
    with pytest.raises(StepError, match=r"Dummy failed at t = 0\.0 s: ZeroDivisionError: .* \(Dummy\.py, line \d+\)"):
        ports.do_step(0.0, 0.1)
    saved = ports.save()
    with pytest.raises(InputError, match="this state was saved after a fault"):
        ports.restore(saved)


# State. -------------------------------------------------------------------------------------------------------------


def run(ports: Ports, first: int, last: int) -> list[Any]:
    seen = []
    for k in range(first, last):
        ports.do_step(0.1 * k, 0.1)
        seen.append(ports.save())
    return seen


def test_state_through_json_repeats_to_the_bit(ports: Ports, dummy: ModuleType) -> None:
    ports.set_real(at(ports, "gain.first", "gain.second"), [0.1 + 0.2, 5e-324])
    ports.initialise()
    run(ports, 0, 5)
    text = json.dumps(ports.save())
    expected = run(ports, 5, 10)
    for other in (ports, dummy.INTERFACE.ports()):
        other.restore(json.loads(text))
        assert json.dumps(other.save()) == text
        assert run(other, 5, 10) == expected


def test_a_saved_state_does_not_change_with_the_model(ports: Ports) -> None:
    ports.initialise()
    saved = ports.save()
    text = json.dumps(saved)
    run(ports, 0, 3)
    assert json.dumps(saved) == text
    ports.restore(saved)
    run(ports, 0, 3)
    assert json.dumps(saved) == text


def test_restoring_reads_the_parameters_again(ports: Ports) -> None:
    """What a model derives from its parameters is not in its state."""
    model: Any = ports.model
    ports.initialise()
    one = ports.save()
    ports.restore(one)
    assert model.initialised == 1  # the same parameters: nothing to read
    changed = json.loads(json.dumps(one).replace('"good"', '"fine"'))
    ports.restore(changed)
    assert model.initialised == 2
    assert ports.save() == changed


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
def test_a_state_that_is_none_changes_nothing(ports: Ports, spoil: Any, reason: str) -> None:
    ports.initialise()
    run(ports, 0, 2)
    before = ports.save()
    state = json.loads(json.dumps(before))
    state["values"][0] = 77.0
    spoil(state)
    with pytest.raises(InputError, match=reason):
        ports.restore(state)
    assert ports.save() == before


def test_a_state_whose_parameters_are_refused_changes_nothing(ports: Ports) -> None:
    ports.initialise()
    run(ports, 0, 2)
    before = ports.save()
    with pytest.raises(InputError, match="name = 'bad'"):
        ports.restore(json.loads(json.dumps(before).replace('"good"', '"bad"')))
    assert ports.save() == before
    run(ports, 2, 3)


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
        Ports("Dummy", (line,), dummy.Model())


def test_a_name_may_stand_once(dummy: ModuleType) -> None:
    line = integer("input", "a", "inputs.number", "")
    with pytest.raises(ValueError, match="the table names a variable twice"):
        Ports("Dummy", (line, line), dummy.Model())
