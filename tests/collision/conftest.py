"""Ships made for a test, and a small world that sails them as a master would."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.ship.coasting_law import make_coasting
from shipcollision_fmu.ship.degrees_of_freedom import free_inverse, level_axes, tilted_inverse
from shipcollision_fmu.ship.frames import attitude_from_rotation, rotation, rotation_vector
from shipcollision_fmu.ship.loading.library import load_ship
from tests.native.collision.kernels import load_kernels
from tests.native.native_collision import NativeCollision
from tests.ship_files import ship_toml

NATIVE = pytest.param("native", marks=pytest.mark.slow)
LANGUAGES = pytest.mark.parametrize("language", ["Python", NATIVE], indirect=True)
"""Marks a test of the world that holds for the model of native/ as well, which has its turn in the slow stage."""
QUICK_LANGUAGES = pytest.mark.parametrize("language", ["Python", "native"], indirect=True)
"""The same without the slow stage."""
BULLET = pytest.param("bullet", marks=pytest.mark.needs("pybullet"))
"""The response that only PyBullet gives."""
FORMS = pytest.mark.parametrize(
    ("language", "response"), [("Python", "pgs"), pytest.param("native", "pgs", marks=pytest.mark.slow),
                               pytest.param("Python", "bullet", marks=pytest.mark.needs("pybullet"))],
    indirect=["language"],
)  # fmt: skip
"""Marks a test of the world that holds for PyBullet's own response, too."""
BOX = 'shape = "box"\ndepth = 20.0'
SHIP = 'shape = "parametric"\ndepth = 20.0\nbow_length = 40.0\nstern_length = 50.0'
NO_ADDED_MASS = "m_x = 0.0\nm_y = 0.0\nm_z = 0.0\nj_x = 0.0\nj_y = 0.0\nj_z = 0.0\nz_y = 0.0"

FOR_IMPACTS = "m_x = 0.05\nm_y = 0.85\nj_z = 0.21\nz_y = 0.0"
"""Pedersen and Zhang (1998)."""


@pytest.fixture
def make_ship(tmp_path: Path) -> Callable[..., str]:
    """Writes a ship file and returns its path: L = 200 m, B = 30 m, T = 10 m unless told."""

    def make(
        name: str, hull: str = SHIP, added_mass: str = FOR_IMPACTS, mass: float = 40e6, r_bg: str = "[0.0, 0.0, 0.0]"
    ) -> str:
        path = tmp_path / f"{name}.toml"
        path.write_text(
            ship_toml(
                ship={"name": name},
                hull=None,
                particulars={"L_pp": 200.0, "B": 30.0, "T": 10.0, "mass": mass, "r_bg": json.loads(r_bg), "k_xx": 11.1},
            )
            + f"[added_mass]\n{added_mass}\n[hull]\n{hull}\n"
        )
        return str(path)

    return make


def make_collision(language: str, ships: list[str]) -> Any:
    """The collision model in Python, or that of native/ behind the same face."""
    return ShipCollision(ships) if language == "Python" else NativeCollision(load_kernels(), ships)


