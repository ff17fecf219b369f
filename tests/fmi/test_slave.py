"""What a host sees of a slave, through fmpy: statuses, log, values, state.

Of the slave in Python and of its twin in C++, but for what the wrapper of Python does in its own way (OF_PYTHON).
"""

from __future__ import annotations

import gc
import math
from collections.abc import Callable
from ctypes import c_char_p, c_double, c_uint
from pathlib import Path
from typing import Any

import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException

from shipcollision_fmu.fmi.slave_base import state_to_bytes

from .conftest import OF_PYTHON

OK, WARNING, DISCARD, ERROR, FATAL = 0, 1, 2, 3, 4
Make = Callable[..., Any]


def test_runs(host: Make) -> None:
    a = host()
    assert a.begin() == OK
    assert a.place() == [0.1, 0.1, 0.1]
    a.fmu.setReal(a.reference("push.x", "push.y"), [1.0, -1.0])
    assert [a.step(k) for k in range(3)] == [OK, OK, OK]
    assert a.fmu.getInteger(a.reference("steps")) == [6]
    x, y, z = a.place()
    assert x - z == pytest.approx(0.3, rel=1e-12)
    assert y - z == pytest.approx(-0.3, rel=1e-12)
    assert a.fmu.getString(a.reference("said")) == [b"start 0.2"]
    assert a.messages == []


def test_start_values_in_the_xml_are_those_of_an_instance(host: Make, unpacked: Path) -> None:
    a = host()
    seen = 0
    for variable in read_model_description(str(unpacked)).modelVariables:
        if variable.causality == "output":
            assert variable.start is None
            continue
        get = {"Real": a.fmu.getReal, "Boolean": a.fmu.getBoolean, "String": a.fmu.getString}.get(
            variable.type, a.fmu.getInteger
        )
        (value,) = get([variable.valueReference])
        read: dict[str, Callable[[str], Any]] = {"Real": float, "Boolean": "true".__eq__, "String": str.encode}
        assert value == read.get(variable.type, int)(variable.start), variable.name
        seen += 1
    assert seen == 12


def test_outputs_in_initialisation_follow_the_parameters(host: Make) -> None:
    a = host()
    a.fmu.setReal(a.reference("gain.first"), [0.25])
    a.fmu.setupExperiment()
    a.fmu.enterInitializationMode()
    assert a.place() == [0.25] * 3
    a.fmu.setReal(a.reference("gain.first"), [-0.0])
    assert [math.copysign(1.0, x) for x in a.place()] == [-1.0] * 3
    a.fmu.setString(a.reference("word"), ["ship ahoy"])
    a.fmu.setInteger(a.reference("count"), [42])
    a.fmu.exitInitializationMode()
    assert a.fmu.getString(a.reference("said")) == [b"ship ahoy"]
    assert a.fmu.getInteger(a.reference("steps")) == [42]


def test_enumerations_count_from_one(host: Make) -> None:
    a = host()
    a.fmu.setInteger(a.reference("method"), [3])
    assert a.fmu.getInteger(a.reference("method")) == [3]
    a.begin()
    assert a.fmu.getInteger(a.reference("phase")) == [1]
    a.fmu.setBoolean(a.reference("open"), [True])
    a.step(0)
    assert a.fmu.getInteger(a.reference("phase")) == [3]


def test_two_instances_do_not_disturb_each_other(host: Make) -> None:
    def run(*instances: Any) -> list[str]:
        for instance, push in zip(instances, (1.0, -2.0), strict=False):
            instance.fmu.setReal(instance.reference("gain.second"), [push / 7.0])
            instance.begin()
        for k in range(20):
            for instance, push in zip(instances, (1.0, -2.0), strict=False):
                instance.fmu.setReal(instance.reference("push.x"), [push * k])
                assert instance.step(k) == OK
        return [instance.everything() for instance in instances]

    together = run(host("a"), host("b"))
    assert run(host("c")) == together[:1]
    assert together[0] != together[1]


# Failures. ----------------------------------------------------------------------------------------------------------


def test_nan_discards_the_step_and_keeps_the_state_before(host: Make, form: str) -> None:
    a, b = host("a"), host("b")
    for instance in (a, b):
        instance.begin()
        instance.step(0)
    before = a.everything()
    a.fmu.setReal(a.reference("push.y"), [math.nan])
    assert a.step(1) == DISCARD
    assert a.fmu.getBooleanStatus(3) is (form == "Python")  # fmi2Terminated: pythonfmu asks for the end
    assert a.fmu.getRealStatus(2) == 0.1  # fmi2LastSuccessfulTime
    assert a.messages == [(ERROR, "push = [0.0, nan, 0.0] is not finite at t = 0.1 s; check what is connected to it")]
    a.fmu.setReal(a.reference("push.y"), [0.0])
    assert a.everything() == before
    assert (a.step(1), b.step(1)) == (OK, OK)
    assert a.saved() == b.saved()
    assert len(a.messages) == 1


