"""The native ship model beside the Python model: each step, whole runs, refusals word for word, states to the bit."""

from __future__ import annotations

import struct
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.errors import ShipCollisionError
from shipcollision_fmu.manoeuvring import model
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.ship.loading.library import load_ship
from tests.native.kernels import load_kernels
from tests.native.native_ship import NativeShip
from tests.native.random_ships import COASTING, SAILING, draw_sailing_ship

STEP, RUN = 1e-11, 1e-9
"""Largest difference over the scale of the state: of a step, and of a run of a thousand steps."""
LAWS = ("kirchhoff", "free", "straight")


def flatten(state: dict[str, Any]) -> list[float]:
    """The state in the order of the native one."""
    return [x for value in state.values() for x in (value if isinstance(value, list | tuple) else [value])]


def give_state(native: NativeShip, state: dict[str, Any]) -> None:
    native.set_state({"bytes": struct.pack("<46d", *flatten(state)).hex()})


def take_state(native: NativeShip) -> list[float]:
    return list(struct.unpack("<46d", bytes.fromhex(native.get_state()["bytes"])))


def find_scales(state: list[float], length: float) -> Array:
    """What a difference of each number is judged by: the place by the ship's length or its distance, velocities by the
    fastest of all, forces by the largest of all."""
    x = np.abs(state)
    speed = max(x[6:9].max(), length * x[9:12].max(), 0.1)
    impulse = max(x[12:15].max(), x[15:18].max() / length, 1.0)
    force = max(max(x[k : k + 3].max(), x[k + 3 : k + 6].max() / length) for k in (22, 28, 34, 40)) or 1.0
    wrench = [*[force] * 3, *[force * length] * 3]
    return np.array([
        *[max(length, *x[:3])] * 3, *[max(1.0, *x[3:6])] * 3, *[speed] * 3, *[speed / length] * 3,
        *[impulse] * 3, *[impulse * length] * 3, 1.0, 1.0, 1.0, max(1.0, x[21]), *wrench * 4,
    ])  # fmt: skip


def compare(native: list[float], state: dict[str, Any], length: float) -> float:
    """The largest difference over its scale."""
    expected = flatten(state)
    return float(np.max(np.abs(np.array(native) - expected) / find_scales(expected, length)))


class Pair:
    """The same ship in both languages."""

    def __init__(self, ship: Any, folder: Path) -> None:
        prepared = folder / "random.ship"
        prepared.write_bytes(prepare_ship(ship))
        self.python, self.native = ShipManoeuvring(), NativeShip(load_kernels())
        self.ship = load_ship(ship)
        self.prepared = str(prepared)

    def initialise(self, monkeypatch: pytest.MonkeyPatch) -> tuple[str, str]:
        """The refusals of both, empty where there is none."""
        monkeypatch.setattr(model, "load_ship", lambda _name, _folder: self.ship)
        said = []
        for of, name in zip(self.each(), ("a ship", self.prepared), strict=True):
            of.parameters.ship = name
            said.append(refusal_of(of.initialise))
        return said[0], said[1]

    def each(self) -> tuple[Any, Any]:
        return self.python, self.native


def refusal_of(call: Callable[..., None], *arguments: float) -> str:
    try:
        call(*arguments)
    except ShipCollisionError as error:
        return str(error)
    return ""


def draw_case(pair: Pair, random: Random) -> None:
    """Random parameters for both models."""
    sails = pair.ship.manoeuvring is not None and random.random() < 0.75
    free, law = random.choice([3, 4, 6]), random.choice(LAWS)
    heels = free == 6 or (free == 4 and random.random() < 0.3) or not sails
    L = pair.ship.L_pp
    position = [random.uniform(-2e3, 2e3), random.uniform(-2e3, 2e3), random.uniform(-0.3, 0.3) if free == 6 else 0.0]
    attitude = [0.1 * random.gauss(0, 1) * heels, 0.02 * random.gauss(0, 1) * (free == 6), random.uniform(-9, 9)]
    if free == 3 and sails:
        attitude[0] = 0.0
    velocity = [random.uniform(-3.0, 10.0), random.gauss(0, 1), 0.1 * random.gauss(0, 1) * (free == 6 or not sails)]
    rate = [0.01 * random.gauss(0, 1) * (free != 3), 0.003 * random.gauss(0, 1) * (free == 6), random.gauss(0, 1) / L]
    for of in pair.each():
        p = of.parameters
        p.degrees_of_freedom, p.hydrodynamics, p.coasting = free, sails, law
        p.initial_position[:], p.initial_attitude[:] = position, attitude
        p.initial_velocity[:], p.initial_rate[:] = velocity, rate
        p.substep = 0.05


def draw_inputs(pair: Pair, random: Random) -> None:
    """New inputs for both models; the impulse is cumulative."""
    calm, still, free = random.random() < 0.4, random.random() < 0.5, pair.ship.propeller is None
    m, L = pair.ship.mass, pair.ship.L_pp
    arms = (1.0, 1.0, 1.0, 0.05 * L, 0.2 * L, 0.2 * L)
    hit, pushed = random.random() < 0.4, random.random() < 0.3
    impulse = [hit * 0.5 * m * a * random.gauss(0, 1) for a in arms]
    force = [pushed * 0.02 * m * a * random.gauss(0, 1) for a in arms]
    rudder, revolutions = (0.0, 0.0) if free else (random.uniform(-0.8, 0.8), random.uniform(-1.5, 3.0))
    current = [0.0, 0.0] if still else [random.gauss(0, 1), random.gauss(0, 1)]
    wind = (0.0 if calm else random.uniform(0.0, 40.0), random.uniform(-7.0, 7.0))
    for of in pair.each():
        i = of.inputs
        i.rudder_order, i.propeller_order, i.current[:], i.force[:] = rudder, revolutions, current, force
        i.wind_speed, i.wind_direction = wind
        i.impulse[:] = [a + b for a, b in zip(i.impulse, impulse, strict=True)]


def step_both(pair: Pair, t: float, h: float) -> float:
    """A step of both from the state of the Python model; the difference, or 0 where both refuse in the same words."""
    before = pair.python.get_state()
    give_state(pair.native, before)
    said = [refusal_of(of.step, t, h) for of in pair.each()]
    assert said[0] == said[1]
    after = pair.python.get_state()
    if said[0]:
        assert take_state(pair.native) == flatten(before)
        return 0.0
    return compare(take_state(pair.native), after, pair.ship.L_pp)


def check_random_steps(seed: int, ships: int, cases: int, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    random, worst = Random(seed), 0.0
    for _ in range(ships):
        shipped = random.random() < 0.3
        pair = Pair(random.choice(SAILING + COASTING) if shipped else draw_sailing_ship(random), folder)
        for _ in range(cases):
            draw_case(pair, random)
            for of in pair.each():
                of.inputs.impulse[:] = [0.0] * 6
            draw_inputs(pair, random)
            said = pair.initialise(monkeypatch)
            assert said[0] == said[1]
            if said[0]:
                continue
            worst = max(worst, compare(take_state(pair.native), pair.python.get_state(), pair.ship.L_pp))
            for k in range(3):
                draw_inputs(pair, random)
                worst = max(worst, step_both(pair, 1.0 * k, random.choice([0.02, 0.1, 0.5])))
    assert worst <= STEP


def test_random_steps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    check_random_steps(1, 8, 4, tmp_path, monkeypatch)


@pytest.mark.slow
def test_a_thousand_random_steps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    check_random_steps(2, 125, 8, tmp_path, monkeypatch)
