"""Each wrong wiring of a ship gives its own warning, once; right wiring gives none. findings.py is the list."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from math import cos, degrees, pi, radians, sin
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.collision.answer_watch import AnswerWatch
from shipcollision_fmu.collision.findings import FINDINGS
from shipcollision_fmu.collision.interface import ShipState
from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.errors import StepError
from shipcollision_fmu.fmi.names import STATE, named
from shipcollision_fmu.fmi.ship_collision import INTERFACE
from tests.collision.conftest import BOX, World

Make = Callable[..., str]
Fault = Callable[[World, int, ShipState], None]

HEADING = radians(20.0)
ALGORITHMS = pytest.mark.parametrize("algorithm", ["gauss-seidel", pytest.param("jacobi", marks=pytest.mark.slow)])


class Wired(World):
    """A World whose master hands the states over with a fault, and takes down the warnings."""

    fault: Fault | None = None
    every = 1  # steps of the collision model between outputs of the ships

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        self.warnings: list[str] = []
        super().__init__(*args, **kwargs)

    def send(self) -> None:
        super().send()
        for i, ship in enumerate(self.model.inputs.ships):
            if self.fault is not None:
                type(self).fault(self, i, ship)  # type: ignore[misc]  # narrowed above

    def step(self, H: float) -> None:
        super().step(H)
        if self.model.warning:
            self.warnings.append(self.model.warning)


def wired(
    make_ship: Make, fault: Fault | None = None, *, at: float = 130.0, rate: float = 0.0, algorithm: str = "jacobi",
    **parameters: Any,
) -> Wired:  # fmt: skip
    """s0 steers 20 deg at 5 m/s for the middle of s1, which steers 110 deg at 2 m/s; its bow is 15 m off at 130 m."""
    box = make_ship("box", BOX)
    ahead = np.array([cos(HEADING), sin(HEADING), 0.0])
    start = [
        {"position": -at * ahead, "attitude": (0.0, 0.0, HEADING), "nu": [5.0, 0.0, 0.0, 0.0, 0.0, rate]},
        {"position": [0.0, 0.0, 0.0], "attitude": (0.0, 0.0, HEADING + pi / 2), "nu": [2.0, 0.0, 0.0, 0.0, 0.0, rate]},
    ]
    kind = type("Faulty", (Wired,), {"fault": staticmethod(fault) if fault else None})
    return kind([box, box], start, degrees_of_freedom=3, algorithm=algorithm, substep=0.05, **parameters)  # type: ignore[no-any-return]  # a type made here


def keys(w: Wired) -> list[str]:
    """Keys of the findings in the warnings, by their remedies."""
    said = "; ".join(w.warnings)
    found = [
        key
        for key, (_, finding) in FINDINGS.items()
        for name in w.model.names
        for _ in range(said.count(finding.remedy.format(ship=name, unit="knots")))
    ]
    assert len(found) == w.model.outputs.diagnosis.count
    return found


def in_degrees(w: World, i: int, ship: ShipState) -> None:
    ship.attitude[:] = [degrees(angle) for angle in ship.attitude]


def in_knots(w: World, i: int, ship: ShipState) -> None:
    ship.velocity[:] = [v * 3600.0 / 1852.0 for v in ship.velocity]


def without_velocity(w: World, i: int, ship: ShipState) -> None:
    ship.velocity[:] = [0.0] * 3


def in_n(w: World, i: int, ship: ShipState) -> None:
    ship.velocity[:] = (w.R[i] @ w.nu[i][:3]).tolist()


def through_water(w: World, i: int, ship: ShipState) -> None:
    """A current of 1.5 m/s sets west."""
    ship.velocity[:] = (w.nu[i][:3] - w.R[i].T @ np.array([0.0, -1.5, 0.0])).tolist()


def without_rate(w: World, i: int, ship: ShipState) -> None:
    ship.rate[:] = [0.0] * 3


def rate_in_degrees(w: World, i: int, ship: ShipState) -> None:
    ship.rate[:] = [degrees(r) for r in ship.rate]


def rate_to_port(w: World, i: int, ship: ShipState) -> None:
    ship.rate[:] = [-r for r in ship.rate]


def not_returned(w: World, i: int, ship: ShipState) -> None:
    ship.impulse_applied[:] = [0.0] * 6


def recorded(w: World, i: int, ship: ShipState) -> None:
    """The ship follows its track, whatever is issued."""
    w.upright[i] = np.zeros((6, 6))
    ship.impulse_applied[:] = [0.0] * 6


def a_hundredth(w: World, i: int, ship: ShipState) -> None:
    """The mass of s0 is too small."""
    if not hasattr(w, "lighter"):
        w.lighter = True  # type: ignore[attr-defined]  # of this test
        w.upright[0] = w.upright[0] * 100.0


def a_thousandfold(w: World, i: int, ship: ShipState) -> None:
    if not hasattr(w, "heavier"):
        w.heavier = True  # type: ignore[attr-defined]  # of this test
        w.upright[0] = w.upright[0] / 1000.0


WRONG: dict[str, tuple[str, Fault, dict[str, Any]]] = {
    "yaw in degrees": ("attitude in degrees", in_degrees, {"at": 600.0}),
    "yaw in degrees, overlap at once": ("attitude in degrees", in_degrees, {}),
    "velocity in knots": ("unit of the velocity", in_knots, {}),
    "velocity left at zero": ("no velocity", without_velocity, {}),
    "velocity in n": ("frame of the velocity", in_n, {}),
    "velocity through the water": ("other velocity", through_water, {}),
    "rate left at zero": ("no rate", without_rate, {"rate": 0.02, "at": 600.0}),
    "rate in degrees per second": ("rate in degrees", rate_in_degrees, {"rate": 0.02, "at": 600.0}),
    "rate to port": ("other rate", rate_to_port, {"rate": 0.02, "at": 600.0}),
    "nothing wired back": ("impulse not applied", recorded, {}),
    "impulse_applied not wired back": ("impulse_applied not returned", not_returned, {}),
    "recorded ships, by force": ("force without effect", recorded, {"feedback": "force"}),
    "recorded ships, by state": ("force without effect", recorded, {"feedback": "state"}),
    "a hundredth of the mass": ("other mass", a_hundredth, {}),
    "a hundredth of the mass, by force": ("other mass", a_hundredth, {"feedback": "force"}),
    "a thousand times the mass": ("other mass", a_thousandfold, {}),
}


@ALGORITHMS
@pytest.mark.parametrize("wrong", WRONG)
def test_a_wrong_wiring_gives_its_own_warning_once_per_ship(make_ship: Make, wrong: str, algorithm: str) -> None:
    key, fault, given = WRONG[wrong]
    w = wired(make_ship, fault, algorithm=algorithm, **given)
    try:
        w.run(5.0, 0.1)
        found = keys(w)
        out = w.model.outputs.diagnosis
    finally:
        w.model.close()
    assert set(found) == {key}
    assert 1 <= len(found) <= 2
    assert out.code == FINDINGS[key][0]
    assert out.ship in (1, 2)
    assert out.text in w.warnings[0]


@ALGORITHMS
@pytest.mark.parametrize("feedback", ["ledger", "force", "state", "none"])
def test_right_wiring_gives_no_warning(make_ship: Make, algorithm: str, feedback: str) -> None:
    """The same ships without a fault: each of them collides, and the watch over its answer ends."""
    w = wired(make_ship, None, algorithm=algorithm, feedback=feedback)
    try:
        w.run(5.0, 0.1)
        assert w.model.outputs.collision_count >= 1
        assert not w.warnings
        assert vars(w.model.outputs.diagnosis) == {"code": 0, "ship": 0, "count": 0, "text": ""}
    finally:
        w.model.close()


def test_the_remedies_of_an_impulse_that_is_not_returned_work(make_ship: Make) -> None:
    """A ship model that has no impulse_applied, with feedback = "force"."""
    w = wired(make_ship, not_returned, feedback="force")
    try:
        w.run(5.0, 0.1)
        assert w.model.outputs.collision_count >= 1
        assert not w.warnings
    finally:
        w.model.close()


def test_a_ship_that_is_thrown_beyond_all_speeds_is_refused_with_its_mass_named(make_ship: Make) -> None:
    """A thousandth of the mass at 5 m/s: 3 km/s, before a second look."""
    w = wired(make_ship)
    w.upright[0] = w.upright[0] * 1000.0
    try:
        with pytest.raises(StepError, match=r"s0.velocity is 3\d{3}.* and after an impact the mass of the ship model"):
            w.run(5.0, 0.1)
    finally:
        w.model.close()


@ALGORITHMS
@pytest.mark.parametrize("feedback", ["ledger", "force"])
def test_a_recorded_ship_is_prescribed_by_the_remedy(make_ship: Make, algorithm: str, feedback: str) -> None:
    """Both ships follow their tracks through each other: the contact is recorded, and no impulse issued."""
    w = wired(make_ship, recorded, algorithm=algorithm, feedback=feedback)
    try:
        for ship in w.model.parameters.ships:
            ship.feedback_name = "prescribed"
        w.model.initialise()
        w.run(5.0, 0.1)
        assert w.model.outputs.collision_count == 1
        assert not w.warnings
        assert not any(any(ship.impulse) for ship in w.model.outputs.ships)
    finally:
        w.model.close()


def test_ships_that_overlap_in_the_first_step_are_said_once(make_ship: Make) -> None:
    w = wired(make_ship, at=100.0)
    try:
        w.run(1.0, 0.1)
        assert keys(w) == ["overlap at the start"]
        assert "'s0' and 's1' overlap by " in w.warnings[0]
    finally:
        w.model.close()


# -- right wiring ----------------------------------------------------------------------------------------------------


def circling(t: float, rate: float, roll: float, speed: float = 5.0) -> ShipState:
    """A heeled ship on a circle, as ShipManoeuvring gives it: velocity and rate in b. It drifts to port by 1 m/s."""
    psi = 0.3 + rate * t
    if rate:
        north = (speed * (sin(psi) - sin(0.3)) - (cos(psi) - cos(0.3))) / rate
        east = (speed * (cos(0.3) - cos(psi)) - (sin(psi) - sin(0.3))) / rate
    else:
        north, east = (speed * cos(psi) + sin(psi)) * t, (speed * sin(psi) - cos(psi)) * t
    return ShipState(
        [north, east, 0.0], [roll, 0.0, psi], [speed, -cos(roll), sin(roll)], [0.0, rate * sin(roll), rate * cos(roll)]
    )


def sail(model: ShipCollision, H: float, own_step: float, rate: float, roll: float, wrapped: bool) -> list[str]:
    """Warnings of 120 steps of H [s] with ships that take steps of own_step [s] of their own."""
    warnings = []
    for k in range(120):
        held = own_step * int(k * H / own_step + 1e-9)
        for i, ship in enumerate(model.inputs.ships):
            now = circling(held, rate, roll, 5.0 - 4.8 * i)
            ship.position[:] = [now.position[0], now.position[1] + 5000.0 * i, 0.0]
            ship.attitude[:], ship.velocity[:], ship.rate[:] = now.attitude, now.velocity, now.rate
            if wrapped:
                ship.attitude[2] %= 2.0 * pi
        model.step(k * H, H)
        warnings.append(model.warning)
    return [warning for warning in warnings if warning]


@pytest.mark.parametrize(
    ("steps", "ratios"),
    [((0.1,), (4.0, 1.5)), pytest.param((0.02, 0.5), (1.0, 1.5, 1.05, 0.3), marks=pytest.mark.slow)],
)
def test_ships_that_turn_heel_drift_and_take_steps_of_their_own_give_no_warning(
    steps: Sequence[float], ratios: Sequence[float]
) -> None:
    """Steps of the ships as long as those of the collision model, four times, 1.5 times and just longer; wrapped
    headings; a tug that turns by 6 deg/s."""
    model = ShipCollision()
    for H in steps:
        for own_step in (ratio * H for ratio in ratios):
            for rate in (0.0, 0.02, -0.1):
                for roll, wrapped in ((0.0, True), (0.3, False)):
                    model.initialise()
                    assert sail(model, H, own_step, rate, roll, wrapped) == [], (H, own_step, rate, roll)
    model.close()


def test_a_ship_that_its_host_moves_once_gives_no_warning() -> None:
    """FMPy's SSP master sends zeros in its first step; an instructor moves a ship to another place."""
    model = ShipCollision()
    model.initialise()
    for k in range(100):
        for i, ship in enumerate(model.inputs.ships):
            now = circling(0.1 * k, 0.0, 0.0)
            moved = 700.0 if k > 6 else 0.0
            ship.position[:] = [now.position[0] + moved, now.position[1] + 5000.0 * i, 0.0] if k else [0.0] * 3
            ship.attitude[:], ship.velocity[:] = (now.attitude, now.velocity) if k else ([0.0] * 3, [0.0] * 3)
        model.step(0.1 * k, 0.1)
        assert model.warning == ""
    model.close()