def test_a_reservation_of_the_model_is_logged_as_a_warning_and_the_step_is_made(host: Make) -> None:
    a, b = host("a"), host("b")
    for instance in (a, b):
        instance.begin()
    a.fmu.setString(a.reference("word"), ["doubt"])
    assert (a.step(0), b.step(0)) == (OK, OK)
    assert a.messages == [(WARNING, "only 90%% right at t = 0.0 s")]
    a.fmu.setString(a.reference("word"), ["start"])
    assert (a.step(1), b.step(1)) == (OK, OK)
    assert len(a.messages) == 1
    assert b.messages == []
    assert a.everything() == b.everything()


def test_what_happens_is_logged_as_an_event_once(host: Make) -> None:
    a = host()
    a.begin()
    a.fmu.setString(a.reference("word"), ["bang"])
    a.step(0)
    a.fmu.setString(a.reference("word"), ["start"])
    a.step(1)
    assert a.messages == [(OK, "100%% happened at t = 0.0 s")]
    assert a.categories == ["logEvents"]


@OF_PYTHON
def test_a_fault_of_the_model_discards_until_restored(host: Make) -> None:
    a = host()
    a.begin()
    a.step(0)
    before, saved = a.everything(), a.saved()
    a.fmu.setString(a.reference("word"), ["divide"])
    assert a.step(1) == DISCARD
    assert a.messages[-1][1].startswith("Dummy failed at t = 0.1 s: ZeroDivisionError: float division by zero (Dummy_")
    a.fmu.setString(a.reference("word"), ["start"])
    assert a.step(1) == DISCARD  # nobody knows how far the step got
    assert a.messages[-1][1].endswith("; reset it or restore a saved state")
    assert a.restore(saved) == OK
    assert a.everything() == before
    assert a.step(1) == OK


@OF_PYTHON
def test_sys_exit_in_a_step_stays_inside(host: Make) -> None:
    a = host()
    a.fmu.setString(a.reference("word"), ["exit"])
    a.begin()
    assert a.step(0) == DISCARD
    assert "SystemExit: 3" in a.messages[-1][1]


@pytest.mark.parametrize("h", [0.0, -0.1, math.nan, math.inf])
def test_a_step_that_is_none_is_discarded(host: Make, h: float) -> None:
    a = host()
    a.begin()
    before = a.saved()
    assert a.dll.fmi2DoStep(a.component, 0.0, c_double(h), 1) == DISCARD
    assert a.messages == [(ERROR, f"Dummy: no step from t = 0.0 s by {h} s: both must be finite and the step > 0")]
    assert a.saved() == before


def test_a_step_before_initialisation_is_refused(host: Make) -> None:
    a = host()
    assert a.step(0) == a.refusal
    assert a.messages[-1][1] == "Dummy is not initialised: initialise it before its first step"


@OF_PYTHON
def test_initialisation_that_fails_is_fatal_with_the_reason(host: Make) -> None:
    a, b = host("a"), host("b")
    b.begin()
    a.fmu.setString(a.reference("name"), ["bad"])
    assert a.begin() == FATAL
    ((status, message),) = a.messages
    assert status == FATAL
    # The percent sign is doubled because FMI's logger takes a printf format.
    assert message.endswith("Dummy cannot be initialised: name = 'bad' is 100%% wrong; call it 'good'")
    # FMI lets a host do nothing after this. One that goes on all the same must not crash.
    a.fmu.reset()
    assert a.begin() == OK
    assert a.step(0) == OK
    assert b.step(0) == OK
    assert a.everything() == b.everything()


@OF_PYTHON
@pytest.mark.parametrize("text", [b"caf\xe9", b"\xff", b"\xed\xa0\x80"])
def test_text_that_is_not_utf8_is_refused_and_named(host: Make, text: bytes) -> None:
    """pythonfmu hands over a null pointer in its place, and leaves an error pending; the process ended there."""
    a, references = host(), (c_uint * 2)(*host("other").reference("name", "word"))
    a.dll.fmi2SetString(a.component, references, 2, (c_char_p * 2)(b"good", text))
    line = "Dummy: word = bytes that are no text in UTF-8 is not a string: give text in UTF-8"
    assert a.messages == [(ERROR, line)]
    assert a.fmu.getString(a.reference("name", "word")) == [b"good", b"start"]
    a.dll.fmi2SetString(a.component, references, 2, (c_char_p * 2)(b"good", "café".encode()))
    assert a.fmu.getString(a.reference("word")) == ["café".encode()]


