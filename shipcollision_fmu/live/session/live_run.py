"""LiveRun: a scenario that people steer while it runs, without a clock.

    advance          one communication step, with the orders that wait
    bridges          orders and failures by ship (bridge.py); armed.py has failures that begin by themselves
    change           current and wind from the next communication point
    mark, go_back    keep the whole state and come back to it; from there the run is, to the bit, as without
    finish           the Run, and the scenario that gives the same run again

The models run in process. The first step is made at once: orders take effect from communication point 1 on, as at
point 0 an order would change how the ships start.
"""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass
from math import degrees, dist
from pathlib import Path
from time import perf_counter
from typing import Any

from pydantic import ValidationError

from ...cosim.factories import model_factories
from ...cosim.parameters import change_surroundings, changed_surroundings, surroundings
from ...cosim.recorder import ContactPoint, EndValues, RecorderMark
from ...cosim.run import Run
from ...cosim.simulate import build_run
from ...cosim.stepper import Stepper
from ...errors import InputError
from ...fmi.names import AXES, NED, STATE, named
from ...scenario.scenario import Scenario, parse_scenario
from ...scenario.tables.environment import EnvironmentChange
from ...ship.loading.messages import describe_error
from ...ship.ship_state import ShipState
from .armed import Armed, ArmedFailures
from .bridge import Bridge
from .input_files import read_input_files
from .scenario_text import write_scenario
from .ship_limits import find_limits
from .snapshot import CollisionSnapshot, ContactSnapshot, EnvironmentSnapshot, ShipSnapshot, TouchSnapshot, WindSnapshot
from .touch_log import LoggedTouch, TouchLog

__all__ = ["MOST_MARKS", "LiveRun"]

MOST_MARKS = 30
"""Marks at a time. Each keeps a copy of the state, some 100 kB."""
SHOWN = 16
"""Collisions in a snapshot, the latest ones."""


@dataclass(frozen=True)
class _Kept:
    """The state at a mark."""

    k: int
    components: list[dict[str, Any]]
    bridges: dict[str, dict[str, Any]]
    recorded: RecorderMark
    changes: dict[int, EnvironmentChange]
    around: list[float]
    waiting: EnvironmentChange | None
    armed: tuple[Armed, ...]
    touches: tuple[LoggedTouch, ...]
    end: EndValues
    note: str = ""


