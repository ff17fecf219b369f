"""Rigid impact knows no length of its own: a boat of the ship's shape, her mass and speeds to scale, answers alike."""

from __future__ import annotations

import json
from collections.abc import Callable
from math import pi
from pathlib import Path

import numpy as np
import pytest

from tests.collision.conftest import BOX, SHIP, World
from tests.ship_files import ship_toml

MakeWorld = Callable[..., World]

CASES = {
    "stem on side": ((-40.0, -114.9), pi / 2, [3.0, 0.0], SHIP),
    "end on side": ((20.0, -114.9), pi / 2, [3.0, 0.0], BOX),
    "corner on side": ((-20.0, -100.0), pi / 3, [4.0, 0.0], BOX),
    "side on side": ((30.0, -29.98), 0.0, [5.0, 1.0], BOX),
    "curved side on side": ((30.0, -29.98), 0.001, [5.0, 1.0], SHIP),
}


def written(folder: Path, name: str, hull: str, scale: float) -> str:
    lengths = ("depth", "bow_length", "stern_length")
    scaled = {
        key: scale * float(value) if key in lengths else json.loads(value)
        for key, value in (line.split(" = ") for line in hull.splitlines())
    }
    path = folder / f"{name}.toml"
    particulars = {
        "L_pp": 200.0 * scale,
        "B": 30.0 * scale,
        "T": 10.0 * scale,
        "mass": 40e6 * scale**3,
        "k_xx": 11.1 * scale,
        "allow_inconsistent": "2 km long at a scale of 10",
    }
    path.write_text(ship_toml(ship={"name": name}, particulars=particulars, hull=scaled))
    return str(path)


def impulses(world: MakeWorld, folder: Path, case: str, scale: float) -> np.ndarray:
    """Impulses on both ships of what touches in the first half second, to scale: (12,) [N s, N m s]."""
    place, heading, speed, hull = CASES[case]
    ships = [written(folder, f"{name}{scale}", hull, scale) for name in ("a", "b")]
    start = [
        {"position": (0, 0, 0), "nu": (0, 0, 0, 0, 0, 0)},
        {"position": (scale * place[0], scale * place[1], 0.0), "attitude": (0, 0, heading),
         "nu": (scale * speed[0], scale * speed[1], 0, 0, 0, 0)},
    ]  # fmt: skip
    w = world(ships, start, friction=0.0)
    w.run(0.5, 0.05)
    assert w.model.outputs.collision_count == 1
    unit = np.array([scale] * 3 + [scale**2] * 3)
    return np.concatenate([np.array(w.model.outputs.ships[i].impulse) / (unit * scale**3) for i in (0, 1)])


@pytest.mark.one_in(3)
@pytest.mark.parametrize("scale", [10.0, *(pytest.param(s, marks=pytest.mark.slow) for s in (0.1, 0.022)), 0.01])
@pytest.mark.parametrize("case", list(CASES))
def test_a_scaled_impact_is_the_impact_scaled(world: MakeWorld, tmp_path: Path, case: str, scale: float) -> None:
    """To a thousandth; of two curved sides that are all but parallel, to a hundredth of the farthest arm: a touching
    feature is 5 cm deep for every ship (contact_place.py), and shrinks with boats only."""
    share = 1e-2 if case == "curved side on side" else 1e-3
    one, other = impulses(world, tmp_path, case, 1.0), impulses(world, tmp_path, case, scale)
    for linear in (slice(0, 3), slice(6, 9)):
        np.testing.assert_allclose(other[linear], one[linear], rtol=0.0, atol=share * np.linalg.norm(one[linear]))
    for angular in (slice(3, 6), slice(9, 12)):
        arm = 100.0 * np.linalg.norm(one[:3])
        np.testing.assert_allclose(other[angular], one[angular], rtol=0.0, atol=share * arm)
