"""What a step of the native collision model costs, beside the Python model and beside PyBullet's own step.

    python benchmarks/native_collision.py

crossing   the steps of kvlcc2_crossing, five substeps each: recorded with the Python model, then made by the native one
           in the same states
far        the same with the ships 5 km apart                        goal: at most 3 us
near       nothing touches, and the clearance is measured            goal: at most 10 us
contact    impulses are found                                        goal: at most 60 us
pressed    the same two hulls pushed together, at contact throughout
PyBullet   five steps of its own (stepSimulation) of the same two hulls in the recorded states
                                                                     goal: at most 1.5 times its time
harbour    2 to 500 ships in near pairs; the exponent of the cost    goal: at most 1.2

The native steps are timed in C++, one by one: the clock costs 0.03 us, the interpreter nothing. Each figure is the
median over the steps of a kind; each step counts with the least of ROUNDS. doStep of the native FMU, Python's and
PyBullet's steps are timed from Python, each with the least of ITS_ROUNDS; a call by ctypes alone costs 0.3 to 0.6 us.
It needs PyBullet.
"""

from __future__ import annotations

import ctypes
import random
import sys
import tempfile
from collections.abc import Sequence
from math import cos, log, pi, sin
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave, defaultCallbacks

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from shipcollision_fmu import load_scenario, simulate  # noqa: E402  # after the path is set
from shipcollision_fmu.cli.console import print_table, say  # noqa: E402  # after the path is set
from shipcollision_fmu.cli.table import make_table  # noqa: E402  # after the path is set
from shipcollision_fmu.collision.geometry.bullet import bullet_module  # noqa: E402  # after the path is set
from shipcollision_fmu.collision.model import ShipCollision  # noqa: E402  # after the path is set
from shipcollision_fmu.fmi.builder.native_fmus import build_native_fmus  # noqa: E402  # after the path is set
from shipcollision_fmu.fmi.names import APPLIED, IMPULSE, STATE, named  # noqa: E402  # after the path is set
from shipcollision_fmu.ship.frames import SWAP, Array, pose_w, rotation  # noqa: E402  # after the path is set
from shipcollision_fmu.ship.hull.hull import build_hull  # noqa: E402  # after the path is set
from shipcollision_fmu.ship.loading.library import load_ship  # noqa: E402  # after the path is set
from shipcollision_fmu.toolchain.libraries import build_library, native_cache  # noqa: E402  # after the path is set
from shipcollision_fmu.toolchain.load import EXPORTS  # noqa: E402  # after the path is set
from shipcollision_fmu.toolchain.platforms import PLATFORMS, find_own_target  # noqa: E402  # after the path is set
from shipcollision_fmu.toolchain.sources import Part, find_native, list_library_parts  # noqa: E402  # after the path
from tests.native.native_collision import NativeCollision  # noqa: E402  # after the path is set

ROUNDS, ITS_ROUNDS = 12, 3
NAMES = ("own", "target")
SCENARIO, SHIP, H, SUBSTEPS = "kvlcc2_crossing", "kvlcc2", 0.05, 5
PARTS = ("position", "attitude", "velocity", "rate")
NEAR = 1.0
"""Clearance [m] below which ships are said to be close: hulls that slide along each other do not always touch."""
COUNTS = (2, 10, 50, 200, 500)
SPACING = 600.0


def open_library() -> ctypes.CDLL:
    """The native library with the timer of native_collision.cpp."""
    target, cache = find_own_target(), native_cache()
    assert target is not None
    timer = Part(Path(__file__).parent, ("native_collision.cpp",), includes=(find_native(),))
    parts = [*list_library_parts(cache), timer]
    return ctypes.CDLL(str(build_library("benchmark", parts, target, EXPORTS, cache=cache, prefer_system=True)))


def time_steps(
    library: ctypes.CDLL, states: Array, steps: int = 0, push: Sequence[float] = (0.0, 0.0), rounds: int = ROUNDS
) -> tuple[Array, np.ndarray[Any, np.dtype[np.intc]]]:
    """Microseconds and contacts of each step. states (n, ships, 12): of all steps, or of the first of `steps`."""
    count = states.shape[1]
    model = NativeCollision(library, [f"s{i}" for i in range(count)])
    for ship in model.parameters.ships:
        ship.ship = SHIP
    model._fill_parameters()
    steps = steps or len(states)
    took, contacts = np.zeros(steps), np.zeros(steps, dtype=np.intc)
    states = np.ascontiguousarray(states, dtype=float)
    library.shipcollision_time_steps.restype = ctypes.c_bool
    done = library.shipcollision_time_steps(
        model._at, steps, ctypes.c_double(H), pointer_to(states), ctypes.c_bool(len(states) == steps),
        (ctypes.c_double * 2)(*push), rounds, pointer_to(took), pointer_to(contacts),
    )  # fmt: skip
    assert done
    return took, contacts


