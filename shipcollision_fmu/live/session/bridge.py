"""The bridge of a ship in a live run: orders of its scenario, orders of people, failures, and the log of all of them.

    timed orders    of the scenario, until a person orders anything; a person's order also ends an evasion
    a person's      given at the next communication point; a heading goes to the autopilot
    rudder stuck    the order becomes the angle at which the rudder is; autopilot and evasion end
    blackout        the same, and the revolutions ordered are 0

The log holds what was ordered, at the communication point of the order. Written into a scenario, the log gives the same
run to the bit: the numbers of the log, in degrees, are those that go to the helm.
"""

from __future__ import annotations

from ctypes import c_double
from dataclasses import dataclass, field, replace
from math import degrees, radians
from pathlib import Path
from typing import Any

from ...cosim.component import Buffer, Component, Group
from ...cosim.helm import Helm, Steering
from ...cosim.scenario_helm import build_autopilot
from ...errors import InputError
from ...fmi.names import STEERING
from ...scenario.order_schedule import find_point
from ...scenario.tables.orders import Order as TimedOrder
from ...scenario.tables.ship_start import ShipStart
from .order_log import Logged, OrderLog
from .ship_limits import ShipLimits

__all__ = ["Bridge"]

LARGEST_RUDDER = 90.0
"""[deg] Limit of a rudder order in a scenario; degrees(radians(90)) may be a last bit beyond."""


class _NoGroup:
    """Stands for variables that a recorded track does not have."""

    values: Buffer = (c_double * 2)()

    def read(self, count: int | None = None) -> None:
        """Nothing."""

    def write(self) -> None:
        """Nothing."""


@dataclass
class _Memory:
    """What changes while a run goes on."""

    timed: tuple[tuple[int, Logged], ...] = ()
    ordered: Logged = field(default_factory=lambda: Logged(0.0, None, 0.0))
    waiting: Logged | None = None
    failures: tuple[str, ...] = ()
    evasion_ended: int | None = None


