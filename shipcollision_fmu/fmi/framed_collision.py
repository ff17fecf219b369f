"""The collision model for ship models that give their velocity, or take a force, in n.

    velocity, rate     v_b = R_nb^T v_n     before the step, at the attitude received
    force, moment      f_n = R_nb f_b       after it, at the attitude at the end of the step, where the ship takes it

R_nb is the rotation of the ship's attitude. The variables keep their names: surge, sway and heave then hold north, east
and down. The turn is made here, and not in an FMU beside the ship, because such a block delays velocity and force by a
step each: contact is then answered again before its effect is received, and a plastic impact is wrong.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

from ..collision.model import ShipCollision
from ..errors import InputError
from ..ship.frames import rotation

__all__ = ["FramedCollision", "Frames"]


@dataclass
class Frames:
    """Frame of a ship's velocity and rate, and that of its force and moment: "b" or "n"."""

    velocity: str = "b"
    force: str = "b"


class FramedCollision(ShipCollision):
    """ShipCollision with the parameter `frames`, one for each ship."""

    def __init__(self, ships: Sequence[str] = ("own", "target")) -> None:
        super().__init__(ships)
        self.frames = [Frames() for _ in ships]
        self._velocity_in_n: list[int] = []
        self._force_in_n: list[int] = []

    def initialise(self) -> None:
        """See ShipCollision. Raises InputError for a frame that is neither b nor n."""
        for name, frames in zip(self.names, self.frames, strict=True):
            for of, frame in vars(frames).items():
                if frame not in ("b", "n"):
                    raise InputError(f"{name}.{of}_frame = {frame!r} must be 'b' (body) or 'n' (north, east, down)")
        self._velocity_in_n = [i for i, frames in enumerate(self.frames) if frames.velocity == "n"]
        self._force_in_n = [i for i, frames in enumerate(self.frames) if frames.force == "n"]
        with self._velocities_in_b():
            super().initialise()

    def step(self, t: float, H: float) -> None:
        """See ShipCollision."""
        if not self._velocity_in_n and not self._force_in_n:
            super().step(t, H)
            return
        with self._velocities_in_b():
            super().step(t, H)
        for i in self._force_in_n:
            out = self.outputs.ships[i]
            R, force = rotation(out.attitude), out.force
            force[:] = [*(R @ force[:3]).tolist(), *(R @ force[3:]).tolist()]

    @contextmanager
    def _velocities_in_b(self) -> Iterator[None]:
        """The inputs in b for as long as the model reads them; then again as the host has set them."""
        kept = [
            (ship, ship.velocity[:], ship.rate[:]) for ship in map(self.inputs.ships.__getitem__, self._velocity_in_n)
        ]
        try:
            for ship, velocity, rate in kept:
                R = rotation(ship.attitude)
                ship.velocity[:], ship.rate[:] = (R.T @ velocity).tolist(), (R.T @ rate).tolist()
            yield
        finally:
            for ship, velocity, rate in kept:
                ship.velocity[:], ship.rate[:] = velocity, rate
