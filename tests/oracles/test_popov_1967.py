"""Popov et al. (1967), Strength of ships sailing in ice, as in Daley (1999): a glancing blow of the bow at an ice edge.

    E   = 1/2 M_e (V l)^2,   M_e = M / C_o               normal energy; the ice is heavy, there is no friction
    C_o = l^2/(1 + m_x) + m^2/(1 + m_y) + n^2/(1 + m_z)                             mass reduction
          + lam^2/(r_x^2 (1 + j_x)) + mu^2/(r_y^2 (1 + j_y)) + eta^2/(r_z^2 (1 + j_z))
    l, m, n       = sin a cos b, cos a cos b, sin b      normal; a waterline angle, b frame angle
    lam, mu, eta  = n y - m z, l z - n x, m x - l y      its arms about CG from the point of contact (x, y, z)
    m_x = 0, m_y = 2 T/B, m_z = 2/3 B C_wp^2/(T C_b (1 + C_wp)), j_x = 0.25, j_y = B/(T (3 - 2 C_wp)(3 - C_wp)),
    j_z = 0.3 + 0.05 L/B,  r_x^2 = C_wp B^2/(11.4 C_m) + H^2/12,  r_y^2 = 0.07 C_wp L^2,  r_z^2 = L^2/16

It is the basis of the design loads of the polar classes (IACS UR I2). M_e is read, C_o and the factors are recalled
with high confidence. Case A: 10 000 t, 5.70 m/s, L 100 m, B 20 m, T 7 m, H 10 m, C_b 0.70, C_wp 0.80, C_m 0.95,
a 30 deg, b 35 deg, point (35, 8, 0): C_o 1.928502, E 14.1309 MJ, worked out from the formulae.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial import ConvexHull, HalfspaceIntersection

from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import make_contact
from shipcollision_fmu.collision.dynamics.delassus import mobility
from shipcollision_fmu.ship.degrees_of_freedom import free_inverse
from shipcollision_fmu.ship.loading.library import load_ship
from tests.oracles.conftest import Collide
from tests.ship_files import ship_toml


@dataclass(frozen=True)
class Bow:
    """A ship in ice: size [m], mass [kg], coefficients, angles a and b [rad], place of contact from CG in b [m]."""

    L: float
    B: float
    T: float
    H: float
    mass: float
    C_b: float
    C_wp: float
    C_m: float
    a: float
    b: float
    point: tuple[float, float, float]
    V: float

    @property
    def normal(self) -> np.ndarray:
        """Of the hull, outward and down."""
        return np.array([sin(self.a) * cos(self.b), cos(self.a) * cos(self.b), sin(self.b)])

    @property
    def added(self) -> dict[str, float]:
        L, B, T, C_wp = self.L, self.B, self.T, self.C_wp
        return {
            "m_x": 0.0, "m_y": 2.0 * T / B, "m_z": 2.0 / 3.0 * B * C_wp**2 / (T * self.C_b * (1.0 + C_wp)),
            "j_x": 0.25, "j_y": B / (T * (3.0 - 2.0 * C_wp) * (3.0 - C_wp)), "j_z": 0.3 + 0.05 * L / B, "z_y": 0.0,
        }  # fmt: skip

    @property
    def radii_squared(self) -> tuple[float, float, float]:
        return (
            self.C_wp * self.B**2 / (11.4 * self.C_m) + self.H**2 / 12.0, 0.07 * self.C_wp * self.L**2, self.L**2 / 16.0
        )  # fmt: skip

    def C_o(self, normal: np.ndarray, point: np.ndarray) -> float:
        x_n, y_n, z_n = normal.tolist()
        x, y, z = point.tolist()
        arms = (z_n * y - y_n * z, x_n * z - z_n * x, y_n * x - x_n * y)
        added = list(self.added.values())
        linear = sum(c**2 / (1.0 + f) for c, f in zip((x_n, y_n, z_n), added[:3], strict=True))
        angular = sum(
            arm**2 / (r2 * (1.0 + f)) for arm, r2, f in zip(arms, self.radii_squared, added[3:6], strict=True)
        )
        return linear + angular

    def energy(self, normal: np.ndarray, point: np.ndarray) -> float:
        """1/2 M_e (V l)^2 [J]."""
        return float(0.5 * self.mass / self.C_o(normal, point) * (self.V * normal[0]) ** 2)

    def tables(self, folder: Path, side: float = 1.0) -> dict[str, Any]:
        """Tables of a ship whose hull is a block, cut off at the facet of the contact; side: 1 starboard, -1 port."""
        mirror = np.array([1.0, side, 1.0])
        p, n = mirror * self.point, mirror * self.normal
        up, keel = self.T - self.H, self.T
        planes = [
            [1, 0, 0, -0.5 * self.L], [-1, 0, 0, -0.5 * self.L], [0, 1, 0, -0.5 * self.B], [0, -1, 0, -0.5 * self.B],
            [0, 0, 1, -keel], [0, 0, -1, up], [*n, -n @ p],
        ]  # fmt: skip
        corners = HalfspaceIntersection(np.array(planes, dtype=float), np.array([-1.0, -1.0, 0.1])).intersections
        corners = np.unique(corners.round(9), axis=0)
        faces = ConvexHull(corners)
        lines = [f"v {x!r} {-y!r} {-z!r}" for x, y, z in corners.tolist()]  # the file's axes: forward, port, up
        middle = corners.mean(axis=0)
        for i, j, k in faces.simplices.tolist():
            outward = np.cross(corners[j] - corners[i], corners[k] - corners[i]) @ (corners[i] - middle) > 0.0
            lines.append(f"f {i + 1} {j + 1} {k + 1}" if outward else f"f {i + 1} {k + 1} {j + 1}")
        (folder / "bow.obj").write_text("\n".join(lines) + "\n", encoding="utf-8")
        return {
            "particulars": {
                "L_pp": self.L, "B": self.B, "T": self.T, "mass": self.mass, "r_bg": [0.0, 0.0, 0.0],
                **dict(zip(("k_xx", "k_yy", "k_zz"), (r2**0.5 for r2 in self.radii_squared), strict=True)),
                "allow_inconsistent": "the case gives mass and C_b apart",
            },
            "added_mass": self.added,
            "hull": {"shape": "mesh", "depth": self.H, "file": "bow.obj"},
        }  # fmt: skip


A = Bow(100.0, 20.0, 7.0, 10.0, 1e7, 0.70, 0.80, 0.95, radians(30.0), radians(35.0), (35.0, 8.0, 0.0), 5.70)
BOWS = {
    "A": A,
    "large, flared": Bow(
        200.0, 32.0, 11.0, 18.0, 5e7, 0.78, 0.86, 0.98, radians(24.0), radians(50.0), (88.0, 9.0, 0.0), 4.0
    ),
    "shoulder": Bow(100.0, 20.0, 7.0, 10.0, 1e7, 0.70, 0.80, 0.95, radians(12.0), radians(20.0), (20.0, 9.0, 0.0), 5.7),
    "wall-sided": Bow(80.0, 15.0, 5.0, 7.0, 4e6, 0.65, 0.76, 0.93, radians(40.0), radians(4.0), (36.0, 3.0, 0.0), 3.0),
}


def write_ship(folder: Path, bow: Bow) -> str:
    """Path of the ship's file."""
    path = folder / "ship.toml"
    path.write_text(ship_toml(**bow.tables(folder)), encoding="utf-8")
    return str(path)


