"""A loop of your own on FMPy: two ships and the collision between them, sequential.

    python examples/own_loop.py

The collision is stepped first, on the ships' states at t; its impulses reach the ships before they step from t. Nothing
is lost with another order, or with all in parallel: impulses are cumulative, and the ships say what they have applied.
"""

from __future__ import annotations

import tempfile
from math import radians
from pathlib import Path
from typing import Any

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

from shipcollision_fmu import build_fmus

STEP, STEPS = 0.05, 400
LINEAR, ANGLES = ("surge", "sway", "heave"), ("roll", "pitch", "yaw")
GROUPS = {"position": ("north", "east", "down"), "attitude": ANGLES, "velocity": LINEAR, "rate": ANGLES}
STATE = [f"{group}.{part}" for group, parts in GROUPS.items() for part in parts]
IMPULSE = [f"impulse.{part}" for part in LINEAR + ANGLES]
APPLIED = [f"impulse_applied.{part}" for part in LINEAR + ANGLES]

SHIP = {"ship": "kvlcc2", "degrees_of_freedom": 3}
START = {
    "own": {"initial.position.north": -230.0, "initial.velocity.surge": 5.0},
    "target": {"initial.attitude.yaw": radians(90.0), "initial.position.east": 40.0, "initial.velocity.surge": 3.0},
}


class Instance:
    """An instance of an FMU whose variables have names."""

    def __init__(self, name: str, unpacked: str) -> None:
        description = read_model_description(unpacked)
        self.variables = {variable.name: variable for variable in description.modelVariables}
        self.fmu = FMU2Slave(
            guid=description.guid, unzipDirectory=unpacked, instanceName=name,
            modelIdentifier=description.coSimulation.modelIdentifier,
        )  # fmt: skip
        self.fmu.instantiate(loggingOn=True)

    def start(self, **values: Any) -> None:
        """Parameters and start values, then initialisation."""
        for name, value in values.items():
            reference = [self.variables[name].valueReference]
            setter = {str: self.fmu.setString, float: self.fmu.setReal, bool: self.fmu.setBoolean}
            setter.get(type(value), self.fmu.setInteger)(reference, [value])
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def get(self, names: list[str]) -> list[float]:
        """Values of Reals."""
        values: list[float] = self.fmu.getReal([self.variables[name].valueReference for name in names])
        return values

    def set(self, names: list[str], values: list[float]) -> None:
        """Set Reals."""
        self.fmu.setReal([self.variables[name].valueReference for name in names], values)

    def step(self, t: float) -> None:
        """One step of STEP [s]; FMPy raises an exception when the FMU refuses it."""
        self.fmu.doStep(currentCommunicationPoint=t, communicationStepSize=STEP)

    def end(self) -> None:
        """Give it back."""
        self.fmu.terminate()
        self.fmu.freeInstance()


def of(ship: str, names: list[str]) -> list[str]:
    """The collision's names for a ship's variables."""
    return [f"{ship}.{name}" for name in names]


def main() -> None:
    """Build, unpack, run, print."""
    with tempfile.TemporaryDirectory() as folder:
        unpacked = {name: extract(fmu, Path(folder, name)) for name, fmu in build_fmus(folder).items()}
        ships = {name: Instance(name, unpacked["ShipManoeuvring"]) for name in START}
        for name, ship in ships.items():
            ship.start(**SHIP, hydrodynamics=False, **START[name])
        collision = Instance("collision", unpacked["ShipCollision"])
        both = {f"{name}.{key}": value for name in ships for key, value in SHIP.items()}
        collision.start(friction=0.3, **both)
        for k in range(STEPS):
            for name, ship in ships.items():
                collision.set(of(name, STATE + APPLIED), ship.get(STATE + APPLIED))
            collision.step(k * STEP)
            for name, ship in ships.items():
                ship.set(IMPULSE, collision.get(of(name, IMPULSE)))
            for ship in ships.values():
                ship.step(k * STEP)
        when, angle = collision.get(["impact.time", "impact.angle"])
        print(f"impact at {when:.2f} s, {angle:.3f} rad between the headings")
        for name, ship in ships.items():
            u, v, _ = ship.get(STATE)[6:9]
            missing = collision.get(of(name, IMPULSE))[0] - ship.get(APPLIED)[0]
            print(f"{name}: {u:.3f} m/s ahead, {v:.3f} m/s to starboard; issued - applied: {missing} N s")
        for instance in (*ships.values(), collision):
            instance.end()


if __name__ == "__main__":
    main()
