"""run_python(): a scenario by the Python models, which ends after a separation as one of the native library does."""

from __future__ import annotations

from math import ceil

import numpy as np

from ...cosim.run import Run
from ...cosim.simulate import simulate
from ...scenario.scenario import Scenario

__all__ = ["run_python"]


def run_python(scenario: Scenario, separation: float | None) -> Run:
    """The run, until the time `separation` [s] has passed without contact after a collision.

    The end is known after the run alone: it is then run once more up to there. Raises what simulate() raises.
    """
    run = simulate(scenario, in_process=True)
    end = _find_end(run, separation, scenario.step)
    if end == len(run.states) - 1:
        return run
    header = scenario.scenario.model_copy(update={"duration": end * scenario.step})
    return simulate(scenario.model_copy(update={"scenario": header}), in_process=True)


def _find_end(run: Run, separation: float | None, step: float) -> int:
    """The communication point at which the run is over."""
    last = len(run.states) - 1
    if separation is None:
        return last
    of_collisions = run.contacts["time"][run.contacts["impact"] > 0]
    touches = np.unique(np.searchsorted(run.states["time"], of_collisions))
    for touch, following in zip(touches, [*touches[1:], last + 1], strict=True):
        over = int(touch) + ceil(separation / step - 1e-9)
        if over < following:
            return min(over, last)
    return last
