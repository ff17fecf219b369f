"""Closest points of our library against PyBullet's: the same bits."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.collision.geometry import closest_points
from shipcollision_fmu.collision.geometry.adapter import CHOICE
from shipcollision_fmu.collision.geometry.bullet import BulletAdapter
from shipcollision_fmu.collision.geometry.closest_points import PlacedHulls
from shipcollision_fmu.collision.geometry.narrow_phase import Closest
from shipcollision_fmu.cosim.run import Run
from shipcollision_fmu.ship.frames import Array, rotation
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.hull.solid import HullMesh
from shipcollision_fmu.ship.loading.library import load_ship

pytestmark = pytest.mark.needs("pybullet")

PROJECT = Path(__file__).parents[4]
SHIPS = ("kvlcc2", "kcs", "kvlcc2_l7", "guan2014_own", "guan2014_target", "buoy", "floating_log", "mesh_example")
OWN = {"fender": "guan2014_target_added_mass", "mesh": "mesh_example"}
"""Scenarios of the tests, and the ship that runs into another one and into a pier."""
SCENARIO = """
[scenario]
name = "{name}"
duration = 40.0
step = 0.05
algorithm = "gauss-seidel"

[ships.own]
ship = "{own}"
position = [-220.0, 0.0]
heading_deg = 0.0
speed = 8.0

[ships.target]
ship = "guan2014_target_added_mass"
position = [20.0, 0.0]
heading_deg = 90.0
speed = 2.0

[collision]
friction = 0.3
restitution = 0.1
response = "pgs"
"""
OBSTACLE = """
[obstacles.pier]
kind = "quay"
shape = "box"
position = [20.0, 165.0]
length = 40.0
breadth = 10.0
fender = { stiffness = 4e6, damping = 1e5, thickness = 1.0 }
"""


@dataclass(frozen=True)
class Pose:
    """A body state, as far as closest points ask for it."""

    x: Array
    R: Array


@pytest.fixture(autouse=True)
def _library(native_library: ctypes.CDLL, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The adapter takes the library of the session."""
    monkeypatch.setattr(closest_points, "load_library", lambda: native_library)
    closest_points.open_library.cache_clear()
    yield
    closest_points.open_library.cache_clear()


@pytest.fixture(scope="module")
def hulls() -> list[HullMesh]:
    """Of all shipped ships: boxes, prisms, a hull of several parts, models of 7 m and ships of 320 m."""
    ships = map(load_ship, SHIPS)
    return [build_hull(ship.L_oa, ship.B, ship.T, ship.hull) for ship in ships]


def random_pair(random: np.random.Generator, hulls: list[HullMesh]) -> tuple[int, int, list[Pose], float]:
    """Two ships, their poses, and a distance: far apart, near, touching, deep inside each other."""
    a, b = random.integers(len(hulls), size=2)
    extents = [np.ptp(hulls[i].vertices, axis=0) for i in (a, b)]
    x_a = random.normal(0.0, [2000.0, 2000.0, 1.0])
    x_b = x_a + random.normal(0.0, 0.4 * (extents[0] + extents[1]))
    tilt = random.choice([0.0, 0.1])
    attitudes = [np.array([*random.normal(0.0, tilt, 2), random.uniform(-10.0, 10.0)]) for _ in range(2)]
    if random.random() < 0.2:  # parallel, and flush in height
        attitudes[1], x_b[2] = attitudes[0], x_a[2]
    poses = {a: Pose(x_a, rotation(attitudes[0])), b: Pose(x_b, rotation(attitudes[1]))}
    elsewhere = Pose(np.zeros(3), np.eye(3))
    return a, b, [poses.get(i, elsewhere) for i in range(len(hulls))], float(random.choice([0.0, 1e-3, 3.0, 500.0]))


def bits(found: list[Closest]) -> list[tuple[bytes | float | int, ...]]:
    """All numbers of closest points, exactly."""
    return [
        (c.on_a.tobytes(), c.on_b.tobytes(), c.normal.tobytes(), c.gap.hex(), c.part_a, c.part_b) for c in found
    ]  # fmt: skip


