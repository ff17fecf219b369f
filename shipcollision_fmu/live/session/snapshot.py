"""Snapshot: a live run at one instant, for pages and for protocols. Frozen, so that every thread may read it.

SI units; angles in radians, but for keys that end in _deg. n is north, east, down; b forward, starboard, down.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

__all__ = [
    "CollisionSnapshot", "ContactSnapshot", "EnvironmentSnapshot", "ShipSnapshot", "Snapshot", "TouchSnapshot",
    "WindSnapshot",
]  # fmt: skip


@dataclass(frozen=True)
class ShipSnapshot:
    """A ship: eta [north, east, down, roll, pitch, yaw] of CO in n, nu [u, v, w, p, q, r] over ground in b.

    rudder [rad] and rev_per_s [1/s] are what they are, rudder_order, rev_order and heading_order [rad] what is ordered;
    heading_order is None without an ordered heading. failures: of "rudder" and "blackout". horn: whether it sounds.
    """

    eta: tuple[float, ...]
    nu: tuple[float, ...]
    rudder: float
    rev_per_s: float
    rudder_order: float
    rev_order: float
    heading_order: float | None = None
    failures: tuple[str, ...] = ()
    horn: bool = False


@dataclass(frozen=True)
class WindSnapshot:
    """The wind over ground: speed [m/s] and the direction from which it comes [deg]."""

    speed: float
    from_deg: float


@dataclass(frozen=True)
class EnvironmentSnapshot:
    """current: velocity of the water, [north, east] [m/s]; wind."""

    current: tuple[float, float]
    wind: WindSnapshot


@dataclass(frozen=True)
class CollisionSnapshot:
    """A collision: number, time of its start [s], bodies, first point in n [m], energy dissipated so far [J].

    a, b: the first point in the b of each body [m].
    """

    id: int
    time: float
    ship_a: str
    ship_b: str
    point: tuple[float, float, float]
    energy: float
    a: tuple[float, float, float]
    b: tuple[float, float, float]


@dataclass(frozen=True)
class TouchSnapshot:
    """A contact point: bodies, its place in the b of each [m], and the normal from ship_a to ship_b in n."""

    ship_a: str
    ship_b: str
    a: tuple[float, float, float]
    b: tuple[float, float, float]
    normal: tuple[float, float, float]


@dataclass(frozen=True)
class ContactSnapshot:
    """Contact: number of points now, and where they are; collisions in all, the latest of them; clearance [m] of the
    nearest pair; energy [J].

    clearance is capped at the scenario's clearance_range; nearest is then empty.
    """

    points: int
    touching: tuple[TouchSnapshot, ...]
    count: int
    collisions: tuple[CollisionSnapshot, ...]
    clearance: float
    nearest: tuple[str, ...]
    energy: float


@dataclass(frozen=True)
class Snapshot:
    """A live run at the communication point `step_count`, at simulated `time` [s].

    rate: simulated seconds per second, as asked for; real_rate: as measured over the last seconds; paced: whether the
    machine keeps up; paused; running: False once the run has ended. command: the client in command by ship. refused:
    messages of clients that were malformed, so far.
    """

    time: float
    step_count: int
    rate: float
    paced: bool
    real_rate: float
    paused: bool
    running: bool
    ships: Mapping[str, ShipSnapshot]
    environment: EnvironmentSnapshot
    contact: ContactSnapshot
    command: Mapping[str, str] = field(default_factory=dict)
    refused: int = 0

    def as_message(self) -> dict[str, Any]:
        """The message "state" of the WebSocket."""
        return {"type": "state", **asdict(self)}
