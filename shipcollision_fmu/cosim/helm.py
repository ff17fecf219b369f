"""The helm of a ship: timed orders, and a steering that combines autopilot, route and evasion.

    orders      rudder and revolutions from the scenario, each at its communication point; held until the next
    heading     an ordered heading is held by the autopilot (autopilot.py)
    route       headings follow the waypoints (route.py) until a heading or a rudder is ordered
    evasion     goes before everything else, once it has begun (evasion.py)
    changes     current and wind around the ship that change at given times go the same way

`steer` is a pure function. The state from one communication point to the next is the HelmState that goes in and comes
out, so a run can be repeated to the bit. SI units, radians; n is north, east.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import NamedTuple

from ..fmi.names import STATE
from ..ship.ship_state import ShipState
from .autopilot import Autopilot, steer_heading
from .component import Buffer, Group
from .evasion import Evasion, is_too_near
from .route import Route, line_of_sight

__all__ = ["Helm", "HelmState", "Steering", "steer"]

Orders = tuple[float, float]
"""(rudder_order [rad], propeller_order [1/s])."""


@dataclass(frozen=True)
class Steering:
    """How a ship is steered besides its timed orders."""

    autopilot: Autopilot
    route: Route | None = None
    evasion: Evasion | None = None


class HelmState(NamedTuple):
    """The memory of a helm: heading ordered [rad] or None, whether on the route, its leg, the integral of the heading
    error [rad s], whether evading."""

    heading: float | None = None
    on_route: bool = False
    leg: int = 0
    integral: float = 0.0
    evading: bool = False


@dataclass
class Helm:
    """The helm of one ship, which writes its orders into `group`.

    `orders` and `headings`, those to come, by communication point; `own` and `other` are the buffers of the two ships'
    states. From point `evades_until` on there is no evasion. `changes` are the surroundings by the communication point
    from which they act, written into `around`.
    """

    group: Group
    orders: dict[int, list[float]] = field(default_factory=dict)
    headings: dict[int, float | None] = field(default_factory=dict)
    steering: Steering | None = None
    step: float = 0.0
    state: HelmState = field(default_factory=HelmState)
    own: Buffer | None = None
    other: Buffer | None = None
    evades_until: int | None = None
    around: Group | None = None
    changes: dict[int, list[float]] = field(default_factory=dict)
    last_order: Orders = (0.0, 0.0)

    def send(self, k: int) -> None:
        """Send the orders of communication point k to the ship; without steering only those that are new."""
        change = self.changes.pop(k, None)
        if change is not None and self.around is not None:
            self.around.values[:] = change
            self.around.write()
        is_new = self.load(k)
        if self.steering is None:
            if is_new:
                self.group.write()
            return
        if k == self.evades_until:
            self.end_evasion()
        if k in self.headings:
            self.state = self.state._replace(heading=self.headings.pop(k), on_route=False, integral=0.0)
        assert self.own is not None
        own = ShipState(*self.own[: len(STATE)])
        other = None if self.other is None else ShipState(*self.other[: len(STATE)])
        orders, self.state = steer(self.steering, self.state, self.last_order, own, other, self.step)
        self.group.values[:] = list(orders)
        self.group.write()

    def end_evasion(self) -> None:
        """Steer as ordered from here on, without an evasion."""
        if self.steering is not None:
            self.steering, self.state = replace(self.steering, evasion=None), self.state._replace(evading=False)

    def load(self, k: int) -> bool:
        """Put the timed order of communication point k into the group's buffer; False when there is none."""
        order = self.orders.pop(k, None)
        if order is None:
            return False
        self.last_order = order[0], order[1]
        self.group.values[:] = order
        return True


def steer(
    steering: Steering, state: HelmState, orders: Orders, own: ShipState, other: ShipState | None, h: float
) -> tuple[Orders, HelmState]:
    """Orders for the next h [s], and the new state of the helm.

    `orders` are the timed orders in force; `other` is the ship to evade, None when there is none.
    """
    rudder, revolutions = orders
    evasion = steering.evasion
    if evasion is not None and other is not None:
        if not state.evading and is_too_near(evasion, own, other):
            state = state._replace(evading=True)
        if state.evading:
            return (evasion.rudder, revolutions if evasion.revolutions is None else evasion.revolutions), state
    heading = state.heading
    if state.on_route and steering.route is not None:
        heading, leg = line_of_sight(steering.route, state.leg, own)
        state = state._replace(leg=leg)
    if heading is not None:
        rudder, integral = steer_heading(steering.autopilot, heading, state.integral, own, h)
        state = state._replace(integral=integral)
    return (rudder, revolutions), state