@OF_PYTHON
@pytest.mark.slow
def test_initialisation_may_fail_often(host: Make) -> None:
    """Every exception costs pythonfmu's wrapper a reference to instance, class and log."""
    a = host()
    for _ in range(20):
        a.fmu.setString(a.reference("name"), ["bad"])
        assert a.begin() == FATAL
        a.fmu.reset()
        gc.collect()
    assert a.begin() == OK


@OF_PYTHON
def test_parameters_may_be_corrected_during_initialisation(host: Make) -> None:
    a = host()
    a.fmu.setString(a.reference("name"), ["bad"])
    a.fmu.setupExperiment()
    a.fmu.enterInitializationMode()
    assert all(map(math.isnan, a.place()))
    assert a.messages == [(ERROR, "name = 'bad' is 100%% wrong; call it 'good'")]
    a.fmu.setString(a.reference("name"), ["good"])
    assert a.place() == [0.1] * 3
    a.fmu.exitInitializationMode()
    assert a.step(0) == OK


@pytest.mark.usefixtures("_tidy_path")
def test_simulate_fmu_raises_when_initialisation_fails(dummy_fmu: Path) -> None:
    with pytest.raises(FMICallException, match="fmi2ExitInitializationMode failed with status 4"):
        simulate_fmu(str(dummy_fmu), start_values={"name": "bad"}, stop_time=1.0)


REFUSED = [
    (lambda a: a.fmu.setReal(a.reference("push.x", "place.x"), [5.0, 1.0]), "place.x is an output and cannot be set"),
    (lambda a: a.fmu.setReal([a.references["push.x"], 99], [5.0, 1.0]), "value reference 99 is unknown; it has 0 to"),
    (lambda a: a.fmu.setReal([4294967295], [1.0]), "value reference -1 is unknown"),
    (lambda a: a.fmu.setReal(a.reference("number"), [1.0]), "number (value reference 10) is Integer, not Real"),
    (lambda a: a.fmu.setReal(a.reference("gain.first"), [1.0]), "parameter gain.first is fixed since initialisation"),
    (lambda a: a.fmu.setInteger(a.reference("push.x"), [1]), "push.x (value reference 7) is Real, not Integer"),
    (lambda a: a.fmu.setInteger(a.reference("phase"), [1]), "phase is an output and cannot be set"),
    (lambda a: a.fmu.setBoolean(a.reference("quick"), [False]), "parameter quick is fixed since initialisation"),
    (lambda a: a.fmu.setString(a.reference("open"), ["x"]), "open (value reference 11) is Boolean, not String"),
    (lambda a: a.fmu.getReal([0, 99]), "value reference 99 is unknown"),
    (lambda a: a.fmu.getReal(a.reference("number")), "number (value reference 10) is Integer, not Real"),
    (lambda a: a.fmu.getInteger(a.reference("push.x")), "push.x (value reference 7) is Real, not Integer"),
    (lambda a: a.fmu.getBoolean([77]), "value reference 77 is unknown"),
    (lambda a: a.fmu.getString([0]), "place.x (value reference 0) is Real, not String"),
    (lambda a: a.restore(b"not a state"), "this is not a saved state of it"),
    (lambda a: a.restore(b""), "bytes that are no state, or damaged ones"),
    (lambda a: a.restore(a.saved()[:-1]), "bytes that are no state, or damaged ones"),
    (lambda a: a.restore(a.saved().replace(b"0.1", b"0.2", 1)), "bytes that are no state, or damaged ones"),
    (lambda a: a.restore(state_to_bytes({"of": "ShipManoeuvring 0123"})), "of 'ShipManoeuvring 0123'"),
]


@OF_PYTHON
@pytest.mark.parametrize(("call", "reason"), REFUSED)
def test_a_refused_call_changes_nothing_and_discards_the_next_step(host: Make, call: Any, reason: str) -> None:
    a = host()
    a.begin()
    before = a.everything()
    call(a)
    assert a.messages[-1][0] == ERROR
    assert reason in a.messages[-1][1]
    assert a.everything() == before
    assert a.step(0) == DISCARD
    assert "no step at t = 0.0 s after a refused call" in a.messages[-1][1]
    assert reason in a.messages[-1][1]
    assert a.step(0) == OK


