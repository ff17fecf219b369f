"""The commonest reason for which cases are refused."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple

__all__ = ["CommonReason", "find_commonest"]

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


class CommonReason(NamedTuple):
    """Cases that have it, and its text as most of them have it."""

    cases: int
    text: str


def find_commonest(counts: Mapping[str, int]) -> CommonReason:
    """The commonest of the reasons, of which there is at least one; counts: cases by text.

    Texts that differ in their numbers alone, such as speeds and numbers of ships, are one reason.
    """
    alike: dict[str, list[str]] = {}
    for text in counts:
        alike.setdefault(NUMBER.sub("#", text), []).append(text)
    found = max(alike.values(), key=lambda texts: sum(counts[text] for text in texts))
    return CommonReason(sum(counts[text] for text in found), max(found, key=lambda text: counts[text]))
