"""The model as a part: what it refuses, its state, its lists."""

from __future__ import annotations

import json
from collections.abc import Callable
from math import inf, nan
from typing import Any

import pytest

from shipcollision_fmu.errors import ScenarioError, ShipCollisionError, ShipError, StepError
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from tests.ship_engines import OF_THE_OBJECT, make_model
from tests.ship_files import ship_toml

Start = Callable[..., ShipManoeuvring]
MMG = {"degrees_of_freedom": 3, "hydrodynamics": True}
SPATIAL = {"degrees_of_freedom": 6, "hydrodynamics": True}
MODES: list[dict[str, Any]] = [{}, MMG, {**MMG, "degrees_of_freedom": 4}, SPATIAL]
NAMES = ["coasting", "MMG", "MMG with roll", "MMG in six"]


def outputs(model: ShipManoeuvring) -> dict[str, float | list[float]]:
    return {name: list(value) if isinstance(value, list) else value for name, value in vars(model.outputs).items()}


BAD_INPUTS = [
    ("impulse", 0, nan, r"impulse = \[nan, 0\.0, .*\] at t = 2 s must be finite"),
    ("impulse", 5, inf, r"impulse = .*inf\] at t = 2 s must be finite"),
    ("force", 3, -inf, r"force = .*-inf.* at t = 2 s must be finite"),
    ("rudder_order", None, nan, r"rudder_order = nan at t = 2 s must be finite"),
    ("current", 1, inf, r"current = \[0\.0, inf\] at t = 2 s must be finite"),
    ("wind_speed", None, nan, r"wind_speed = nan at t = 2 s must be finite"),
    ("wind_direction", None, inf, r"wind_direction = inf at t = 2 s must be finite"),
    ("wind_speed", None, 1e3, r"wind speed = 1000\.0 m/s at t = 2 s must be below 1000 m/s"),
    ("current", 0, 1e3, r"current = \[1000\.0, 0\.0\] m/s at t = 2 s must be below 1000 m/s"),
    ("impulse", 0, 1e15, r"at t = 2 s velocity \[.* rate .* must be below 1000 m/s; look at impulse and force"),
    ("impulse", 5, 1e17, r"at t = 2 s velocity \[.* rate .* the ship's ends must be below 1000 m/s"),
    ("force", 1, 1e15, r"at t = 2 s velocity \[.* must be below 1000 m/s; look at impulse and force"),
    ("force", 1, 1e300, r"at t = 2 s velocity \[.* must be below 1000 m/s; look at impulse and force"),
]


@pytest.mark.one_in(2)
@pytest.mark.parametrize("mode", MODES, ids=NAMES)
@pytest.mark.parametrize(("name", "index", "value", "message"), BAD_INPUTS)
def test_bad_input_is_refused_and_the_state_kept(
    start: Start, mode: dict[str, Any], name: str, index: int | None, value: float, message: str
) -> None:
    ship, twin = start(**mode, velocity=[5.0, 0.1, 0.0]), start(**mode, velocity=[5.0, 0.1, 0.0])
    for model in (ship, twin):
        model.step(0.0, 2.0)
    container, key = (vars(ship.inputs), name) if index is None else (getattr(ship.inputs, name), index)
    good = container[key]
    container[key] = value
    state, before = ship.get_state(), outputs(ship)
    with pytest.raises(StepError, match=message):
        ship.step(2.0, 2.0)
    assert ship.get_state() == state
    assert outputs(ship) == before
    container[key] = good  # and it goes on as if nothing had happened
    for model in (ship, twin):
        model.step(2.0, 2.0)
    assert outputs(ship) == outputs(twin)


@OF_THE_OBJECT
@pytest.mark.parametrize(
    ("t", "h", "message"),
    [
        (0.0, 0.0, r"over h = 0\.0 s: t must be finite and h greater than 0"),
        (0.0, -0.1, r"h greater than 0"),
        (0.0, nan, r"over h = nan s"),
        (nan, 0.1, r"step from t = nan s"),
        (0.0, 1e6, r"h = 1e\+06 s takes 2e\+07 substeps of 0\.05 s, at most 100000: take shorter steps"),
    ],
)
def test_bad_step_is_refused(start: Start, t: float, h: float, message: str) -> None:
    with pytest.raises(StepError, match=message):
        start().step(t, h)


