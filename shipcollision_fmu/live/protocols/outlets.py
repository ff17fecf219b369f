"""Outlets: NMEA, AIS and DIS of a live session, and its order port.

One thread looks at the latest snapshot 50 times a second and sends what is due in simulated time. Nothing waits for it:
a snapshot that it misses is not sent, and what a receiver does not take is dropped.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from math import radians
from typing import Any, NamedTuple

from ...errors import ShipCollisionError
from ...scenario.scenario import Scenario
from ...scenario.tracks.tangent_plane import TangentPlane
from ...ship.ship_state import ShipState
from ..session.commands import Leave, Order, TakeCommand
from ..session.session import Session
from ..session.snapshot import Snapshot
from .addresses import parse_address
from .feeds import DisFeed, Fleet, NmeaFeed
from .identity import Hull, make_identity
from .order_port import OrderPort, Orders
from .sample import CollisionSample, Sample, ShipSample, Wind
from .senders import Sender, TcpSender, UdpSender

__all__ = ["OutletAddresses", "Outlets", "make_fleet", "make_sample"]

PERIOD = 0.02
"""[s] of wall time between two looks at the session."""


class OutletAddresses(NamedTuple):
    """What a live session is to send and take: addresses as options give them (addresses.py)."""

    nmea: Sequence[str] = ()
    nmea_tcp: str | None = None
    dis: Sequence[str] = ()
    orders: str | None = None
    order_token: str | None = None

    def __bool__(self) -> bool:
        return bool(self.nmea or self.nmea_tcp or self.dis or self.orders)


def make_fleet(scenario: Scenario, own: str) -> Fleet:
    """The ships of a scenario, and where and when it takes place."""
    identities = {}
    for i, (name, ship) in enumerate(scenario.load_ships().items()):
        start = scenario.ships[name]
        ais = start.ais.model_dump(exclude_unset=True) if start.ais is not None else {}
        hull = Hull(ship.kind, ship.L_oa, ship.B, ship.T, ship.mass)
        identities[name] = make_identity(i, name, hull, ais, None if start.recorded is None else start.recorded.mmsi)
    place = scenario.somewhere
    return Fleet(own, identities, TangentPlane(place.latitude, place.longitude), place.start)


def make_sample(snapshot: Snapshot) -> Sample:
    """A snapshot as the encoders need it."""
    wind = snapshot.environment.wind
    return Sample(
        snapshot.time,
        {
            name: ShipSample(ShipState(*ship.eta, *ship.nu), ship.rudder, ship.rev_per_s, bool(ship.failures))
            for name, ship in snapshot.ships.items()
        },
        Wind(wind.speed, radians(wind.from_deg)),
        tuple(CollisionSample(c.id, c.time, c.ship_a, c.ship_b, c.point) for c in snapshot.contact.collisions),
    )


class Outlets:
    """All outlets of a session; start() them, and close() them. Raises HostError for an address that cannot be used,
    InputError for one that is none. `tell` is given a line on the first fault while it sends."""

    def __init__(
        self, session: Session, own: str, addresses: OutletAddresses, tell: Callable[[str], object] = lambda line: None
    ) -> None:
        self._tell = tell
        fleet = make_fleet(session.scenario, own)
        self._session = session
        self.senders: list[Sender] = []
        self._feeds: list[tuple[NmeaFeed | DisFeed, list[Sender]]] = []
        self.orders: OrderPort | None = None
        try:
            nmea: list[Sender] = [UdpSender(*parse_address(at, "udp", "--nmea")) for at in addresses.nmea]
            self.senders += nmea
            if addresses.nmea_tcp is not None:
                nmea.append(TcpSender(*parse_address(addresses.nmea_tcp, "tcp", "--nmea-tcp")))
                self.senders.append(nmea[-1])
            dis: list[Sender] = [UdpSender(*parse_address(at, "udp", "--dis"), "--dis") for at in addresses.dis]
            self.senders += dis
            if addresses.orders is not None:
                at = parse_address(addresses.orders, "tcp", "--orders")
                self.orders = OrderPort(*at, _connect(session), token=addresses.order_token)
        except ShipCollisionError:
            self.close()
            raise
        self._feeds = [(feed, to) for feed, to in ((NmeaFeed(fleet), nmea), (DisFeed(fleet), dis)) if to]
        self.fault: str | None = None
        self._ending, self._step = threading.Event(), -1
        self._thread = threading.Thread(target=self._pump, name="protocols", daemon=True)
        self.silenced = 0

    def start(self) -> None:
        """Begin."""
        self._thread.start()
        if self.orders is not None:
            self.orders.start()

    def close(self) -> None:
        """End, and give the sockets back."""
        if hasattr(self, "_thread") and self._thread.is_alive():
            self._ending.set()
            self._thread.join(2.0)
        for sender in self.senders:
            sender.close()
        if self.orders is not None:
            self.orders.close()

    def _pump(self) -> None:
        while not self._ending.wait(PERIOD):
            try:
                self.send(self._session.snapshot)
            except Exception as fault:  # of ours; what comes later is sent, and somebody is to hear of it
                if self.fault is None:
                    self.fault = f"{type(fault).__name__}: {fault}"
                    self._tell(f"warning: NMEA, AIS and DIS have gaps: {self.fault}")

    def send(self, snapshot: Snapshot) -> None:
        """Send what is due at a snapshot; one that was seen before gives clients alone the chance to come and go."""
        is_new, self._step = snapshot.step_count != self._step, snapshot.step_count
        sample = make_sample(snapshot) if is_new else None
        for feed, senders in self._feeds:
            messages: list[bytes] = []
            if sample is not None:
                try:
                    messages = feed.take(sample)
                except ShipCollisionError:  # farther from [place] than positions on earth go
                    self.silenced += 1
            for sender in senders:
                sender.send(messages)


def _connect(session: Session) -> Orders:
    """The functions of a session that the order port needs."""

    def order(client: str, ship: str, values: Mapping[str, float | int]) -> Any:
        return session.submit(Order(client, ship, **values))  # type: ignore[arg-type]

    def state() -> Mapping[str, Any]:
        now = session.snapshot
        return {
            "time": now.time, "paused": now.paused, "command": dict(now.command),
            "ships": {name: asdict(ship) for name, ship in now.ships.items()},
        }  # fmt: skip

    return Orders(
        take=lambda client, ship, take: session.submit(TakeCommand(client, ship, take)),
        order=order,
        in_command=lambda ship: session.snapshot.command.get(ship),
        leave=lambda client: session.submit(Leave(client)),
        state=state,
        refused=session.count_refused,
    )
