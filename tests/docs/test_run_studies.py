"""The page about running studies: its programs read a study as they stand, and its lines say what the command says."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from shipcollision_fmu import run_study
from shipcollision_fmu.study.engine.batches import TARGET
from shipcollision_fmu.study.engine.dask_executor import PATIENCE
from shipcollision_fmu.study.engine.parts import PART_ROWS
from tests.docs.test_guide import GUIDE, blocks

PAGE = "run-studies.md"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A working folder that holds the folder `quick`."""
    made = tmp_path_factory.mktemp("guide")
    run_study("quick", made / "quick", workers=0)
    return made


@pytest.mark.parametrize(
    ("library", "said"),
    [
        ("pandas", r"^0\.90 "),
        ("polars", "│ energy"),
        ("duckdb", "starboard"),
        ("pyarrow", r"^energy \{.*b'unit': b'J'"),
    ],
)
def test_readers_run_as_they_stand(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], library: str, said: str
) -> None:
    monkeypatch.chdir(folder)
    (program,) = (block for block in blocks(PAGE, "python") if f"import {library}" in block)
    exec(program, {})
    assert re.search(said, capsys.readouterr().out, re.MULTILINE)


def test_numbers_of_the_page_are_those_of_the_code() -> None:
    text = " ".join((GUIDE / PAGE).read_text(encoding="utf-8").split())
    part = "A part has {impact} rows of level `impact`, {encounter} of `encounter`, or {sailed} of `sailed`."
    assert part.format(**{level: f"{rows:,}".replace(",", " ") for level, rows in PART_ROWS.items()}) in text
    assert PATIENCE == 600.0
    assert "no worker, or no scheduler, for ten minutes" in text


def read_time_of_a_case(level: str) -> float:
    """The time [s] of a case that the page Studies has."""
    text = (GUIDE / "studies.md").read_text(encoding="utf-8")
    number, unit = re.search(rf"^\| `{level}` \|.* \| ([\d.]+) (m?s)\b[^|]*\|$", text, re.MULTILINE).groups()  # type: ignore[union-attr]
    return float(number) * {"ms": 1e-3, "s": 1.0}[unit]


def test_what_many_cases_cost_follows_from_what_is_measured() -> None:
    """10^8 cases on 100 cores, of the time of a case, that of a batch, and those of the client."""
    text = (GUIDE / PAGE).read_text(encoding="utf-8")
    per_batch, per_1000 = (
        float(re.search(rf"{words} \| ([\d.]+) ms \|", text)[1]) * 1e-3  # type: ignore[index]
        for words in ("for a batch", "workers elsewhere send the files")
    )
    cases, cores, hour = 1e8, 100, 3600.0
    of_a_worker = float(re.search(r"for 1 000 rows of level `impact`, their files.* \| ([\d.]+) ms \|", text)[1])  # type: ignore[index]
    for level in ("impact", "encounter", "sailed"):
        row = re.search(rf"^\| `{level}` \| (.*) \|$", text, re.MULTILINE)[1].split(" | ")  # type: ignore[index]
        seconds = of_a_worker * 1e-6 if level == "impact" else read_time_of_a_case(level)
        number, unit = row[0].split()
        assert float(number) * {"ms": 1e-3, "s": 1.0}[unit] == pytest.approx(seconds)
        computing, parts = cases * seconds, cases / PART_ROWS[level]
        batches = parts * max(1, round(PART_ROWS[level] * seconds / TARGET))
        client = max(cases / 1000 * per_1000 if level == "impact" else 0.0, batches * per_batch)
        assert float(row[1].removesuffix(" core hours").replace(" ", "")) == pytest.approx(computing / hour, rel=0.03)
        assert float(row[2].replace(" ", "")) == pytest.approx(batches)
        number, unit = row[3].split()
        assert float(number) == pytest.approx(client / (hour if unit == "hours" else 60.0), rel=0.03)
        number, unit = re.match(r"([\d.]+) (\w+)", row[4]).groups()  # type: ignore[union-attr]
        longest = max(client, computing / cores) / {"minutes": 60.0, "hours": hour, "days": 24 * hour}[unit]
        assert float(number) == pytest.approx(longest, rel=0.03)
        if level == "impact":
            assert row[4].endswith(f"and {computing / client:.0f} cores are enough")
    assert f"some {round(1 / per_batch, -1):.0f} batches a second" in text
    assert f"enough for {round(TARGET / per_batch, -1):.0f} cores" in text
