"""ShipCollision as an add-on to a simulator that can be told where a ship is: it adopts the state after impact.

    python examples/adopt_state.py

The simulator here moves its ships on straight lines and knows nothing of contact, as a visual system or a traffic
generator does. feedback = "state": the collision takes it that what it sent, post.*, is what the ship has next.
"""

from __future__ import annotations

import tempfile
from math import cos, radians, sin
from pathlib import Path

from fmpy import extract
from own_loop import STATE, STEP, Instance, of

from shipcollision_fmu import build_fmus

STEPS = 400
SHIP = {"ship": "kvlcc2", "degrees_of_freedom": 3}
POST = [f"post.{name}" for name in STATE]


class Puppet:
    """A ship that goes on as she goes: her 12 states, in the order of STATE."""

    def __init__(self, north: float, east: float, heading: float, speed: float) -> None:
        self.state = [north, east, 0.0, 0.0, 0.0, heading, speed, 0.0, 0.0, 0.0, 0.0, 0.0]

    def go_on(self, h: float) -> None:
        """Straight on, and turning as before."""
        heading, u, v, r = (self.state[i] for i in (5, 6, 7, 11))
        self.state[0] += h * (u * cos(heading) - v * sin(heading))
        self.state[1] += h * (u * sin(heading) + v * cos(heading))
        self.state[5] += h * r


def main() -> None:
    """Run both, print what happened."""
    ships = {"own": Puppet(-230.0, 0.0, 0.0, 5.0), "target": Puppet(0.0, 40.0, radians(90.0), 3.0)}
    with tempfile.TemporaryDirectory() as folder:
        collision = Instance("collision", extract(build_fmus(folder)["ShipCollision"], Path(folder, "collision")))
        both = {f"{name}.{key}": value for name in ships for key, value in SHIP.items()}
        collision.start(feedback=3, **both)  # the third item of the enumeration: state
        active = [collision.variables["contact.active"].valueReference]
        steps_in_contact = 0
        for k in range(STEPS):
            for name, ship in ships.items():
                collision.set(of(name, STATE), ship.state)
            collision.step(k * STEP)
            touching = collision.fmu.getBoolean(active)[0]
            steps_in_contact += touching
            for name, ship in ships.items():
                if touching:
                    ship.state = collision.get(of(name, POST))
                else:
                    ship.go_on(STEP)
        print(f"impact at {collision.get(['impact.time'])[0]:.2f} s, {steps_in_contact} steps in contact")
        print(f"energy lost: {collision.get(['energy.dissipated'])[0] / 1e6:.1f} MJ")
        for name, ship in ships.items():
            print(f"{name}: {ship.state[6]:.3f} m/s ahead, {ship.state[7]:.3f} m/s to starboard")
        collision.end()


if __name__ == "__main__":
    main()
