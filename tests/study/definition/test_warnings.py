"""Studies that are allowed and hardly meant: a line each, and none for studies as they should be."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from shipcollision_fmu.cli import main
from shipcollision_fmu.study.definition.study import list_study_names, parse_study, read_study

STUDY = """
[study]
name = "mine"
level = "impact"
{rows}
[own]
ships = {ships}
[encounter]
{encounter}
{more}
"""
DRAWN = 'at = {distribution = "uniform", least = -0.4, most = 0.4}\n'
NORMAL = 'angle_deg = {distribution = "normal", mean = 1.4, sd = 0.6, least = 0.1, most = %s}'


def warn(folder: Path, encounter: str, more: str = "", ships: str = '["kcs"]', rows: str = "rows = 24") -> list[str]:
    (folder / "angles.csv").write_text("angle\n1.0\n1.5\n")
    text = STUDY.format(rows=rows, ships=ships, encounter=encounter, more=more)
    return parse_study(text, folder=folder).warnings


ALIKE = "as no variable has a distribution and there is one ship of each role: give one, or fewer rows"
RADIANS = "degrees in all rows: give degrees if these are radians"


def test_rows_that_are_all_alike(tmp_path: Path) -> None:
    assert warn(tmp_path, "angle_deg = 90.0") == [f"all 24 rows are alike, {ALIKE}"]
    grid = "[grid]\nat = [0.0, 0.1, 0.2]"
    assert warn(tmp_path, "", grid) == [f"each of the 3 cells has 8 rows that are alike, {ALIKE}"]


@pytest.mark.parametrize(
    ("encounter", "more", "most"),
    [
        (NORMAL % "3.1", "", "3.1"),
        ("angle_deg = 1.5708", "", "1.571"),
        ('angle_deg = {table = "data", column = "angle"}', '[tables.data]\nfile = "angles.csv"', "1.5"),
        ("", "[grid]\nangle_deg = [0.5, 1.5]", "1.5"),
    ],
)
def test_angles_that_look_like_radians(tmp_path: Path, encounter: str, more: str, most: str) -> None:
    assert warn(tmp_path, DRAWN + encounter, more) == [f"angle_deg is at most {most} {RADIANS}"]


def test_studies_as_they_should_be(tmp_path: Path) -> None:
    assert [read_study(name).warnings for name in list_study_names()] == [[], [], []]
    assert warn(tmp_path, "", ships='["kcs", "kvlcc2"]') == []
    assert warn(tmp_path, "", rows="rows = 1") == []
    assert warn(tmp_path, "", "[grid]\nat = [0.0, 0.1, 0.2]", rows="") == []
    assert warn(tmp_path, DRAWN + NORMAL % "3.2") == []
    assert warn(tmp_path, DRAWN + 'kind = "overtaking"\nangle_deg = 0.0') == []


def test_a_warning_stands_on_stderr_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = STUDY.format(rows="rows = 24", ships='["kcs"]', encounter="angle_deg = 1.5", more="")
    (tmp_path / "mine.toml").write_text(text)
    result = CliRunner().invoke(main, ["study", "mine.toml", "--out", "out", "--workers", "0", "--engine", "python"])
    assert result.exit_code == 0
    assert result.stderr.splitlines() == [
        f"warning: all 24 rows are alike, {ALIKE}", f"warning: angle_deg is at most 1.5 {RADIANS}",
    ]  # fmt: skip
    assert "warning" not in result.stdout
