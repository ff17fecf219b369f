# ruff: noqa: T201 - a program that prints
"""Random calls with random values on an FMU, through its C interface.

    python tests/fmi/fuzz.py FOLDER STATES.json --seed 17 --count 1 --trace

FOLDER is an unpacked FMU of FMI 2.0 or 3.0 for co-simulation, STATES.json a list of its states, serialised, as
base64. The calls of a sequence follow from its seed alone; the instance is mostly that of the sequence before:

    restore one of the states;  random calls;  restore the state again (from the handle, from bytes, after reset, or in
    a new instance);  one step, after which every value must be what it was without the calls, to the bit

Random calls are what a confused host could make: any order, any value reference, any value, wrong types, no values,
steps backwards, states that are damaged, states of before a reset, terminate twice. Not among them is what no slave
can survive: freed handles, arrays shorter than their stated length, null pointers where FMI wants values.

The process ends with 0, with 1 and a line about the seed that went wrong, or with a signal: the last line printed is
the seed of the sequence that crashed.
"""

from __future__ import annotations

import argparse
import base64
import ctypes
import json
import math
import random
import sys
from collections.abc import Callable
from ctypes import CFUNCTYPE, Structure, byref, c_bool, c_char_p, c_double, c_int, c_int64, c_size_t, c_uint
from ctypes import c_void_p as pointer
from pathlib import Path
from time import perf_counter
from typing import Any
from xml.etree import ElementTree

OK, WARNING, DISCARD, ERROR, FATAL, PENDING = range(6)

REALS = [0.0, -0.0, 1.0, -1.0, math.nan, math.inf, -math.inf, 1e300, -1e300, 5e-324, 1e9, -1e15, 3.5, 0.05, 1e-9]
INTEGERS = [0, 1, -1, 2, 3, 4, 5, 6, 7, 99, 2**31 - 1, -(2**31)]
STRINGS = [
    b"", b"kvlcc2", b"kcs", b"guan2014_own", b"nobody", b"/", b"/nonexistent.toml", b"%s%n%d%", b"x" * 5000, b"../..",
    "Schiff ä 船".encode(), b"[buoy]\nship = 3", b"\n\t\"'\\", b"nan",
]  # fmt: skip
STEPS = [0.05, 0.05, 0.05, 0.01, 0.0, -0.05, math.nan, math.inf, 1e-300, 1e300]


class Wrong(Exception):  # noqa: N818 - what the line that is printed says
    """A sequence that did not end as it must."""


