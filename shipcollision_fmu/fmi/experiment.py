"""The experiment that a host has set up, and whether a step fits into it.

FMI 2.0 tells an instance the start and, if the host wants one, the stop of the simulation. Beyond the stop there is no
step. A step begins where the last one ended; a host that leaves a gap has lost count of the time, and is told once.

    Experiment.set_up(start, stop)  ->  check_step(t, h), finish_step(t, h) at every step

pythonfmu3 passes neither start nor stop of FMI 3.0 on: there the first step begins wherever the host begins it.
"""

from __future__ import annotations

from typing import Any

from ..errors import StepError

__all__ = ["Experiment"]

ROUNDING = 1e-9
"""Share of the span, or of the stop time, by which a step may end late. Smaller: hosts that add up their steps lose the
last one. Larger: a host with very small steps makes one too many."""
GAP = 1e-3
"""Share of a step by which it may begin early or late. Smaller: hosts that count whole nanoseconds are warned."""


class Experiment:
    """Start, stop and present time of an instance [s]."""

    def __init__(self) -> None:
        self.time = 0.0
        """End of the last step; before the first step the start."""
        self._begun = False  # time is known from the host
        self._stop: float | None = None
        self._latest = float("inf")  # the stop, rounding allowed for
        self._warned = False

    def set_up(self, start: float, stop: float | None) -> str:
        """Take start and stop [s]; returns a warning about a stop that is none, or nothing."""
        self.time, self._begun = start, True
        warning = ""
        if stop is not None and not stop > start:
            warning, stop = f"stop time {stop:g} s is not after the start time {start:g} s and is ignored", None
        self._set_stop(stop)
        return warning

    def check_step(self, t: float, h: float) -> str:
        """A warning about a step from t by h [s] that does not begin where the last one ended, or nothing.

        It is given until such a step was made, so that a refused step takes no warning with it.

        Raises StepError for a step that ends after the stop.
        """
        if t + h > self._latest:
            raise StepError(
                f"a step from t = {t:g} s by {h:g} s ends after the stop time {self._stop:g} s of the experiment: end "
                "there, or set the experiment up without a stop time"
            )
        if self._warned or self._follows(t, h):
            return ""
        return (
            f"a step begins at t = {t:g} s, but the last one ended at {self.time:g} s: ships and collision then lose "
            "count of the time; step from where the last step ended, or restore a state"
        )

    def finish_step(self, t: float, h: float) -> None:
        """The step was made, and a warning about it was given."""
        self._warned = self._warned or not self._follows(t, h)
        self.time, self._begun = t + h, True

    def get_state(self) -> dict[str, Any]:
        """All of it, as plain data."""
        return {
            "time": self.time,
            "begun": self._begun,
            "stop": self._stop,
            "warned": self._warned,
            "latest": self._latest,
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Put it back."""
        self.time, self._begun, self._warned = float(state["time"]), bool(state["begun"]), bool(state["warned"])
        self._stop, self._latest = state["stop"], float(state["latest"])

    def _follows(self, t: float, h: float) -> bool:
        return not self._begun or abs(t - self.time) <= GAP * h

    def _set_stop(self, stop: float | None) -> None:
        self._stop = stop
        self._latest = float("inf") if stop is None else stop + ROUNDING * max(stop - self.time, abs(stop))
