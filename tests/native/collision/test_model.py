"""native/collision: whole encounters step by step beside the Python model, which is given the same states."""

from __future__ import annotations

from dataclasses import replace

import pytest

from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.errors import ShipError, StepError
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from tests.native.collision.kernels import load_kernels
from tests.native.collision.shadow import Shadow
from tests.native.native_collision import NativeCollision

pytestmark = pytest.mark.needs("pybullet")

CLOSE = 1e-9
"""Of the scale of impulses, motions and energies."""
QUAY = """
[quay]
kind = "quay"
shape = "box"
length = 900.0
breadth = 30.0
position = [0.0, 190.0]
heading_deg = 3.0
"""


class Encounter:
    """Ships that coast, coupled to the model and its shadow as a sequential or a parallel master does it."""

    def __init__(
        self, motions: list[tuple[float, float, float, float]], parallel: bool, ship: str = "kvlcc2",
        degrees_of_freedom: int = 6, feedback: str = "ledger", **parameters: object,
    ) -> None:  # fmt: skip
        """motions: north, east, heading and speed of each ship."""
        self.t, self.parallel, self.feedback = 0.0, parallel, feedback
        self.model = ShipCollision([f"s{i}" for i in range(len(motions))])
        self.fleet = []
        for of_model, (north, east, heading, speed) in zip(self.model.parameters.ships, motions, strict=True):
            own = ShipManoeuvring()
            of_model.ship = own.parameters.ship = ship
            of_model.degrees_of_freedom = own.parameters.degrees_of_freedom = degrees_of_freedom
            own.parameters.initial_position[:] = [north, east, 0.0]
            own.parameters.initial_attitude[:], own.parameters.initial_velocity[:] = [0, 0, heading], [speed, 0, 0]
            own.initialise()
            self.fleet.append(own)
        self.model.parameters.feedback = feedback
        for name, value in parameters.items():
            setattr(self.model.parameters, name, value)
        self.give_states()
        self.model.initialise()
        self.shadow = Shadow(self.model)

    def give_states(self) -> None:
        for given, ship in zip(self.model.inputs.ships, self.fleet, strict=True):
            out = ship.outputs
            given.position[:], given.attitude[:], given.impulse_applied[:] = (
                out.position, out.attitude, out.impulse_applied
            )  # fmt: skip
            given.velocity[:], given.rate[:] = out.velocity, out.rate

    def step(self, H: float) -> dict[str, float]:
        """One communication step; what differs."""
        self.give_states()
        if self.parallel:
            self.step_ships(H)
        self.shadow.give_inputs()
        self.model.step(self.t, H)
        self.shadow.step(self.t, H)
        for ship, out in zip(self.fleet, self.model.outputs.ships, strict=True):
            if self.feedback == "ledger":
                ship.inputs.impulse[:] = out.impulse
            elif self.feedback == "force":
                ship.inputs.force[:] = out.force
        if not self.parallel:
            self.step_ships(H)
        self.t += H
        return {name: share for name, share in self.shadow.compare().items() if not share <= CLOSE}

    def step_ships(self, H: float) -> None:
        for ship in self.fleet:
            ship.step(self.t, H)


CROSSING = [(0.0, 0.0, 0.0, 7.0), (215.0, 30.0, 1.6, 3.0)]
CASES = {
    "crossing": (CROSSING, False, {}),
    "parallel": (CROSSING, True, {"restitution": 0.3}),
    "by force": (CROSSING, False, {"feedback": "force"}),
    "ignored": (CROSSING, False, {"feedback": "none"}),
    "three in a row": ([*CROSSING, (240.0, 120.0, 1.4, 0.0)], True, {"degrees_of_freedom": 4, "friction": 0.1}),
    "against a quay": ([(0.0, 60.0, 0.6, 4.0)], False, {"obstacles": QUAY}),
}


SLOW = {"by force", "ignored", "three in a row"}


