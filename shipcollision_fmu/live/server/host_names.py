"""The hosts by which browsers reach a server: an address such as 0.0.0.0, at which it listens, leads nowhere."""

from __future__ import annotations

import socket
from contextlib import suppress
from ipaddress import ip_address
from typing import NamedTuple

__all__ = ["Hosts", "find_hosts", "list_own_addresses"]

OUTSIDE = {socket.AF_INET: "192.0.2.1", socket.AF_INET6: "2001:db8::1"}
"""Addresses for documents (RFC 5737, RFC 3849). Nothing is sent there: the system only chooses the way."""


class Hosts(NamedTuple):
    """Hosts as they stand in an address: `here` for this machine; `elsewhere` for others, if those are not the same."""

    here: str
    elsewhere: tuple[str, ...] = ()


def find_hosts(listening: socket.socket) -> Hosts:
    """The hosts of a socket that listens."""
    at = ip_address(str(listening.getsockname()[0]).partition("%")[0])
    if not at.is_unspecified:
        return Hosts(_bracket(str(at)))
    families = [listening.family]
    if listening.family == socket.AF_INET6 and not listening.getsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY):
        families.append(socket.AF_INET)
    here = "127.0.0.1" if socket.AF_INET in families else "[::1]"
    return Hosts(here, tuple(_bracket(address) for family in families for address in list_own_addresses(family)))


def list_own_addresses(family: int) -> list[str]:
    """The addresses of this machine that others may reach: that of its usual way out first, then those of its name."""
    found: list[str] = []
    with suppress(OSError), socket.socket(family, socket.SOCK_DGRAM) as probe:
        probe.connect((OUTSIDE[socket.AddressFamily(family)], 9))
        found.append(str(probe.getsockname()[0]))
    with suppress(OSError):
        found += [str(at[4][0]) for at in socket.getaddrinfo(socket.gethostname(), None, family, socket.SOCK_STREAM)]
    return [address for address in dict.fromkeys(found) if _is_for_others(address)]


def _is_for_others(address: str) -> bool:
    at = ip_address(address.partition("%")[0])
    return not (at.is_loopback or at.is_link_local or at.is_unspecified)


def _bracket(address: str) -> str:
    return f"[{address}]" if ":" in address else address
