"""NativeShip: the native ship model behind the face of the Python model, through the plain C interface."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from dataclasses import asdict, dataclass, field, fields
from functools import cache
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from shipcollision_fmu.errors import ScenarioError, ShipError, StepError
from shipcollision_fmu.manoeuvring.interface import ShipInputs, ShipOutputs, ShipParameters
from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from shipcollision_fmu.ship.coasting_law import COASTING

__all__ = ["NativeShip", "RefusedError"]

MESSAGE = 4096
REAL, VECTORS = ctypes.c_double, {"current": 2, "impulse": 6, "force": 6}


class RefusedError(ShipError, ScenarioError, StepError):
    """What the native model refuses; it has one kind of refusal."""


class _Parameters(ctypes.Structure):
    _fields_ = (
        ("ship", ctypes.c_char * 4096), ("degrees_of_freedom", ctypes.c_int), ("hydrodynamics", ctypes.c_bool),
        ("initial_position", REAL * 3), ("initial_attitude", REAL * 3), ("initial_velocity", REAL * 3),
        ("initial_rate", REAL * 3), ("substep", REAL), ("coasting", ctypes.c_int),
    )  # fmt: skip


class _Inputs(ctypes.Structure):
    _fields_ = tuple((of.name, REAL * VECTORS[of.name] if of.name in VECTORS else REAL) for of in fields(ShipInputs))


class _Outputs(ctypes.Structure):
    _fields_ = (
        ("position", REAL * 3), ("attitude", REAL * 3), ("velocity", REAL * 3), ("rate", REAL * 3),
        ("rudder_angle", REAL), ("propeller_speed", REAL), ("impulse_applied", REAL * 6), ("hull", REAL * 6),
        ("propeller", REAL * 6), ("rudder", REAL * 6), ("wind", REAL * 6),
    )  # fmt: skip


def prepare(source: str) -> str:
    """Path of the prepared file of a ship; a prepared one stays as it is."""
    if source.endswith(".ship"):
        return source
    return _prepare(source, Path(source).read_bytes() if Path(source).is_file() else b"")


@cache
def _prepare(source: str, _content: bytes) -> str:
    path = Path(mkdtemp(prefix="shipcollision-"), "prepared.ship")
    path.write_bytes(prepare_ship(source))
    return str(path)


@dataclass
class NativeShip:
    """ShipManoeuvring of native/: fill parameters and inputs, initialise(), then step(t, h), as of the model.

    directory: resources, in which the model looks for ships. find_ship: the text for its parameter `ship`.
    """

    library: ctypes.CDLL
    directory: str = ""
    find_ship: Callable[[str], str] = prepare
    parameters: ShipParameters = field(default_factory=ShipParameters)
    inputs: ShipInputs = field(default_factory=ShipInputs)
    outputs: ShipOutputs = field(default_factory=ShipOutputs)

    def __post_init__(self) -> None:
        for name in ("make_ship", "ship_parameters", "ship_inputs", "ship_outputs"):
            getattr(self.library, f"shipcollision_{name}").restype = ctypes.c_void_p
        for name in ("initialise_ship", "step_ship", "set_ship_state"):
            getattr(self.library, f"shipcollision_{name}").restype = ctypes.c_bool
        self.library.shipcollision_ship_warning.restype = ctypes.c_char_p
        for name in ("ship_state_size", "get_ship_state"):
            getattr(self.library, f"shipcollision_{name}").restype = ctypes.c_size_t
        self._ship = ctypes.c_void_p(self.library.shipcollision_make_ship(self.directory.encode()))
        if not self._ship:
            raise ValueError(f"a folder of {len(self.directory.encode())} bytes: it must have less than 4096")
        at = {name: getattr(self.library, f"shipcollision_ship_{name}")(self._ship) for name in ("inputs", "outputs")}
        self._inputs, self._outputs = _Inputs.from_address(at["inputs"]), _Outputs.from_address(at["outputs"])
        self._parameters = _Parameters.from_address(self.library.shipcollision_ship_parameters(self._ship))

    def __del__(self) -> None:
        self.library.shipcollision_free_ship(self._ship)

    @property
    def warning(self) -> str:
        text: bytes = self.library.shipcollision_ship_warning(self._ship)
        return text.decode()

    def initialise(self) -> None:
        self._fill_parameters()
        _fill(self._inputs, self.inputs)
        self._call("initialise_ship")

    def step(self, t: float, h: float) -> None:
        _fill(self._inputs, self.inputs)
        self._call("step_ship", REAL(t), REAL(h))

    def get_state(self) -> dict[str, Any]:
        data = ctypes.create_string_buffer(self.library.shipcollision_ship_state_size())
        size = self.library.shipcollision_get_ship_state(self._ship, data)
        return {"bytes": data.raw[:size].hex()} if size else {}

    def set_state(self, state: dict[str, Any]) -> None:
        data = bytes.fromhex(state.get("bytes", ""))
        self._fill_parameters()
        self._call("set_ship_state", data, ctypes.c_size_t(len(data)))

    def _fill_parameters(self) -> None:
        p = asdict(self.parameters)
        p["ship"], p["coasting"] = self.find_ship(p["ship"]).encode(), COASTING.index(p["coasting"])
        for name, value in p.items():
            if isinstance(value, list):
                getattr(self._parameters, name)[:] = value
            else:
                setattr(self._parameters, name, value)

    def _call(self, name: str, *arguments: Any) -> None:
        message = ctypes.create_string_buffer(MESSAGE)
        function = getattr(self.library, f"shipcollision_{name}")
        if not function(self._ship, *arguments, message, ctypes.c_size_t(MESSAGE)):
            raise RefusedError(message.value.decode())
        for of in fields(ShipOutputs):
            value = getattr(self._outputs, of.name)
            if isinstance(value, float):
                setattr(self.outputs, of.name, value)
            else:
                getattr(self.outputs, of.name)[:] = value[:]


def _fill(into: _Inputs, inputs: ShipInputs) -> None:
    for of in fields(ShipInputs):
        value = getattr(inputs, of.name)
        if isinstance(value, list):
            getattr(into, of.name)[:] = value
        else:
            setattr(into, of.name, value)
