"""Ships that coast in 4 and 6 degrees of freedom float: small oscillations have the textbook's period and decrement."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import exp, log, pi, sqrt
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.ship.coasting_law import make_coasting
from shipcollision_fmu.ship.frames import rotation
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.restoring import Restoring
from shipcollision_fmu.ship.seakeeping import compute_seakeeping
from shipcollision_fmu.ship.ship import Ship
from tests.ship_files import ship_tables

ZERO = [0.0, 0.0, 0.0]


def make_barge(**seakeeping: float) -> Ship:
    """A barge whose sway and roll are not coupled, so that one oscillation is one sine."""
    return load_ship(
        ship_tables(added_mass={"z_y": 0.0}, particulars={"GM_T": 2.0, "GM_L": 150.0}, seakeeping=seakeeping)
    )


def swing(ship: Ship, degrees_of_freedom: int, motion: int, size: float, h: float, steps: int) -> list[float]:
    """Displacement in heave (2), roll (3) or pitch (4) after each step, let go from `size` [m, rad]."""
    eta = [0.0] * 6
    eta[motion] = size
    state: Any = (eta[:3], eta[3:], ZERO, ZERO)
    law, path = make_coasting(ship, degrees_of_freedom, "kirchhoff"), [size]
    for _ in range(steps):
        state = law.coast(*state, h)
        path.append((*state[0], *state[1])[motion])
    return path


def crossings(path: list[float], h: float) -> list[float]:
    """Times at which the path crosses zero."""
    return [h * (k + a / (a - b)) for k, (a, b) in enumerate(pairwise(path)) if a * b < 0.0]


@pytest.mark.parametrize(
    ("degrees_of_freedom", "motion", "size"), [(4, 3, 1e-4), (6, 3, 1e-4), (6, 2, 1e-3), (6, 4, 1e-5)],
    ids=["roll in 4", "roll in 6", "heave", "pitch"],
)  # fmt: skip
def test_the_period_is_2_pi_sqrt_of_inertia_over_stiffness(degrees_of_freedom: int, motion: int, size: float) -> None:
    """T = 2 pi sqrt((m + a)/k), with rho g A_wp, m g GM_T and m g GM_L, of an undamped ship."""
    none = dict.fromkeys(("zeta_heave", "zeta_roll", "zeta_pitch", "zeta_roll_per_rad"), 0.0)
    ship = make_barge(**none)
    weight, C_w = ship.mass * 9.80665, (1.0 + 2.0 * ship.C_b) / 3.0
    k = {2: 1025.0 * 9.80665 * C_w * 100.0 * 20.0, 3: weight * 2.0, 4: weight * 150.0}[motion]
    T = 2.0 * pi * sqrt(ship.M[motion, motion] / k)
    path = swing(ship, degrees_of_freedom, motion, size, T / 64.0, 64 * 10)
    zeros = crossings(path, T / 64.0)
    assert 2.0 * (zeros[-1] - zeros[0]) / (len(zeros) - 1) == pytest.approx(T, rel=1e-3)
    assert max(map(abs, path[-64:])) == pytest.approx(size, rel=2e-3)  # ten periods on, nothing is lost


@pytest.mark.parametrize(
    ("motion", "size", "ratio"), [(3, 1e-4, "zeta_roll"), (2, 1e-3, "zeta_heave"), (4, 1e-5, "zeta_pitch")]
)
@pytest.mark.parametrize("zeta", [0.05, 0.2])
def test_the_logarithmic_decrement_is_that_of_the_damping_ratio(
    motion: int, size: float, ratio: str, zeta: float
) -> None:
    """ln of two extremes half a period apart: pi zeta/sqrt(1 - zeta^2)."""
    ship = make_barge(**{"zeta_roll_per_rad": 0.0, ratio: zeta})
    path = swing(ship, 6, motion, size, 0.05, 600)
    extremes = [abs(b) for a, b, c in zip(path, path[1:], path[2:], strict=False) if (b - a) * (c - b) < 0.0]
    decrement = log(extremes[0] / extremes[1])
    assert decrement == pytest.approx(pi * zeta / sqrt(1.0 - zeta**2), rel=0.01)
    assert extremes[0] == pytest.approx(size * exp(-decrement), rel=0.01)


def energy(ship: Ship, state: Any) -> float:
    x, (phi, theta, _), velocity, rate = state
    nu = np.array([*velocity, *rate])
    return float(0.5 * nu @ ship.M @ nu) + Restoring(compute_seakeeping(ship)).compute_energy(x[2], phi, theta)


def test_large_motions_lose_energy_in_every_step() -> None:
    """Kinetic and potential energy, thrown about in all six degrees of freedom."""
    ship = load_ship("kvlcc2")
    law = make_coasting(ship, 6, "kirchhoff")
    state: Any = ([0.0, 0.0, 2.0], [0.35, 0.03, 1.0], [5.0, 2.0, 0.5], [0.05, 0.01, 0.02])
    last = energy(ship, state)
    for _ in range(1500):
        state = law.coast(*state, 0.1)
        now = energy(ship, state)
        assert now <= last * (1.0 + 1e-5)
        last = now
    assert abs(state[0][2]) < 0.1
    assert abs(state[1][0]) < 0.05


def test_in_6_degrees_of_freedom_a_settled_ship_moves_in_the_plane_as_with_3() -> None:
    """A raft with CG in the water plane, whose sway does not roll it."""
    ship = make_barge()
    ship = replace(ship, M=np.diag(np.diag(ship.M)))
    start = (ZERO, ZERO, [3.0, 0.5, 0.0], [0.0, 0.0, 0.01])
    three, six = (make_coasting(ship, n, "kirchhoff") for n in (3, 6))
    a: Any = start
    b: Any = start
    for _ in range(500):
        a, b = three.coast(*a, 0.1), six.coast(*b, 0.1)
    np.testing.assert_allclose(b[0], a[0], atol=1e-3)  # the substeps of 6 are the finer ones
    np.testing.assert_allclose(rotation(b[1]), rotation(a[1]), atol=1e-5)
