"""The native ship model beside the Python model: each step, whole runs, refusals word for word, states to the bit."""

from __future__ import annotations

from collections.abc import Callable
from math import inf, nan
from pathlib import Path
from random import Random
from typing import Any

import pytest

from shipcollision_fmu.errors import ShipCollisionError
from shipcollision_fmu.manoeuvring import model
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from shipcollision_fmu.ship.loading.library import load_ship, read_ship_tables
from tests.native.kernels import load_kernels
from tests.native.manoeuvring.state import RUN, STEP, compare, flatten, give_state, take_state
from tests.native.native_ship import NativeShip, RefusedError
from tests.native.random_ships import COASTING, SAILING, draw_sailing_ship
from tests.ship_files import ship_tables

LAWS = ("kirchhoff", "free", "straight")


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


def make_pair(tmp_path: Path, ship: Any = "kvlcc2") -> Pair:
    return Pair(ship, tmp_path)


REFUSED_STARTS: dict[str, Callable[[Any], None]] = {
    "place": lambda m: set_list(m.parameters.initial_position, nan),
    "attitude": lambda m: set_list(m.parameters.initial_attitude, inf),
    "order": lambda m: setattr(m.inputs, "rudder_order", nan),
    "wind": lambda m: setattr(m.inputs, "wind_direction", -inf),
    "current": lambda m: set_list(m.inputs.current, nan),
    "force": lambda m: set_list(m.inputs.force, nan),
    "substep": lambda m: setattr(m.parameters, "substep", -0.5),
    "long substep": lambda m: setattr(m.parameters, "substep", 10.0),
    "freedom": lambda m: setattr(m.parameters, "degrees_of_freedom", 5),
    "fast": lambda m: set_list(m.parameters.initial_velocity, 1234.5678901234567),
    "spinning": lambda m: set_list(m.parameters.initial_rate, 1e2),
    "steep": lambda m: set_list(m.parameters.initial_attitude, 1.5, 1),
    "heeled": lambda m: (set_list(m.parameters.initial_attitude, 0.1), setattr(m.parameters, "degrees_of_freedom", 3)),
    "trimmed": lambda m: (
        set_list(m.parameters.initial_attitude, -0.01, 1), setattr(m.parameters, "degrees_of_freedom", 4)
    ),
    "heaving": lambda m: (
        set_list(m.parameters.initial_velocity, 0.5, 2), setattr(m.parameters, "degrees_of_freedom", 4)
    ),
    "pitching": lambda m: (
        set_list(m.parameters.initial_rate, -1e-5, 1), setattr(m.parameters, "degrees_of_freedom", 3)
    ),
}  # fmt: skip
REFUSED_STEPS: dict[str, Callable[[Any], None]] = {
    "order": lambda m: setattr(m.inputs, "propeller_order", nan),
    "impulse": lambda m: set_list(m.inputs.impulse, inf, 5),
    "fast current": lambda m: set_list(m.inputs.current, -1e3),
    "storm": lambda m: setattr(m.inputs, "wind_speed", 1000.5),
    "large impulse": lambda m: set_list(m.inputs.impulse, 1e13),
    "large force": lambda m: set_list(m.inputs.force, -1e14),
    "capsizing": lambda m: set_list(m.inputs.impulse, 9e12, 4),
    "large moment": lambda m: set_list(m.inputs.force, 5e12, 3),
}


def set_list(values: list[float], value: float, place: int = 0) -> None:
    values[place] = value


