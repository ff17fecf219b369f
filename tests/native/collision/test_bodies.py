"""native/collision: bodies, their distances and the schedule of a step beside their Python twins."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import replace
from functools import cache, reduce
from math import pi
from pathlib import Path
from random import Random
from zlib import crc32

import numpy as np
import pytest

from shipcollision_fmu.collision.bodies import Body, prepare_bodies
from shipcollision_fmu.collision.conservative_advancement import ConservativeAdvancement
from shipcollision_fmu.collision.contact_problem import ContactCaches
from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.feedback import SHIP_FEEDBACKS
from shipcollision_fmu.collision.fender_ledger import select_fenders
from shipcollision_fmu.collision.geometry.broad_phase import Pair
from shipcollision_fmu.collision.geometry.detection import Detector
from shipcollision_fmu.collision.interface import CollisionParameters, FenderParameters, ShipParameters, ShipState
from shipcollision_fmu.collision.prepared_obstacles import prepare_obstacles
from shipcollision_fmu.collision.proximity import Proximity
from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from shipcollision_fmu.ship.coasting_law import COASTING
from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.ship.prepared_lines import seal
from tests.native.collision.kernels import evaluate, load_kernels
from tests.native.comparison import assert_close

pytestmark = pytest.mark.needs("pybullet")

OBSTACLES = """
[pier]
kind = "pier"
shape = "cylinder"
diameter = 12.0
position = [150.0, 20.0]

