"""Who may come in: tokens, the Origin of a page, and how many messages a client may send.

A token is in the address that is printed, one for the bridge and one for the instructor, who may do more. A WebSocket
that a browser opens has the Origin of its page: it must be this server's own, so that no page from elsewhere can use a
token that it came by. Programs send no Origin.
"""

from __future__ import annotations

import secrets
from dataclasses import dataclass, field
from ipaddress import ip_address
from urllib.parse import urlsplit

__all__ = [
    "AT_ONCE", "PER_SECOND", "REFUSED_AT_ONCE", "REFUSED_PER_SECOND", "Allowance", "Tokens", "is_own_origin",
]  # fmt: skip

PER_SECOND, AT_ONCE = 60.0, 120.0
"""Messages of a client in a second, and at once. A hand on a wheel sends some 20 a second."""
REFUSED_PER_SECOND, REFUSED_AT_ONCE = 20.0, 1000.0
"""Of those beyond, how many are refused in a second, and at once, before the client is dropped."""


@dataclass(frozen=True)
class Tokens:
    """The tokens of a server, by role."""

    bridge: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    instructor: str = field(default_factory=lambda: secrets.token_urlsafe(24))

    def admits(self, token: str, role: str) -> bool:
        """Whether the token admits to that role: the instructor's admits to both."""
        is_instructor = secrets.compare_digest(token.encode(), self.instructor.encode())
        is_bridge = secrets.compare_digest(token.encode(), self.bridge.encode())
        return is_instructor or (is_bridge and role == "bridge")


def is_own_origin(origin: str | None, host: str, names: frozenset[str]) -> bool:
    """Whether a page of that Origin is one of this server, which was asked as `host`. `names` are the server's own.

    A name that is neither an address nor one of `names` could be anyone's, who lets it lead here.
    """
    if origin is None:
        return True
    try:
        parts = urlsplit(origin)
        name = parts.hostname or ""
    except ValueError:
        return False
    if parts.scheme not in ("http", "https") or parts.netloc.lower() != host.lower():
        return False
    return name in names or _is_address(name)


def _is_address(name: str) -> bool:
    try:
        ip_address(name)
    except ValueError:
        return False
    return True


@dataclass
class Allowance:
    """How many messages a client may send now: a bucket that fills with time. `now` is a wall time [s]."""

    now: float
    per_second: float
    at_once: float
    left: float = field(init=False)

    def __post_init__(self) -> None:
        self.left = self.at_once

    def take(self, now: float) -> bool:
        """Whether one more is allowed."""
        self.left = min(self.at_once, self.left + (now - self.now) * self.per_second)
        self.now = now
        if self.left < 1.0:
            return False
        self.left -= 1.0
        return True
