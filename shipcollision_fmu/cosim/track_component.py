"""TrackComponent: a ship that follows a recorded track, whatever hits it, as a Component of the master."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from ctypes import c_double
from typing import Any

from ..errors import HostError
from ..fmi.names import APPLIED, STATE
from ..scenario.tracks.track import Track
from .component import Buffer, Group, Value

__all__ = ["TrackComponent"]


class TrackComponent:
    """The state of a track at communication points, as outputs; impulse_applied stays zero."""

    def __init__(self, name: str, track: Track) -> None:
        self.name = name
        self._track, self._time = track, 0.0

    def reals(self, names: Sequence[str], values: Buffer | None = None) -> Group:
        """See Component. Outputs alone: a track has no inputs."""
        unknown = sorted(set(names) - {*STATE, *APPLIED})
        if unknown:
            raise HostError(f"{self.name}: a recorded track has no variable {unknown[0]!r}")
        return _Outputs(self, [*names], (c_double * len(names))() if values is None else values)

    def integers(self, names: Sequence[str]) -> Group:
        """See Component."""
        raise HostError(f"{self.name}: a recorded track has no Integer variables")

    def initialise(self, parameters: Mapping[str, Value], stop_time: float, inputs: Sequence[Group] = ()) -> None:
        """See Component."""
        self._time = 0.0

    def step(self, t: float, h: float) -> None:
        """See Component."""
        self._time = t + h

    def save(self) -> dict[str, Any]:
        """The whole state."""
        return {"time": self._time}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Back to a state that save() gave."""
        self._time = state["time"]

    def close(self) -> None:
        """See Component."""

    def list_outputs(self, names: Sequence[str]) -> list[float]:
        """Values of outputs at the present time."""
        state = dict(zip(STATE, self._track.state(self._time), strict=True))
        return [state.get(name, 0.0) for name in names]


class _Outputs:
    def __init__(self, owner: TrackComponent, names: list[str], values: Buffer) -> None:
        self.values = values
        self._owner, self._names = owner, names

    def read(self, count: int | None = None) -> None:
        names = self._names if count is None else self._names[:count]
        self.values[: len(names)] = self._owner.list_outputs(names)

    def write(self) -> None:
        """Nothing: a track has no inputs."""
