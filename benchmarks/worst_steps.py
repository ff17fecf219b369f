"""The worst steps of the collision model: a search over random rafts of ships at quays and in locks.

    python benchmarks/worst_steps.py [--count 200] [--seconds 600] [--seed 0] [--steps 15] [--least 2] [--most 8]
                                     [--repeat 1] [--response pgs]

A case is drawn from its own seed: ships side by side in rows, apart, flush or in overlap by millimetres, pushed against
each other, a quay, a lock or a corner, with any friction and restitution. Both orders of the master are drawn. Printed
are the ten steps that took longest on the processor, with their times, the sweeps and the inputs that make them again.
With --repeat each step is made so many times from the same state, and the least time counts.

The goal is 100 ms a step of 0.1 s with up to four ships and 300 ms with eight, on two quiet cores.
"""

from __future__ import annotations

import argparse
import random
import tempfile
from dataclasses import dataclass, field
from math import inf, radians
from pathlib import Path
from time import perf_counter, thread_time

from rich.console import Console

from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring

H = 0.1
SHOWN = 10

SHIP_FILE = """
[ship]
name = "box"
kind = "barge"
source = "a case of the bench of worst steps"
[particulars]
L_pp = {L}
B = {B}
T = {T}
mass = {mass}
allow_inconsistent = "drawn at random"
[hull]
shape = "{shape}"
depth = {depth}
{taper}
"""


@dataclass
class Case:
    """One random case: what a run of a few steps starts from."""

    seed: int
    sizes: list[tuple[float, float, float, float, float, str]] = field(default_factory=list)  # L, B, T, depth, mass
    starts: list[tuple[float, float, float]] = field(default_factory=list)  # north, east [m], heading [deg]
    speeds: list[tuple[float, float, float]] = field(default_factory=list)  # surge, sway [m/s], yaw rate [rad/s]
    forces: list[tuple[float, float, float]] = field(default_factory=list)  # surge, sway [N], yaw moment [N m]
    obstacles: str = ""
    friction: float = 0.0
    restitution: float = 0.0
    degrees_of_freedom: int = 6
    parallel: bool = False
    coasting: str = "straight"

    def describe(self) -> str:
        """The inputs in one line."""
        walls = self.obstacles.count("shape")
        berth = f", {walls} walls" if walls else ""
        return (
            f"seed {self.seed}: {len(self.sizes)} ships, {self.degrees_of_freedom} DOF{berth}, mu {self.friction:g}, "
            f"e {self.restitution:g}, {'parallel' if self.parallel else 'sequential'}"
        )