@pytest.mark.parametrize(
    "feedback", ["ledger", *(pytest.param(each, marks=pytest.mark.slow) for each in ("force", "state"))]
)
def test_a_ship_that_its_propeller_presses_to_another_gives_no_warning(make_ship: Make, feedback: str) -> None:
    """0.05 m/s2 against a ship that does not move: each impulse is answered, and the velocity shows nothing of it."""
    box = make_ship("box", BOX)
    start = [
        {"position": [0.0, 0.0, 0.0], "nu": [-0.005, 0.0, 0.0, 0.0, 0.0, 0.0]},  # it is sent once before the first step
        {"position": [199.9999, 0.0, 0.0], "nu": [0.0] * 6},
    ]

    def press(w: World, i: int, ship: ShipState) -> None:
        if i == 0:
            w.nu[0][0] += 0.005
            ship.velocity[0] += 0.005
        else:
            w.upright[1] = np.zeros((6, 6))

    kind = type("Pressed", (Wired,), {"fault": staticmethod(press)})
    w = kind([box, box], start, degrees_of_freedom=3, substep=0.05, feedback=feedback, friction=0.0)
    try:
        w.model.parameters.ships[1].feedback = "prescribed"
        w.model.initialise()
        w.run(6.0, 0.1)
        assert w.model.outputs.ships[1].impulse[0] > 0.5 * 42e6 * 0.05 * 6.0
        assert w.warnings == []
    finally:
        w.model.close()


