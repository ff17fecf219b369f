"""ShipManoeuvring replaced by a vessel FMU of somebody else's, which knows nothing of impulses: it takes a force.

    python examples/foreign_vessel.py

The vessel is written here, with pythonfmu: a model of its own (in the plane, resistance linear in speed) with inputs
for an external force and moment, as every vessel FMU has them. What has to fit:

    collision: feedback = "force"    own.force.*, own.moment.* is the mean over the last step; to be held over the next
    the same mass                    own.ship has the mass, the added mass and the inertia of the vessel's model
    the same axes                    b is forward, starboard, down about midship; n is north, east, down

With a force the impulse of an impact arrives one step late, spread over that step, and a push against a resting hull
is answered late again and again: take the shortest step you can.
"""

from __future__ import annotations

import json
import tempfile
from math import radians
from pathlib import Path

from fmpy import extract
from own_loop import ANGLES, IMPULSE, LINEAR, STEP, Instance, of
from pythonfmu.builder import FmuBuilder

from shipcollision_fmu import build_fmus, load_ship

STEPS = 400
SHIP = "kvlcc2"
FORCE = [*(f"force.{part}" for part in LINEAR), *(f"moment.{part}" for part in ANGLES)]
START = {"own": (-230.0, 0.0, 0.0, 5.0), "target": (0.0, 40.0, radians(90.0), 3.0)}  # north, east, heading, speed

VESSEL = '''
import json
from math import cos, sin
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real, String

PLANE = {"north": 0.0, "east": 0.0, "heading": 0.0, "u": 0.0, "v": 0.0, "r": 0.0}


class Vessel(Fmi2Slave):
    """A ship in the plane: M nu' = F - D nu. `matrix` is M of surge, sway and yaw, JSON."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.matrix, self.damping = "", 0.01
        self.X, self.Y, self.N = 0.0, 0.0, 0.0
        for name, value in PLANE.items():
            setattr(self, name, value)
            self.register_variable(Real(name, causality=Fmi2Causality.output))
            setattr(self, "start_" + name, value)
            self.register_variable(Real(
                "start_" + name, causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))
        self.register_variable(String(
            "matrix", causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))
        for name in ("X", "Y", "N"):
            self.register_variable(Real(name, causality=Fmi2Causality.input))

    def exit_initialization_mode(self):
        for name in PLANE:
            setattr(self, name, getattr(self, "start_" + name))
        self.M = json.loads(self.matrix)

    def do_step(self, t, h):
        (m, _, _), (_, a, b), (_, c, d) = self.M  # surge apart, sway and yaw coupled
        X, Y, N = self.X - self.damping * m * self.u, self.Y, self.N
        self.u += h * X / m
        self.v += h * (d * Y - b * N) / (a * d - b * c)
        self.r += h * (a * N - c * Y) / (a * d - b * c)
        self.north += h * (self.u * cos(self.heading) - self.v * sin(self.heading))
        self.east += h * (self.u * sin(self.heading) + self.v * cos(self.heading))
        self.heading += h * self.r
        return True
'''

# What the vessel calls the states that the collision wants; the rest stays zero.
NAMES = {"position.north": "north", "position.east": "east", "attitude.yaw": "heading",
         "velocity.surge": "u", "velocity.sway": "v", "rate.yaw": "r"}  # fmt: skip
PUSH = {"X": "force.surge", "Y": "force.sway", "N": "moment.yaw"}


def main() -> None:
    """Build both, run, print."""
    plane = load_ship(SHIP).M[[0, 1, 5]][:, [0, 1, 5]].tolist()
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "vessel.py").write_text(VESSEL)
        FmuBuilder.build_FMU(Path(folder, "vessel.py"), dest=folder)
        vessel = extract(str(Path(folder, "Vessel.fmu")), str(Path(folder, "vessel")))
        ships = {name: Instance(name, vessel) for name in START}
        for name, (north, east, heading, speed) in START.items():
            ships[name].start(
                start_north=north, start_east=east, start_heading=heading, start_u=speed, matrix=json.dumps(plane)
            )
        collision = Instance("collision", extract(build_fmus(folder)["ShipCollision"], Path(folder, "collision")))
        both = {f"{name}.{key}": value for name in ships for key, value in (("ship", SHIP), ("degrees_of_freedom", 3))}
        collision.start(feedback=2, **both)  # the second item of the enumeration: force
        pushed = dict.fromkeys(ships, 0.0)
        for k in range(STEPS):
            for name, ship in ships.items():
                collision.set(of(name, list(NAMES)), ship.get(list(NAMES.values())))
            collision.step(k * STEP)
            for name, ship in ships.items():
                ship.set(list(PUSH), collision.get(of(name, list(PUSH.values()))))
                pushed[name] += collision.get([f"{name}.force.surge"])[0] * STEP
            for ship in ships.values():
                ship.step(k * STEP)
        print(f"impact at {collision.get(['impact.time'])[0]:.2f} s")
        for name, ship in ships.items():
            u, v, r = ship.get(["u", "v", "r"])
            issued = collision.get(of(name, IMPULSE))[0]
            print(f"{name}: {u:.3f} m/s ahead, {v:.3f} m/s to starboard, {r:.5f} rad/s")
            print(f"  impulse ahead issued {issued / 1e6:.3f} MN s, force times time {pushed[name] / 1e6:.3f} MN s")
        for instance in (*ships.values(), collision):
            instance.end()


if __name__ == "__main__":
    main()
