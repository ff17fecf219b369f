"""KeptScenario: the scenario of a live run while it lasts, since the process may be killed before it writes its run.

`unfinished.toml` in the run's folder has the orders up to the last time that it was written. Run like scenario.toml, it
gives the run up to there. At the end scenario.toml takes its place.
"""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from ...files import write_files
from .live_run import LiveRun

__all__ = ["EVERY", "UNFINISHED", "KeptScenario"]

UNFINISHED = "unfinished.toml"
EVERY = 30.0
"""[s] of wall time between two writings, with few orders."""
ORDERS = 1000
"""With so many orders it is written half as often, with twice as many a third as often: 1000 take some 10 ms."""


class KeptScenario:
    """The file of a run in the folder `out`, from the wall time `now` [s] on. That of an earlier run is removed."""

    def __init__(self, run: LiveRun, out: Path, now: float) -> None:
        self._run, self._out, self._due, self._has_inputs = run, out, now + EVERY, False
        self.remove()

    def keep(self, now: float) -> None:
        """Write it if it is due. Raises HostError, and then not again before the next time."""
        if now < self._due:
            return
        orders = sum(len(bridge.log) for bridge in self._run.bridges.values() if bridge.limits is not None)
        self._due = now + EVERY * (1.0 + orders / ORDERS)
        if not self._has_inputs:  # they are as they were when the run began
            self._run.inputs.write(self._out)
            self._has_inputs = True
        write_files(self._out, {UNFINISHED: self._run.write_scenario()})

    def remove(self) -> None:
        """It is not, or no longer, needed."""
        with suppress(OSError):
            (self._out / UNFINISHED).unlink(missing_ok=True)
