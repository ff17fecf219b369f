"""What a step of the collision model costs, as ratios taken side by side in one process.

    python benchmarks/collision_step.py

    far        a whole communication step of ShipCollision.fmu (set, doStep, get) with two ships apart, against the same
               of an FMU with the same variables and an empty step                                    goal: at most 1.2
    near       per internal substep, hulls within reach but apart, against PyBullet's own detection and dynamics of the
               same two hulls (stepSimulation)                                                        goal: at most 3
    contact    the same with hulls that are pressed together and slide: a new impact in every substep goal: at most 10

Each figure is the least of ROUNDS; raw PyBullet is given the same convex hulls, masses and speeds.
"""

from __future__ import annotations

import tempfile
from contextlib import ExitStack, closing
from dataclasses import replace
from pathlib import Path
from time import perf_counter

import numpy as np

from shipcollision_fmu.cli.console import print_table
from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.collision.geometry.bullet import bullet_module
from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.cosim.fmi2_component import Fmi2Component
from shipcollision_fmu.cosim.fmu_instance import UnpackedFmu
from shipcollision_fmu.fmi.builder.package import fmu_bytes, slave_directory
from shipcollision_fmu.fmi.names import APPLIED, IMPULSE, STATE, named
from shipcollision_fmu.fmi.ship_collision import INTERFACE
from shipcollision_fmu.ship.frames import SWAP
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.loading.library import load_ship

ROUNDS, STEPS, H = 5, 300, 0.05
SHIP, NAMES = "kvlcc2", ("own", "target")

EMPTY_SLAVE = """
from dataclasses import replace

from shipcollision_fmu.fmi.ship_collision import INTERFACE
from shipcollision_fmu.fmi.slave import ModelSlave


def empty(ships):
    model = INTERFACE.model(ships)
    model.step = lambda t, h: None
    return model


class EmptyShipCollision(ModelSlave):
    interface = replace(INTERFACE, name="EmptyShipCollision", model=empty)
"""


def fmu_step(path: Path, stack: ExitStack) -> list[float]:
    """Seconds per step with two ships far apart, of every round."""
    collision = stack.enter_context(
        closing(Fmi2Component("collision", stack.enter_context(closing(UnpackedFmu(path)))))
    )
    inputs = [collision.reals([*named(s, STATE), *named(s, APPLIED)]) for s in NAMES]
    outputs = [collision.reals(named(s, IMPULSE)) for s in NAMES]
    counts = collision.integers(["contact.count", "impact.count"])
    inputs[1].values[0] = 5000.0
    inputs[0].values[6] = 3.0
    collision.initialise({f"{s}.ship": SHIP for s in NAMES}, 1e6, inputs)
    rounds = []
    for _ in range(ROUNDS):
        begin = perf_counter()
        for k in range(STEPS):
            for group in inputs:
                group.write()
            collision.step(k * H, H)
            for group in (*outputs, counts):
                group.read()
        rounds.append((perf_counter() - begin) / STEPS)
    return rounds


def far() -> tuple[float, float]:
    """Least seconds per step of our FMU and of the empty one."""
    with tempfile.TemporaryDirectory() as folder, ExitStack() as stack:
        ours, empty = Path(folder) / "ShipCollision.fmu", Path(folder) / "EmptyShipCollision.fmu"
        ours.write_bytes(fmu_bytes(INTERFACE, (slave_directory() / "ShipCollision.py").read_bytes(), NAMES))
        empty.write_bytes(fmu_bytes(replace(INTERFACE, name="EmptyShipCollision"), EMPTY_SLAVE.encode(), NAMES))
        return min(fmu_step(ours, stack)), min(fmu_step(empty, stack))


def near_substep(gap: float) -> float:
    """Least seconds per internal substep of our model, ten to a step: side by side with `gap` [m]."""
    model = ShipCollision(NAMES)
    ship = load_ship(SHIP)
    for slot in model.parameters.ships:
        slot.ship = SHIP
    model.inputs.ships[1].position[1] = ship.B + gap
    model.inputs.ships[0].velocity[:] = [2.0, 0.0, 0.0]
    model.initialise()
    substeps, best = 10, float("inf")
    step = substeps * model.parameters.substep
    for _ in range(ROUNDS):
        begin = perf_counter()
        for k in range(STEPS // substeps):
            model.step(k * step, step)
        best = min(best, (perf_counter() - begin) / STEPS)
    model.close()
    return best


def contact_substep() -> float:
    """As above in contact, one substep a step, so that every substep solves an impact."""
    model = ShipCollision(NAMES)
    ship = load_ship(SHIP)
    for slot in model.parameters.ships:
        slot.ship = SHIP
    model.inputs.ships[1].position[1] = ship.B - 1e-4
    model.inputs.ships[0].velocity[:] = [2.0, 0.05, 0.0]
    model.inputs.ships[0].rate[2] = 0.001
    model.initialise()
    fresh, h, best = model.get_state(), model.parameters.substep, float("inf")
    for _ in range(ROUNDS):
        begin = perf_counter()
        for k in range(STEPS):
            model.step(k * h, h)
            model.set_state(fresh)
        best = min(best, (perf_counter() - begin) / STEPS)
    assert model.outputs.contact_active
    model.close()
    return best


def bullet_step(gap: float) -> float:
    """Least seconds per stepSimulation of the same two hulls."""
    p, ship, h = bullet_module(), load_ship(SHIP), 0.01
    client = p.connect(p.DIRECT)
    p.setPhysicsEngineParameter(fixedTimeStep=h, physicsClientId=client)
    hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
    vertices = (np.vstack(hull.parts) @ SWAP).tolist()
    bodies = []
    for _ in NAMES:
        shape = p.createCollisionShape(p.GEOM_MESH, vertices=vertices, physicsClientId=client)
        bodies.append(p.createMultiBody(ship.mass, shape, useMaximalCoordinates=1, physicsClientId=client))
        p.changeDynamics(bodies[-1], -1, linearDamping=0.0, angularDamping=0.0, physicsClientId=client)
    best = float("inf")
    for _ in range(ROUNDS):
        spent = 0.0
        for _ in range(STEPS):
            p.resetBasePositionAndOrientation(bodies[0], (0, 0, 0), (0, 0, 0, 1), physicsClientId=client)
            p.resetBasePositionAndOrientation(bodies[1], (ship.B + gap, 0, 0), (0, 0, 0, 1), physicsClientId=client)
            p.resetBaseVelocity(bodies[0], (0.05, 2.0, 0), (0, 0, -0.001), physicsClientId=client)
            p.resetBaseVelocity(bodies[1], (0, 0, 0), (0, 0, 0), physicsClientId=client)
            begin = perf_counter()
            p.stepSimulation(physicsClientId=client)
            spent += perf_counter() - begin
        best = min(best, spent / STEPS)
    p.disconnect(client)
    return best


def main() -> None:
    """Measure, and print the ratios."""
    shown = make_table("case", ">ours [us]", ">beside [us]", ">ratio", ">goal", title="collision step")
    near, contact = near_substep(0.5), contact_substep()
    beside_near, beside_contact = bullet_step(0.5), bullet_step(-0.001)
    fmu, empty = far()
    for case, ours, beside, goal in (
        ("far, per FMU step", fmu, empty, 1.2),
        ("near, per substep", near, beside_near, 3.0),
        ("contact, per substep", contact, beside_contact, 10.0),
    ):
        shown.add_row(case, f"{1e6 * ours:.1f}", f"{1e6 * beside:.1f}", f"{ours / beside:.2f}", f"{goal:g}")
    print_table(shown)


main()