class Bridge:
    """The bridge of one ship, whose helm is at communication point 0.

    `limits` None: it takes no orders. `spool`: folder for the log. A ship that follows a recorded track has no helm.
    `horn`: whether it sounds. A hand is on it now, so that it is no part of what save() keeps.
    """

    def __init__(
        self,
        name: str,
        start: ShipStart,
        L_pp: float,
        ship: Component,
        helm: Helm | None,
        limits: ShipLimits | None,
        step: float,
        spool: Path | None = None,
    ) -> None:
        self.name, self.limits, self._helm, self._step = name, limits, helm or Helm(_NoGroup()), step
        self._machines: Group = _NoGroup() if helm is None else ship.reals(STEERING)
        self.log, self.horn = OrderLog(spool), False
        self._memory = _Memory(timed=tuple(_list_points(start.orders, step)))
        if limits is None or helm is None:
            return
        if helm.steering is None:
            helm.steering = Steering(build_autopilot(start, L_pp))
        at_start = [order for k, order in self._memory.timed if k == 0]
        for order in at_start:  # the helm has them already
            self._log(0, order)
        self._memory.timed = self._memory.timed[len(at_start) :]
        helm.orders.clear()
        helm.headings = {k: heading for k, heading in helm.headings.items() if k == 0}

    @property
    def failures(self) -> tuple[str, ...]:
        """Of "rudder" and "blackout", those that last."""
        return self._memory.failures

    @property
    def evasion_ended(self) -> int | None:
        """The communication point from which on a person's orders replace an evasion; None if there was none."""
        return self._memory.evasion_ended

    def read_machines(self) -> tuple[float, float]:
        """Rudder angle [rad] and propeller speed [1/s], as they are."""
        self._machines.read()
        rudder, revolutions = self._machines.values
        return rudder, revolutions

    def read_orders(self) -> tuple[float, float, float | None]:
        """Rudder [rad] and revolutions [1/s] as ordered, by the autopilot too, and the heading ordered [rad]."""
        rudder, revolutions = self._helm.group.values
        return rudder, revolutions, self._helm.state.heading

    def order(
        self, rudder_deg: float | None, heading_deg: float | None, rev_per_s: float | None, telegraph: int | None
    ) -> None:
        """Take an order for the next communication point. Raises InputError, and then nothing changes."""
        limits = self.require_limits()
        _refuse_contradictions(self.name, rudder_deg, heading_deg, rev_per_s, telegraph)
        if telegraph is not None:
            rev_per_s = limits.convert_telegraph(self.name, telegraph)
        given = Logged(
            None if rudder_deg is None else limits.check_rudder(self.name, rudder_deg),
            None if heading_deg is None else limits.check_heading(self.name, heading_deg),
            None if rev_per_s is None else limits.check_revolutions(self.name, rev_per_s),
        )
        self._refuse_failed(given)
        self._wait(given)
        self._memory.timed = ()

    def fail(self, what: str, on: bool) -> None:
        """A failure begins or ends, from the next communication point. Raises InputError."""
        self.require_limits()
        memory = self._memory
        if (what in memory.failures) == on:
            raise InputError(f"{self.name}: {what} is {'on' if on else 'off'} already: give the other")
        if not on:
            memory.failures = tuple(name for name in memory.failures if name != what)
            return
        angle = min(LARGEST_RUDDER, max(-LARGEST_RUDDER, degrees(self.read_machines()[0])))
        self._wait(Logged(angle, None, 0.0 if what == "blackout" else None))
        memory.failures = (*memory.failures, what)

    def require_limits(self) -> ShipLimits:
        """The limits of the ship. Raises InputError for a ship that takes no orders."""
        if self.limits is None:
            raise InputError(
                f"{self.name} takes no orders, it coasts, follows a track or has no rudder and propeller: give it a "
                "ship with [manoeuvring], and hydrodynamics = true"
            )
        return self.limits

    def prepare(self, k: int) -> None:
        """Give the helm what is ordered at communication point k, and log it."""
        if self.limits is None:
            return
        memory = self._memory
        given: Logged | None = None
        while memory.timed and memory.timed[0][0] <= k:
            given = _join(given, self._spare_failed(memory.timed[0][1]))
            memory.timed = memory.timed[1:]
        if memory.waiting is not None:
            given, memory.waiting = _join(given, memory.waiting), None
            steering = self._helm.steering
            if steering is not None and steering.evasion is not None:
                memory.evasion_ended = k
                self._helm.end_evasion()
        if given is None or given == Logged():
            return
        self._log(k, given)
        now = memory.ordered
        self._helm.orders[k] = [radians(now.rudder_deg or 0.0), float(now.rev_per_s or 0.0)]
        if given.heading_deg is not None:
            self._helm.headings[k] = radians(given.heading_deg)
        elif given.rudder_deg is not None:
            self._helm.headings[k] = None

    def save(self) -> dict[str, Any]:
        """The whole state of bridge and helm, for restore()."""
        helm = self._helm
        return {
            "memory": replace(self._memory),
            "logged": len(self.log),
            "helm": (dict(helm.orders), dict(helm.headings), helm.steering, helm.state, dict(helm.changes)),
            "last": helm.last_order,
            "values": (helm.group.values[:], helm.around.values[:] if helm.around is not None else []),
        }

    def restore(self, saved: dict[str, Any]) -> None:
        """Back to what save() gave, which stays as it is."""
        helm = self._helm
        self._memory = replace(saved["memory"])
        self.log.truncate(saved["logged"])
        orders, headings, helm.steering, helm.state, changes = saved["helm"]
        helm.orders, helm.headings, helm.changes = dict(orders), dict(headings), dict(changes)
        helm.last_order = saved["last"]
        helm.group.values[:] = saved["values"][0]
        if helm.around is not None:
            helm.around.values[:] = saved["values"][1]

    def _log(self, k: int, given: Logged) -> None:
        memory = self._memory
        self.log.append(k, given)
        kept = Logged(memory.ordered.rudder_deg, None, memory.ordered.rev_per_s)
        memory.ordered = Logged(
            kept.rudder_deg if given.rudder_deg is None else given.rudder_deg,
            None,
            kept.rev_per_s if given.rev_per_s is None else given.rev_per_s,
        )

    def _wait(self, given: Logged) -> None:
        self._memory.waiting = _join(self._memory.waiting, given)

    def _spare_failed(self, order: Logged) -> Logged:
        """A timed order without the parts that a failure stops."""
        failures = self._memory.failures
        if not failures:
            return order
        return Logged(None, None, None if "blackout" in failures else order.rev_per_s)

    def _refuse_failed(self, given: Logged) -> None:
        failures = self._memory.failures
        if "blackout" in failures:
            raise InputError(f"{self.name} has a blackout and takes no orders until the instructor ends it")
        if "rudder" in failures and (given.rudder_deg is not None or given.heading_deg is not None):
            raise InputError(
                f"{self.name}: the rudder is stuck at {degrees(self.read_machines()[0]):.1f} deg: order revolutions "
                "alone until the instructor ends the failure"
            )


def _refuse_contradictions(
    ship: str, rudder_deg: float | None, heading_deg: float | None, rev_per_s: float | None, telegraph: int | None
) -> None:
    if rudder_deg is not None and heading_deg is not None:
        raise InputError(f"{ship}: rudder_deg and heading_deg are both given: keep one of them")
    if rev_per_s is not None and telegraph is not None:
        raise InputError(f"{ship}: rev_per_s and telegraph are both given: keep one of them")
    if rudder_deg is heading_deg is rev_per_s is telegraph is None:
        raise InputError(f"{ship}: the order is empty: give rudder_deg, heading_deg, rev_per_s or telegraph")


def _list_points(orders: list[TimedOrder], step: float) -> list[tuple[int, Logged]]:
    """Orders of a scenario by communication point; those of one point are joined."""
    points: dict[int, Logged] = {}
    for order in orders:
        k, given = find_point(order.time, step), Logged(order.rudder_deg, order.heading_deg, order.rev_per_s)
        points[k] = _join(points.get(k), given)
    return list(points.items())


def _join(earlier: Logged | None, later: Logged) -> Logged:
    return later if earlier is None else earlier.followed_by(later)