def test_case_a() -> None:
    assert A.C_o(A.normal, np.array(A.point)) == pytest.approx(1.928502, abs=5e-7)
    assert A.energy(A.normal, np.array(A.point)) == pytest.approx(14.1309e6, rel=5e-6)


@pytest.mark.parametrize("name", BOWS)
def test_mass_reduction_of_the_contact_solver(tmp_path: Path, name: str) -> None:
    """M W_nn = C_o at the exact place and normal, with the inertia and the Jacobian of the model."""
    bow = BOWS[name]
    M = load_ship(write_ship(tmp_path, bow)).M
    ship = BodyState.at(np.zeros(3), np.zeros(3), np.zeros(6), free_inverse(M, 6))
    ice = BodyState.wall(np.zeros(3), 0.0)
    contact = make_contact(0, 1, [ship, ice], np.array(bow.point), bow.normal, 0.0)
    W = mobility(contact, [ship, ice])
    assert bow.mass * W[0, 0] == pytest.approx(bow.C_o(bow.normal, np.array(bow.point)), rel=1e-9)


@pytest.mark.one_in(3)
@pytest.mark.parametrize("response", ["pgs", "closed_form"])
@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("name", BOWS)
def test_energy_of_a_glancing_blow(collide: Collide, tmp_path: Path, name: str, side: float, response: str) -> None:
    """A hull with the facet meets the corner of a floe, to starboard or mirrored to port.

    At the normal that Bullet reports, and where the model books the impulse, the energy is the formula's to 1e-9. The
    place is midway between the two material points, millimetres apart at the start of the step. Bullet's rounding of
    the hull moves place and normal from the nominal ones, and the energy by up to 0.05 %.
    """
    bow = BOWS[name]
    x, y, z = bow.point
    out_of_plan = np.array([bow.normal[0], side * bow.normal[1]])
    turns = [np.array([[cos(t), -sin(t)], [sin(t), cos(t)]]) for t in (-1.2, 1.2)]
    ends = [(30.0 * turn @ out_of_plan).tolist() for turn in turns]
    floe = (
        f'[floe]\nkind = "ice"\nshape = "polygon"\npoints = [[0.0, 0.0], {ends[0]}, {ends[1]}]\n'
        f"position = [{x}, {side * y}]\ntop = {-z}\nbottom = {z + 40.0}\n"
    )
    start = {"position": (-0.005, 0.0, 0.0), "nu": (bow.V, 0, 0, 0, 0, 0)}
    w = collide(
        [bow.tables(tmp_path, side)], [start], 0.0, obstacles=floe, substep=1e-3,
        friction=0.0, restitution=0.0, response=response,
    )  # fmt: skip
    out = w.model.outputs
    for _ in range(10):
        before = w.x[0].copy()
        w.step(1e-3)
        if out.contact_count:
            break
    assert out.collision_count == out.contact_count == 1
    contact, mirror = out.contacts[0], np.array([1.0, side, 1.0])
    place = 0.5 * (np.array(contact.r_a) + np.array([x, side * y, 0.0]) + contact.r_b - before)
    normal = mirror * contact.normal
    lost = out.energy.dissipated
    assert lost == pytest.approx(bow.energy(normal, mirror * place), rel=1e-9)
    assert lost == pytest.approx(bow.energy(bow.normal, np.array(bow.point)), rel=5e-4)