def pointer_to(array: np.ndarray[Any, Any]) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)


def record_crossing() -> tuple[Array, Array, Array]:
    """Of each step of the scenario: the states (2, 12), Python's microseconds and the clearance."""
    states: list[list[list[float]]] = []
    clearance: list[float] = []
    step = ShipCollision.step
    took: list[float] = []

    def record(model: ShipCollision, t: float, h: float) -> None:
        states.append([[x for part in PARTS for x in getattr(ship, part)] for ship in model.inputs.ships])
        begin = perf_counter()
        step(model, t, h)
        took.append(1e6 * (perf_counter() - begin))
        clearance.append(model.outputs.clearance)

    ShipCollision.step = record  # type: ignore[assignment,method-assign]  # to see what it is given
    rounds = []
    try:
        for _ in range(ITS_ROUNDS):
            for of_round in (states, clearance, took):
                of_round.clear()
            simulate(load_scenario(SCENARIO), in_process=True)
            rounds.append(list(took))
    finally:
        ShipCollision.step = step  # type: ignore[method-assign]  # as it was
    return np.array(states), np.min(rounds, axis=0), np.array(clearance)


def time_fmu(states: Array) -> Array:
    """Microseconds of doStep of the native FMU in each of the states (n, 2, 12)."""
    platform = next(one.name for one in PLATFORMS.values() if find_own_target() in one.targets)
    with tempfile.TemporaryDirectory() as home:
        unpacked = extract(str(build_native_fmus(home, platforms=[platform])["ShipCollision"]), str(Path(home, "fmu")))
        description = read_model_description(unpacked)
        references = {variable.name: variable.valueReference for variable in description.modelVariables}
        fmu = FMU2Slave(
            guid=description.guid, unzipDirectory=unpacked, modelIdentifier="ShipCollision", instanceName="collision"
        )
        fmu.instantiate(callbacks=defaultCallbacks)
        fmu.setString([references[f"{name}.ship"] for name in NAMES], [SHIP] * len(NAMES))
        inputs = [references[one] for name in NAMES for one in (*named(name, STATE), *named(name, APPLIED))]
        outputs = [references[one] for name in NAMES for one in named(name, IMPULSE)]
        fmu.setupExperiment()
        fmu.enterInitializationMode()
        fmu.setReal(inputs, [x for state in states[0] for x in (*state, *[0.0] * 6)])
        fmu.exitInitializationMode()
        component, fresh = ctypes.c_void_p(fmu.component), fmu.getFMUState()
        rounds = []
        for _ in range(ITS_ROUNDS):
            fmu.setFMUState(fresh)
            took, issued = [], [0.0] * 12
            for k, (one, other) in enumerate(states.tolist()):
                fmu.setReal(inputs, [*one, *issued[:6], *other, *issued[6:]])
                t, h = ctypes.c_double(k * H), ctypes.c_double(H)
                begin = perf_counter()
                fmu.dll.fmi2DoStep(component, t, h, 1)
                took.append(1e6 * (perf_counter() - begin))
                issued = fmu.getReal(outputs)
            rounds.append(took)
        fmu.freeFMUState(fresh)
        fmu.freeInstance()
    least: Array = np.min(rounds, axis=0)
    return least


def time_bullet(states: Array) -> float:
    """Microseconds of five steps of PyBullet's own, in the median over the states (n, 2, 12)."""
    p: Any = bullet_module()
    ship, client = load_ship(SHIP), p.connect(p.DIRECT)
    p.setPhysicsEngineParameter(fixedTimeStep=H / SUBSTEPS, physicsClientId=client)
    hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
    vertices, bodies = (np.vstack(hull.parts) @ SWAP).tolist(), []
    for _ in range(2):
        shape = p.createCollisionShape(p.GEOM_MESH, vertices=vertices, physicsClientId=client)
        bodies.append(p.createMultiBody(ship.mass, shape, useMaximalCoordinates=1, physicsClientId=client))
        p.changeDynamics(bodies[-1], -1, linearDamping=0.0, angularDamping=0.0, physicsClientId=client)
    rounds = []
    for _ in range(ITS_ROUNDS):
        took = []
        for pair in states:
            for body, state in zip(bodies, pair, strict=True):
                R = rotation(state[3:6])
                place, turned = pose_w(state[:3], R)
                p.resetBasePositionAndOrientation(body, place, turned, physicsClientId=client)
                twist = (R @ state[6:9]) @ SWAP, -(R @ state[9:12]) @ SWAP  # SWAP mirrors: a rate changes its sign
                p.resetBaseVelocity(body, *(vector.tolist() for vector in twist), physicsClientId=client)
            begin = perf_counter()
            for _ in range(SUBSTEPS):
                p.stepSimulation(physicsClientId=client)
            took.append(1e6 * (perf_counter() - begin))
        rounds.append(took)
    p.disconnect(client)
    return float(np.median(np.min(rounds, axis=0)))


