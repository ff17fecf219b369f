"""Stepper: a scenario's instances with their helms and recorder, advanced from communication point to point.

advance    send the orders of k;   one step of the algorithm;   record k+1
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..scenario.scenario import Scenario
from ..scenario.tables.header import MAXIMUM_STEPS
from ..ship.ship import Ship
from .factories import Factories
from .helm import Helm
from .master import ALGORITHMS
from .prepared_files import PreparedFiles
from .recorder import Recorder
from .wiring import connect

__all__ = ["Stepper"]


class Stepper:
    """The instances of a scenario, made by `factories`, at communication point `k`, which is recorded.

    Beyond `most_recorded` steps the run goes on and nothing more is recorded: no scenario gives a longer run again.

    prepared: files of native FMUs. With `spool`, a folder, the record grows in temporary files there. Raises what
    connect() raises.
    """

    def __init__(
        self, scenario: Scenario, ships: Mapping[str, Ship], factories: Factories,
        prepared: PreparedFiles | None = None, spool: Path | None = None,
    ) -> None:  # fmt: skip
        self.system, helms = connect(scenario, ships, *factories, prepared)
        steered = [name for name in scenario.ships if name not in scenario.tracks]
        self.helms: dict[str, Helm] = dict(zip(steered, helms, strict=True))  # by name
        sailing = {
            name: component
            for (name, start), component in zip(scenario.ships.items(), self.system.ships, strict=True)
            if start.hydrodynamics and name in steered
        }
        self.recorder = Recorder(
            self.system, list(scenario.ships), scenario.step, scenario.steps, list(scenario.obstacles), sailing, spool
        )
        self.k, self.step = 0, scenario.step
        self.most_recorded = MAXIMUM_STEPS
        self._advance = ALGORITHMS[scenario.algorithm]
        self.recorder.record(0)

    def advance(self) -> None:
        """One communication step. Raises StepError; k then stays."""
        for helm in self.helms.values():
            helm.send(self.k)
        self._advance(self.system, self.k * self.step, self.step)
        if self.k < self.most_recorded:
            self.recorder.record(self.k + 1)
        else:
            self.recorder.look()
        self.k += 1