class LiveRun:
    """A live run of a scenario, after its first step. `spool`: folder for temporary files of the record.

    Raises ScenarioError for ships that cannot be loaded, StepError when the first step is refused. close() it.
    """

    def __init__(self, scenario: Scenario, spool: Path | None = None) -> None:
        self.scenario, self.ships = scenario, scenario.load_ships()
        self.inputs = read_input_files(scenario)
        self._stack = ExitStack()
        try:
            factories = model_factories(tuple(scenario.ships), self._stack)
            self._stepper = Stepper(scenario, self.ships, factories, spool=spool)
            self._stack.callback(self._stepper.recorder.close)
        except BaseException:
            self._stack.close()
            raise
        system = self._stepper.system
        self._components: list[Any] = [*system.ships, system.collision]
        self.bridges = {
            name: Bridge(
                name, start, self.ships[name].L_pp, system.ships[i], self._stepper.helms.get(name),
                find_limits(self.ships[name], bool(start.hydrodynamics)), scenario.step, spool,
            )
            for i, (name, start) in enumerate(scenario.ships.items())
        }  # fmt: skip
        for bridge in self.bridges.values():
            self._stack.callback(bridge.log.close)
        self._coming = changed_surroundings(scenario)
        self._changes: dict[int, EnvironmentChange] = {}
        self._around = self._coming.get(0, surroundings(scenario))
        self._waiting: EnvironmentChange | None = None
        self._marks: dict[str, _Kept] = {}
        self.touch_log, self.armed, self.triggered = TouchLog(), ArmedFailures(), list[Armed]()
        self._begin = perf_counter()
        self._end = self._stepper.recorder.read_end()
        self.advance()

    # -- time ---------------------------------------------------------------------------------------------------------

    @property
    def k(self) -> int:
        """The communication point."""
        return self._stepper.k

    @property
    def step(self) -> float:
        """The communication step [s]."""
        return self._stepper.step

    @property
    def latest_end(self) -> float | None:
        """The time [s] at which recorded tracks end; None without any."""
        return self.scenario.scenario.duration if self.scenario.tracks else None

    @property
    def recorded(self) -> int:
        """The communication point up to which the run is recorded; the record has a full length."""
        return min(self.k, self._stepper.most_recorded)

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return round(self.k * self.step, 9)

    def advance(self) -> None:
        """One communication step. Raises StepError; the record then ends before it."""
        k = self.k
        self._trigger()
        for bridge in self.bridges.values():
            bridge.prepare(k)
        self._change(k)
        self._stepper.advance()
        recorder = self._stepper.recorder
        if recorder.contact_count:
            self.touch_log.add(self.time, map(_observe_touch, recorder.read_contact_points()), self._turn)
        if self.k <= self._stepper.most_recorded:
            self._end = recorder.read_end()

    # -- failures that are armed ---------------------------------------------------------------------------------------

    def arm(self, armed: Armed) -> None:
        """Let a failure begin by itself. Raises InputError for one that cannot be."""
        bridge = self.bridges[armed.ship]
        bridge.require_limits()
        if armed.what in bridge.failures:
            raise InputError(f"{armed.ship}: {armed.what} is on already: end it first")
        armed.check(self.time, self._distance)
        self.armed.arm(armed)

    def _trigger(self) -> None:
        """Begin what is due, for the order of this communication point; `triggered` then has what has begun."""
        due = self.armed.take_due(self.time, self._distance)
        self.triggered = [one for one in due if one.what not in self.bridges[one.ship].failures]
        for one in self.triggered:
            self.bridges[one.ship].fail(one.what, True)

    def _distance(self, ship: str, other: str) -> float:
        """[m] between CO of two ships in plan."""
        here, there = (self._read_state(name)[:2] for name in (ship, other))
        return dist(here, there)

    def _read_state(self, ship: str) -> list[float]:
        wire = self._stepper.system.states[list(self.bridges).index(ship)]
        return list(wire.outputs.values[: len(STATE)])

    def _turn(self, body: str, vector: tuple[float, float, float]) -> tuple[float, float, float]:
        """A vector in n, in the b of a ship as it is; of an obstacle as it is."""
        if body not in self.bridges:
            return vector
        x, y, z = ShipState(*self._read_state(body)).R_nb.T @ vector
        return float(x), float(y), float(z)

    # -- current and wind ---------------------------------------------------------------------------------------------

    def change(self, current: tuple[float, float] | None, wind: tuple[float, float] | None) -> None:
        """Another current [north, east] [m/s] or wind (speed [m/s], from [deg]), from the next communication point.

        Raises InputError beyond the limits of a scenario file, and where no ship feels either.
        """
        if not any(start.hydrodynamics for start in self.scenario.ships.values()):
            raise InputError("current and wind act on no ship here: take a scenario with hydrodynamics = true")
        before = self._waiting
        given = make_change(current, wind)
        if before is not None:
            given = EnvironmentChange(time=0.0, current=given.current or before.current, wind=given.wind or before.wind)
        self._waiting = given

    def _change(self, k: int) -> None:
        """Write down and send what changes at communication point k."""
        values = self._coming.pop(k, None)
        if values is not None:  # of the scenario, whose helms have it already
            self._around = values
        if self._waiting is None:
            return
        self._changes[k], self._waiting = self._waiting, None
        self._coming.clear()
        self._around = change_surroundings(self._around, self._changes[k])
        for helm in self._stepper.helms.values():
            helm.changes = {k: self._around}

    # -- marks --------------------------------------------------------------------------------------------------------

    @property
    def marks(self) -> dict[str, float]:
        """Simulated times [s] of the marks by name."""
        return {name: round(kept.k * self.step, 9) for name, kept in self._marks.items()}

    @property
    def notes(self) -> dict[str, str]:
        """Notes on the marks by name, empty where there is none."""
        return {name: kept.note for name, kept in self._marks.items()}

    def mark(self, name: str, note: str = "") -> None:
        """Keep the state under a name, with a note; one of that name goes. Raises InputError for too many marks."""
        if name not in self._marks and len(self._marks) >= MOST_MARKS:
            raise InputError(f"mark {name!r}: there are {MOST_MARKS} marks, which is the limit: take the name of one")
        kept = _Kept(
            self.k, [component.save() for component in self._components],
            {ship: bridge.save() for ship, bridge in self.bridges.items()}, self._stepper.recorder.mark(),
            dict(self._changes), list(self._around), self._waiting, self.armed.listed, self.touch_log.touches,
            self._end, note,
        )  # fmt: skip
        others = {other: mark for other, mark in self._marks.items() if other != name}
        self._marks = {**others, name: kept}  # a new one, as other threads may read the one before

    def go_back(self, name: str) -> None:
        """Go back to a mark; what was recorded and marked since is forgotten. Raises InputError for an unknown name."""
        if name not in self._marks:
            known = ", ".join(self._marks) or "none"
            raise InputError(f"there is no mark {name!r}: the marks are {known}")
        kept = self._marks[name]
        for component, state in zip(self._components, kept.components, strict=True):
            component.restore(state)
        for ship, bridge in self.bridges.items():
            bridge.restore(kept.bridges[ship])
        system = self._stepper.system
        for wire in (*system.states, *system.answers):
            wire.outputs.read()
        self._stepper.recorder.go_back(kept.recorded)
        self._stepper.k = kept.k
        self.touch_log.restore(kept.touches)
        self._changes, self._around, self._end = dict(kept.changes), list(kept.around), kept.end
        self._coming = {k: values for k, values in changed_surroundings(self.scenario).items() if k >= kept.k}
        if self._changes:
            self._coming.clear()
        self._waiting, self.armed.listed = kept.waiting, kept.armed
        self._marks = {name: mark for name, mark in self._marks.items() if mark.k <= kept.k}

    # -- what is seen -------------------------------------------------------------------------------------------------

    def observe_ships(self) -> dict[str, ShipSnapshot]:
        """The ships as they are."""
        return {
            name: self._observe_ship(bridge, wire.outputs.values)
            for (name, bridge), wire in zip(self.bridges.items(), self._stepper.system.states, strict=True)
        }

    def observe_environment(self) -> EnvironmentSnapshot:
        """Current and wind as they are, or as they will be from the next step."""
        values = self._around if self._waiting is None else change_surroundings(self._around, self._waiting)
        north, east, speed, direction = values
        return EnvironmentSnapshot((north, east), WindSnapshot(speed, degrees(direction)))

    def observe_contact(self) -> ContactSnapshot:
        """Contact and collisions so far."""
        recorder = self._stepper.recorder
        latest = list(recorder.collisions.items())[-SHOWN:]
        return ContactSnapshot(
            recorder.contact_count, tuple(map(_observe_touch, recorder.read_contact_points())),
            len(recorder.collisions),
            tuple(
                CollisionSnapshot(
                    number, recorder.starts[number].time, so_far.ship_a, so_far.ship_b, recorder.starts[number].point,
                    so_far.energy, so_far.a, so_far.b,
                )
                for number, so_far in latest
            ),
            recorder.clearance, recorder.nearest, recorder.dissipated,
        )  # fmt: skip

    def list_touches(self) -> dict[int, float]:
        """When the bodies of each collision last touched [s], by its number, for the latest collisions."""
        return {number: so_far.last for number, so_far in list(self._stepper.recorder.collisions.items())[-SHOWN:]}

    @staticmethod
    def _observe_ship(bridge: Bridge, values: Any) -> ShipSnapshot:
        state = tuple(values[: len(STATE)])
        rudder, revolutions = bridge.read_machines()
        rudder_order, rev_order, heading = bridge.read_orders()
        return ShipSnapshot(
            state[:6], state[6:], rudder, revolutions, rudder_order, rev_order, heading, bridge.failures, bridge.horn
        )

    # -- the end ------------------------------------------------------------------------------------------------------

    def write_scenario(self) -> str:
        """The text of a scenario that gives this run again: orders, failures, current and wind as they were given."""
        return write_scenario(self.scenario, self.inputs, self.recorded, self.bridges, self._changes)

    def finish(self, folder: Path) -> Run:
        """The run so far; its `inputs` are written into `folder`."""
        scenario = parse_scenario(self.write_scenario(), f"{self.scenario.name}, live", folder)
        record = self._stepper.recorder.build_record(self._end)
        return build_run(scenario, self.ships, record, "live", perf_counter() - self._begin)

    def close(self) -> None:
        """Give everything back; may be called twice."""
        self._stack.close()


def _observe_touch(point: ContactPoint) -> TouchSnapshot:
    def vector(columns: tuple[str, ...]) -> tuple[float, float, float]:
        x, y, z = (point.values[column] for column in columns)
        return x, y, z

    places = vector(named("a", AXES)), vector(named("b", AXES))
    return TouchSnapshot(point.ship_a, point.ship_b, *places, vector(named("normal", NED)))


def make_change(current: tuple[float, float] | None, wind: tuple[float, float] | None) -> EnvironmentChange:
    """A change of current [north, east] [m/s] and wind (speed [m/s], from [deg]). Raises InputError."""
    data: dict[str, Any] = {"time": 0.0}
    if current is not None:
        data["current"] = list(map(float, current))
    if wind is not None:
        data["wind"] = {"speed": float(wind[0]), "from_deg": float(wind[1])}
    try:
        return EnvironmentChange.model_validate(data)
    except ValidationError as error:
        raise InputError(f"environment: {describe_error(error, EnvironmentChange)}") from None
