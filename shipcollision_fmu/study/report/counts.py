"""Numbers of cases in words."""

from __future__ import annotations

__all__ = ["count_cases", "group"]


def count_cases(count: int, before: str = "") -> str:
    """`1 case`, `4 972 cases`; before: words between the number and the noun."""
    return f"{group(count)} {before}{'case' if count == 1 else 'cases'}"


def group(count: int) -> str:
    """A number with thin gaps between thousands."""
    return f"{count:,}".replace(",", "\N{NARROW NO-BREAK SPACE}")
