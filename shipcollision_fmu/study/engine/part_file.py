"""A part as the bytes of a Parquet file, and its mark: whose rows they are, and how many.

The bytes depend on the tables alone: one row group, fixed compression, no time and no name of a machine. The mark
stands in the metadata of the schema beside units and meanings, so that --resume reads the end of a file only.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from .interface import RowTables
from .parts import Part

__all__ = [
    "Mark",
    "PartBytes",
    "Tables",
    "check_rows",
    "encode",
    "encode_part",
    "join_tables",
    "pack",
    "read_mark",
    "unpack",
]

KEY = b"shipcollision.part"
"""Key of the mark in the metadata of the schema. Other programs pass over it."""
AT_END = "contact_at_end"


@dataclass(frozen=True)
class Mark:
    """What a file of a part says of itself."""

    fingerprint: str
    first: int
    last: int
    refused: int
    """Rows that are refused cases."""
    collisions: int
    contact_at_end: int = 0
    """Rows that end with hulls that touch."""


@dataclass(frozen=True)
class PartBytes:
    """Both files of a part."""

    part: Part
    encounters: bytes
    collisions: bytes
    mark: Mark


@dataclass(frozen=True)
class Tables:
    """Tables of a range of rows."""

    encounters: pa.Table
    collisions: pa.Table


def pack(table: pa.Table) -> bytes:
    """A table as bytes that give back exactly this table, metadata included."""
    sink = pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, table.schema, options=pa.ipc.IpcWriteOptions(compression="zstd")) as writer:
        writer.write_table(table.combine_chunks())
    return bytes(sink.getvalue())


def unpack(data: bytes) -> pa.Table:
    """The table of these bytes."""
    return pa.ipc.open_stream(data).read_all()


def encode(table: pa.Table) -> bytes:
    """A table as the bytes of a Parquet file."""
    sink = pa.BufferOutputStream()
    pq.write_table(
        table.combine_chunks(), sink, row_group_size=max(1, table.num_rows), compression="zstd", compression_level=1
    )
    return bytes(sink.getvalue())


def encode_part(tables: RowTables, part: Part, fingerprint: str) -> PartBytes:
    """Both files of a part, of the tables of all its rows."""
    refused = pc.sum(pc.equal(tables.encounters["status"], "refused")).as_py() or 0
    at_end = 0
    if AT_END in tables.encounters.column_names:
        at_end = pc.sum(tables.encounters[AT_END]).as_py() or 0
    mark = Mark(fingerprint, part.first, part.last, refused, tables.collisions.num_rows, at_end)
    return PartBytes(part, encode(_put_mark(tables.encounters, mark)), encode(_put_mark(tables.collisions, mark)), mark)


def join_tables(pieces: Iterable[RowTables]) -> Tables:
    """Tables of ranges of rows, one below the other."""
    listed = list(pieces)
    return Tables(
        pa.concat_tables([piece.encounters for piece in listed]),
        pa.concat_tables([piece.collisions for piece in listed]),
    )


def check_rows(tables: RowTables, first: int, count: int) -> None:
    """Raises RuntimeError, a fault of this package, unless the tables have the rows of a range, each once."""
    rows = tables.encounters["row"].to_numpy()
    expected = range(first, first + count)
    if len(rows) != count or any(rows != expected):
        raise RuntimeError(f"rows {first} to {first + count - 1} were computed as {len(rows)} other rows")
    owners = tables.collisions["row"].to_numpy()
    if len(owners) and not (first <= owners.min() and owners.max() < first + count):
        raise RuntimeError(f"collisions of rows {owners.min()} to {owners.max()} are not of rows {first} and following")


def read_mark(path: Path) -> Mark | None:
    """The mark of a part's file; None where it is missing, cut short, or no file of a study."""
    try:
        with pq.ParquetFile(path) as file:
            found = (file.schema_arrow.metadata or {}).get(KEY)
        return None if found is None else Mark(**json.loads(found))
    except (OSError, pa.ArrowInvalid, ValueError, TypeError):
        return None


def _put_mark(table: pa.Table, mark: Mark) -> pa.Table:
    """A table with the mark in the metadata of its schema."""
    text = json.dumps(asdict(mark), sort_keys=True).encode()
    return table.replace_schema_metadata({**(table.schema.metadata or {}), KEY: text})
