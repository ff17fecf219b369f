"""count_reasons(): why rows of a study are refused."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pyarrow.parquet as pq

__all__ = ["count_reasons"]


def count_reasons(folder: Path) -> Counter[str]:
    """Rows by the text of their reason, in the tables of a study's folder."""
    counts: Counter[str] = Counter()
    for path in (folder / "encounters").glob("part-*.parquet"):
        for found in pq.read_table(path, columns=["reason"])["reason"].value_counts().to_pylist():
            if found["values"] is not None:
                counts[found["values"]] += found["counts"]
    return counts
