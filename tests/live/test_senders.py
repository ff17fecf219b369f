"""Senders never wait: nobody there, a client that does not read, too many clients; and what a live session sends."""

from __future__ import annotations

import socket
from collections.abc import Iterator

import pyais
import pytest

from shipcollision_fmu import load_scenario
from shipcollision_fmu.errors import HostError, InputError
from shipcollision_fmu.live.protocols.addresses import parse_address
from shipcollision_fmu.live.protocols.feeds import NmeaFeed
from shipcollision_fmu.live.protocols.outlets import OutletAddresses, Outlets
from shipcollision_fmu.live.protocols.sample import Sample
from shipcollision_fmu.live.protocols.senders import MOST_CLIENTS, MOST_PENDING, TcpSender, UdpSender
from shipcollision_fmu.live.session.commands import End
from shipcollision_fmu.live.session.session import Session
from tests.live.live_server import PATIENCE, eventually

LINE = b"$IIHDT,180.0,T*2B\r\n"


@pytest.fixture
def receiver() -> Iterator[socket.socket]:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as made:
        made.bind(("127.0.0.1", 0))
        made.settimeout(PATIENCE)
        yield made


@pytest.fixture
def server() -> Iterator[TcpSender]:
    made = TcpSender("127.0.0.1", 0)
    yield made
    made.close()


def connect(server: TcpSender) -> socket.socket:
    client = socket.create_connection(("127.0.0.1", server.port), timeout=PATIENCE)
    before = server.clients
    while server.clients == before:
        server.send([])
    return client


@pytest.mark.parametrize(
    ("text", "scheme", "address"),
    [
        ("udp://127.0.0.1:10110", "udp", ("127.0.0.1", 10110)),
        ("10110", "udp", ("127.0.0.1", 10110)),
        ("tcp://chart.local:4000", "tcp", ("chart.local", 4000)),
        ("[::1]:4000", "tcp", ("::1", 4000)),
    ],
)
def test_addresses_are_loopback_unless_told(text: str, scheme: str, address: tuple[str, int]) -> None:
    assert parse_address(text, scheme, "--nmea") == address


@pytest.mark.parametrize("text", ["", "tcp://127.0.0.1:1", "127.0.0.1", "udp://", "1:2:3", "70000", "0", "udp://a b:1"])
def test_what_is_no_address_is_refused(text: str) -> None:
    with pytest.raises(InputError, match=r"--nmea .*: give one such as udp://127.0.0.1:10110, or 10110"):
        parse_address(text, "udp", "--nmea")


def test_udp_goes_on_where_nobody_listens(receiver: socket.socket) -> None:
    host, port = receiver.getsockname()
    sender = UdpSender(host, port)
    sender.send([LINE])
    assert receiver.recv(1000) == LINE
    receiver.close()
    for _ in range(100):
        sender.send([LINE])
    lost = sender.dropped  # some systems say that nobody was there
    sender.send([bytes(70_000)])  # more than a datagram holds
    assert sender.dropped == lost + 1
    sender.close()


def test_unknown_hosts_are_refused() -> None:
    with pytest.raises(HostError, match=r"--nmea no.such.host.invalid:1: .*; give an address that exists"):
        UdpSender("no.such.host.invalid", 1)


def test_tcp_clients_come_and_go(server: TcpSender) -> None:
    first, second = connect(server), connect(server)
    server.send([LINE, LINE])
    assert first.recv(1000) == second.recv(1000) == LINE + LINE
    first.sendall(b"GET / HTTP/1.1\r\n\r\n")  # whatever it says
    second.close()
    eventually(lambda: server.send([LINE]) or server.clients < 2)
    assert (server.clients, server.dropped) == (1, 1)
    first.close()


def test_a_slow_client_is_dropped_and_nobody_waits_for_it(server: TcpSender) -> None:
    """A call that waits for the slow one does not return: nobody reads for it. Nor does one wait for a while only, as
    no socket has a time for which it does."""
    slow, fast = connect(server), connect(server)
    assert {client.gettimeout() for client in server._clients} == {0.0}
    chunk, read = LINE * 1000, 0
    fast.setblocking(False)
    for _ in range(10_000):
        server.send([chunk])
        while True:
            try:
                read += len(fast.recv(1 << 20))
            except BlockingIOError:
                break
        if server.dropped:
            break
    assert (server.clients, server.dropped) == (1, 1)
    assert read > MOST_PENDING
    slow.close()
    fast.close()


def test_more_clients_than_room_are_turned_away(server: TcpSender) -> None:
    clients = [connect(server) for _ in range(MOST_CLIENTS)]
    late = socket.create_connection(("127.0.0.1", server.port), timeout=PATIENCE)
    server.send([LINE])
    assert late.recv(10) == b""
    assert server.clients == MOST_CLIENTS
    for client in (*clients, late):
        client.close()


def test_a_live_session_speaks_to_all(receiver: socket.socket) -> None:
    """Simulated time goes 20 times as fast: within a second of it, every kind of sentence of 1 Hz has come."""
    session = Session(load_scenario("kvlcc2_crossing"), rate=20.0)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as dis:
        dis.bind(("127.0.0.1", 0))
        dis.settimeout(PATIENCE)
        addresses = OutletAddresses(
            nmea=[f"udp://127.0.0.1:{receiver.getsockname()[1]}"], dis=[str(dis.getsockname()[1])]
        )
        outlets = Outlets(session, "own", addresses)
        session.start()
        outlets.start()
        try:
            kinds: set[str] = set()
            while kinds < {"RMC", "GGA", "VTG", "HDT", "ROT", "RSA", "RPM", "MWV", "VDO", "VDM"}:
                line = receiver.recv(1000)
                kinds.add(line[3:6].decode())
                if line[3:6] == b"VDO" and line[7:8] == b"1":
                    assert pyais.decode(line).mmsi == 200000001
            assert {dis.recv(1000)[2], dis.recv(1000)[2]} == {1}
        finally:
            outlets.close()
            session.submit(End())
            assert session.join(PATIENCE)
    assert session.error is None


def test_a_fault_while_sending_is_told_once_and_what_comes_later_is_sent(
    receiver: socket.socket, monkeypatch: pytest.MonkeyPatch
) -> None:  # fmt: skip
    session, told, left = Session(load_scenario("kvlcc2_crossing"), rate=20.0), list[str](), [3]
    take = NmeaFeed.take

    def fail_at_first(feed: NmeaFeed, sample: Sample) -> list[bytes]:
        left[0] -= 1
        if left[0] >= 0:
            raise ZeroDivisionError("oops")
        return take(feed, sample)

    monkeypatch.setattr(NmeaFeed, "take", fail_at_first)
    outlets = Outlets(session, "own", OutletAddresses((f"udp://127.0.0.1:{receiver.getsockname()[1]}",)), told.append)
    session.start()
    outlets.start()
    try:
        assert receiver.recv(1000).startswith((b"$", b"!"))
    finally:
        outlets.close()
        session.submit(End())
        assert session.join(PATIENCE)
    assert told == ["warning: NMEA, AIS and DIS have gaps: ZeroDivisionError: oops"]