@pytest.mark.parametrize("name", REFUSED_STARTS)
def test_a_start_is_refused_in_the_same_words(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And the model is then as it was."""
    pair = make_pair(tmp_path)
    for of in pair.each():
        of.parameters.hydrodynamics, of.parameters.initial_velocity[:] = True, [5.0, 0.0, 0.0]
    assert pair.initialise(monkeypatch) == ("", "")
    before = take_state(pair.native)
    for of in pair.each():
        REFUSED_STARTS[name](of)
    python, native = pair.initialise(monkeypatch)
    assert python == native != ""
    assert take_state(pair.native) == before


@pytest.mark.parametrize("hydrodynamics", [True, False])
@pytest.mark.parametrize("name", REFUSED_STEPS)
def test_a_step_is_refused_in_the_same_words(
    name: str, hydrodynamics: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pair = make_pair(tmp_path)
    for of in pair.each():
        of.parameters.hydrodynamics, of.parameters.initial_velocity[:] = hydrodynamics, [5.0, 0.0, 0.0]
    assert pair.initialise(monkeypatch) == ("", "")
    assert step_both(pair, 0.0, 0.5) <= STEP
    for of in pair.each():
        REFUSED_STEPS[name](of)
    assert step_both(pair, 0.5, 5.0) <= STEP


@pytest.mark.parametrize(("t", "h"), [(0.0, 0.0), (0.0, -1.0), (nan, 0.1), (inf, 0.1), (0.0, nan), (123.25, 1e5)])
def test_a_time_is_refused_in_the_same_words(
    t: float, h: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pair = make_pair(tmp_path)
    assert [refusal_of(of.step, t, h) for of in pair.each()] == ["step before initialise: call initialise() first"] * 2
    assert pair.initialise(monkeypatch) == ("", "")
    python, native = (refusal_of(of.step, t, h) for of in pair.each())
    assert python == native != ""


DRIFTING: dict[str, Any] = {**read_ship_tables("kvlcc2"), "added_mass": {"z_y": 0.0}}
for machine in ("propeller", "rudder", "engine"):
    del DRIFTING[machine]
LOPSIDED = {**DRIFTING, "particulars": {**DRIFTING["particulars"], "r_bg": [0, 0.5, 0]}}
NEVER_IDLE = {**ship_tables(manoeuvring={"estimate": True}), "propeller": {"k_1": 0.3, "k_2": 0.1}}


@pytest.mark.parametrize(
    ("ship", "hydrodynamics", "degrees_of_freedom"),
    [
        (ship_tables(), True, 3), (LOPSIDED, True, 3),
        (DRIFTING, True, 3), ("guan2014_target", False, 6), ("guan2014_target", False, 4),
        (NEVER_IDLE, True, 3),
        (ship_tables(particulars={"GM_T": 0.01}, manoeuvring={"estimate": True}), True, 6),
    ],
    ids=["only coasts", "lopsided", "drifts", "no C_b", "no C_b in 4", "never idle", "lolls"],
)  # fmt: skip
def test_a_ship_is_refused_in_the_same_words(
    ship: Any, hydrodynamics: bool, degrees_of_freedom: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pair = make_pair(tmp_path, ship)
    for of in pair.each():
        of.parameters.hydrodynamics, of.parameters.degrees_of_freedom = hydrodynamics, degrees_of_freedom
        of.inputs.rudder_order = 0.1
    python, native = pair.initialise(monkeypatch)
    assert python == native != ""


def test_warnings_are_the_same(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a motion that is held, and of what is suspicious in the ship's file; until the first step."""
    pair = make_pair(tmp_path, ship_tables(
        ship={"kind": "tankr"}, particulars={"r_bg": [0.02, 0.0, 0.0]}, manoeuvring={"estimate": True}
    ))  # fmt: skip
    for of in pair.each():
        p = of.parameters
        p.hydrodynamics, p.degrees_of_freedom = True, 4
        p.initial_attitude[:], p.initial_velocity[:], p.initial_rate[:] = [0.2, 0, 0], [5.0, 1.0, 0.0], [0, 0.01, 0]
    assert pair.initialise(monkeypatch) == ("", "")
    assert pair.python.warning == pair.native.warning
    assert pair.native.warning.startswith("initial heave velocity = 0.198669 and pitch rate = 0.00980067 in level axes")
    assert "looks like x_G/L_pp" in pair.native.warning
    assert compare(take_state(pair.native), pair.python.get_state(), 100.0) <= STEP
    pair.native.step(0.0, 0.1)
    assert pair.native.warning == ""


RUNS: list[tuple[bool, int, str]] = [(True, free, "kirchhoff") for free in (3, 4, 6)]
RUNS += [(False, free, law) for free in (4, 6) for law in LAWS]


@pytest.mark.parametrize(("hydrodynamics", "degrees_of_freedom", "law"), RUNS)
def test_a_run_ends_at_the_same_place(
    hydrodynamics: bool, degrees_of_freedom: int, law: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In wind and current, hit twice, helm and engine moved; each model from its own states."""
    pair, random = make_pair(tmp_path, "kvlcc2"), Random(3)
    for of in pair.each():
        p = of.parameters
        p.hydrodynamics, p.degrees_of_freedom, p.coasting = hydrodynamics, degrees_of_freedom, law
        p.initial_velocity[:], p.substep = [7.0, 0.0, 0.0], 0.5
    assert pair.initialise(monkeypatch) == ("", "")
    for k in range(150):
        if k % 30 == 0:
            orders, wind = (
                (random.uniform(-0.6, 0.6), random.uniform(-1.0, 2.0)),
                (random.uniform(0, 20), random.random()),
            )
            hit = 0.1 * pair.ship.mass * (k in (60, 120))
            for of in pair.each():
                i = of.inputs
                (i.rudder_order, i.propeller_order), (i.wind_speed, i.wind_direction) = orders, wind
                i.current[:] = [0.5, -0.3]
                i.impulse[:] = [a + b for a, b in zip(i.impulse, (-hit, hit, 0, 5 * hit, 0, 50 * hit), strict=True)]
        for of in pair.each():
            of.step(2.0 * k, 2.0)
    assert compare(take_state(pair.native), pair.python.get_state(), pair.ship.L_pp) <= RUN


@pytest.mark.parametrize(("hydrodynamics", "degrees_of_freedom"), [(True, 3), (True, 4), (True, 6), (False, 6)])
def test_a_state_is_restored_to_the_bit(
    hydrodynamics: bool, degrees_of_freedom: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In the same ship and in another, whose outputs then are the same too."""
    pair, random = make_pair(tmp_path), Random(4)
    for of in pair.each():
        of.parameters.hydrodynamics, of.parameters.degrees_of_freedom = hydrodynamics, degrees_of_freedom
        of.parameters.initial_velocity[:] = [5.0, 0.0, 0.0]
    assert pair.initialise(monkeypatch) == ("", "")
    draw_inputs(pair, random)
    native = pair.native
    native.step(0.0, 0.5)
    kept = native.get_state()
    outputs = repr(native.outputs)
    native.step(0.5, 0.5)
    after = native.get_state()
    other = NativeShip(load_kernels(), parameters=native.parameters, inputs=native.inputs)
    for of in (native, other):
        of.set_state(kept)
        assert repr(of.outputs) == outputs
        of.step(0.5, 0.5)
        assert of.get_state() == after
    other.set_state({})
    assert other.get_state() == {}
    assert refusal_of(other.step, 0.0, 0.1) == "step before initialise: call initialise() first"
    with pytest.raises(RefusedError, match="the state is not of ShipManoeuvring"):
        other.set_state({"bytes": kept["bytes"][2:]})


@pytest.mark.parametrize(
    ("law", "hydrodynamics", "degrees_of_freedom", "h", "why"),
    [
        ("kirchhoff", True, 3, 4e5, "the motion diverges in the step"),
        ("straight", False, 6, 1e300, "the motion diverges in the step"),
        ("straight", False, 3, 1e308, "the motion diverges in the step"),
        ("kirchhoff", False, 4, 1e5, "substeps of a ship that coasts"),
        ("free", False, 6, 1e300, "substeps of a ship that coasts"),
    ],
)
def test_a_step_that_is_too_long_is_refused_in_the_same_words(
    law: str, hydrodynamics: bool, degrees_of_freedom: int, h: float, why: str, tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    pair = make_pair(tmp_path)
    for of in pair.each():
        p = of.parameters
        p.hydrodynamics, p.degrees_of_freedom, p.coasting, p.substep = hydrodynamics, degrees_of_freedom, law, h / 4
        p.initial_velocity[:], p.initial_rate[:] = [8.0, 1.0, 0.0], [0.0, 0.0, 0.01]
    assert pair.initialise(monkeypatch) == ("", "")
    python, native = (refusal_of(of.step, 0.0, h) for of in pair.each())
    assert python == native
    assert why in native
