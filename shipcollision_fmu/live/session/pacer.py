"""Pacer: when the next communication step is due on the wall clock.

    due(T) = W0 + (T - T0) / rate

T0, W0   simulated and wall time [s] at which the pace was last set: a start, another rate, the end of a pause
rate     simulated seconds per second

Times are absolute, so no error of a sleep adds up, and a busy moment of the machine is made up for at full speed. A
machine that lags by more than MOST_LAG starts anew from where it is: it is too slow for the rate. From TOLD_LAG on the
pace counts as not kept, for a while. All times come in from outside: the pacer has no clock.
"""

from __future__ import annotations

from collections import deque

__all__ = ["FASTEST", "MOST_LAG", "SLOWEST", "TOLD_LAG", "WINDOW", "Pacer"]

SLOWEST, FASTEST = 0.25, 20.0
"""Limits of the rate. Twenty times is near what one core computes for two ships."""
MOST_LAG = 3.0
"""[s] Lag that is made up for. With less, a machine that is shared loses percents of time; with more, ships jump."""
TOLD_LAG = 0.25
"""[s] Lag that is told. It can be seen."""
WINDOW = 3.0
"""[s] of wall time over which the rate is measured, and for which a lag is shown."""
SPACING = 0.1
"""[s] between two samples of that measurement."""


class Pacer:
    """The pace of a session that is at simulated time `simulated` at wall time `now` [s]."""

    def __init__(self, rate: float, now: float, simulated: float) -> None:
        self.rate = rate
        self.restart(now, simulated)

    def restart(self, now: float, simulated: float, rate: float | None = None, begun: float = 0.0) -> None:
        """Begin a pace anew: after a pause, at another rate, at another time. `begun`: see read_begun()."""
        self.rate = self.rate if rate is None else rate
        self._wall, self._simulated = now, simulated + begun
        self._samples: deque[tuple[float, float]] = deque([(now, simulated)])
        self._lagged: float | None = None

    def due(self, simulated: float) -> float:
        """The wall time [s] at which the step that begins at that simulated time [s] is to end."""
        return self._wall + (simulated - self._simulated) / self.rate

    def read_begun(self, now: float, simulated: float, step: float) -> float:
        """How much of the step to come has passed [s] of simulated time. Without it, whoever sets the pace again and
        again would stop the run."""
        return min(step, max(0.0, self._simulated + (now - self._wall) * self.rate - simulated))

    def note(self, now: float, simulated: float) -> None:
        """A step has ended, at wall time `now`, at that simulated time."""
        lag = now - self.due(simulated)
        if lag > TOLD_LAG:
            self._lagged = now
        if lag > MOST_LAG:
            self._wall, self._simulated = now, simulated
        if now - self._samples[-1][0] >= SPACING:
            self._samples.append((now, simulated))
        while now - self._samples[0][0] > WINDOW and len(self._samples) > 2:
            self._samples.popleft()

    def is_paced(self, now: float) -> bool:
        """Whether the machine has kept up over the last seconds."""
        return self._lagged is None or now - self._lagged > WINDOW

    def measure(self, now: float, simulated: float) -> float:
        """Simulated seconds per second over the last seconds."""
        wall, before = self._samples[0]
        return (simulated - before) / (now - wall) if now > wall else self.rate
