"""The bits of an impact do not depend on the number of threads of BLAS: 66 contacts of a row of twelve ships."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

SCRIPT = """
from hashlib import sha256

import numpy as np

from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import make_contact
from shipcollision_fmu.collision.dynamics.delassus import approach_velocities, delassus, held_delassus
from shipcollision_fmu.collision.solvers.held_motions import yield_to_friction
from shipcollision_fmu.collision.solvers.poisson_restitution import solve_poisson_impact
from shipcollision_fmu.collision.solvers.work_limit import WorkLimit

rng, states = np.random.default_rng(1), []
for i in range(12):
    half = rng.normal(size=(6, 6))
    M_inverse = (half @ half.T + 6.0 * np.eye(6)) / 1e7 / np.outer([1, 1, 1, 9, 25, 25], [1, 1, 1, 9, 25, 25])
    nu = np.array([*rng.uniform(-0.1, 0.1, 3), *rng.uniform(-1e-3, 1e-3, 3)]) - [0.0, 0.05 * i, 0.0, 0.0, 0.0, 0.0]
    attitude = rng.uniform(-1e-3, 1e-3, 3)
    held = np.diag([1e-7, 1e-10, 1e-11])
    states.append(BodyState.at(np.array([0.0, 20.0 * i, 0.0]), attitude, nu, M_inverse, held=held))
contacts = [
    make_contact(i, i + 1, states, np.array([x, 20.0 * i + 10.0, z]), np.array([0.01, 1.0, 0.003]) / 1.00005, 0.0)
    for i in range(11) for x in (-30.0, 31.0) for z in (-3.0, 0.5, 4.0)
]
W, H, v = delassus(contacts, states), held_delassus(contacts, states), approach_velocities(contacts, states)
free = solve_poisson_impact(W, v, 0.3, 0.4, work=WorkLimit(5e4)).P
operator, slip, start = yield_to_friction(W, v, 0.3, H, None, WorkLimit(2e4))
P = solve_poisson_impact(operator, v, 0.3, 0.4, start, slip, WorkLimit(5e4)).P
print(len(contacts), *(sha256(x.tobytes()).hexdigest() for x in (W, H, v, free, start, P)))
"""


def bits_of_an_impact(threads: int) -> list[str]:
    """Hashes of W, H, v and the impulses."""
    names = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
    run = subprocess.run(
        [sys.executable, "-c", SCRIPT], env=os.environ | dict.fromkeys(names, str(threads)), capture_output=True,
        text=True, check=True,
    )  # fmt: skip
    return run.stdout.split()


@pytest.mark.slow
def test_an_impact_has_the_same_bits_with_one_and_with_two_threads() -> None:
    one = bits_of_an_impact(1)
    assert one[0] == "66"
    assert bits_of_an_impact(2) == one