def draw_case(seed: int, least: int, most: int) -> Case:
    """The case of a seed."""
    rng = random.Random(seed)
    case = Case(seed)
    count = rng.randint(least, most)
    alike = rng.random() < 0.5
    rows = rng.choice((1, 1, 2))
    flush = rng.random() < 0.7
    east, north, widest, base = 0.0, 0.0, 0.0, _draw_size(rng)
    for i in range(count):
        size = base if alike else _draw_size(rng)
        L, B = size[:2]
        if i and i % max(1, count // rows) == 0:
            north, east = north + 1.1 * base[0], 0.0
        gap = rng.choice((0.0, 0.0, 1e-6, 1e-3, -1e-3, 0.02)) if flush else rng.uniform(0.0, 0.3)
        east += (0.5 * B + gap) if east or case.starts else 0.0
        heading = 0.0 if flush else rng.uniform(-1.0, 1.0)
        case.sizes.append(size)
        case.starts.append((north + rng.uniform(-0.2, 0.2) * L, east, heading))
        east += 0.5 * B
        widest = max(widest, east)
        sway = rng.choice((0.0, 0.0, 0.05, 0.5, rng.uniform(-2.0, 2.0)))
        case.speeds.append((rng.choice((0.0, 0.0, rng.uniform(-1, 1))), sway, rng.choice((0.0, 0.0, 1e-3))))
        push = 10.0 ** rng.uniform(3.0, 6.5) * rng.choice((1.0, 1.0, 1.0, -1.0, 0.0))
        case.forces.append(
            (0.1 * push * rng.uniform(-1, 1), push, push * L * rng.choice((0.0, rng.uniform(-0.3, 0.3))))
        )
    case.obstacles = _draw_walls(rng, widest, -0.5 * case.sizes[0][1], flush)
    case.friction = rng.choice((0.0, 0.05, 0.3, 0.3, 0.6, 1.0, 3.0))
    case.restitution = rng.choice((0.0, 0.05, 0.1, 0.1, 0.3, 0.5, 0.9, 1.0))
    case.degrees_of_freedom = rng.choice((3, 4, 6, 6))
    case.parallel = rng.random() < 0.3
    return case


def reported_case() -> Case:
    """Two boxes pressed against each other and a quay: a step of these once took 51 s."""
    size = (82.5, 18.8, 7.6, 12.0, 4e6, "box")
    return Case(
        -1, [size] * 2, [(0.0, 0.0, 0.0), (3.0, 18.8, 0.0)], [(0.0, 0.0, 0.0)] * 2, [(0.0, 1e5, 0.0)] * 2,
        _wall("quay", 600.0, 20.0, 0.0, 38.2), 0.3, 0.1,
    )  # fmt: skip


def _draw_size(rng: random.Random) -> tuple[float, float, float, float, float, str]:
    L = 10.0 ** rng.uniform(1.1, 2.5)
    B, shape = L * rng.uniform(0.12, 0.3), rng.choice(("box", "box", "parametric"))
    T = B * rng.uniform(0.25, 0.45)
    return L, B, T, T * rng.uniform(1.3, 2.0), 1025.0 * L * B * T * rng.uniform(0.5, 0.9), shape


def _wall(name: str, length: float, breadth: float, north: float, east: float) -> str:
    return (
        f'[{name}]\nkind = "quay"\nshape = "box"\nlength = {length}\nbreadth = {breadth}\n'
        f"position = [{north}, {east}]\n"
    )


def _draw_walls(rng: random.Random, right: float, left: float, flush: bool) -> str:
    """A quay to starboard, a lock's two walls, a corner, or nothing; right, left: outer sides of the raft [m]."""
    kind = rng.choice(("quay", "quay", "lock", "corner", "none"))
    gap = 0.0 if flush else rng.uniform(0.0, 0.5)
    walls = _wall("quay", 4000.0, 20.0, 0.0, right + 10.0 + gap) if kind != "none" else ""
    if kind == "lock":
        walls += _wall("side", 4000.0, 20.0, 0.0, left - 10.0 - rng.choice((0.0, 1e-3, gap)))
    if kind == "corner":
        walls += _wall("head", 20.0, 4000.0, 700.0, 0.0)
    return walls


def run_case(
    case: Case, folder: Path, steps: int, repeat: int = 1, response: str = "pgs"
) -> list[tuple[float, float, int, int]]:
    """(seconds on the processor, by the clock, sweeps, substeps not converged) of every step."""
    names = [f"s{i}" for i in range(len(case.sizes))]
    model = ShipCollision(names)
    ships = [ShipManoeuvring() for _ in names]
    p = model.parameters
    p.obstacles, p.friction, p.restitution, p.response = case.obstacles, case.friction, case.restitution, response
    for i, (L, B, T, depth, mass, shape) in enumerate(case.sizes):
        path = folder / f"{case.seed}_{i}.toml"
        taper = f"bow_length = {0.2 * L}\nstern_length = {0.2 * L}" if shape == "parametric" else ""
        path.write_text(SHIP_FILE.format(L=L, B=B, T=T, depth=depth, mass=mass, shape=shape, taper=taper))
        ship, (north, east, heading), (surge, sway, yaw) = ships[i], case.starts[i], case.speeds[i]
        p.ships[i].ship = ship.parameters.ship = str(path)
        p.ships[i].coasting = ship.parameters.coasting = case.coasting
        p.ships[i].degrees_of_freedom = ship.parameters.degrees_of_freedom = case.degrees_of_freedom
        ship.parameters.initial_position[:2] = [north, east]
        ship.parameters.initial_attitude[2] = radians(heading)
        ship.parameters.initial_velocity[:2], ship.parameters.initial_rate[2] = [surge, sway], yaw
        ship.initialise()
        ship.inputs.force[0], ship.inputs.force[1], ship.inputs.force[5] = case.forces[i]
    _send(model, ships)
    model.initialise()
    taken = []
    for k in range(steps):
        before, late = model.outputs.solver.unconverged, [list(out.impulse) for out in model.outputs.ships]
        _send(model, ships)
        seconds = clock = inf
        start = model.get_state()
        for again in range(repeat):
            if again:
                model.set_state(start)
            begin, begin_clock = thread_time(), perf_counter()
            model.step(k * H, H)
            seconds, clock = min(seconds, thread_time() - begin), min(clock, perf_counter() - begin_clock)
        taken.append((seconds, clock, model.outputs.solver.sweeps, model.outputs.solver.unconverged - before))
        for ship, out, earlier in zip(ships, model.outputs.ships, late, strict=True):
            ship.inputs.impulse[:] = earlier if case.parallel else out.impulse
            ship.step(k * H, H)
    model.close()
    return taken


def _send(model: ShipCollision, ships: list[ShipManoeuvring]) -> None:
    for state, ship in zip(model.inputs.ships, ships, strict=True):
        out = ship.outputs
        state.position[:], state.attitude[:] = out.position, out.attitude
        state.velocity[:], state.rate[:] = out.velocity, out.rate
        state.impulse_applied[:] = out.impulse_applied


def main() -> None:
    """Search, and print the ten worst steps."""
    parser = argparse.ArgumentParser(description="the worst steps of the collision model over random cases")
    parser.add_argument("--count", type=int, default=200, help="cases at most")
    parser.add_argument("--seconds", type=float, default=600.0, help="no case is begun after so many seconds")
    parser.add_argument("--seed", type=int, default=0, help="seed of the first case; the next has the next seed")
    parser.add_argument("--steps", type=int, default=15, help="steps of 0.1 s of each case")
    parser.add_argument("--least", type=int, default=2, help="ships at least")
    parser.add_argument("--most", type=int, default=8, help="ships at most")
    parser.add_argument("--repeat", type=int, default=1, help="times that each step is made; the least time counts")
    parser.add_argument("--response", default="pgs", choices=("pgs", "closed_form"))
    options = parser.parse_args()
    console = Console(width=160)
    found: list[tuple[float, float, int, int, int, str]] = []
    refused = unconverged = steps = cases = 0
    begin = perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(options.seed - 1, options.seed + options.count - 1):
            if perf_counter() - begin > options.seconds:
                break
            case = reported_case() if seed == options.seed - 1 else draw_case(seed, options.least, options.most)
            cases += 1
            try:
                taken = run_case(case, Path(folder), options.steps, options.repeat, options.response)
            except Exception as error:
                refused += 1
                console.print(f"{case.describe()}: {type(error).__name__}: {error}")
                continue
            steps, unconverged = steps + len(taken), unconverged + sum(missed for *_, missed in taken)
            k = max(range(len(taken)), key=lambda k: taken[k][0])
            found.append((*taken[k], k, case.describe()))
    shown = make_table(
        ">processor [ms]", ">clock [ms]", ">sweeps", ">not converged", ">step", "case",
        title=f"worst steps of {H:g} s: {cases} cases, {steps} steps, {refused} refused, {unconverged} not converged",
    )  # fmt: skip
    for seconds, clock, sweeps, missed, k, text in sorted(found, reverse=True)[:SHOWN]:
        shown.add_row(f"{1e3 * seconds:.1f}", f"{1e3 * clock:.1f}", str(sweeps), str(missed), str(k), text)
    console.print(shown)


if __name__ == "__main__":
    main()
