"""Addresses as options give them: udp://HOST:PORT, HOST:PORT, or a PORT of this machine."""

from __future__ import annotations

import re
import socket
from ipaddress import ip_address
from typing import Any

from ...errors import HostError, InputError

__all__ = ["LOOPBACK", "is_loopback", "listen", "parse_address", "resolve"]

LOOPBACK = "127.0.0.1"
_FORM = re.compile(r"(?:(?P<scheme>udp|tcp)://)?(?:(?P<host>\[[0-9a-fA-F:]+\]|[^:/\s\[\]]+):)?(?P<port>\d{1,5})")


def parse_address(text: str, scheme: str, option: str) -> tuple[str, int]:
    """Host and port; without a host the loopback one. Raises InputError for another scheme, and for no address."""
    found = _FORM.fullmatch(text.strip())
    example = f"{scheme}://{LOOPBACK}:10110, or 10110"
    if found is None or (found["scheme"] or scheme) != scheme:
        raise InputError(f"{option} {text!r} is no address: give one such as {example}")
    port = int(found["port"])
    if not 0 < port <= 65535:
        raise InputError(f"{option} {text!r}: port {port} must be 1 to 65535: give one such as {example}")
    return (found["host"] or LOOPBACK).strip("[]"), port


def is_loopback(host: str) -> bool:
    """Whether this machine alone reaches a host's address; False for a name that is not known."""
    try:
        found = {str(at[4][0]) for at in socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)}
    except OSError:
        return False
    return all(ip_address(address.partition("%")[0]).is_loopback for address in found)


def resolve(host: str, port: int, option: str) -> tuple[int, Any]:
    """Family and socket address of a UDP receiver. Raises HostError for a host that is not known."""
    try:
        family, _, _, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_DGRAM)[0]
    except OSError as error:
        raise HostError(f"{option} {host}:{port}: {error.strerror or error}; give an address that exists") from None
    return family, address


def listen(host: str, port: int, option: str) -> socket.socket:
    """A TCP socket that listens, and does not block. Raises HostError when the address is in use or is not ours."""
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        listening = socket.socket(family, socket.SOCK_STREAM)
    except OSError as error:
        raise HostError(f"{option} {host}:{port}: {error.strerror or error}; give an address of this machine") from None
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind((host, port))
        listening.listen(16)
    except OSError as error:
        listening.close()
        raise HostError(f"{option} {host}:{port}: {error.strerror or error}; give another port") from None
    listening.setblocking(False)
    return listening
