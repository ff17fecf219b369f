"""A Bullet world that a closed model gave back is as a new one, bit for bit, and client 0 stays the user's."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from types import ModuleType
from typing import Any, Literal

import numpy as np
import pytest

from shipcollision_fmu.collision.geometry import bullet
from shipcollision_fmu.collision.geometry.bullet import BulletAdapter, BulletBody, bullet_module
from shipcollision_fmu.collision.geometry.bullet_worlds import KEPT, BulletWorlds
from shipcollision_fmu.ship.frames import Array, rotation
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.hull.solid import HullMesh
from shipcollision_fmu.ship.tables.hull import HullTable

pytestmark = pytest.mark.needs("pybullet")


def build(L: float, B: float, shape: Literal["box", "parametric"]) -> HullMesh:
    """A hull with its keel 5 m below the water and its deck 8 m above."""
    ends = {"bow_length": 0.2 * L, "stern_length": 0.1 * L} if shape == "parametric" else {}
    return build_hull(L, B, 5.0, HullTable(shape=shape, depth=13.0, **ends))


HULLS = [build(100.0, 20.0, "parametric"), build(60.0, 12.0, "box")]
OTHER_HULLS = [build(30.0 + k, 12.0 if k % 2 else 20.0, "box") for k in range(5)]


@pytest.fixture
def p() -> ModuleType:
    return bullet_module()


@pytest.fixture
def worlds(p: ModuleType, monkeypatch: pytest.MonkeyPatch) -> Iterator[BulletWorlds]:
    """Worlds of this test alone."""
    own = BulletWorlds(p)
    monkeypatch.setattr(bullet, "_worlds", lambda module: own)
    for client in (own.take(), own.take()):  # one may be client 0, which is not kept
        own.give_back(client)
    yield own
    while own._waiting:
        p.disconnect(own._waiting.pop())


@dataclass(frozen=True)
class Pose:
    """A body state, as far as closest points ask for it."""

    x: Array
    R: Array


def step(adapter: BulletAdapter, x: float, h: float, friction: float, restitution: float) -> list[Any]:
    """Bullet's own step of two ships that overlap at the second's position x [m] and close at 2 m/s."""
    bodies = [BulletBody(mass, np.array([mass * 30.0, mass * 700.0, mass * 720.0]), np.array([1.0, 0.0, -0.5]))
              for mass in (2e7, 4e6)]  # fmt: skip
    poses = [(np.zeros(3), np.eye(3)), (np.array([x, 15.9, 0.1]), rotation(np.array([0.0, 0.01, 0.02])))]
    twists = [np.zeros(6), np.array([1.0, -2.0, 0.0, 0.0, 0.0, 0.03])]
    return adapter.dynamic_step((0, 1), tuple(bodies), tuple(poses), tuple(twists), h, friction, restitution)


def measure(hulls: list[HullMesh], random: np.random.Generator) -> list[Any]:
    """All that an adapter answers, in bits: corners, closest points and gaps of twenty poses, and eight steps."""
    adapter = BulletAdapter(hulls)
    found: list[Any] = [adapter.corners(ship, 0).tobytes() for ship in range(len(hulls))]
    for _ in range(20):
        states = [Pose(random.normal(0.0, 12.0, 3), rotation(random.normal(0.0, 0.3, 3))) for _ in hulls]
        for c in adapter.closest(0, 1, states, 30.0):
            found.append((c.on_a.tobytes(), c.on_b.tobytes(), c.normal.tobytes(), c.gap.hex(), c.part_a, c.part_b))
        found.append(adapter.gap(0, 1, states, 40.0).hex())
    for k in range(8):
        rows = step(adapter, float(random.normal()), 0.01 + 0.002 * k, 0.3, 0.2)
        found.append([(*(part.tobytes() for part in (*row[:3], row[4])), float(row[3]).hex()) for row in rows])
    assert all(found[-8:]), "each step needs a contact"
    adapter.close()
    return found


def leave_as_it_is(p: ModuleType, client: int) -> None:
    """Nothing."""


def end_in_a_step(p: ModuleType, client: int) -> None:
    """Bodies that touch and a filter of their pair stay, as when an exception ends a step; so do its parameters."""
    p.setPhysicsEngineParameter(fixedTimeStep=0.5, numSolverIterations=3, erp=0.9, contactERP=0.9, frictionERP=0.9,
                                physicsClientId=client)  # fmt: skip
    shape = p.createCollisionShape(p.GEOM_BOX, halfExtents=[1.0, 1.0, 1.0], physicsClientId=client)
    first, other = (
        p.createMultiBody(5.0, shape, basePosition=[x, 0.0, 0.0], useMaximalCoordinates=1, physicsClientId=client)
        for x in (0.0, 1.5)
    )
    for _ in range(3):
        p.stepSimulation(physicsClientId=client)
    for a, b in ((0, 1), (first, other), (2, 3)):
        p.setCollisionFilterPair(a, b, -1, -1, 0, physicsClientId=client)


def set_everything(p: ModuleType, client: int) -> None:
    """Gravity, a constraint, a height field, a saved state, and what a solver can be told."""
    end_in_a_step(p, client)
    p.setGravity(1.0, 2.0, -9.8, physicsClientId=client)
    p.setPhysicsEngineParameter(
        restitutionVelocityThreshold=9.0, solverResidualThreshold=0.5, contactSlop=0.4, enableConeFriction=0,
        enableSAT=1, deterministicOverlappingPairs=1, collisionFilterMode=1, physicsClientId=client,
    )  # fmt: skip
    ball = p.createMultiBody(1.0, p.createCollisionShape(p.GEOM_SPHERE, physicsClientId=client), physicsClientId=client)
    p.createConstraint(ball, -1, -1, -1, p.JOINT_FIXED, [0, 0, 0], [0, 0, 0], [0, 0, 0], physicsClientId=client)
    field = p.createCollisionShape(
        p.GEOM_HEIGHTFIELD, heightfieldData=[0.0, 1.0, 2.0, 3.0], numHeightfieldRows=2, numHeightfieldColumns=2,
        physicsClientId=client,
    )  # fmt: skip
    p.createMultiBody(0.0, field, physicsClientId=client)
    p.saveState(physicsClientId=client)


@pytest.mark.parametrize("leave", [leave_as_it_is, end_in_a_step, set_everything])
def test_a_world_that_was_used_answers_as_a_new_one(
    worlds: BulletWorlds, p: ModuleType, leave: Callable[[ModuleType, int], None]
) -> None:
    (client,) = worlds._waiting
    p.disconnect(client)
    new = measure(HULLS, np.random.default_rng(5))  # in a world that was just opened
    measure(OTHER_HULLS, np.random.default_rng(6))
    used = worlds.take()
    leave(p, used)
    worlds.give_back(used)
    assert worlds._waiting == [used]
    assert measure(HULLS, np.random.default_rng(5)) == new
    assert worlds._waiting == [used], "it was that world"


def test_of_its_parameters_the_length_of_a_step_alone_outlives_a_world(worlds: BulletWorlds, p: ModuleType) -> None:
    """The reason why dynamic_step() sets it for each step. PyBullet's documentation is silent on it."""
    fresh = p.connect(p.DIRECT)
    expected = p.getPhysicsEngineParameters(physicsClientId=fresh)
    p.disconnect(fresh)
    used = worlds.take()
    set_everything(p, used)
    worlds.give_back(used)
    found = p.getPhysicsEngineParameters(physicsClientId=used)
    assert {name for name in expected if found[name] != expected[name]} == {"fixedTimeStep"}
    assert (p.getNumBodies(physicsClientId=used), p.getNumConstraints(physicsClientId=used)) == (0, 0)


