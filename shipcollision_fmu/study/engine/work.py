"""compute_batch(): what a worker does with a batch. Its answer is bytes, which the client writes."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter

from ... import __version__
from ...errors import HostError
from .batches import Batch
from .interface import ComputeRows, Study
from .part_file import PartBytes, check_rows, encode_part, pack
from .versions import describe_other_version

__all__ = ["Answer", "compute_batch"]


@dataclass(frozen=True)
class Answer:
    """The rows of a batch, and the time [s] that they took."""

    batch: Batch
    encounters: bytes
    collisions: bytes
    seconds: float
    part: PartBytes | None = None
    """The files, where the batch is a whole part: then the client only writes them."""


def compute_batch(study: Study, compute: ComputeRows, engine: str, batch: Batch, version: str = __version__) -> Answer:
    """The rows of a batch. version: that of the client; another one here raises HostError."""
    if version != __version__:
        raise HostError(describe_other_version("a worker", __version__, version))
    begin = perf_counter()
    tables = compute(study, batch.first, batch.count, engine)
    check_rows(tables, batch.first, batch.count)
    if batch.is_whole:
        part = encode_part(tables, batch.part, study.fingerprint)
        return Answer(batch, b"", b"", perf_counter() - begin, part)
    encounters, collisions = pack(tables.encounters), pack(tables.collisions)
    return Answer(batch, encounters, collisions, perf_counter() - begin)