def test_a_ship_that_bounces_gives_no_warning(make_ship: Make) -> None:
    """Between two quays, elastic, every second step: what it moved by is nowhere near its velocity."""
    box = make_ship("box", BOX)
    start = [
        {"position": [x, 0.0, 0.0], "nu": [u, 0.0, 0.0, 0.0, 0.0, 0.0]}
        for x, u in ((0.0, 3.0), (200.3, 0.0), (-200.3, 0.0))
    ]
    w = Wired([box] * 3, start, degrees_of_freedom=3, substep=0.05, restitution=1.0, friction=0.0)
    try:
        for i in (1, 2):
            w.upright[i] = np.zeros((6, 6))
            w.model.parameters.ships[i].feedback = "prescribed"
        w.model.initialise()
        w.run(5.0, 0.1)
        assert w.nu[0][0] == pytest.approx(3.0, rel=1e-9) or w.nu[0][0] == pytest.approx(-3.0, rel=1e-9)
        assert w.warnings == []
    finally:
        w.model.close()


# -- state -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("wrong", ["velocity in knots", pytest.param("nothing wired back", marks=pytest.mark.slow)])
def test_a_restored_state_leads_to_the_same_finding_at_the_same_step(make_ship: Make, wrong: str) -> None:
    """Every step is made twice: the state saved before it is restored."""

    class Twice(ShipCollision):
        def step(self, t: float, H: float) -> None:
            before = json.loads(json.dumps(self.get_state()))
            super().step(t, H)
            self.set_state(before)
            first = self.warning
            super().step(t, H)
            assert self.warning == first

    _, fault, given = WRONG[wrong]
    once, twice = wired(make_ship, fault, **given), wired(make_ship, fault, **given)
    try:
        twice.model.__class__ = Twice
        once.run(5.0, 0.1)
        twice.run(5.0, 0.1)
        assert once.warnings
        assert twice.warnings == once.warnings
    finally:
        once.model.close()
        twice.model.close()


