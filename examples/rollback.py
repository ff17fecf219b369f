"""A variable-step master that steps back to the instant of impact.

    python examples/rollback.py [--step 1.0] [--finest 1e-4] [--ship NAME_OR_FILE]

Own ship runs into the side of a ship that lies across her course. Far from contact the master takes long steps. When
the collision FMU counts a new collision within a step, that step was too long: all FMUs are set back to the state
before it, and half of it is tried, down to the finest step. So the impact is applied at the instant at which it
happens, within that finest step, and the steps after it grow again.

What a master of your own needs for this: fmi2GetFMUstate before the step, fmi2SetFMUstate after a step that went too
far, fmi2FreeFMUstate always. Outputs are those of the restored state at once; only what the master itself keeps, here
nothing, must be put back by hand.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

from shipcollision_fmu import build_fmus, load_ship

STATE = [
    *(f"position.{part}" for part in ("north", "east", "down")),
    *(f"attitude.{part}" for part in ("roll", "pitch", "yaw")),
    *(f"velocity.{part}" for part in ("surge", "sway", "heave")),
    *(f"rate.{part}" for part in ("roll", "pitch", "yaw")),
    *(f"impulse_applied.{part}" for part in ("surge", "sway", "heave", "roll", "pitch", "yaw")),
]
IMPULSE = [f"impulse.{part}" for part in ("surge", "sway", "heave", "roll", "pitch", "yaw")]


class Instance:
    """An FMU instance whose variables are reached by name."""

    def __init__(self, name: str, unpacked: Path) -> None:
        description = read_model_description(str(unpacked))
        self.reference = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.fmu: Any = FMU2Slave(
            guid=description.guid,
            unzipDirectory=str(unpacked),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.fmu.instantiate(loggingOn=True)
        self.fmu.setDebugLogging(True, ["logStatusError", "logStatusWarning"])  # no events of steps that are taken back

    def get(self, names: list[str]) -> list[float]:
        values: list[float] = self.fmu.getReal([self.reference[name] for name in names])
        return values

    def set(self, names: list[str], values: list[float]) -> None:
        self.fmu.setReal([self.reference[name] for name in names], values)

    def begin(self) -> None:
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()


class Encounter:
    """Both ships and the collision between them, with a sequential master: collision first, then the ships."""

    def __init__(self, unpacked: dict[str, Path], ship: str, speed: float, gap: float) -> None:
        own, target = Instance("own", unpacked["ShipManoeuvring"]), Instance("target", unpacked["ShipManoeuvring"])
        self.ships = {"own": own, "target": target}
        self.collision = Instance("collision", unpacked["ShipCollision"])
        for name, one in self.ships.items():
            one.fmu.setString([one.reference["ship"]], [ship])
            self.collision.fmu.setString([self.collision.reference[f"{name}.ship"]], [ship])
        size = load_ship(ship)
        apart = 0.5 * (size.L_oa + size.B) + gap
        own.set(["initial.position.north", "initial.velocity.surge"], [-apart, speed])
        target.set(["initial.attitude.yaw"], [1.5707963267948966])
        for one in self.ships.values():
            one.begin()
        self._tell()
        self.collision.begin()
        self.all = [self.collision, own, target]

    @property
    def impacts(self) -> int:
        """Collisions so far."""
        count: int = self.collision.fmu.getInteger([self.collision.reference["impact.count"]])[0]
        return count

    def step(self, t: float, h: float) -> None:
        """One step [t, t + h]."""
        self._tell()
        self.collision.fmu.doStep(t, h)
        for name, one in self.ships.items():
            one.set(IMPULSE, self.collision.get([f"{name}.{variable}" for variable in IMPULSE]))
            one.fmu.doStep(t, h)

    def save(self) -> list[Any]:
        """The states of all FMUs."""
        return [one.fmu.getFMUstate() for one in self.all]

    def restore(self, states: list[Any]) -> None:
        """Put them back."""
        for one, state in zip(self.all, states, strict=True):
            one.fmu.setFMUstate(state)

    def free(self, states: list[Any]) -> None:
        """Saved states take memory until they are freed."""
        for one, state in zip(self.all, states, strict=True):
            one.fmu.freeFMUstate(state)

    def close(self) -> None:
        """End all instances."""
        for one in self.all:
            one.fmu.terminate()
            one.fmu.freeInstance()

    def _tell(self) -> None:
        """The ships' states go to the collision FMU."""
        for name, one in self.ships.items():
            self.collision.set([f"{name}.{variable}" for variable in STATE], one.get(STATE))


class Found(NamedTuple):
    """Where a run came to: time of the first impact [s] (the start of the finest step that it lies in), number of
    steps that were kept and taken back, length of the steps that were kept [s], speeds after the run [m/s]."""

    impact: float | None
    kept: int
    taken_back: int
    steps: list[float]
    speeds: dict[str, float]


def run(
    unpacked: dict[str, Path], *, ship: str = "kvlcc2", speed: float = 4.0, gap: float = 20.3, end: float = 10.0,
    longest: float = 1.0, finest: float = 1e-4,
) -> Found:  # fmt: skip
    """Sail to `end` [s], steps from `finest` to `longest` [s]."""
    encounter = Encounter(unpacked, ship, speed, gap)
    t, h, impact, taken_back, steps = 0.0, longest, None, 0, list[float]()
    try:
        while t < end:
            h = min(h, end - t)
            before, states = encounter.impacts, encounter.save()
            encounter.step(t, h)
            if encounter.impacts > before and h > finest:
                encounter.restore(states)
                encounter.free(states)
                h, taken_back = max(0.5 * h, finest), taken_back + 1
                continue
            encounter.free(states)
            if encounter.impacts > before and impact is None:
                impact = t
            t += h
            steps.append(h)
            h = min(2.0 * h, longest)
        speeds = {name: encounter.ships[name].get(["velocity.surge"])[0] for name in encounter.ships}
        return Found(impact, len(steps), taken_back, steps, speeds)
    finally:
        encounter.close()


def main() -> None:
    """Print what was found."""
    parser = argparse.ArgumentParser(description="Step back to the instant of impact.")
    parser.add_argument("--step", type=float, default=1.0, metavar="S", help="longest step [s] (default: 1)")
    parser.add_argument("--finest", type=float, default=1e-4, metavar="S", help="finest step [s] (default: 0.0001)")
    parser.add_argument("--ship", default="kvlcc2", help="name of a ship or path of a TOML file (default: kvlcc2)")
    options = parser.parse_args()
    if not 0.0 < options.finest <= options.step:
        parser.error("--finest must be greater than 0 and at most --step")
    with TemporaryDirectory() as folder:
        files = build_fmus(folder)
        unpacked = {name: Path(extract(file, str(Path(folder, name)))) for name, file in files.items()}
        found = run(unpacked, ship=options.ship, longest=options.step, finest=options.finest)
    print(f"impact at t = {found.impact:.4f} s" if found.impact is not None else "no impact")
    print(f"{found.kept} steps of {min(found.steps):g} to {max(found.steps):g} s, {found.taken_back} taken back")
    print(f"a fixed step as fine would take {round(sum(found.steps) / options.finest)} steps")


if __name__ == "__main__":
    main()
