"""UDP and TCP senders that never wait: what cannot be sent at once is dropped, by TCP together with the client.

All sockets are non-blocking, and one thread calls a sender. A counter says how many messages, or clients, were dropped.
"""

from __future__ import annotations

import socket
from collections.abc import Sequence
from typing import Protocol

from .addresses import listen, resolve

__all__ = ["MOST_CLIENTS", "MOST_PENDING", "Sender", "TcpSender", "UdpSender"]

MOST_CLIENTS = 16
"""Clients of a TCP sender; more are turned away."""
MOST_PENDING = 65_536
"""Bytes that wait for a slow client, some 40 s of sentences; with more it is dropped."""


class Sender(Protocol):
    """What takes messages and passes them on."""

    dropped: int

    def send(self, messages: Sequence[bytes]) -> None:
        """Send messages, or drop them; returns at once."""

    def close(self) -> None:
        """Give the sockets back."""


class UdpSender:
    """A datagram for each message to one receiver, also a broadcast or multicast address."""

    def __init__(self, host: str, port: int, option: str = "--nmea") -> None:
        family, self._address = resolve(host, port, option)
        self._socket = socket.socket(family, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
        self.dropped = 0

    def send(self, messages: Sequence[bytes]) -> None:
        """See Sender."""
        for message in messages:
            try:
                self._socket.sendto(message, self._address)
            except OSError:  # full, nobody there, no network: the next one may do
                self.dropped += 1

    def close(self) -> None:
        """See Sender."""
        self._socket.close()


class TcpSender:
    """A server: every client has every message from when it comes on. What clients send is read and thrown away."""

    def __init__(self, host: str, port: int, option: str = "--nmea-tcp") -> None:
        self._listening = listen(host, port, option)
        self._clients: dict[socket.socket, bytearray] = {}
        self.dropped = 0

    @property
    def port(self) -> int:
        """The port, also where 0 was given."""
        return int(self._listening.getsockname()[1])

    @property
    def clients(self) -> int:
        """Clients now."""
        return len(self._clients)

    def send(self, messages: Sequence[bytes]) -> None:
        """See Sender."""
        self._accept()
        data = b"".join(messages)
        for client, pending in list(self._clients.items()):
            pending += data
            if not self._flush(client, pending) or len(pending) > MOST_PENDING:
                self._drop(client)

    def close(self) -> None:
        """See Sender."""
        for client in list(self._clients):
            self._drop(client)
        self._listening.close()

    def _accept(self) -> None:
        while True:
            try:
                client, _ = self._listening.accept()
            except OSError:
                return
            if len(self._clients) >= MOST_CLIENTS:
                client.close()
                self.dropped += 1
                continue
            client.setblocking(False)
            self._clients[client] = bytearray()

    def _flush(self, client: socket.socket, pending: bytearray) -> bool:
        """Send what goes at once; False for a client that has gone."""
        try:
            if client.recv(4096) == b"":
                return False
        except BlockingIOError:
            pass
        except OSError:
            return False
        try:
            while pending:
                del pending[: client.send(pending)]
        except BlockingIOError:
            pass
        except OSError:
            return False
        return True

    def _drop(self, client: socket.socket) -> None:
        del self._clients[client]
        client.close()
        self.dropped += 1