# -- not moved -------------------------------------------------------------------------------------------------------


def lie(position_of: Callable[[float], float], speed_of: Callable[[float], float], H: float) -> tuple[list[str], Any]:
    """Warnings of 40 s with a ship at north position_of(t) [m] that gives the surge velocity speed_of(t) [m/s]."""
    model = ShipCollision()
    model.initialise()
    warnings = []
    for k in range(round(40.0 / H)):
        for i, ship in enumerate(model.inputs.ships):
            ship.position[:] = [position_of(k * H) if i == 0 else -5000.0, 0.0, 0.0]
            ship.velocity[0] = speed_of(k * H) if i == 0 else 0.0
        model.step(k * H, H)
        warnings += [model.warning] if model.warning else []
    model.close()
    return warnings, model.outputs.diagnosis


@pytest.mark.parametrize("H", [0.5, pytest.param(0.05, marks=pytest.mark.slow)])
def test_a_ship_with_a_velocity_whose_position_never_changes_is_said_once(H: float) -> None:
    """Start values that nobody connected: the ship is there, and stays there at 5 m/s."""
    warnings, out = lie(lambda _: 300.0, lambda _: 5.0, H)
    key = "no motion"
    assert (out.code, out.ship, out.count) == (FINDINGS[key][0], 1, 1)
    assert len(warnings) == 1
    assert warnings[0].startswith("own.velocity is 5 m/s, but own.position has not changed for ")
    assert FINDINGS[key][1].remedy.format(ship="own") in warnings[0]
    assert FINDINGS[key][0] == max(code for code, _ in FINDINGS.values())  # codes are an interface: at the end


