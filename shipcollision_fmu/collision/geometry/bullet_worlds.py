"""Bullet worlds: one that a closed model gave back serves the next. Opening a world takes 16 ms of processor time, as
Bullet then clears 30 MB of buffers; emptying one takes 0.3 ms.

An emptied world has the state of a new one: resetSimulation() makes Bullet's dynamics world, its solver, broad phase
and contact caches anew, counts bodies and shapes from zero, and forgets its filter of pairs. The length of a step alone
outlives it; dynamic_step() sets that for each step.
"""

from __future__ import annotations

from ctypes import CDLL
from types import ModuleType

__all__ = ["BulletWorlds"]

KEPT = 1
"""Worlds that wait for a model, at most; each holds 31 MB. One is enough where models follow each other."""


class BulletWorlds:
    """The worlds (DIRECT, no rendering) of one process, by PyBullet's number of their client.

    Client 0 never waits here: it is the one that PyBullet takes where a user's own program names none.
    """

    def __init__(self, bullet: ModuleType) -> None:
        """bullet: the module pybullet."""
        self._bullet = bullet
        self._waiting: list[int] = []  # append and pop are atomic: models may live in threads
        self._has_opened = False

    def take(self) -> int:
        """An empty world of one's own."""
        while self._waiting:
            client = self._waiting.pop()
            if self._bullet.isConnected(client):
                return client
        return self._open()

    def _open(self) -> int:
        p = self._bullet
        client: int = p.connect(p.DIRECT)
        if client == 0 and self._has_opened:  # models do follow each other: a world that may be kept pays
            client = p.connect(p.DIRECT)
            p.disconnect(0)
        self._has_opened = True
        return client

    def give_back(self, client: int) -> None:
        """Empty a world that nobody uses any more. It waits for the next model, or is closed."""
        p = self._bullet
        if not p.isConnected(client):
            return
        if client > 0 and len(self._waiting) < KEPT:
            p.resetSimulation(physicsClientId=client)
            self._waiting.append(client)
        else:
            p.disconnect(client)
            _give_back_memory()


def _give_back_memory() -> None:
    """Return freed memory to the system: a world has 30 MB of buffers, and glibc keeps them for the process. Takes
    some milliseconds; where the C library is another, nothing is done."""
    trim = getattr(CDLL(None), "malloc_trim", None)
    if trim is not None:
        trim(0)
