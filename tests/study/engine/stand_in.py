"""A study of cheap rows, each a function of the seed and of its own number, in the place of a real one.

Its computation may also kill its process, once or always: workers die there as they do out of memory.
"""

from __future__ import annotations

import hashlib
import os
import signal
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow as pa

__all__ = ["StandIn", "Tables", "compute_stand_in"]

ENCOUNTERS = pa.schema(
    [
        pa.field("row", pa.int64(), metadata={"meaning": "number of the row"}),
        pa.field("status", pa.string(), metadata={"meaning": "ok or refused"}),
        pa.field("reason", pa.string(), metadata={"meaning": "why it is refused"}),
        pa.field("energy", pa.float64(), metadata={"unit": "J", "meaning": "energy lost"}),
    ]
)
COLLISIONS = pa.schema(
    [pa.field("row", pa.int64()), pa.field("collision", pa.int32()), pa.field("impulse", pa.float64())]
)


@dataclass(frozen=True)
class StandIn:
    """A study with the interface of a real one."""

    rows: int
    level: str = "sailed"
    seed: int = 1
    pause: float = 0.0
    """Time [s] that each row takes."""
    gate: str = ""
    """A file: rows from `gated` on wait until it is there, so that a test can act while they are out."""
    gated: int = 0
    deadly: int = -1
    """A row that ends its worker when more than `bearable` rows are in its batch."""
    is_killed: bool = True
    """Whether its worker is killed; it raises MemoryError otherwise."""
    bearable: int = 0
    megabytes: int = 0
    """Memory that each row of a batch takes, all together. With more than `bearable` rows it is held until somebody
    ends the worker for it: a nanny on a busy machine is long about that."""
    fails: int = -1
    """A row whose computation raises ValueError."""

    @property
    def text(self) -> str:
        """Stands for the study file."""
        return f"rows = {self.rows}\nseed = {self.seed}\n"

    @property
    def folder(self) -> str:
        """Of its file, which is none."""
        return "."

    @property
    def inputs(self) -> dict[str, str]:
        """It names no other files."""
        return {}

    @property
    def warnings(self) -> list[str]:
        """None."""
        return []

    @property
    def fingerprint(self) -> str:
        """That of what determines the rows."""
        return hashlib.sha256(f"{self.rows} {self.level} {self.seed}".encode()).hexdigest()


@dataclass(frozen=True)
class Tables:
    """The tables of a range of rows."""

    encounters: pa.Table
    collisions: pa.Table


def compute_stand_in(study: StandIn, first: int, count: int, engine: str) -> Tables:
    """The rows of a range: every seventh is refused, and row n has n modulo 3 collisions."""
    if study.pause:
        time.sleep(study.pause * count)
    if study.gate and first + count > study.gated:
        Path(f"{study.gate}.{os.getpid()}").touch()  # says which worker has come to the gate
        while not Path(study.gate).exists():
            time.sleep(0.01)
    if first <= study.deadly < first + count and count > study.bearable:
        if not study.is_killed:
            raise MemoryError
        os.kill(os.getpid(), signal.SIGKILL)
    if first <= study.fails < first + count:
        raise ValueError(f"row {study.fails} cannot be computed")
    if study.megabytes:
        held = np.ones(study.megabytes * count * 2**17)
        time.sleep(600.0 if count > study.bearable else 1.0)
        del held
    rows = np.arange(first, first + count)
    refused = rows % 7 == 0
    reasons = [f"row {row} is refused" if no else None for row, no in zip(rows, refused, strict=True)]
    energy = [np.random.default_rng([study.seed, int(row)]).exponential(1e6) for row in rows]
    hits = np.where(refused, 0, rows % 3)
    owners = np.repeat(rows, hits)
    collisions = np.concatenate([np.arange(number) for number in hits])
    return Tables(
        pa.table(
            {
                "row": rows,
                "status": np.where(refused, "refused", "ok"),
                "reason": pa.array(reasons, pa.string()),
                "energy": pa.array(energy, mask=refused),
            },
            schema=ENCOUNTERS,
        ),
        pa.table({"row": owners, "collision": collisions, "impulse": owners * 0.1}, schema=COLLISIONS),
    )
