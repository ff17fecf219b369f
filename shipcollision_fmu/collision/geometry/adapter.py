"""The adapter that gives closest points: PyBullet where it can be imported, this package's own library elsewhere."""

from __future__ import annotations

import os
from collections.abc import Sequence

from ...errors import HostError, InputError
from ...ship.hull.solid import HullMesh
from .bullet import BulletAdapter, bullet_module, has_pybullet
from .closest_points import PlacedHulls, open_library
from .narrow_phase import NarrowPhase

__all__ = ["CHOICE", "choose_adapter", "open_narrow_phase"]

CHOICE = "SHIPCOLLISION_NARROW_PHASE"
"""Environment variable that forces one of both: "pybullet" or "library". Results are the same to the bit."""


def open_narrow_phase(hulls: Sequence[HullMesh], choice: str | None = None) -> NarrowPhase:
    """The narrow phase of these hulls, their vertices in b about CO [m].

    choice: "pybullet" or "library"; None: what the environment variable says, else PyBullet if it can be imported.
    Raises HostError when neither can be had.
    """
    return BulletAdapter(hulls) if choose_adapter(choice) == "pybullet" else PlacedHulls(hulls)


def choose_adapter(choice: str | None = None) -> str:
    """Which adapter open_narrow_phase takes, "pybullet" or "library". Raises HostError when it cannot be had."""
    chosen = choice or os.environ.get(CHOICE) or ("pybullet" if has_pybullet() else "")
    if chosen == "pybullet":
        bullet_module()
    elif chosen == "library":
        open_library()
    elif chosen:
        raise InputError(f"{CHOICE} = {chosen!r} must be 'pybullet' or 'library'; leave it out for what is there")
    else:
        _open_in_its_place()
    return chosen or "library"


def _open_in_its_place() -> None:
    try:
        open_library()
    except HostError as error:
        raise HostError(
            "contacts cannot be detected: pybullet, with wheels for CPython 3.10 and 3.11 on Linux (x86-64), is not "
            f"installed, and this package's own library is missing: {error}"
        ) from error