def test_closest_points_have_pybullets_bits(hulls: list[HullMesh]) -> None:
    """In 2000 poses, of which a good part overlaps, and a good part is out of reach."""
    random, ours, theirs = np.random.default_rng(15), PlacedHulls(hulls), BulletAdapter(hulls)
    count = {"overlap": 0, "apart": 0, "out of reach": 0}
    for _ in range(2000):
        a, b, states, distance = random_pair(random, hulls)
        found = theirs.closest(a, b, states, distance)
        assert bits(ours.closest(a, b, states, distance)) == bits(found)
        assert ours.gap(a, b, states, distance).hex() == theirs.gap(a, b, states, distance).hex()
        kind = "out of reach" if not found else "overlap" if min(c.gap for c in found) <= 0.0 else "apart"
        count[kind] += 1
    assert min(count.values()) > 200, count
    ours.close()
    theirs.close()


def test_closest_points_of_two_parts_have_pybullets_bits(hulls: list[HullMesh]) -> None:
    random, ours, theirs = np.random.default_rng(16), PlacedHulls(hulls), BulletAdapter(hulls)
    for _ in range(500):
        a, b, states, distance = random_pair(random, hulls)
        i, j = (int(random.integers(len(hulls[ship].parts))) for ship in (a, b))
        asked = (a, i, states[a].x, states[a].R), (b, j, states[b].x, states[b].R), distance
        one, other = ours.closest_of_parts(*asked), theirs.closest_of_parts(*asked)
        assert (one is None) == (other is None)
        if one is not None and other is not None:
            assert (one[0].hex(), one[1].tobytes()) == (float(other[0]).hex(), other[1].tobytes())
    ours.close()
    theirs.close()


def test_corners_are_rounded_as_pybullets(hulls: list[HullMesh]) -> None:
    ours, theirs = PlacedHulls(hulls), BulletAdapter(hulls)
    for ship, hull in enumerate(hulls):
        for part in range(len(hull.parts)):
            assert (ours.corners(ship, part) == theirs.corners(ship, part)).all()
    ours.close()
    theirs.close()


def test_what_is_asked_before_changes_nothing(hulls: list[HullMesh]) -> None:
    """Results depend on hulls, poses and arguments alone, as for PyBullet."""
    random, used = np.random.default_rng(17), PlacedHulls(hulls)
    asked = [random_pair(random, hulls) for _ in range(30)]
    first = [bits(used.closest(*one)) for one in asked]
    for one, before in zip(reversed(asked), reversed(first), strict=True):
        fresh = PlacedHulls(hulls)
        assert bits(used.closest(*one)) == bits(fresh.closest(*one)) == before
        fresh.close()
        fresh.close()
    used.close()


def both(monkeypatch: pytest.MonkeyPatch, scenario: Path) -> list[Run]:
    """A run with PyBullet, and one with our library."""
    found = []
    for choice in ("pybullet", "library"):
        monkeypatch.setenv(CHOICE, choice)
        found.append(simulate(load_scenario(scenario), in_process=True))
    return found


@pytest.mark.parametrize(
    "name",
    [
        "guan2014",
        "guan2014_added_mass",
        pytest.param("fender", marks=pytest.mark.slow),
        pytest.param("mesh", marks=pytest.mark.slow),
        pytest.param("kvlcc2_crossing", marks=pytest.mark.slow),
    ],
)
def test_whole_runs_have_the_same_bits(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the shipped scenarios; with a fender and an obstacle; with a hull of several parts."""
    scenario = tmp_path / f"{name}.toml"
    if name in OWN:
        scenario.write_text(SCENARIO.format(name=name, own=OWN[name]) + OBSTACLE)
    else:  # the response of guan2014 is PyBullet's own
        text = (PROJECT / "models" / "scenarios" / f"{name}.toml").read_text(encoding="utf-8")
        scenario.write_text(text.replace('"bullet"', '"closed_form"'), encoding="utf-8")
    theirs, ours = both(monkeypatch, scenario)
    assert len(theirs.contacts) > 0
    assert ours.states.tobytes() == theirs.states.tobytes()
    assert ours.contacts.tobytes() == theirs.contacts.tobytes()
    assert ours.events == theirs.events
    if name in OWN:
        assert {str(row["ship_b"]) for row in theirs.contacts} == {"target", "pier"}
        assert theirs.summary["energy"]["fender_dissipated"] > 0.0
