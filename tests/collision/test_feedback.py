"""Ships that respond in different ways beside each other: by the ledger, by a force, or not at all on a track."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.collision.feedback import COMMON_FEEDBACKS
from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.errors import InputError
from shipcollision_fmu.fmi.ship_collision import INTERFACE
from tests.collision.conftest import BOX, World

Make = Callable[..., str]

ALGORITHMS = pytest.mark.parametrize("algorithm", ["gauss-seidel", pytest.param("jacobi", marks=pytest.mark.slow)])
SURGE_MASS = 40e6 * 1.05
"""Of the box, with its added mass in surge [kg]."""


class Mixed(World):
    """s0 returns impulse_applied, s1 takes a force and returns nothing, s2 follows its track."""

    def send(self) -> None:
        super().send()
        for ship, feedback in zip(self.model.inputs.ships[1:], ("force", "prescribed"), strict=False):
            ship.impulse_applied[:] = [0.0] * 6
            self.model.parameters.ships[self.model.inputs.ships.index(ship)].feedback = feedback
        self.upright[2] = np.zeros((6, 6))


def row(make_ship: Make, algorithm: str) -> Mixed:
    """Boxes of 200 m in a row, bow to stern: s0 at 5 m/s behind s1 at rest, s2 before them comes astern by 1 m/s."""
    start: list[dict[str, Any]] = [
        {"position": [0.0, 0.0, 0.0], "nu": [5.0, 0.0, 0.0, 0.0, 0.0, 0.0]},
        {"position": [205.0, 0.0, 0.0], "nu": [0.0] * 6},
        {"position": [415.0, 0.0, 0.0], "nu": [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0]},
    ]
    box = make_ship("box", BOX)
    return Mixed([box] * 3, start, degrees_of_freedom=3, algorithm=algorithm, friction=0.0, substep=0.05)


@ALGORITHMS
def test_ledger_force_and_prescribed_work_side_by_side(make_ship: Make, algorithm: str) -> None:
    """s0 and s1 share their momentum at first; then the prescribed ship takes both with it, as infinite mass does. It
    stays on its track, and its impulse is the momentum that the others lost."""
    w = row(make_ship, algorithm)
    try:
        w.run(1.6, 0.1)
        assert w.nu[0][0] + w.nu[1][0] == pytest.approx(5.0, rel=1e-12)
        assert w.nu[1][0] == pytest.approx(2.5, rel=1e-9)
        w.run(8.0, 0.1)
        assert [nu[0] for nu in w.nu] == pytest.approx([-1.0] * 3, abs=1e-9)
        assert w.x[2][0] == pytest.approx(415.0 - w.t, rel=1e-12)
        lost = SURGE_MASS * (5.0 + 2.0 * 1.0)
        assert w.model.outputs.ships[2].impulse[0] == pytest.approx(lost, rel=1e-9)
        # In the frame of s2 both end at rest: all their energy there is lost.
        assert w.model.outputs.energy.dissipated == pytest.approx(0.5 * SURGE_MASS * (6.0**2 + 1.0**2), rel=1e-9)
        assert w.model.outputs.diagnosis.count == 0
    finally:
        w.model.close()


def test_a_prescribed_ship_in_motion_is_one_at_rest_in_another_frame(make_ship: Make) -> None:
    """s0 strikes the side of a prescribed ship, and slides along it. All moved on by 4 m/s, it is the same impact."""
    box = make_ship("box", BOX)
    ends = []
    for along in (0.0, 4.0):
        heading = np.pi / 2 - 0.3
        u, v = 5.0 + along * np.cos(heading), -along * np.sin(heading)
        start: list[dict[str, Any]] = [
            {"position": [-60.0, -118.0, 0.0], "attitude": (0.0, 0.0, heading), "nu": [u, v, 0.0, 0.0, 0.0, 0.0]},
            {"position": [0.0, 0.0, 0.0], "nu": [along, 0.0, 0.0, 0.0, 0.0, 0.0]},
        ]
        w = World([box] * 2, start, degrees_of_freedom=3, friction=0.2, substep=0.05)
        w.upright[1] = np.zeros((6, 6))
        w.model.parameters.ships[1].feedback = "prescribed"
        w.model.initialise()
        w.run(4.0, 0.1)
        ends.append((w.R[0] @ w.nu[0][:3] - [along, 0.0, 0.0], w.nu[0][3:]))
        w.model.close()
    assert abs(ends[0][1][2]) > 1e-3
    assert ends[1][0] == pytest.approx(ends[0][0], abs=1e-9)
    assert ends[1][1] == pytest.approx(ends[0][1], abs=1e-9)


def test_one_ship_that_ignores_contact_is_answered_once(make_ship: Make) -> None:
    """s1 has feedback "none" and sails through; s0, by the ledger, gets the impulse of the impact and no more."""
    start: list[dict[str, Any]] = [
        {"position": [0.0, 0.0, 0.0], "nu": [5.0, 0.0, 0.0, 0.0, 0.0, 0.0]},
        {"position": [201.0, 0.0, 0.0], "nu": [0.0] * 6},
    ]
    w = World([make_ship("box", BOX)] * 2, start, degrees_of_freedom=3, friction=0.0)
    w.model.parameters.ships[1].feedback = "none"
    w.model.initialise()
    try:
        w.run(2.0, 0.1)
        assert w.nu[0][0] == pytest.approx(2.5, rel=1e-9)
    finally:
        w.model.close()


# -- parameters ------------------------------------------------------------------------------------------------------


def feedbacks(common: str, *ships: tuple[str, str]) -> list[str]:
    model = ShipCollision()
    model.parameters.feedback = common
    for parameters, (word, name) in zip(model.parameters.ships, ships, strict=True):
        parameters.feedback, parameters.feedback_name = word, name
    model.initialise()
    found = [body.feedback for body in model._bodies]
    model.close()
    return found


def test_each_ship_has_its_own_feedback_or_that_of_all() -> None:
    assert feedbacks("force", ("common", ""), ("common", "common")) == ["force", "force"]
    assert feedbacks("force", ("ledger", ""), ("common", " prescribed ")) == ["ledger", "prescribed"]
    assert feedbacks("ledger", ("force", "force"), ("none", "")) == ["force", "none"]


@pytest.mark.parametrize(
    ("word", "name", "message"),
    [
        ("wish", "", r"own.feedback = 'wish' is not known: choose one of common, ledger, .*prescribed"),
        ("common", "wish", r"own.feedback_name = 'wish' is not known"),
        ("force", "ledger", r"own.feedback = 'force' and own.feedback_name = 'ledger' differ: give one of them"),
    ],
)
def test_a_feedback_that_is_unknown_or_given_twice_is_refused(word: str, name: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        feedbacks("ledger", (word, name), ("common", ""))


@pytest.mark.needs("pybullet")
def test_the_response_bullet_refuses_a_prescribed_ship(make_ship: Make) -> None:
    model = ShipCollision()
    for ship in model.parameters.ships:
        ship.ship = "guan2014_own"
    model.parameters.response = "bullet"
    model.parameters.ships[1].feedback = "prescribed"
    with pytest.raises(InputError, match="response 'bullet' moves bodies by their mass, and target is prescribed"):
        model.initialise()
    model.parameters.ships[1].feedback = "none"
    model.initialise()
    model.close()


def test_the_variables_are_an_enumeration_and_a_text() -> None:
    access = INTERFACE.make_access()
    number, text = access.references(["target.feedback"]), access.references(["own.feedback_name"])
    assert access.get_integer(number) == [1]
    access.set_integer(number, [6])
    access.set_string(text, ["force"])
    access.initialise()
    assert [body.feedback for body in access.model._bodies] == ["force", "prescribed"]
    assert access.table[access.references(["feedback"])[0]].items == COMMON_FEEDBACKS
    access.close()