def make_harbour(count: int) -> Array:
    """States (1, count, 12) of ships in pairs, 30 to 50 m from side to side, on courses of their own at 3 m/s."""
    draw = random.Random(count)
    side, states = max(1, round((0.5 * count) ** 0.5)), np.zeros((1, count, 12))
    for i, state in enumerate(states[0]):
        place = i // 2
        if i % 2:
            state[:] = states[0, i - 1]
            apart = draw.uniform(88.0, 108.0)
            state[:2] += -apart * sin(state[5]), apart * cos(state[5])
        else:
            state[:2], state[5], state[6] = (
                [SPACING * (place // side), SPACING * (place % side)],
                draw.uniform(-pi, pi),
                3,
            )
    return states


def beside(east: float, *twist: float) -> Array:
    """States (1, 2, 12) of the first ship with surge, sway and rate of turn, the other at rest beside it."""
    states = np.zeros((1, 2, 12))
    states[0, 1, 1] = east
    states[0, 0, [6, 7, 11]] = twist
    return states


def main() -> None:
    """Measure, and print two tables."""
    library = open_library()
    states, python, clearance = record_crossing()
    native, found = time_steps(library, states)
    apart, close = found == 0, clearance < NEAR
    shown = make_table(
        "case", ">steps", ">native [us]", ">doStep [us]", ">Python [us]", ">ratio", ">PyBullet [us]", ">ratio",
        ">goal [us]", title=f"a step of {SUBSTEPS} substeps, medians",
    )  # fmt: skip
    far = states.copy()
    far[:, 1, 0] += 5000.0
    alone, whole = np.median(time_steps(library, far)[0]), np.median(time_fmu(far))
    shown.add_row("far", str(len(far)), f"{alone:.2f}", f"{whole:.2f}", "", "", "", "", "3")
    do_step = time_fmu(states)
    for case, chosen, goal in (
        (f"near, {NEAR:g} m apart or more", apart & ~close, "10"),
        ("near, hulls slide along each other", apart & close, "10"),
        ("contact", ~apart, "60"),
    ):
        ours, theirs, its = np.median(native[chosen]), np.median(python[chosen]), time_bullet(states[chosen][::5])
        shown.add_row(
            case, str(chosen.sum()), f"{ours:.2f}", f"{np.median(do_step[chosen]):.2f}", f"{theirs:.0f}",
            f"{theirs / ours:.0f}", f"{its:.1f}", f"{ours / its:.2f}", goal,
        )  # fmt: skip
    width = load_ship(SHIP).B
    for case, start, push in (
        ("pressed side to side, sliding", beside(width + 1e-3, 2.0, 0.05, 0.001), (0.0, 2e-3)),
        ("pressed side to side, at rest", beside(width + 1e-3, 0.0, 0.05, 0.0), (0.0, 2e-3)),
    ):
        took, count = time_steps(library, start, 150, push)
        chosen = count == np.bincount(count).argmax()
        start[0, 1, 1] = width - 1e-3
        ours, its = np.median(took[chosen]), time_bullet(np.repeat(start, 50, axis=0))
        name = f"{case}: {count[chosen][0]} contacts"
        shown.add_row(name, str(chosen.sum()), f"{ours:.1f}", "", "", "", f"{its:.1f}", f"{ours / its:.2f}", "")
    print_table(shown)
    costs = [float(np.median(time_steps(library, make_harbour(n), 20, rounds=4)[0])) for n in COUNTS]
    shown = make_table(">ships", ">step [us]", ">per ship [us]", title="harbour")
    for n, cost in zip(COUNTS, costs, strict=True):
        shown.add_row(str(n), f"{cost:.1f}", f"{cost / n:.2f}")
    print_table(shown)
    slope = np.polyfit([log(n) for n in COUNTS], [log(cost) for cost in costs], 1)[0]
    say(f"cost of a step ~ number^{slope:.2f} (goal: at most 1.2)")


main()