[quay]
kind = "quay"
shape = "box"
length = 900.0
breadth = 30.0
position = [0.0, 190.0]
heading_deg = 3.0
{fender}
"""
FENDER = "fender = { stiffness = 4e6, damping = 1e5, thickness = 1.5 }"
SHIPS = {
    "vlcc": ShipParameters("kvlcc2", 3),
    "container": ShipParameters("kcs", 6, "free"),
    "log": ShipParameters("floating_log", 6, feedback="none"),
    "buoy": ShipParameters("buoy", 4, "straight", FenderParameters(1e5, 0.0, 0.2)),
    "hollow": ShipParameters("mesh_example", 4, feedback="prescribed"),
}
NAMES = tuple(SHIPS)


prepare = cache(prepare_ship)


def open_bodies(folder: Path, ships: dict[str, ShipParameters], obstacles: str) -> str:
    """Prepare the bodies in native code; why they are refused, or nothing."""
    places, numbers = [], []
    for name, ship in ships.items():
        places.append(folder / f"{name}.ship")
        places[-1].write_bytes(prepare(ship.ship))
        fender = ship.fender
        feedback = SHIP_FEEDBACKS.index("ledger" if ship.feedback == "common" else ship.feedback)
        numbers.append([
            ship.degrees_of_freedom, COASTING.index(ship.coasting), feedback, fender.stiffness, fender.damping,
            fender.thickness,
        ])  # fmt: skip
    rows, message = np.array(numbers), ctypes.create_string_buffer(4096)
    words = ctypes.c_char_p * len(ships)
    load_kernels().shipcollision_open_bodies(
        words(*(name.encode() for name in ships)), words(*(str(place).encode() for place in places)), len(ships),
        ctypes.c_void_p(rows.ctypes.data), obstacles.encode(), message,
    )  # fmt: skip
    return message.value.decode()


def prepare_both(folder: Path, obstacles: str) -> list[Body]:
    """The bodies in both languages."""
    place = folder / "harbour.obstacles"
    place.write_bytes(prepare_obstacles(obstacles))
    assert open_bodies(folder, SHIPS, str(place)) == ""
    return prepare_bodies(NAMES, CollisionParameters(list(SHIPS.values()), obstacles=obstacles))


def describe(body: Body, row: Array) -> list[float]:
    """What the kernel `body` gives, by the Python model."""
    attitude, velocity, rate = row[1:].reshape(3, 3).tolist()
    inverse = body.inverse_at(attitude)
    state = BodyState.at(np.zeros(3), attitude, np.array(velocity + rate), inverse)
    wall = [0.0] * 12 if body.wall is None else [*body.wall.x, *body.wall.R.ravel()]
    found = [
        *inverse.ravel(), *(np.zeros(9) if body.held is None else body.held.ravel()), *body.bullet.r_bg, body.reach,
        body.free, body.fender_thickness, body.fender.stiffness if body.fender else 0.0, body.largest_speed(state),
        *body.rectangle, *wall,
    ]  # fmt: skip
    if body.coasting is None:
        return [*found, 0.0, *[0.0] * 12]
    after = body.coasting.coast([0.0] * 3, attitude, velocity, rate, 0.1)
    return [*found, 1.0, *(x for part in after for x in part)]


def test_bodies(tmp_path: Path) -> None:
    bodies = prepare_both(tmp_path, OBSTACLES.format(fender=FENDER))
    random = np.random.default_rng(1)
    motions = random.normal(0.0, 1.0, (40, 9)) * [0.2, 0.1, pi, 5.0, 1.0, 0.1, 0.02, 0.01, 0.02]
    for i, body in enumerate(bodies):
        rows = np.hstack([np.full((40, 1), i), motions])
        expected = [describe(body, row) for row in rows]
        assert_close(evaluate("bodies", "body", rows, len(expected[0])), expected, 1e-11)


def draw_motions(random: np.random.Generator) -> list[list[float]]:
    """Position, attitude, velocity and rate of each ship: near each other, alongside, far apart, not received."""
    spread = random.choice([60.0, 150.0, 600.0])
    motions = []
    for _ in NAMES:
        heading = random.choice([0.0, pi / 2, random.uniform(-pi, pi)])
        position = [*random.normal(0.0, spread, 2), random.normal(0.0, 0.2)]
        speed = random.choice([0.0, 1.0, 8.0])
        velocity = random.normal(0.0, 1.0, 3) * [speed, 0.2 * speed, 0.0]
        rate = random.normal(0.0, 0.02, 3) * random.choice([0.0, 1.0])
        motions.append([*position, 0.0, 0.0, heading, *velocity, *rate])
        if random.random() < 0.1:
            motions[-1] = [0.0] * 12
    return motions


def ask_python(row: list[float], bodies: Sequence[Body], detector: Detector) -> list[float]:
    """What the kernel `schedule` gives, by the Python model."""
    count, (H, substep) = len(NAMES), row[:2]
    motions = np.array(row[2 + 2 * count :]).reshape(count, 4, 3)
    received = [ShipState(*motion.tolist()) for motion in motions]
    states = [
        BodyState.at(m[0], m[1].tolist(), m[2:].ravel(), body.inverse_at(m[1].tolist()), body.bullet.r_bg)
        for body, m in zip(bodies, motions, strict=False)
    ]
    active = [state if has else None for state, has in zip(states, row[2:], strict=False)]
    for body in bodies[count:]:
        assert body.wall is not None
        states.append(body.wall)
    proximity = Proximity(bodies, count, detector, 150.0)
    absent = frozenset(i for i in range(count) if row[2 + count + i])
    candidates = proximity.find_candidates(active, received, H, absent)
    answer = [len(candidates), *(100 * a + b for a, b in candidates)]
    near = proximity.find_near(candidates, states, H)
    answer += [len(near), *(x for (a, b), pair in near.items() for x in (100 * a + b, *pair))]
    least, (a, b) = proximity.measure_clearance(candidates, states)
    answer += [least, 100 * a + b]
    if not near:
        return answer
    caches, fenders = ContactCaches(), select_fenders(bodies, list(near))
    schedule = ConservativeAdvancement(H, substep, bodies, states, detector, caches, near, fenders)
    answer += [schedule.count, schedule.h]
    for i in range(schedule.count):
        if pairs := schedule.pairs_due(i):
            for moment, due in schedule.advance(i, pairs):
                numbers = [meet(pair, states, detector, caches, i % 3 == 0) for pair in due]
                schedule.touched |= any(met for met, _ in numbers)
                answer += [moment, reduce(lambda sum, number: 3.0 * sum + number[1], numbers, 0.0)]
    schedule.finish()
    answer.append(schedule.touches_left)
    answer += [x for state in states for x in (*state.x, *state.R.ravel())]
    return [*answer, len(caches.last_normals)]


def meet(
    pair: Pair, states: list[BodyState], detector: Detector, caches: ContactCaches, turn: bool
) -> tuple[bool, float]:
    """Whether twists were changed, by what stands for a response; and a number that tells pair and touch."""
    number = float(10 * pair[0] + pair[1])
    if not detector.contacts(*pair, states, caches.last_normals):
        return False, number
    for body in pair if turn else ():
        if not states[body].fixed:
            states[body].set_twist(-states[body].nu)
    return turn, number + 1e4


@pytest.mark.parametrize(
    ("count", "fender"),
    [(8, ""), pytest.param(100, "", marks=pytest.mark.slow), pytest.param(100, FENDER, marks=pytest.mark.slow)],
)
def test_proximity_and_the_schedule_of_a_step(count: int, fender: str, tmp_path: Path) -> None:
    """Candidates, near pairs, clearance, every stop of a step with the pairs examined there, and the poses after it."""
    bodies = prepare_both(tmp_path, OBSTACLES.format(fender=fender))
    random, detector = np.random.default_rng(count), Detector([body.hull for body in bodies])
    rows = []
    for _ in range(count):
        flags = [*random.choice([0.0, 1.0], len(NAMES)), *random.choice([0.0, 1.0], len(NAMES), p=[0.9, 0.1])]
        H, substep = random.choice([0.05, 0.1, 0.5, 0.07]), random.choice([0.01, 0.05])
        rows.append([H, substep, *flags, *(x for motion in draw_motions(random) for x in motion)])
    expected = [ask_python(row, bodies, detector) for row in rows]
    width = max(map(len, expected)) + 10
    found = evaluate("bodies", "schedule", rows, width)
    differ = []
    for own, twin in zip(found, expected, strict=True):
        size = len(twin)
        if not (np.isnan(own[size:]).all() and np.allclose(own[:size], twin, rtol=1e-9, atol=1e-8)):
            differ.append(np.flatnonzero(~np.isclose(own[:size], twin, rtol=1e-9, atol=1e-8))[:5])
    assert not differ
    assert len({len(twin) for twin in expected}) > 4


def test_refusals_of_bodies_and_obstacles(tmp_path: Path) -> None:
    """In one line, with the remedy; after it, the bodies can be prepared."""
    one = {"vlcc": SHIPS["vlcc"]}
    place, content = tmp_path / "a.obstacles", prepare_obstacles(OBSTACLES.format(fender=""))
    begin = f"obstacles: {place} is"
    assert open_bodies(tmp_path, one, "[pier]\nkind = 1") == (
        "obstacles: a native FMU reads no TOML; write prepared obstacles with `shipcollision prepare OBSTACLES.toml` "
        "and give the path of that file, which ends in .obstacles"
    )
    assert open_bodies(tmp_path, one, str(place)) == (
        f"obstacles: file {place} does not exist or cannot be read: give the path of prepared obstacles"
    )
    for wrong, why in (
        (b"x", f"{begin} no file of prepared obstacles: write one with `shipcollision prepare OBSTACLES.toml`"),
        (
            content.replace(b"obstacles 1", b"obstacles 9"),
            f"{begin} a file of prepared obstacles of version 9, this FMU reads version 1: prepare the obstacles with "
            "the shipcollision that built the FMU, or build the FMU again",
        ),
        (seal([*content.decode().splitlines()[:9], "x"]), f"{begin} damaged: line 10 must be the key 'place'"),
        (
            prepare_obstacles(OBSTACLES.format(fender="").replace("[pier]", "[vlcc]")),
            "obstacles: 'vlcc' is the name of a ship: give the obstacle another name",
        ),
    ):
        place.write_bytes(wrong)
        assert open_bodies(tmp_path, one, str(place)).startswith(why)
    place.write_bytes(content)
    assert open_bodies(tmp_path, one, f"  {place}") != ""
    assert open_bodies(tmp_path, one, str(place)) == open_bodies(tmp_path, one, " ") == ""
    no_fender = {"vlcc": replace(SHIPS["vlcc"], fender=FenderParameters(1e6, -1.0, 1.0))}
    assert open_bodies(tmp_path, no_fender, "") == (
        "vlcc.fender: stiffness = 1000000.0 N/m, damping = -1.0 N s/m, thickness = 1.0 m is no fender: stiffness and "
        "thickness must be positive, damping not negative; all 0 for none"
    )


def test_damaged_obstacles_are_refused(tmp_path: Path) -> None:
    """With a checksum that is right, obstacles may come out; what is read never leaves its place."""
    random, place, refused = Random(1), tmp_path / "a.obstacles", 0
    content = prepare_obstacles(OBSTACLES.format(fender=FENDER))[: -len("crc32 01234567\n")]
    for _ in range(100):
        damaged = bytearray(content)
        for _ in range(random.randrange(1, 4)):
            begin = random.randrange(len(damaged))
            damaged[begin : begin + random.choice([0, 1, 1, 30])] = random.randbytes(random.choice([0, 1, 1, 5]))
        place.write_bytes(bytes(damaged) + f"crc32 {crc32(damaged):08x}\n".encode())
        said = open_bodies(tmp_path, {"vlcc": SHIPS["vlcc"]}, str(place))
        assert said == "" or said.startswith(f"obstacles: {place} is ")
        refused += said != ""
    assert refused > 50
