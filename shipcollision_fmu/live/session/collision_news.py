"""CollisionNews: tells when a collision begins and ends."""

from __future__ import annotations

from ...collision.interface import CollisionParameters
from .live_run import LiveRun
from .news import Tell

__all__ = ["CollisionNews"]


class CollisionNews:
    """What was told of the collisions of a run."""

    def __init__(self, run: LiveRun, tell: Tell) -> None:
        self._run, self._tell = run, tell
        given = run.scenario.collision.minimum_separation_time
        self._apart = given or CollisionParameters.minimum_separation_time
        """Time [s] without contact after which a collision ends."""
        self._touching: dict[int, bool] = {}

    def look(self) -> bool:
        """Tell what has changed; whether a collision has begun."""
        touches = self._run.list_touches()
        touching = {number: self._run.time - last < self._apart for number, last in touches.items()}
        news = [number for number, on in touching.items() if self._touching.get(number) is not on]
        self._touching |= touching
        for number in news:
            (collision,) = [one for one in self._run.observe_contact().collisions if one.id == number]
            self._tell(
                "collision begins" if touching[number] else "collision ends", id=number, ship_a=collision.ship_a,
                ship_b=collision.ship_b, point=list(collision.point), start=collision.time, energy=collision.energy,
            )  # fmt: skip
        return any(touching[number] for number in news)

    def forget(self) -> None:
        """The run has gone back: collisions since have not happened."""
        left = self._run.list_touches()
        self._touching = {number: on for number, on in self._touching.items() if number in left}
