"""A checksum of a ship's numbers, by which a saved state recognises the ship that it belongs to."""

from __future__ import annotations

from dataclasses import fields
from zlib import crc32

import numpy as np
from pydantic import BaseModel

from .ship import Ship

__all__ = ["compute_checksum"]

_WORDS = frozenset({"source", "estimated", "suspicious"})
"""Fields that no model reads."""


def compute_checksum(ship: Ship) -> int:
    """CRC-32 of all numbers of a ship. Where its files lie makes no difference; what a mesh file holds is not in it."""
    checksum = 0
    for field in fields(ship):
        value = getattr(ship, field.name)
        if field.name in _WORDS:
            continue
        if isinstance(value, np.ndarray):
            checksum = crc32(value.tobytes(), checksum)
        else:
            text = value.model_dump(exclude={"file"}) if isinstance(value, BaseModel) else value
            checksum = crc32(repr(text).encode(), checksum)
    return checksum