@pytest.mark.parametrize("H", [0.5, pytest.param(0.05, marks=pytest.mark.slow)])
def test_a_ship_that_lies_waits_or_takes_long_steps_gives_no_warning(H: float) -> None:
    """Moored in waves, without a change of the position; steps ten times as long; a report of the position every 10 s,
    as of a recorded track; put in motion, and stopped in motion, by an instructor."""
    long = 10.0 * H
    cases: dict[str, tuple[Callable[[float], float], Callable[[float], float]]] = {
        "moored": (lambda _: 300.0, lambda t: 0.1 * sin(t)),
        "long steps": (lambda t: 5.0 * long * int(t / long + 1e-9), lambda _: 5.0),
        "reports": (lambda t: 50.0 * int(t / 10.0 + 1e-9), lambda _: 5.0),
        "put in motion": (lambda t: 5.0 * max(0.0, t - 30.0 - long), lambda t: 5.0 if t >= 30.0 else 0.0),
        "frozen": (lambda t: 5.0 * min(t, 5.0), lambda _: 5.0),
    }
    for name, (position_of, speed_of) in cases.items():
        assert lie(position_of, speed_of, H)[0] == [], name


@pytest.mark.slow
def test_a_ship_that_is_held_by_contact_gives_no_warning(make_ship: Make) -> None:
    """Its propeller presses it to another for 20 s: neither moves."""
    box = make_ship("box", BOX)
    start = [
        {"position": [0.0, 0.0, 0.0], "nu": [0.0] * 6},
        {"position": [199.9999, 0.0, 0.0], "nu": [0.0] * 6},
    ]

    def press(w: World, i: int, ship: ShipState) -> None:
        if i == 0:
            w.nu[0][0] += 0.005
            ship.velocity[0] += 0.005

    kind = type("Pressed", (Wired,), {"fault": staticmethod(press)})
    w = kind([box, box], start, degrees_of_freedom=3, substep=0.05, friction=0.0)
    try:
        w.upright[1] = np.zeros((6, 6))
        w.model.parameters.ships[1].feedback = "prescribed"
        w.model.initialise()
        w.run(20.0, 0.1)
        assert w.warnings == []
    finally:
        w.model.close()