class Fmu:
    """The C interface of an FMU, as far as both versions have it in common, over the differences between them."""

    def __init__(self, folder: Path) -> None:
        root = ElementTree.parse(folder / "modelDescription.xml").getroot()
        self.fmi = 3 if root.get("fmiVersion", "").startswith("3") else 2
        able = root.find("CoSimulation")
        assert able is not None
        platform = "x86_64-linux" if self.fmi == 3 else "linux64"
        # The wrappers of Python FMUs can only discard a step; others answer an error where FMI asks for it.
        is_python = able.get("needsExecutionTool") == "true"
        self.steps_refused = {DISCARD} if is_python else {DISCARD, ERROR}
        self.dll = ctypes.CDLL(str(folder / "binaries" / platform / f"{able.get('modelIdentifier')}.so"))
        self.token = (root.get("guid") or root.get("instantiationToken") or "").encode()
        self.resources = folder / "resources"
        self.sizes: dict[int, int] = {}
        self.kinds: dict[str, list[int]] = {}
        for variable in root.iter("ScalarVariable") if self.fmi == 2 else list(root.find("ModelVariables") or []):
            reference = int(variable.get("valueReference", ""))
            kind = variable[0].tag if self.fmi == 2 else variable.tag
            size = math.prod(int(d.get("start", "")) for d in variable.iter("Dimension"))
            self.sizes[reference] = size
            self.kinds.setdefault(kind, []).append(reference)
        self.said: list[tuple[int, bytes]] = []
        self._logger = self._callbacks()
        self.call("InstantiateCoSimulation" if self.fmi == 3 else "Instantiate").restype = pointer

    # Values: names of the accessors, C type and random values by kind.

    @property
    def accessors(self) -> dict[str, tuple[str, Any, list[Any]]]:
        if self.fmi == 2:
            return {
                "Real": ("Real", c_double, REALS), "Integer": ("Integer", c_int, INTEGERS),
                "Enumeration": ("Integer", c_int, INTEGERS), "Boolean": ("Boolean", c_int, [0, 1, 7, -1]),
                "String": ("String", c_char_p, STRINGS),
            }  # fmt: skip
        return {
            "Float64": ("Float64", c_double, REALS), "Int32": ("Int32", c_int, INTEGERS),
            "Enumeration": ("Int64", c_int64, [*INTEGERS, 2**62]), "Boolean": ("Boolean", c_bool, [False, True]),
            "String": ("String", c_char_p, STRINGS),
        }  # fmt: skip

    def call(self, name: str) -> Any:
        return getattr(self.dll, f"fmi{self.fmi}{name}")

    def get(self, kind: str, component: pointer, references: list[int], size: int) -> tuple[int, list[Any]]:
        name, type_, _ = self.accessors[kind]
        values = (type_ * size)()
        array = (c_uint * len(references))(*references)
        sizes = (c_size_t(size),) if self.fmi == 3 else ()
        return self.call(f"Get{name}")(component, array, c_size_t(len(references)), values, *sizes), list(values)

    def set(self, kind: str, component: pointer, references: list[int], values: list[Any]) -> int:
        name, type_, _ = self.accessors[kind]
        array = (c_uint * len(references))(*references)
        sizes = (c_size_t(len(values)),) if self.fmi == 3 else ()
        given = (type_ * len(values))(*values)
        return self.call(f"Set{name}")(component, array, c_size_t(len(references)), given, *sizes)  # type: ignore[no-any-return]  # ctypes

    # Life of an instance.

    def instantiate(self, logging: bool) -> pointer:
        if self.fmi == 2:
            uri = c_char_p(self.resources.as_uri().encode())
            one = self.call("Instantiate")(b"one", 1, c_char_p(self.token), uri, byref(self._logger), 0, int(logging))
        else:
            path, no = c_char_p(f"{self.resources}/".encode()), c_bool(False)
            one = self.call("InstantiateCoSimulation")(
                b"one", c_char_p(self.token), path, no, c_bool(logging), no, no, None, c_size_t(0), None,
                self._logger, None,
            )  # fmt: skip
        if not one:
            raise Wrong(f"cannot be instantiated: {self.said}")
        return pointer(one)

    def free(self, component: pointer) -> None:
        self.call("FreeInstance").restype = None
        self.call("FreeInstance")(component)

    def enter(self, component: pointer, start: float, stop: float) -> int:
        if self.fmi == 3:
            times = c_double(0.0), c_double(start), c_bool(True), c_double(stop)
            return self.call("EnterInitializationMode")(component, c_bool(False), *times)  # type: ignore[no-any-return]  # ctypes
        self.call("SetupExperiment")(component, 0, c_double(0.0), c_double(start), 1, c_double(stop))
        return self.call("EnterInitializationMode")(component)  # type: ignore[no-any-return]  # ctypes

    def step(self, component: pointer, t: float, h: float) -> int:
        if self.fmi == 2:
            return self.call("DoStep")(component, c_double(t), c_double(h), 1)  # type: ignore[no-any-return]  # ctypes
        flags = [byref(c_bool()) for _ in range(3)]
        return self.call("DoStep")(component, c_double(t), c_double(h), c_bool(True), *flags, byref(c_double()))  # type: ignore[no-any-return]  # ctypes

    # State.

    def saved(self, component: pointer) -> pointer:
        state = pointer()
        self.call("GetFMUState" if self.fmi == 3 else "GetFMUstate")(component, byref(state))
        return state

    def restored(self, component: pointer, state: pointer) -> int:
        return self.call("SetFMUState" if self.fmi == 3 else "SetFMUstate")(component, state)  # type: ignore[no-any-return]  # ctypes

    def freed(self, component: pointer, state: pointer) -> None:
        self.call("FreeFMUState" if self.fmi == 3 else "FreeFMUstate")(component, byref(state))

    def to_bytes(self, component: pointer, state: pointer) -> bytes:
        size = c_size_t()
        kind = "FMUState" if self.fmi == 3 else "FMUstate"
        self.call("SerializedFMUStateSize" if self.fmi == 3 else "SerializedFMUstateSize")(
            component, state, byref(size)
        )
        data = ctypes.create_string_buffer(size.value)
        self.call(f"Serialize{kind}")(component, state, data, size)
        return data.raw

    def from_bytes(self, component: pointer, data: bytes) -> pointer:
        state = pointer()
        name = "DeserializeFMUState" if self.fmi == 3 else "DeSerializeFMUstate"
        self.call(name)(component, ctypes.create_string_buffer(data, len(data)), c_size_t(len(data)), byref(state))
        return state

    def _callbacks(self) -> Any:
        if self.fmi == 3:
            return CFUNCTYPE(None, pointer, c_int, c_char_p, c_char_p)(self._hear3)
        log = CFUNCTYPE(None, pointer, c_char_p, c_int, c_char_p, c_char_p)

        class Callbacks(Structure):
            _fields_ = (("log", log), ("allocate", pointer), ("free", pointer), ("finished", pointer), ("env", pointer))

        memory = ctypes.CDLL(None)
        calloc, free = (ctypes.cast(getattr(memory, name), pointer) for name in ("calloc", "free"))
        return Callbacks(log(self._hear2), calloc, free, None, None)

    def _hear2(self, env: Any, who: bytes, status: int, category: bytes, message: bytes) -> None:
        self.said.append((status, message))

    def _hear3(self, env: Any, status: int, category: bytes, message: bytes) -> None:
        self.said.append((status, message))


