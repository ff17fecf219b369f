"""The order of calls of the two algorithms, and what each does to a head-on impact in one dimension."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from ctypes import c_double, c_int
from typing import Any

import pytest

from shipcollision_fmu.cosim.component import Buffer, Group, Value
from shipcollision_fmu.cosim.master import ALGORITHMS, System, Wire


class Recorded:
    """A component that notes every call; its outputs are all `value`."""

    def __init__(self, name: str, calls: list[str]) -> None:
        self.name, self.calls, self.value = name, calls, 0.0

    def reals(self, names: Sequence[str], values: Buffer | None = None) -> Group:
        buffer = (c_double * len(names))() if values is None else values
        return RecordedGroup(self, buffer)

    def integers(self, names: Sequence[str]) -> Group:
        return RecordedGroup(self, (c_int * len(names))())

    def initialise(self, parameters: Mapping[str, Value], stop_time: float, inputs: Sequence[Group] = ()) -> None:
        self.calls.append(f"initialise {self.name}")

    def step(self, t: float, h: float) -> None:
        self.calls.append(f"step {self.name}")

    def close(self) -> None:
        self.calls.append(f"close {self.name}")


class RecordedGroup:
    def __init__(self, owner: Recorded, values: Any) -> None:
        self.owner, self.values = owner, values

    def read(self, count: int | None = None) -> None:
        self.owner.calls.append(f"read {self.owner.name}")

    def write(self) -> None:
        self.owner.calls.append(f"write {self.owner.name}")


@pytest.fixture
def calls() -> list[str]:
    return []


@pytest.fixture
def system(calls: list[str]) -> System:
    ships, collision = [Recorded("own", calls), Recorded("target", calls)], Recorded("collision", calls)
    return System(
        ships,
        collision,
        states=[Wire.between(ship, ["x"], collision, [f"{ship.name}.x"]) for ship in ships],
        answers=[Wire.between(collision, [f"{ship.name}.P"], ship, ["P"]) for ship in ships],
    )


def test_a_wire_has_one_buffer(system: System) -> None:
    assert system.states[0].outputs.values is system.states[0].inputs.values


def test_gauss_seidel_steps_the_collision_first_and_takes_its_impulses_to_the_ships(
    system: System, calls: list[str]
) -> None:
    ALGORITHMS["gauss-seidel"](system, 0.0, 0.05)
    assert calls == [
        "write collision", "write collision", "step collision",
        "read collision", "read collision", "write own", "write target",
        "step own", "step target", "read own", "read target",
    ]  # fmt: skip


def test_jacobi_exchanges_everything_before_anyone_steps(system: System, calls: list[str]) -> None:
    ALGORITHMS["jacobi"](system, 0.0, 0.05)
    assert calls == [
        "write collision", "write collision", "write own", "write target",
        "step collision", "step own", "step target",
        "read collision", "read collision", "read own", "read target",
    ]  # fmt: skip
