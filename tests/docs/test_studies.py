"""The studies that the guide shows, and those that are shipped, are read and run."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from shipcollision_fmu import load_scenario
from shipcollision_fmu.study.definition.study import list_study_names, parse_study, read_study
from shipcollision_fmu.study.rows.compute import compute_rows
from tests.docs.test_guide import blocks


def test_the_studies_of_the_guide_are_read(tmp_path: Path) -> None:
    first, pool, data, grid, situations = blocks("studies.md")
    (tmp_path / "traffic.csv").write_text("speed,angle,passages\n5.0,60.0,3\n7.0,90.0,1\n")
    (tmp_path / "situations").mkdir()
    (tmp_path / "situations" / "one.json").write_text(json.dumps({}))
    without = first.partition("[encounter]")[0]
    assert parse_study(first).rows == 10_000
    assert parse_study(first + pool).own.size == 52
    assert parse_study(without + data, folder=tmp_path).tables["traffic"].cumulated.tolist() == [0.75, 1.0]
    assert parse_study((without + grid).replace("rows = 10_000", "")).rows == 10
    assert parse_study(situations, folder=tmp_path).rows == 1


@pytest.mark.parametrize(("name", "rows"), [("quick", 2_000), ("million", 1_000_000), ("closed_forms", 2_000)])
def test_the_shipped_studies_run(name: str, rows: int) -> None:
    """Nearly all of their cases have an impact, of all ships."""
    study = read_study(name)
    assert study.rows == rows
    tables = compute_rows(study, rows - 2000, 2000)
    assert tables.collisions.num_rows > 1900
    assert len(set(tables.encounters.column("own_ship").to_pylist())) == study.own.size


def test_all_shipped_studies_are_in_the_guide() -> None:
    assert list_study_names() == ["closed_forms", "million", "quick"]


def test_the_python_of_the_guide_runs(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    rows, case, closed = blocks("studies.md", "python")
    exec(rows, {})
    assert "energy" in capsys.readouterr().out
    exec(case, {})
    path = capsys.readouterr().out.strip()
    assert path == str(Path("cases", "quick_7.toml"))
    assert load_scenario(path).name == "quick_7"
    exec(closed, {})
    assert 0.9 < float(capsys.readouterr().out) < 1.4
