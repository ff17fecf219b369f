"""Cost of a collision step against the number of ships spread over a harbour, and the exponent that fits it.

    python benchmarks/harbour.py [MOST]          default: 500 ships

Ships lie in pairs, 40 m apart and so close enough for the narrow phase, 600 m from pair to pair, on headings of their
own, under way at 3 m/s: the share of near pairs is the same at any number. A quay of 2 km runs along one side. All
numbers are timed in turns in one process; each figure is the least of ROUNDS. The exponent is the slope of log(cost)
over log(number); 1 is the best there can be.
"""

from __future__ import annotations

import random
import sys
from math import cos, log, pi, sin
from time import perf_counter

from shipcollision_fmu.cli.console import print_table, say
from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.collision.geometry.broad_phase import near_pairs
from shipcollision_fmu.collision.model import ShipCollision

COUNTS = (2, 5, 10, 20, 50, 100, 200, 500)
ROUNDS, SPACING, H = 5, 600.0, 0.05
QUAY = '[quay]\nkind = "quay"\nshape = "box"\nlength = 2000.0\nbreadth = 20.0\nposition = [0.0, -400.0]\n'


def harbour(n: int) -> ShipCollision:
    """n ships at their places, initialised."""
    rng = random.Random(n)
    model = ShipCollision([f"s{i}" for i in range(n)])
    model.parameters.obstacles = QUAY
    side = max(1, round((0.5 * n) ** 0.5))
    for i, (slot, state) in enumerate(zip(model.parameters.ships, model.inputs.ships, strict=True)):
        slot.ship, slot.degrees_of_freedom = "kvlcc2", 3
        place = i // 2  # each for a pair
        north, east, psi = SPACING * (place // side), SPACING * (place % side), rng.uniform(-pi, pi)
        if i % 2:  # alongside the ship before, 40 m off
            before = model.inputs.ships[i - 1]
            psi = before.attitude[2]
            north, east = before.position[0] - 98.0 * sin(psi), before.position[1] + 98.0 * cos(psi)
        state.position[:2], state.attitude[2], state.velocity[0] = [north, east], psi, 3.0
    model.initialise()
    return model


def main() -> None:
    """Measure, and print a table and the exponent."""
    most = int(sys.argv[1]) if len(sys.argv) > 1 else COUNTS[-1]
    counts = [n for n in COUNTS if n <= most]
    models = {n: harbour(n) for n in counts}
    best, broad = dict.fromkeys(counts, float("inf")), dict.fromkeys(counts, float("inf"))
    for _ in range(ROUNDS):
        for n, model in models.items():
            steps = max(2, 400 // n)
            begin = perf_counter()
            for k in range(steps):
                model.step(k * H, H)
            best[n] = min(best[n], (perf_counter() - begin) / steps)
            rectangles = [(s.position[0] - 260, s.position[0] + 260, s.position[1] - 260, s.position[1] + 260)
                          for s in model.inputs.ships]  # fmt: skip
            begin = perf_counter()
            for _ in range(steps):
                near_pairs(rectangles, n)
            broad[n] = min(broad[n], (perf_counter() - begin) / steps)
    shown = make_table(">ships", ">step [us]", ">per ship [us]", ">of which broad phase [us]", title="harbour")
    for n in counts:
        shown.add_row(str(n), f"{1e6 * best[n]:.0f}", f"{1e6 * best[n] / n:.1f}", f"{1e6 * broad[n]:.0f}")
    print_table(shown)
    x, y = [log(n) for n in counts], [log(best[n]) for n in counts]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    slope = sum((a - mx) * (b - my) for a, b in zip(x, y, strict=True)) / sum((a - mx) ** 2 for a in x)
    say(f"cost of a step ~ number^{slope:.2f} (goal: at most 1.2)")
    for model in models.values():
        model.close()


main()