@pytest.mark.parametrize("case", [pytest.param(case, marks=[pytest.mark.slow] * (case in SLOW)) for case in CASES])
def test_each_step_is_that_of_the_python_model(case: str) -> None:
    """In contact and before it: impulses, motions, energies, contact counts, warnings and events."""
    motions, parallel, parameters = CASES[case]
    encounter = Encounter(motions, parallel, **parameters)
    touched = 0
    for k in range(60):
        assert encounter.step(0.25) == {}, f"step {k}"
        touched += encounter.model.outputs.contact_count > 0
    assert touched >= 1
    assert encounter.model.outputs.energy.dissipated > 1e6 or case == "ignored"


def test_a_state_comes_back_to_the_bit() -> None:
    """In the middle of a contact, in the same model and in another one; a state of another size is refused."""
    encounter = Encounter(CROSSING, True)
    for _ in range(25):
        encounter.step(0.25)
    native = encounter.shadow.native
    assert native.outputs.contact_count > 0
    state = native.get_state()
    other = NativeCollision(native._library, native.names)
    other.parameters = native.parameters
    encounter.give_states()
    runs = []
    for model in (native, native, other):
        model.set_state(state)
        for given, source in zip(model.inputs.ships, encounter.model.inputs.ships, strict=True):
            vars(given).update({name: list(value) for name, value in vars(source).items()})
        model.step(encounter.t, 0.25)
        runs.append((model.get_state(), [vars(ship) for ship in model.outputs.ships]))
    assert runs[0] == runs[1] == runs[2]
    with pytest.raises(Exception, match="the state is not of ShipCollision: give what get_state"):
        native.set_state({"bytes": state["bytes"][:-2]})
    assert native.get_state() == runs[0][0]


def test_the_ship_is_named_whose_freedom_is_none() -> None:
    for model in (ShipCollision(["a", "b"]), NativeCollision(load_kernels(), ["a", "b"])):
        model.parameters.ships[1].degrees_of_freedom = 5
        with pytest.raises(ShipError, match=r"^b\.degrees_of_freedom = 5 must be 3 \(surge, sway, yaw\), 4 \(and roll"):
            model.initialise()


def test_ships_at_rest_inside_each_other_close_at_zero() -> None:
    """Not at minus zero."""
    encounter = Encounter([(10.0, 0.0, 0.0, 0.0), (10.0, 0.0, 0.0, 0.0)], False)
    assert encounter.step(0.05) == {}
    (event,) = encounter.shadow.native.events
    assert "closing at 0.00 m/s" in event


def test_a_state_with_more_bodies_is_refused() -> None:
    """Its obstacles may have been in a file that has become shorter."""
    motions, parallel, parameters = CASES["against a quay"]
    encounter = Encounter(motions, parallel, **parameters)
    while not encounter.model.outputs.contact_count:
        encounter.step(0.25)
    native = encounter.shadow.native
    models = (encounter.model, ShipCollision(native.names)), (native, NativeCollision(native._library, native.names))
    for model, other in models:
        state = model.get_state()
        other.parameters = replace(model.parameters, obstacles="")
        other.initialise()
        with pytest.raises(StepError, match="the state is not of ShipCollision: give what get_state"):
            other.set_state(state)
        other.parameters = model.parameters
        other.initialise()
        other.set_state(state)  # the remedy
        assert other.get_state() == state


def test_a_refused_step_changes_nothing() -> None:
    """A step with too many substeps fails in the middle; the next one is as if it had not been."""
    encounter = Encounter(CROSSING, True)
    for _ in range(25):
        encounter.step(0.25)
    state = encounter.shadow.native.get_state()
    for H, why in ((-1.0, "a step from t = 6.25 s by -1.0 s cannot be made"), (1e6, "substeps")):
        with pytest.raises(Exception, match=why):
            encounter.shadow.step(6.25, H)
        assert encounter.shadow.native.get_state() == state
    assert encounter.step(0.25) == {}