class World:
    """Two ships that coast, coupled to a collision model by the ledger. Their law is known to both: straight, unless
    another one is named (ship/coasting_law.py).

    The algorithm is a master's: "gauss-seidel" hands impulses over at once, "jacobi" one step late.
    """

    def __init__(self, ships: list[str], start: list[dict], *, algorithm: str = "gauss-seidel",
                 degrees_of_freedom: int = 6, coasting: str = "straight", language: str = "Python",
                 **parameters: object) -> None:  # fmt: skip
        self.model = make_collision(language, [f"s{i}" for i in range(len(ships))])
        for slot, ship in zip(self.model.parameters.ships, ships, strict=True):
            slot.ship, slot.degrees_of_freedom, slot.coasting = ship, degrees_of_freedom, coasting
        for key, value in parameters.items():
            setattr(self.model.parameters, key, value)
        self.law = (
            None
            if coasting == "straight"
            else [make_coasting(load_ship(ship), degrees_of_freedom, coasting) for ship in ships]
        )
        self.M = [load_ship(ship).M for ship in ships]
        self.r_bg = [np.array(load_ship(ship).r_bg) for ship in ships]
        self.upright = [free_inverse(M, degrees_of_freedom) for M in self.M]
        self.free = degrees_of_freedom
        self.x = [np.array(s["position"], dtype=float) for s in start]
        self.R = [rotation(s.get("attitude", (0, 0, 0))) for s in start]
        self.nu = [np.array(s["nu"], dtype=float) for s in start]
        self.applied = [np.zeros(6) for _ in ships]
        self.waiting = [np.zeros(6) for _ in ships]
        self.algorithm = algorithm
        self.t = 0.0
        self.work: list[float] = []  # change of kinetic energy by impulses, per step
        self.increments: list[
            list[tuple[np.ndarray, np.ndarray, np.ndarray]]
        ] = []  # (x, R, impulse taken) per ship and step
        self.send()
        self.model.initialise()

    def send(self) -> None:
        for i, inputs in enumerate(self.model.inputs.ships):
            inputs.position[:] = self.x[i].tolist()
            inputs.attitude[:] = attitude_from_rotation(self.R[i]).tolist()
            inputs.velocity[:], inputs.rate[:] = self.nu[i][:3].tolist(), self.nu[i][3:].tolist()
            inputs.impulse_applied[:] = self.applied[i].tolist()

    def step(self, H: float) -> None:
        self.send()
        poses = [(x.copy(), rotation(attitude_from_rotation(R))) for x, R in zip(self.x, self.R, strict=True)]
        self.model.step(self.t, H)
        work, rows = 0.0, []
        for i, outputs in enumerate(self.model.outputs.ships):
            issued = np.array(outputs.impulse)
            if self.algorithm == "jacobi":
                issued, self.waiting[i] = self.waiting[i], issued
            new = issued - self.applied[i]
            rows.append((*poses[i], new))
            after = self.nu[i] + tilted_inverse(self.upright[i], self.free, attitude_from_rotation(self.R[i])) @ new
            had = self.energy(i)
            self.nu[i], self.applied[i] = after, issued
            work += self.energy(i) - had
            self._coast(i, H)
        self.work.append(work)
        self.increments.append(rows)
        self.t += H

    def _coast(self, i: int, H: float) -> None:
        """On by H with the velocity of CG constant in n, and the angular velocity: in 4 degrees of freedom the velocity
        of CO and the rates of heading and heel, so that what is held stays held."""
        if self.law is not None:
            angles, nu = attitude_from_rotation(self.R[i]).tolist(), self.nu[i].tolist()
            x, angles, velocity, rate = self.law[i].coast(self.x[i].tolist(), angles, nu[:3], nu[3:], H)
            self.x[i], self.R[i], self.nu[i] = np.array(x), rotation(angles), np.array([*velocity, *rate])
            return
        v_n, nu = self.R[i] @ self.nu[i][:3], self.nu[i]
        if self.free != 4:
            w_n, r = self.R[i] @ nu[3:], self.r_bg[i]
            v_g, g = v_n + np.cross(w_n, self.R[i] @ r), self.x[i] + self.R[i] @ r
            self.R[i] = rotation_vector(w_n * H) @ self.R[i]
            self.x[i] = g + v_g * H - self.R[i] @ r
            self.nu[i] = np.concatenate([self.R[i].T @ (v_g - np.cross(w_n, self.R[i] @ r)), self.R[i].T @ w_n])
            return
        self.x[i] = self.x[i] + v_n * H
        rates, attitude = self.motion(i)[3:], attitude_from_rotation(self.R[i]) + self.motion(i)[3:] * H
        self.R[i] = rotation(attitude)
        self.nu[i] = np.concatenate([self.R[i].T @ v_n, level_axes(attitude)[3:, 3:] @ rates])

    def motion(self, i: int) -> np.ndarray:
        """The twist (6,) in the axes of the motions that M is of: those of b, or level ones."""
        if self.free == 6:
            return self.nu[i]
        return np.linalg.solve(level_axes(attitude_from_rotation(self.R[i])), self.nu[i])

    def energy(self, i: int) -> float:
        """Kinetic energy of a ship [J]."""
        return float(0.5 * self.motion(i) @ self.M[i] @ self.motion(i))

    def know_delays(self) -> None:
        """From the start on, the model knows that every ship takes impulses one step late."""
        if isinstance(self.model, ShipCollision):
            for ledger in self.model._exchange.ledgers:
                ledger.one_step_delay = True
            return
        state = bytearray.fromhex(self.model.get_state()["bytes"])
        for i in range(len(self.x)):  # 50 numbers of the ledger are before its delay, and two flags after it
            state[406 * i + 400] = 2
        self.model.restore(bytes(state))

    def run(self, duration: float, H: float) -> World:
        for _ in range(round(duration / H)):
            self.step(H)
        return self

    def momentum(self) -> np.ndarray:
        """Virtual momentum, linear and angular about n's origin, of ships in 6 degrees of freedom; (6,)."""
        total = np.zeros(6)
        for x, R, nu, M in zip(self.x, self.R, self.nu, self.M, strict=True):
            h = M @ nu
            total[:3] += R @ h[:3]
            total[3:] += R @ h[3:] + np.cross(x, R @ h[:3])
        return total


@pytest.fixture
def language(request: pytest.FixtureRequest) -> str:
    """Which form of the collision model a world has. LANGUAGES runs a test on each."""
    return getattr(request, "param", "Python")


@pytest.fixture
def world(language: str) -> Iterator[Callable[..., World]]:
    made: list[World] = []

    def make(*args: object, **kwargs: object) -> World:
        made.append(World(*args, language=language, **kwargs))  # type: ignore[arg-type]  # passed on
        return made[-1]

    yield make
    for w in made:
        w.model.close()