def test_models_at_once_have_worlds_of_their_own(worlds: BulletWorlds, p: ModuleType) -> None:
    """They are closed in any order; of the worlds that are free then, KEPT wait and the others are gone."""
    for order in ((0, 1, 2), (2, 0, 1)):
        adapters = [BulletAdapter(HULLS) for _ in range(3)]
        clients = [adapter._client for adapter in adapters]
        assert len(set(clients)) == 3
        for place in order:
            adapters[place].close()
            adapters[place].close()  # no world is given back twice
        assert len(worlds._waiting) == KEPT
        assert sum(map(p.isConnected, set(clients))) == KEPT


def test_a_world_that_was_closed_meanwhile_is_not_taken(worlds: BulletWorlds, p: ModuleType) -> None:
    (waiting,) = worlds._waiting
    p.disconnect(waiting)
    adapter = BulletAdapter(HULLS)
    assert p.isConnected(adapter._client)
    p.disconnect(adapter._client)
    adapter.close()
    assert worlds._waiting == []


PROCESS = """
import ctypes, os, threading
import numpy as np
import pybullet as p
from tests.collision.geometry.test_bullet_worlds import HULLS, measure
from shipcollision_fmu.collision.geometry.bullet import BulletAdapter

def answers():
    return measure(HULLS, np.random.default_rng(1))

def used():
    class Mallinfo(ctypes.Structure):
        _fields_ = [(name, ctypes.c_size_t) for name in (
            "arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks", "fordblks", "keepcost")]
    mallinfo = ctypes.CDLL(None).mallinfo2
    mallinfo.restype = Mallinfo
    now = mallinfo()
    return (now.uordblks + now.hblkhd) / 1e6

first = answers()
assert [p.isConnected(k) for k in range(9)] == [0] * 9, "the first world was client 0"
assert answers() == first
assert [k for k in range(9) if p.isConnected(k)] == [1], "one waits"
assert p.connect(p.DIRECT) == 0, "a user's own program has client 0"
p.setGravity(0, 0, -1)
assert answers() == first
p.disconnect()

found = []
threads = [threading.Thread(target=lambda: found.extend(answers() == first for _ in range(3))) for _ in range(4)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
assert found == [True] * 12

child = os.fork()
if child == 0:
    os._exit(answers() != first)
assert answers() == first
assert os.waitpid(child, 0)[1] == 0

before = used()
for _ in range(30):
    answers()
assert used() - before < 1.0, "memory grows"
left_open = BulletAdapter(HULLS)
print("done")
"""


def test_a_process_of_many_models() -> None:
    """In turn, beside a user's own PyBullet, in threads, after a fork, with memory that does not grow, and to the end
    of the process, at which a world waits and another is open."""
    done = subprocess.run([sys.executable, "-c", PROCESS], capture_output=True, text=True, timeout=300, check=False)
    assert (done.returncode, done.stdout.splitlines()[-1:]) == (0, ["done"]), done.stderr
