"""Times of recordings: ISO 8601, day/month/year as the Danish archive has them, seconds or milliseconds since 1970.

A time without a zone is UTC, as all of AIS is.
"""

from __future__ import annotations

import re
from datetime import datetime, timezone

__all__ = ["format_time", "parse_time"]

_FORMS = ("%d/%m/%Y %H:%M:%S", "%d/%m/%Y %H:%M", "%Y/%m/%d %H:%M:%S")
_NUMBER = re.compile(r"\d{9,10}(\.\d+)?|\d{12,13}")
MILLISECONDS = 1e11
"""Numbers above it are milliseconds: as seconds they would be of the year 5138."""


def parse_time(text: str) -> float | None:
    """Seconds since 1970 UTC; None for a text that is no time."""
    text = text.strip()
    if _NUMBER.fullmatch(text):
        number = float(text)
        return number / 1000.0 if number > MILLISECONDS else number
    for form in _FORMS:
        try:
            return datetime.strptime(text, form).replace(tzinfo=timezone.utc).timestamp()
        except ValueError:
            continue
    try:
        found = datetime.fromisoformat(text.replace("Z", "+00:00").removesuffix(" UTC"))
    except ValueError:
        return None
    return (found if found.tzinfo else found.replace(tzinfo=timezone.utc)).timestamp()


def format_time(seconds: float) -> str:
    """The time in ISO 8601, e.g. 2026-01-01T00:00:00Z, with decimals where it has any."""
    text = datetime.fromtimestamp(round(seconds, 3), timezone.utc).isoformat(timespec="milliseconds")
    return text.removesuffix("+00:00").removesuffix(".000") + "Z"