# -- not connected ---------------------------------------------------------------------------------------------------


def pass_the_origin(targets: Sequence[str], values: Sequence[float]) -> tuple[Any, list[str]]:
    """The collision FMU of the default build, inside: own passes the origin at 5 m/s, and of target only the variables
    named are set. Its access, and its warnings."""
    access = INTERFACE.make_access()
    own = access.references(named("own", STATE))
    if targets:
        access.set_real(access.references(targets), values)
    access.set_real(own, [-400.0, *[0.0] * 5, 5.0, *[0.0] * 5])
    access.initialise()
    warnings = []
    for k in range(40):
        access.set_real(own, [-400.0 + 2.5 * k, *[0.0] * 5, 5.0, *[0.0] * 5])
        access.do_step(0.5 * k, 0.5)
        warnings += [access.warning] if access.warning else []
    return access, warnings


def test_a_ship_that_nobody_connected_is_absent_and_said_once() -> None:
    access, warnings = pass_the_origin((), ())
    numbers = ("impact.count", "diagnosis.code", "diagnosis.ship", "diagnosis.count")
    assert access.get_integer(access.references(numbers)) == [0, 1, 2, 1]
    assert len(warnings) == 1
    assert warnings[0].startswith("no state of 'target' was ever set")
    assert access.get_string(access.references(["diagnosis.text"])) == warnings
    (clearance,) = access.get_real(access.references(["clearance"]))
    assert clearance == 200.0
    access.close()


@pytest.mark.parametrize("by", ["a call", "a start value"])
def test_a_ship_that_is_set_to_the_origin_at_rest_is_there(by: str) -> None:
    if by == "a call":
        access, warnings = pass_the_origin(named("target", STATE), [0.0] * 12)
    else:
        access = INTERFACE.make_access(start={"target.position.north": 0.0})
        assert not access.model._absent & {1}
        access.close()
        return
    assert access.get_integer(access.references(["impact.count"])) == [1]
    assert not [warning for warning in warnings if "was ever set" in warning]
    access.close()


def test_a_ship_is_absent_again_in_a_state_from_before_it_was_connected() -> None:
    access = INTERFACE.make_access()
    access.set_real(access.references(named("own", STATE)), [-400.0, *[0.0] * 11])
    access.initialise()
    before = json.loads(json.dumps(access.save()))
    access.set_real(access.references(["target.velocity.surge"]), [1.0])
    assert access.model._absent == frozenset()
    access.restore(before)
    assert access.model._absent == {1}
    access.set_real(access.references(["target.velocity.surge"]), [1.0])
    assert access.model._absent == frozenset()
    access.close()


def test_a_ship_that_answered_at_first_is_heavier_and_not_without_effect() -> None:
    """Of 10 m/s by an impulse it shows 2 m/s, and 0.5 m/s at the deadline, since its propeller has pushed it back."""
    watch, ship, found = AnswerWatch(), ShipState(), None
    body: Any = SimpleNamespace(feedback="force", inverse_at=lambda _: np.eye(6))
    assert watch.look(ship, body, [10.0, 0.0, 0.0, 0.0, 0.0, 0.0], 0.0) is None
    for k in range(1, 11):
        assert found is None
        ship.velocity[:] = [2.0 if k < 10 else 0.5, 0.0, 0.0]
        found = watch.look(ship, body, [10.0, 0.0, 0.0, 0.0, 0.0, 0.0], 0.125 * k)
    assert found is not None
    assert found[0] == "other mass"


def test_a_large_share_is_said_in_plain_digits() -> None:
    (finding,) = (finding for _, finding in FINDINGS.values() if finding.key == "other mass")
    assert " by 100 times what was predicted" in finding.describe(ship="own", share=100.0, mass=0.01)
