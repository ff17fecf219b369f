"""Saved states of native FMUs by FMI 2.0.4: phases, handles, bytes that are damaged or foreign."""

from __future__ import annotations

import ctypes
from ctypes import byref, c_size_t
from typing import Any

import pytest

from tests.fmi.Dummy import INTERFACE
from tests.fmi.hosts import Host

from .fmi2_calls import ERROR, OK, PHASES, Make, handle, raw

GARBAGE = ctypes.create_string_buffer(64)


def saved(a: Host) -> Any:
    state = handle()
    assert raw(a, "GetFMUstate", byref(state)) == OK
    return state


@pytest.mark.parametrize("phase", PHASES)
def test_a_state_of_every_phase(host: Make, phase: str) -> None:
    a, b = host("a"), host("b")
    PHASES[phase](a)
    data = a.saved()
    b.begin()
    for k in range(3):
        b.step(k)
    assert b.restore(data) == OK
    assert b.saved() == data
    assert (b.step(1) == OK) == (phase == "running")


def test_a_handle_is_used_again_and_nulled_when_freed(host: Make) -> None:
    a = host()
    a.begin()
    state = saved(a)
    address = state.value
    first = a.saved()
    a.step(0)
    assert raw(a, "GetFMUstate", byref(state)) == OK
    assert state.value == address
    second = a.saved()
    a.step(1)
    assert raw(a, "SetFMUstate", state) == OK
    assert a.saved() == second != first
    assert raw(a, "FreeFMUstate", byref(state)) == OK
    assert state.value is None
    assert raw(a, "FreeFMUstate", byref(state)) == OK
    assert raw(a, "FreeFMUstate", None) == OK
    assert a.messages == []


def test_a_handle_grows_with_the_state(host: Make) -> None:
    a = host()
    a.begin()
    state = saved(a)
    a.fmu.setString(a.reference("word"), ["w" * 4000])
    assert raw(a, "GetFMUstate", byref(state)) == OK
    a.fmu.setString(a.reference("word"), [""])
    assert raw(a, "SetFMUstate", state) == OK
    assert a.fmu.getString(a.reference("word")) == [b"w" * 4000]


FOREIGN = (
    "this is no saved state of this instance: it was freed, or another instance saved it; serialize a state to take it "
    "to another instance"
)


@pytest.mark.parametrize("which", ["null", "garbage", "another instance's", "freed"])
def test_handles_that_are_none_are_refused(host: Make, which: str) -> None:
    a, b = host("a"), host("b")
    a.begin()
    state = {
        "null": handle, "garbage": lambda: handle(ctypes.addressof(GARBAGE)), "another instance's": lambda: saved(b),
        "freed": lambda: saved(a),
    }[which]()  # fmt: skip
    if which == "freed":
        kept = handle(state.value)
        raw(a, "FreeFMUstate", byref(state))
        state = kept
    line = "a null pointer is no saved state" if which == "null" else FOREIGN
    before = a.saved()
    assert raw(a, "SetFMUstate", state) == ERROR
    assert raw(a, "SerializedFMUstateSize", state, byref(c_size_t())) == ERROR
    assert raw(a, "SerializeFMUstate", state, GARBAGE, c_size_t(64)) == ERROR
    if which != "null":
        assert raw(a, "GetFMUstate", byref(state)) == ERROR
        assert raw(a, "FreeFMUstate", byref(state)) == ERROR
        assert state.value is not None
    assert {message for _, message in a.messages} == {line}
    assert a.saved() == before


def test_damaged_bytes_are_refused(host: Make) -> None:
    a = host()
    a.begin()
    data = a.saved()
    damaged = [b"", b"not a state", data[:-1], data + b"\0", *(flip(data, k) for k in range(0, len(data), 5))]
    for wrong in damaged:
        state = handle()
        buffer = ctypes.create_string_buffer(wrong, max(len(wrong), 1))
        assert raw(a, "DeSerializeFMUstate", buffer, c_size_t(len(wrong)), byref(state)) == ERROR
        assert state.value is None
    assert {line for _, line in a.messages} == {"Dummy: bytes that are no state, or damaged ones"}
    assert a.saved() == data


def flip(data: bytes, k: int) -> bytes:
    return data[:k] + bytes([data[k] ^ 1 << k % 8]) + data[k + 1 :]


def seal(data: bytes, old: bytes, new: bytes) -> bytes:
    """A state of another FMU: the digest is that of zlib, the format that of native/fmi/saved_state.cpp."""
    from zlib import crc32

    assert len(old) == len(new)
    inside = data[16:].replace(old, new, 1)
    return data[:12] + crc32(inside).to_bytes(4, "little") + inside


def test_a_state_of_another_build_or_fmu_is_refused(host: Make) -> None:
    a = host()
    a.begin()
    data = a.saved()
    tag = INTERFACE.make_access().tag
    assert a.restore(seal(data, b"", b"")) == OK
    assert a.restore(seal(data, tag.encode(), b"Mummy" + tag[5:].encode())) == ERROR
    assert a.messages[-1][1] == f"Dummy: this is not a saved state of it (of 'Mummy{tag[5:]}', want '{tag}')"
    assert a.restore(seal(data, b"0.1.0 of", b"0.1.1 of")) == ERROR
    assert a.messages[-1][1] == (
        "Dummy: this state was saved by another build of shipcollision_fmu (0.1.1 of the tests; this one is 0.1.0 of "
        "the tests): a state can be restored only in the build that saved it"
    )
    assert a.saved() == data


def test_a_state_whose_parameters_are_refused_leaves_everything(host: Make) -> None:
    a, b = host("a"), host("b")
    b.fmu.setString(b.reference("name"), ["gut!"])
    b.begin()
    data = seal(b.saved(), b"gut!", b"bad\0")
    a.begin()
    a.step(0)
    before = a.saved()
    assert a.restore(data) == ERROR
    assert a.saved() == before
    assert a.step(1) == OK


def test_too_little_room_for_a_state_is_refused(host: Make) -> None:
    a = host()
    state, size = saved(a), c_size_t()
    assert raw(a, "SerializedFMUstateSize", state, byref(size)) == OK
    assert raw(a, "SerializedFMUstateSize", state, None) == ERROR
    few = size.value - 1
    assert raw(a, "SerializeFMUstate", state, GARBAGE, c_size_t(few)) == ERROR
    assert a.messages[-1][1] == f"Dummy: {few} bytes are too few for a state of {size.value}"
