"""compute_batch(): what a worker does with a batch. Its answer is bytes, which the client writes; a whole part may be
written by a worker that has the disk of the study, and then the client moves its files into place."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from ... import __version__
from ...errors import HostError
from .batches import Batch
from .interface import ComputeRows, Study
from .part_file import PartBytes, check_rows, encode_part, pack
from .part_files import PartFiles, write_part
from .versions import describe_other_version

__all__ = ["Answer", "compute_batch"]


@dataclass(frozen=True)
class Answer:
    """The rows of a batch, and the time [s] that they took."""

    batch: Batch
    encounters: bytes
    collisions: bytes
    seconds: float
    part: PartBytes | PartFiles | None = None
    """The files, where the batch is a whole part: then the client only writes or moves them."""


def compute_batch(
    study: Study,
    compute: ComputeRows,
    engine: str,
    batch: Batch,
    version: str = __version__,
    aside: Path | None = None,
) -> Answer:
    """The rows of a batch. version: that of the client; another one here raises HostError.

    aside: folder for the files of a whole part, where this process has the disk of the study; None: bytes.
    """
    if version != __version__:
        raise HostError(describe_other_version("a worker", __version__, version))
    begin = perf_counter()
    tables = compute(study, batch.first, batch.count, engine)
    check_rows(tables, batch.first, batch.count)
    if batch.is_whole:
        encoded = encode_part(tables, batch.part, study.fingerprint)
        part = encoded if aside is None else write_part(encoded, aside)
        return Answer(batch, b"", b"", perf_counter() - begin, part)
    encounters, collisions = pack(tables.encounters), pack(tables.collisions)
    return Answer(batch, encounters, collisions, perf_counter() - begin)