@OF_PYTHON
def test_a_call_refused_before_the_start_fails_initialisation(host: Make) -> None:
    a = host()
    a.fmu.setInteger(a.reference("method"), [4])
    assert a.messages[-1][1] == "Dummy: method = 4 is not one of 1 (pgs), 2 (closed_form), 3 (bullet)"
    assert a.begin() == FATAL
    a.fmu.reset()
    assert a.begin() == OK


@OF_PYTHON
def test_a_reference_that_is_wrong_spoils_its_own_value_alone(host: Make) -> None:
    a = host()
    a.begin()
    x, nothing, count, y = a.fmu.getReal([0, 99, *a.reference("number"), 1])
    assert [x, y] == [0.1, 0.1]
    assert math.isnan(nothing)
    assert math.isnan(count)  # an Integer
    assert a.fmu.getInteger([*a.reference("number"), 99, *a.reference("phase")]) == [7, 0, 1]
    assert a.fmu.getBoolean([99, *a.reference("quick")]) == [False, True]
    assert a.fmu.getString([*a.reference("word"), 99]) == [b"start", b""]
    assert [status for status, _ in a.messages] == [ERROR] * 4
    assert a.step(0) == DISCARD
    assert a.step(0) == OK


# Time. --------------------------------------------------------------------------------------------------------------


def test_no_step_ends_after_the_stop_time(host: Make) -> None:
    """FMI 2.0.4, section 4.2.1: stepping beyond the stop time is an error. Hosts that add up steps may be 1e-9 late."""
    a = host()
    assert a.begin(0.0, 1.0) == OK
    assert a.step(0, 0.75) == OK
    before = a.everything()
    assert a.dll.fmi2DoStep(a.component, c_double(0.75), c_double(0.26), 1) == a.refusal
    assert a.messages[-1][1] == (
        "a step from t = 0.75 s by 0.26 s ends after the stop time 1 s of the experiment: end there, or set the "
        "experiment up without a stop time"
    )
    assert a.everything() == before
    assert a.dll.fmi2DoStep(a.component, c_double(0.75), c_double(0.25 + 0.9e-9), 1) == OK
    assert a.dll.fmi2DoStep(a.component, c_double(1.0), c_double(0.25), 1) == a.refusal

    b = host("b")  # the remedy: without a stop time
    b.begin(0.0)
    assert [b.step(k, 0.25) for k in range(9)] == [OK] * 9
    assert b.messages == []


def test_a_stop_time_that_is_none_is_said_and_ignored(host: Make) -> None:
    a = host()
    assert a.begin(3.0, 3.0) == OK
    assert a.messages == [(WARNING, "stop time 3 s is not after the start time 3 s and is ignored")]
    assert a.dll.fmi2DoStep(a.component, c_double(3.0), c_double(0.1), 1) == OK


def test_steps_that_are_added_up_reach_the_stop_time(host: Make) -> None:
    a, t = host(), 0.0
    a.begin(0.0, 3.0)
    for _ in range(30):
        assert a.dll.fmi2DoStep(a.component, c_double(t), c_double(0.1), 1) == OK
        t += 0.1
    assert t != 3.0
    assert a.messages == []


def test_a_gap_in_time_warns_once(host: Make) -> None:
    a = host()
    a.begin(5.0)
    for t in (5.0, 5.1 + 1e-9, 5.3, 7.0):
        assert a.dll.fmi2DoStep(a.component, c_double(t), c_double(0.1), 1) == OK
    line = (
        "a step begins at t = 5.3 s, but the last one ended at 5.2 s: ships and collision then lose count of the time; "
        "step from where the last step ended, or restore a state"
    )
    assert a.messages == [(WARNING, line)]
    assert a.categories == ["logStatusWarning"]

    b = host("b")  # the start counts as well
    b.begin(5.0)
    b.step(0)
    assert b.messages[0][1].startswith("a step begins at t = 0 s, but the last one ended at 5 s")


def test_a_refused_step_takes_no_warning_with_it(host: Make) -> None:
    a = host()
    a.begin()
    a.fmu.setReal(a.reference("push.x"), [math.nan])
    before = a.saved()
    assert a.dll.fmi2DoStep(a.component, c_double(5.0), c_double(0.1), 1) == DISCARD
    assert a.saved() == before
    a.fmu.setReal(a.reference("push.x"), [0.0])
    assert a.dll.fmi2DoStep(a.component, c_double(5.0), c_double(0.1), 1) == OK
    assert a.messages[-1][1].startswith("a step begins at t = 5 s, but the last one ended at 0 s")


