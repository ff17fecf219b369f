"""Navigators' units in SI units."""

from __future__ import annotations

__all__ = ["KNOT"]

KNOT = 1852.0 / 3600.0
"""[m/s] A nautical mile an hour, exact by definition."""
