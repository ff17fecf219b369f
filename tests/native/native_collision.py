"""NativeCollision: the native collision model behind the face of the Python model, through the plain C interface."""

from __future__ import annotations

import ctypes
from collections.abc import Collection, Sequence
from functools import cache
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from shipcollision_fmu.collision.feedback import COMMON_FEEDBACKS, SHIP_FEEDBACKS
from shipcollision_fmu.collision.interface import (
    CollisionInputs,
    CollisionOutputs,
    CollisionParameters,
    ContactOutput,
    ShipParameters,
    ShipPost,
    ShipState,
)
from shipcollision_fmu.collision.prepared_obstacles import prepare_obstacles
from shipcollision_fmu.collision.responses import RESPONSES
from shipcollision_fmu.errors import ShipError, StepError
from shipcollision_fmu.ship.coasting_law import COASTING
from tests.native.native_ship import prepare

__all__ = ["NativeCollision"]

MESSAGE = 4096
STATE = ("position", "attitude", "velocity", "rate", "impulse_applied")
POST = ("position", "attitude", "velocity", "rate", "impulse", "force")


class RefusedError(ShipError, StepError):
    """What the native model refuses; it has one kind of refusal."""


class _Contact(ctypes.Structure):
    _fields_ = (
        *((name, ctypes.c_double * 3) for name in ("point", "normal", "r_a", "r_b", "impulse", "couple")),
        *((name, ctypes.c_double) for name in ("gap", "impulse_normal", "impulse_tangential", "energy")),
        *((name, ctypes.c_int) for name in ("ship_a", "ship_b", "collision", "scratch")), ("start", ctypes.c_double),
        ("first", ctypes.c_double * 3), ("closing_speed", ctypes.c_double), ("angle", ctypes.c_double),
    )  # fmt: skip


@cache
def prepare_wall(text: str) -> str:
    """Path of prepared obstacles."""
    path = Path(mkdtemp(prefix="shipcollision-"), "prepared.obstacles")
    path.write_bytes(prepare_obstacles(text))
    return str(path)


