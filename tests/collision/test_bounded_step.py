"""A step of ships that rest against each other and a quay, pressed on by a breeze, takes a bounded work.

Work is counted in Newton's steps and gradient steps of the solvers of last resort, not in time.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.collision.solvers import aclm_fixed_point, alart_curnier
from tests.collision.conftest import World
from tests.ship_files import ship_toml

MakeWorld = Callable[..., World]

QUAY = '[quay]\nkind = "quay"\nshape = "box"\nlength = 600.0\nbreadth = 20.0\nposition = [0.0, 38.2]'
MOST = 400
"""Steps of Newton's method and of the gradient method in a communication step; 51 s were half a million."""


@pytest.fixture
def last_resort(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """[calls of the equations of Newton's method and of the projection of the gradient method]."""
    calls = [0]

    def counted(owner: object, name: str) -> None:
        plain: Callable[..., Any] = getattr(owner, name)

        def call(*args: object) -> Any:
            calls[0] += 1
            if calls[0] > 20 * MOST:
                pytest.fail(f"more than {20 * MOST} steps of the solvers of last resort")
            return plain(*args)

        monkeypatch.setattr(owner, name, call)

    counted(alart_curnier, "_evaluate_equations")
    counted(aclm_fixed_point, "_project_on_cones")
    return calls


@pytest.mark.parametrize("restitution", [0.05, 0.1, 0.5, 1.0])
def test_ships_pressed_on_each_other_and_a_quay(
    world: MakeWorld, tmp_path: Any, last_resort: list[int], restitution: float
) -> None:
    """Two flush boxes at a quay with a side force on each; the laws hold in every step."""
    path = tmp_path / "box.toml"
    path.write_text(
        ship_toml(
            particulars={
                "L_pp": 82.5, "B": 18.8, "T": 7.6, "mass": 4e6, "allow_inconsistent": "a light ship in a deep hull",
            },
            hull={"depth": 12.0},
        )
    )  # fmt: skip
    start = [{"position": (0.0, 0.0, 0.0), "nu": np.zeros(6)}, {"position": (3.0, 18.8, 0.0), "nu": np.zeros(6)}]
    w = world([str(path)] * 2, start, obstacles=QUAY, friction=0.3, restitution=restitution)
    force, lost = np.array([0.0, 1e5, 0.0, 0.0, 0.0, 0.0]), 0.0
    for _ in range(25):
        for i in range(2):
            w.nu[i] = w.nu[i] + 0.1 * w.upright[i] @ force
        last_resort[0], had = 0, sum(w.energy(i) for i in range(2))
        w.step(0.1)
        out = w.model.outputs
        assert last_resort[0] <= MOST
        assert w.work[-1] <= 1e-6 * had, "energy from contact"
        assert out.energy.dissipated >= lost - 1e-6 * had
        lost = out.energy.dissipated
        assert max(x[1] for x in w.x) < 18.8 + 1e-2, "in the quay"
    assert out.solver.unconverged <= 2
    assert abs(w.x[1][1] - 18.8) < 1e-2
    assert abs(w.x[0][1]) < 1e-2