def test_divergence_is_refused(start: Start) -> None:
    """A 7 m model at 100 m/s, integrated in steps of 5 s."""
    ship = start("kvlcc2_l7", **MMG, velocity=[100.0, -30.0, 0.0], rate=[0.0, 0.0, 20.0], substep=5.0)
    state = ship.get_state()
    with pytest.raises(StepError, match=r"at t = 0 s.*(shorten substep = 5\.0 s|must be below 1000 m/s)"):
        ship.step(0.0, 500.0)
    assert ship.get_state() == state


def test_divergence_of_a_ship_that_coasts_is_refused(start: Start) -> None:
    """A buoy 300 m under water comes up so fast that its step ends at more than 10 km/s."""
    ship = start(
        "buoy", degrees_of_freedom=6, position=[0.0, 0.0, 300.0], attitude=[-0.319, 0.0, 0.0],
        velocity=[3.0, 0.0, 0.0], rate=[0.0, 0.037, 0.0],
    )  # fmt: skip
    state = ship.get_state()
    with pytest.raises(StepError, match=r"the motion diverges in the step at t = 0 s: shorten h = 0\.1 s"):
        ship.step(0.0, 0.1)
    assert ship.get_state() == state
    ship.step(0.0, 0.01)


def test_step_before_initialise() -> None:
    with pytest.raises(StepError, match=r"step before initialise: call initialise\(\) first"):
        ShipManoeuvring().step(0.0, 0.1)


BAD_STARTS: list[tuple[dict[str, Any], type[ShipCollisionError], str]] = [
    ({"ship": "kvlc2"}, ShipError, r"unknown ship 'kvlc2': .*kvlcc2"),
    ({"degrees_of_freedom": 5}, ShipError, r"degrees_of_freedom = 5 must be 3"),
    ({"velocity": [nan, 0.0, 0.0]}, ScenarioError, r"initial_velocity = \[nan, 0\.0, 0\.0\] must be finite"),
    ({"rate": [0.0, 0.0, inf]}, ScenarioError, r"initial_rate = \[0\.0, 0\.0, inf\] must be finite"),
    ({"position": [0.0, nan, 0.0]}, ScenarioError, r"initial_position = .* must be finite"),
    ({"velocity": [2e3, 0.0, 0.0]}, ScenarioError, r"initial velocity \[2000\.0, .* must be below 1000 m/s"),
    ({"rate": [0.0, 0.0, 10.0]}, ScenarioError, r"initial velocity .* rate \[0\.0, 0\.0, 10\.0\] rad/s: .*ends"),
    ({"orders": [0.0, nan]}, ScenarioError, r"propeller_order = nan at the start must be finite"),
    ({"substep": 0.0}, ScenarioError, r"substep = 0\.0 s must be finite and greater than 0"),
    ({"substep": nan}, ScenarioError, r"substep = nan s must be finite and greater than 0"),
    ({**MMG, "attitude": [0.1, 0.0, 0.0]}, ScenarioError, r"initial roll angle = 0\.1 must be 0 with hydrodynamics"),
    ({**MMG, "rate": [0.0, 0.1, 0.0]}, ScenarioError, r"initial pitch rate = 0\.1 must be 0 with hydrodynamics"),
    (
        {**MMG, "degrees_of_freedom": 4, "velocity": [0.0, 0.0, 0.1]},
        ScenarioError,
        r"initial heave velocity = 0\.1 must be 0 .* in 4 degrees of freedom, which hold it: .* degrees_of_freedom = 6",
    ),
    ({**SPATIAL, "attitude": [0.0, 1.5, 0.0]}, ScenarioError, r"initial pitch angle = 1\.5 rad must be below 1\.4 rad"),
    ({**SPATIAL, "substep": 3.0}, ScenarioError, r"substep = 3\.0 s is too long for the heave, .* at most 1\.9\d* s"),
    (
        {"wind": [nan, 0.0]},
        ScenarioError,
        r"wind_speed = nan at the start must be finite: look at what feeds it; where it has failed, its message",
    ),
]


@pytest.mark.parametrize(("keys", "error", "message"), BAD_STARTS)
def test_bad_start_is_refused(
    start: Start, keys: dict[str, Any], error: type[ShipCollisionError], message: str
) -> None:
    with pytest.raises(error, match=message) as raised:
        start(**keys)
    assert "\n" not in str(raised.value)


def test_ship_without_an_mmg_set_can_only_coast(start: Start, tmp_path: Any) -> None:
    barge = tmp_path / "barge.toml"
    barge.write_text(ship_toml())
    start(str(barge))
    with pytest.raises(ShipError, match=r"'Barge' has no \[manoeuvring\], so it can only coast: set hydrodyn"):
        start(str(barge), **MMG)