class Fuzzer:
    """Sequences on one FMU."""

    def __init__(self, fmu: Fmu, states: list[bytes], trace: bool) -> None:
        self.fmu, self.states, self.trace = fmu, states, trace
        self.refused = self.steps = 0
        self.component: Any = None
        self.handles: list[pointer] = []
        self.expected = [self._continued(state) for state in states]

    def sequence(self, seed: int) -> None:
        """One sequence, mostly on the instance of the one before. Raises Wrong."""
        self.random = random.Random(seed)
        if self.component is None or self.random.random() < 0.1:
            self.close()
            self.component = self.fmu.instantiate(self.random.random() < 0.8)
        try:
            which = self.random.randrange(len(self.states))
            self._restore(self.states[which])
            kept = self.fmu.saved(self.component)
            self.handles.append(kept)
            for _ in range(self.random.randrange(1, 25)):
                self._anything()
            self._recover(which, kept)
        finally:
            self._forget()
            self.fmu.said.clear()

    def close(self) -> None:
        """Free the instance."""
        if self.component is not None:
            self.fmu.free(self.component)
            self.component = None

    def _forget(self) -> None:
        for handle in self.handles:
            self.fmu.freed(self.component, handle)
        self.handles.clear()

    def _recover(self, which: int, kept: pointer) -> None:
        """Back to the state in one of the ways that FMI has; then the step must be the one that was not disturbed."""
        way = self.random.choice(["handle", "bytes", "reset and handle", "new instance", "reset and start"])
        self._say(f"recover by {way}")
        if "reset" in way:
            self._want(OK, self.fmu.call("Reset")(self.component), "reset")
        if way == "reset and start":
            self._want(OK, self.fmu.enter(self.component, 0.0, 1e6), "enter")
            self._want(OK, self.fmu.call("ExitInitializationMode")(self.component), "exit")
            self._want(OK, self.fmu.step(self.component, 0.0, 0.05), "step")
            return
        if "handle" in way:
            self._want(OK, self.fmu.restored(self.component, kept), "restore")
        else:
            data = self.fmu.to_bytes(self.component, kept)
            if way == "new instance":
                self._forget()
                self.close()
                self.component = self.fmu.instantiate(True)
            self._restore(data)
        if self._stepped() != self.expected[which]:
            raise Wrong("the step after recovery is another than without the calls")

    def _continued(self, state: bytes) -> str:
        """Everything after one step from a state in a fresh instance."""
        self.close()
        self.component = self.fmu.instantiate(True)
        self._restore(state)
        values = self._stepped()
        self._forget()
        return values

    def _stepped(self) -> str:
        self._want(OK, self.fmu.step(self.component, 1.0, 0.05), "step")
        everything = []
        for kind, references in self.fmu.kinds.items():
            size = sum(self.fmu.sizes[reference] for reference in references)
            status, values = self.fmu.get(kind, self.component, references, size)
            self._want(OK, status, f"get {kind}")
            everything.append([value.hex() if isinstance(value, float) else str(value) for value in values])
        return json.dumps(everything)

    def _restore(self, data: bytes) -> None:
        self.handles.append(self.fmu.from_bytes(self.component, data))
        self._want(OK, self.fmu.restored(self.component, self.handles[-1]), "restore")

    def _want(self, status: int, got: int, what: str) -> None:
        if got != status:
            raise Wrong(f"{what}: status {got}, want {status}; said {self.fmu.said[-3:]}")

    def _say(self, what: str) -> None:
        if self.trace:
            print("   ", what, flush=True)

    # Random calls. ----------------------------------------------------------------------------------------------

    def _anything(self) -> None:
        chance: list[tuple[int, Callable[[], object]]] = [
            (30, self._set), (20, self._get), (20, self._step), (3, self._life), (6, self._state), (4, self._damaged),
            (2, self._unsupported), (2, self._logging),
        ]  # fmt: skip
        self.random.choices([call for _, call in chance], [weight for weight, _ in chance])[0]()

    def _references(self, kind: str) -> list[int]:
        mostly = self.fmu.kinds[kind]
        many = self.random.choice([0, 1, 1, 2, 3, 20])
        odd = [len(self.fmu.sizes), 2**32 - 1, 2**31, *self.fmu.sizes]
        return [self.random.choice(odd if self.random.random() < 0.03 else mostly) for _ in range(many)]

    def _size(self, kind: str, references: list[int]) -> int:
        """Values that go with these references, one for each that is not of this kind."""
        known = set(self.fmu.kinds[kind])
        return sum(self.fmu.sizes[reference] if reference in known else 1 for reference in references)

    def _set(self) -> None:
        kind = self.random.choice(list(self.fmu.kinds))
        references = self._references(kind)
        size = self._size(kind, references)
        usual = kind in ("Real", "Float64") and self.random.random() < 0.5
        values = [
            self.random.gauss(0.0, 100.0) if usual else self.random.choice(self.fmu.accessors[kind][2])
            for _ in range(size)
        ]
        status = self.fmu.set(kind, self.component, references, values)
        self._say(f"set {kind} {references} {values}: {status}")

    def _get(self) -> None:
        kind = self.random.choice(list(self.fmu.kinds))
        references = self._references(kind)
        size = self._size(kind, references)
        self._say(f"get {kind} {references}")
        status, values = self.fmu.get(kind, self.component, references, size)
        self._say(f"    {status} {values}")

    def _step(self) -> None:
        t = self.random.choice([0.0, 1.0, 1.05, -1.0, math.nan, 1e300])
        h = self.random.choice(STEPS)
        self._say(f"step {t} {h}")
        status = self.fmu.step(self.component, t, h)
        self.steps += status == OK
        self.refused += status != OK
        self._say(f"    {status} {self.fmu.said[-1:]}")
        if status not in {OK, *self.fmu.steps_refused}:
            raise Wrong(f"step {t} {h}: status {status}; said {self.fmu.said[-3:]}")

    def _life(self) -> None:
        name = self.random.choice(["enter", "ExitInitializationMode", "Terminate", "Reset", "again"])
        self._say(name)
        if name == "enter":
            start = self.random.choice(REALS)
            self.fmu.enter(self.component, start, self.random.choice(REALS))
        elif name == "again":
            self.fmu.call("Terminate")(self.component)
            self.fmu.call("Reset")(self.component)
            self.fmu.enter(self.component, 0.0, 1e6)
            self.fmu.call("ExitInitializationMode")(self.component)
        else:
            self.fmu.call(name)(self.component)

    def _state(self) -> None:
        if self.handles and self.random.random() < 0.5:
            self._say("restore a handle")
            self.fmu.restored(self.component, self.random.choice(self.handles))
        else:
            self._say("save")
            self.handles.append(self.fmu.saved(self.component))

    def _damaged(self) -> None:
        data = bytearray(self.random.choice(self.states))
        how = self.random.choice(["truncated", "flipped", "noise", "none"])
        if how == "truncated":
            del data[self.random.randrange(len(data)) :]
        elif how == "flipped":
            for _ in range(self.random.choice([1, 3])):
                data[self.random.randrange(len(data))] ^= 1 << self.random.randrange(8)
        else:
            data = bytearray(self.random.randbytes(50) if how == "noise" else b"")
        self._say(f"restore {how} bytes")
        self.handles.append(self.fmu.from_bytes(self.component, bytes(data)))
        self.fmu.restored(self.component, self.handles[-1])

    def _unsupported(self) -> None:
        one, none = (c_uint * 1)(0), c_size_t(0)
        if self.fmu.fmi == 2:
            two, many = (c_double * 1)(), c_size_t(1)
            calls = [
                lambda: self.fmu.call("CancelStep")(self.component),
                lambda: self.fmu.call("GetRealOutputDerivatives")(self.component, one, many, one, two),
                lambda: self.fmu.call("SetRealInputDerivatives")(self.component, one, many, one, two),
                lambda: self.fmu.call("GetDirectionalDerivative")(self.component, one, many, one, many, two, two),
                lambda: self.fmu.call(f"Get{self.random.choice(['', 'Real', 'Integer', 'Boolean'])}Status")(
                    self.component, self.random.choice([0, 2, 3, 9]), byref(two)
                ),
            ]
        else:
            calls = [
                lambda: self.fmu.call("GetDirectionalDerivative")(
                    self.component, one, none, one, none, None, none, None, none
                ),
                lambda: self.fmu.call("GetUInt64")(self.component, one, c_size_t(1), (c_int64 * 1)(), c_size_t(1)),
                lambda: self.fmu.call("EnterEventMode")(self.component),
                lambda: self.fmu.call("EnterStepMode")(self.component),
                lambda: self.fmu.call("EnterConfigurationMode")(self.component),
                lambda: self.fmu.call("ExitConfigurationMode")(self.component),
                lambda: self.fmu.call("SetTime")(self.component, c_double(1.0)),
            ]
        self._say("unsupported")
        self.random.choice(calls)()

    def _logging(self) -> None:
        categories = (c_char_p * 1)(self.random.choice([b"logStatusError", b"nothing"]))
        on, many = self.random.random() < 0.5, c_size_t(self.random.choice([0, 1]))
        self._say(f"logging {on} {many}")
        self.fmu.call("SetDebugLogging")(self.component, c_bool(on) if self.fmu.fmi == 3 else int(on), many, categories)


def main() -> None:
    parser = argparse.ArgumentParser(description="Random calls on an FMU.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("states", type=Path)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--trace", action="store_true")
    options = parser.parse_args()
    states = [base64.b64decode(text) for text in json.loads(options.states.read_text())]
    slowest = (0.0, 0)
    fuzzer = Fuzzer(Fmu(options.folder), states, options.trace)
    for seed in range(options.seed, options.seed + options.count):
        print(f"seed {seed}", flush=True)
        try:
            begin = perf_counter()
            fuzzer.sequence(seed)
            slowest = max(slowest, (perf_counter() - begin, seed))
        except Wrong as error:
            print(f"wrong at seed {seed}: {error}")
            sys.exit(1)
    fuzzer.close()
    print(f"done: {options.count} sequences, {fuzzer.steps} random steps made, {fuzzer.refused} refused")
    print(f"slowest: {slowest[0]:.3f} s with seed {slowest[1]}")


if __name__ == "__main__":
    main()