def test_a_restored_state_takes_the_time_back(host: Make) -> None:
    a, b = host(), host("b")
    a.begin(0.0, 1.0)
    a.step(0)
    saved = a.saved()
    a.step(1)
    assert a.restore(saved) == OK
    assert a.step(1) == OK
    assert b.restore(saved) == OK
    assert b.step(1) == OK
    assert b.dll.fmi2DoStep(b.component, c_double(0.2), c_double(0.9), 1) == b.refusal
    assert a.messages == []


@OF_PYTHON
def test_a_state_of_a_run_in_process_has_no_stop_time(host: Make, access: Any) -> None:
    access.initialise()
    a = host()
    a.begin(0.0, 0.5)
    assert a.restore(state_to_bytes(access.save())) == OK
    assert a.step(7) == OK
    assert a.messages == []


@OF_PYTHON
def test_an_experiment_cannot_be_set_up_on_the_way(host: Make) -> None:
    a = host()
    a.begin()
    a.fmu.setupExperiment(startTime=7.0)
    assert "the experiment cannot be set up: the instance is running; reset it" in a.messages[-1][1]
    assert a.step(0) == DISCARD
    assert a.step(0) == OK


# State. -------------------------------------------------------------------------------------------------------------


def test_a_restored_state_repeats_to_the_bit(host: Make) -> None:
    a = host()
    a.fmu.setReal(a.reference("gain.second"), [math.pi])
    a.begin()
    for k in range(5):
        a.step(k)
    a.fmu.setReal(a.reference("push.x", "push.y"), [0.1, -1e-300])
    state, at_save = a.fmu.getFMUstate(), a.everything()
    first = [(a.step(k), a.everything()) for k in range(5, 9)]
    for _ in range(2):
        a.fmu.setReal(a.reference("push.x"), [123.0])
        a.fmu.setFMUstate(state)
        assert a.everything() == at_save
        assert [(a.step(k), a.everything()) for k in range(5, 9)] == first
    a.fmu.freeFMUstate(state)
    assert first[0][1] != at_save


@pytest.mark.parametrize("fresh", [True, False])
def test_serialised_state_goes_into_another_instance(host: Make, fresh: bool) -> None:
    a, b = host("a"), host("b")
    if not fresh:  # other parameters and another time, which the state replaces
        b.fmu.setReal(b.reference("gain.second"), [4.0])
        b.begin()
        b.step(0)
    a.fmu.setReal(a.reference("gain.first", "gain.second"), [1.0 / 3.0, math.e])
    a.fmu.setInteger(a.reference("method", "count"), [2, 17])
    a.begin()
    a.fmu.setReal(a.reference("push.x"), [-0.0])
    for k in range(7):
        a.step(k)
    data = a.saved()
    assert b.restore(data) == OK
    assert b.everything() == a.everything()
    assert b.saved() == data
    for k in range(7, 12):
        assert (a.step(k), b.step(k)) == (OK, OK)
    assert b.everything() == a.everything()
    assert b.saved() == a.saved()


def test_state_keeps_what_is_not_finite(host: Make) -> None:
    a, b = host("a"), host("b")
    a.begin()
    a.fmu.setReal(a.reference("push.x", "push.y", "push.z"), [math.nan, math.inf, -math.inf])
    assert b.restore(a.saved()) == OK
    assert b.everything() == a.everything()
    assert b.step(0) == DISCARD


def test_a_state_saved_before_initialisation(host: Make) -> None:
    a = host()
    a.fmu.setReal(a.reference("gain.first"), [0.75])
    data = a.saved()
    a.begin()
    a.step(0)
    assert a.restore(data) == OK
    a.fmu.setReal(a.reference("gain.second"), [0.5])  # parameters are open again
    assert a.begin() == OK
    assert a.place() == [0.75] * 3
    assert a.messages == []


def test_reset_is_a_fresh_start(host: Make) -> None:
    a, b = host("a"), host("b")
    fresh = a.saved()
    a.fmu.setReal(a.reference("gain.first"), [0.5])
    a.begin(5.0, 6.0)
    a.fmu.setReal(a.reference("push.x"), [3.0])
    a.step(50)
    a.fmu.terminate()
    a.fmu.reset()
    assert a.saved() == fresh
    assert (a.begin(), b.begin()) == (OK, OK)
    assert (a.step(0), b.step(0)) == (OK, OK)
    assert a.saved() == b.saved()
    assert a.messages == []


def test_raw_arrays_of_no_length(host: Make) -> None:
    a = host()
    a.begin()
    assert a.dll.fmi2GetReal(a.component, (c_uint * 0)(), 0, (c_double * 0)()) == OK
    assert a.dll.fmi2SetReal(a.component, (c_uint * 0)(), 0, (c_double * 0)()) == OK
