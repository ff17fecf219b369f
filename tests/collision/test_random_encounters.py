"""Random encounters run without an exception, a NaN or a gain of energy: ships, headings, speeds, offsets at random."""

from __future__ import annotations

import random
from collections.abc import Callable
from math import cos, isfinite, pi, sin

import numpy as np
import pytest

from tests.collision.conftest import World

Make = Callable[..., str]
MakeWorld = Callable[..., World]

SHIPS = ("kvlcc2", "guan2014_own_added_mass", "guan2014_target_added_mass", "buoy", "floating_log")
REACH = {"kvlcc2": 160.0, "guan2014_own_added_mass": 147.0, "guan2014_target_added_mass": 135.0, "buoy": 1.5,
         "floating_log": 5.0}  # fmt: skip
OBSTACLES = (
    "",
    '[pier]\nkind = "pier"\nshape = "cylinder"\ndiameter = 15.0\nposition = [0.0, 60.0]\n',
    '[quay]\nkind = "quay"\nshape = "box"\nlength = 900.0\nbreadth = 30.0\nposition = [0.0, 90.0]\nheading_deg = 10.0\n'
    "fender = {stiffness = 2e7, damping = 2e6, thickness = 1.5}\n",
)


def encounter(rng: random.Random) -> tuple[list[str], list[dict], dict]:
    """Two ships on courses that meet near the origin, or nearly; placed apart."""
    names = [rng.choice(SHIPS), rng.choice(SHIPS)]
    flat = rng.random() < 0.5
    heading, other = rng.uniform(-pi, pi), rng.uniform(-pi, pi)
    gap = REACH[names[0]] + REACH[names[1]] + rng.uniform(1.0, 30.0)
    bearing, aim = rng.uniform(-pi, pi), rng.uniform(-0.5, 0.5) * (REACH[names[0]] + REACH[names[1]])
    towards = np.array([-cos(bearing), -sin(bearing)])
    place = -gap * towards + aim * np.array([-towards[1], towards[0]])
    closing = rng.uniform(0.1, 8.0)
    drift = np.array([rng.uniform(-2, 2), rng.uniform(-2, 2)])
    velocities = (drift + closing * towards, drift)
    starts = []
    for x, psi, v in zip((place, np.zeros(2)), (heading, other), velocities, strict=True):
        c, s = cos(psi), sin(psi)
        rates = [0.0, 0.0, rng.uniform(-0.01, 0.01)] if flat else [rng.uniform(-0.01, 0.01) for _ in range(3)]
        tilt = (0.0, 0.0) if flat else (rng.uniform(-0.1, 0.1), rng.uniform(-0.03, 0.03))
        starts.append({
            "position": [float(x[0]), float(x[1]), 0.0], "attitude": (*tilt, psi),
            "nu": [float(c * v[0] + s * v[1]), float(-s * v[0] + c * v[1]), 0.0, *rates],
        })  # fmt: skip
    parameters = {
        "degrees_of_freedom": 3 if flat else 6, "friction": rng.choice([0.0, 0.3, 1.0]),
        "algorithm": rng.choice(["gauss-seidel", "jacobi"]), "obstacles": rng.choice(OBSTACLES), "substep": 0.05,
        "response": rng.choice(["pgs", "pgs", "closed_form"]),
    }  # fmt: skip
    return names, starts, {**parameters, "time": min(60.0, 1.3 * (gap + abs(aim)) / closing)}


def check(world: MakeWorld, seed: int) -> bool:
    """Run one encounter; whether the hulls touched. Nothing may be gained at any step, and nothing may be NaN."""
    names, starts, parameters = encounter(random.Random(seed))
    duration = parameters.pop("time")
    w = world(names, starts, **parameters)
    kinetic = sum(0.5 * nu @ M @ nu for nu, M in zip(w.nu, w.M, strict=True))
    H, spent, touched = 0.2, 0.0, False
    for _ in range(round(duration / H)):
        w.step(H)
        out = w.model.outputs
        spent += w.work[-1]
        held = out.fender[0]
        assert w.work[-1] <= held + 1e-9 * kinetic + 1e-3, (seed, w.t, w.work[-1])
        assert spent <= 1e-9 * kinetic + 1e-3, (seed, w.t, spent)
        values = [*out.energy, *out.fender, *out.clearance, *(x for s in out.ships for x in (
            *s.position, *s.attitude, *s.velocity, *s.rate, *s.impulse, *s.force))]  # fmt: skip
        assert all(map(isfinite, values)), (seed, w.t)
        touched |= out.contact_active
    assert out.energy[0] >= -1e-9 * kinetic
    w.model.close()
    return touched


@pytest.mark.parametrize("block", range(3))
def test_three_hundred_random_encounters(world: MakeWorld, block: int) -> None:
    touched = sum(check(world, seed) for seed in range(100 * block, 100 * block + 100))
    assert touched > 20


@pytest.mark.slow
@pytest.mark.parametrize("block", range(100))
def test_ten_thousand_random_encounters(world: MakeWorld, block: int) -> None:
    touched = sum(check(world, seed) for seed in range(1000 + 100 * block, 1100 + 100 * block))
    assert touched > 20