def test_ship_with_CG_off_the_centreline_cannot_sail(start: Start, tmp_path: Any) -> None:
    listing = tmp_path / "listing.toml"
    listing.write_text('extends = "kvlcc2"\n[particulars]\nr_bg = [11.2, 0.5, 2.2]\n')
    start(str(listing))
    with pytest.raises(ShipError, match=r"not symmetric to its centreline .* r_bg = \[x, 0, z\]"):
        start(str(listing), **MMG)


def test_failed_initialise_leaves_the_model_as_it_was(start: Start) -> None:
    ship = start(velocity=[5.0, 0.0, 0.0])
    before = outputs(ship)
    ship.parameters.ship = "nothing"
    with pytest.raises(ShipError, match="unknown ship 'nothing'"):
        ship.initialise()
    ship.parameters.ship = "kvlcc2"
    assert outputs(ship) == before
    ship.step(0.0, 1.0)
    assert ship.outputs.position == [5.0, 0.0, 0.0]


@pytest.mark.parametrize("mode", MODES, ids=NAMES)
def test_initialise_again_starts_again(start: Start, mode: dict[str, Any]) -> None:
    ship = start(**mode, velocity=[5.0, 0.1, 0.0], rate=[0.0, 0.0, 0.01], orders=[0.0, 1.0], impulse=[1e8] * 6)
    before = outputs(ship)
    ship.step(0.0, 1.0)
    after = outputs(ship)
    assert after != before
    ship.initialise()
    assert outputs(ship) == before
    ship.step(0.0, 1.0)
    assert outputs(ship) == after


@pytest.mark.parametrize("mode", MODES, ids=NAMES)
def test_state_is_exact_to_the_bit(start: Start, mode: dict[str, Any]) -> None:
    """Through JSON, into the same model and into a fresh one."""
    ship = start(**mode, velocity=[5.0, 0.1, 0.0], rate=[0.0, 0.0, 0.01], orders=[0.0, 1.0], impulse=[1e8] * 6)
    ship.inputs.rudder_order = 0.4
    ship.step(0.0, 0.37)
    text, at_save = json.dumps(ship.get_state()), outputs(ship)
    ship.step(0.37, 0.37)
    after = outputs(ship)
    fresh = make_model()
    fresh.parameters, fresh.inputs = ship.parameters, ship.inputs
    for model in (ship, fresh):
        model.set_state(json.loads(text))
        assert outputs(model) == at_save
        model.step(0.37, 0.37)
        assert outputs(model) == after


@OF_THE_OBJECT
def test_state_is_a_copy(start: Start) -> None:
    ship = start(velocity=[5.0, 0.0, 0.0])
    saved = ship.get_state()
    saved["nu"][0] = 99.0
    ship.step(0.0, 1.0)
    assert ship.outputs.velocity[0] == 5.0


@OF_THE_OBJECT
def test_state_before_initialise(start: Start) -> None:
    ship = start()
    ship.set_state(ShipManoeuvring().get_state())
    with pytest.raises(StepError, match="call initialise"):
        ship.step(0.0, 0.1)


@OF_THE_OBJECT
def test_two_ships_do_not_share_anything(start: Start) -> None:
    one, other = start(velocity=[5.0, 0.0, 0.0]), start()
    one.step(0.0, 1.0)
    assert other.outputs.position == [0.0, 0.0, 0.0]
    lists = [{id(v) for v in vars(model.outputs).values() if isinstance(v, list)} for model in (one, other)]
    assert lists[0].isdisjoint(lists[1])


@OF_THE_OBJECT
@pytest.mark.parametrize("mode", MODES, ids=NAMES)
def test_lists_keep_their_identity(start: Start, mode: dict[str, Any]) -> None:
    ship = start(**mode, velocity=[5.0, 0.0, 0.0])
    held = {f"{part}.{name}": value for part in ("parameters", "inputs", "outputs")
            for name, value in vars(getattr(ship, part)).items() if isinstance(value, list)}  # fmt: skip
    ship.step(0.0, 1.0)
    ship.set_state(ship.get_state())
    ship.initialise()
    for path, value in held.items():
        part, name = path.split(".")
        assert getattr(getattr(ship, part), name) is value
        assert all(type(x) is float for x in value)


@pytest.mark.parametrize("state", [{"a": 1}, {"t": 0.0}])
def test_a_state_of_another_kind_is_refused_in_one_line(state: dict[str, Any]) -> None:
    with pytest.raises(StepError, match=r"^the state is not of ShipManoeuvring: give what get_state\(\) returned$"):
        ShipManoeuvring().set_state(state)
