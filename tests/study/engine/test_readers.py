"""The programs that the guide shows read a study, finished or while it grows, and find the same rows."""

from __future__ import annotations

from pathlib import Path

import duckdb
import pandas as pd
import polars as pl
import pytest

from shipcollision_fmu.study.engine.folder import StudyFolder
from shipcollision_fmu.study.engine.part_file import PartBytes
from shipcollision_fmu.study.engine.run import run_study
from tests.study.engine.folders import STUDY
from tests.study.engine.stand_in import compute_stand_in


def count_with_all(folder: Path) -> list[tuple[int, int]]:
    """Rows and collisions that pandas, Polars and DuckDB find."""
    return [
        (len(pd.read_parquet(folder / "encounters")), len(pd.read_parquet(folder / "collisions"))),
        tuple(
            pl.scan_parquet(folder / table / "*.parquet").select(pl.len()).collect().item()
            for table in ("encounters", "collisions")
        ),
        tuple(
            duckdb.sql(f"SELECT count(*) FROM '{folder}/{table}/*.parquet'").fetchall()[0][0]
            for table in ("encounters", "collisions")
        ),
    ]  # type: ignore[list-item]


def test_they_read_a_study_while_it_grows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out, write, found = tmp_path / "study", StudyFolder.write, []

    def write_and_read(folder: StudyFolder, part: PartBytes) -> None:
        write(folder, part)
        found.append(count_with_all(out))

    monkeypatch.setattr(StudyFolder, "write", write_and_read)
    run_study(STUDY, out, workers=0, engine="python", compute=compute_stand_in)
    for number, counts in enumerate(found):
        rows = min(200 * (number + 1), 1010)
        assert counts == [(rows, sum(row % 3 for row in range(rows) if row % 7))] * 3
    assert len(found) == 6


def test_they_read_the_same_numbers(whole: Path) -> None:
    expected = pd.read_parquet(whole / "encounters")["energy"].quantile(0.9)
    assert expected > 1e6
    assert pl.read_parquet(whole / "encounters" / "*.parquet")["energy"].quantile(0.9, "linear") == pytest.approx(
        expected
    )
    asked = f"SELECT quantile_cont(energy, 0.9) FROM '{whole}/encounters/*.parquet'"
    assert duckdb.sql(asked).fetchall()[0][0] == pytest.approx(expected)