class NativeCollision:
    """ShipCollision of native/: fill parameters and inputs, initialise(), then step(t, H), as of the model."""

    def __init__(self, library: ctypes.CDLL, ships: Sequence[str] = ("own", "target")) -> None:
        self._library, self.names = library, tuple(ships)
        for name in ("make_collision", "collision_inputs", "collision_posts", "collision_contacts"):
            getattr(library, f"shipcollision_{name}").restype = ctypes.c_void_p
        for name in ("initialise_collision", "step_collision", "set_collision_state", "set_collision_ship"):
            getattr(library, f"shipcollision_{name}").restype = ctypes.c_bool
        for name in ("collision_warning", "collision_event", "collision_outputs"):
            getattr(library, f"shipcollision_{name}").restype = ctypes.c_char_p
        library.shipcollision_collision_state_size.restype = ctypes.c_size_t
        words, message = (ctypes.c_char_p * len(ships))(*(s.encode() for s in ships)), self._message()
        made = library.shipcollision_make_collision(words, len(ships), b"", *message)
        if made is None:
            raise RefusedError(message[0].value.decode())
        self._at = ctypes.c_void_p(made)
        self.parameters = CollisionParameters([ShipParameters() for _ in ships])
        self.inputs = CollisionInputs([ShipState() for _ in ships])
        self.outputs = CollisionOutputs([ShipPost() for _ in ships])
        count = library.shipcollision_collision_contact_count(self._at)
        assert count == len(self.outputs.contacts)
        place = library.shipcollision_collision_inputs(self._at)
        self._inputs = (ctypes.c_double * (18 * len(ships))).from_address(place)
        place = library.shipcollision_collision_posts(self._at)
        self._posts = (ctypes.c_double * (24 * len(ships))).from_address(place)
        self._contacts = (_Contact * count).from_address(library.shipcollision_collision_contacts(self._at))

    def __del__(self) -> None:
        if hasattr(self, "_at"):
            self._library.shipcollision_free_collision(self._at)

    def close(self) -> None:
        """Nothing is open."""

    @staticmethod
    def _message() -> tuple[Any, ctypes.c_size_t]:
        return ctypes.create_string_buffer(MESSAGE), ctypes.c_size_t(MESSAGE)

    @property
    def warning(self) -> str:
        text: bytes = self._library.shipcollision_collision_warning(self._at)
        return text.decode()

    @property
    def events(self) -> list[str]:
        count = self._library.shipcollision_collision_event_count(self._at)
        return [self._library.shipcollision_collision_event(self._at, i).decode() for i in range(count)]

    def note_inputs_set(self, paths: Collection[str]) -> None:
        for i in range(len(self.names)):
            is_set = any(f"inputs.ships.{i}.{part}" in paths for part in STATE[:4])
            self._library.shipcollision_note_collision_state_set(self._at, i, ctypes.c_bool(is_set))

    def initialise(self) -> None:
        self._fill_parameters()
        self._fill_inputs()
        self._call("initialise_collision")

    def step(self, t: float, H: float) -> None:
        self._fill_inputs()
        self._call("step_collision", ctypes.c_double(t), ctypes.c_double(H))

    def get_state(self) -> dict[str, Any]:
        size = self._library.shipcollision_collision_state_size(self._at)
        data = ctypes.create_string_buffer(size)
        self._library.shipcollision_get_collision_state(self._at, data, ctypes.c_size_t(size))
        return {"bytes": data.raw[:size].hex()} if size else {}

    def set_state(self, state: dict[str, Any]) -> None:
        self._fill_parameters()
        self.restore(bytes.fromhex(state.get("bytes", "")))

    def restore(self, data: bytes) -> None:
        """Back to the bytes of a state; parameters and outputs stay."""
        message = self._message()
        if not self._library.shipcollision_set_collision_state(self._at, data, ctypes.c_size_t(len(data)), *message):
            raise RefusedError(message[0].value.decode())

    def _fill_parameters(self) -> None:
        p = self.parameters
        for i, ship in enumerate(p.ships):
            fender = (ctypes.c_double * 3)(ship.fender.stiffness, ship.fender.damping, ship.fender.thickness)
            self._library.shipcollision_set_collision_ship(
                self._at, i, prepare(ship.ship).encode(), ship.degrees_of_freedom, COASTING.index(ship.coasting),
                fender, SHIP_FEEDBACKS.index(ship.feedback), ship.feedback_name.encode(),
            )  # fmt: skip
        numbers = (ctypes.c_double * 5)(
            p.friction, p.restitution, p.substep, p.minimum_separation_time, p.clearance_range
        )
        obstacles = prepare_wall(p.obstacles) if p.obstacles.strip() else ""
        self._library.shipcollision_set_collision_parameters(
            self._at, numbers, list(RESPONSES).index(p.response), COMMON_FEEDBACKS.index(p.feedback), obstacles.encode()
        )

    def _fill_inputs(self) -> None:
        self._inputs[:] = [x for ship in self.inputs.ships for name in STATE for x in getattr(ship, name)]

    def _call(self, name: str, *arguments: Any) -> None:
        message = self._message()
        is_done = getattr(self._library, f"shipcollision_{name}")(self._at, *arguments, *message)
        self._read_outputs()
        if not is_done:
            raise RefusedError(message[0].value.decode())

    def _read_outputs(self) -> None:
        out, posts = self.outputs, self._posts[:]
        for i, ship in enumerate(out.ships):
            at = 24 * i
            for name, size in zip(POST, (3, 3, 3, 3, 6, 6), strict=True):
                getattr(ship, name)[:] = posts[at : at + size]
                at += size
        for contact, native in zip(out.contacts, self._contacts, strict=True):
            for name in vars(ContactOutput()):
                value = getattr(native, name)
                if isinstance(value, (int, float)):
                    setattr(contact, name, value)
                else:
                    getattr(contact, name)[:] = value[:]
        numbers = (ctypes.c_double * 27)()
        text: bytes = self._library.shipcollision_collision_outputs(self._at, numbers)
        n = list(numbers)
        out.contact_active, out.contact_count, out.collision_count = bool(n[0]), int(n[1]), int(n[2])
        out.impact.time, out.impact.point[:], out.impact.closing_speed, out.impact.angle = n[3], n[4:7], n[7], n[8]
        out.impact.ship_a, out.impact.ship_b, out.scratch_id = int(n[9]), int(n[10]), int(n[11])
        out.energy.dissipated, out.energy.normal, out.energy.tangential = n[12:15]
        out.fender.stored, out.fender.dissipated, out.clearance = n[15:18]
        out.nearest_ship_a, out.nearest_ship_b, out.solver.residual = int(n[18]), int(n[19]), n[20]
        out.solver.sweeps, out.solver.unconverged, out.solver.scaled = int(n[21]), int(n[22]), int(n[23])
        out.diagnosis.code, out.diagnosis.ship, out.diagnosis.count = int(n[24]), int(n[25]), int(n[26])
        out.diagnosis.text = text.decode()
