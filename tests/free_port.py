"""A port that stays free until the server that a test starts listens there."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["hold_free_port"]


@contextmanager
def hold_free_port() -> Iterator[int]:
    """A port of loopback that no other program is given meanwhile, but that a server may listen at.

    The socket that holds it does not listen. Linux then lets a second socket take the port where both have
    SO_REUSEADDR, as servers have; it gives a bound port to nobody who asks for any that is free.
    """
    with socket.socket() as holding:
        holding.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        holding.bind(("127.0.0.1", 0))
        yield int(holding.getsockname()[1])
