"""The files that the user guide shows are accepted as they stand."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from shipcollision_fmu import load_scenario, load_ship

GUIDE = Path(__file__).parents[2] / "docs" / "guide"


def blocks(page: str, language: str = "toml") -> list[str]:
    """The blocks of a page in a language, in their order."""
    return re.findall(
        rf"^```{language}\n(.*?)^```", (GUIDE / page).read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE
    )


def test_the_ship_of_the_guide_is_loaded(tmp_path: Path) -> None:
    ship, least, estimate, *_ = blocks("ships.md")
    path = tmp_path / "mine.toml"
    path.write_text(ship, encoding="utf-8")
    assert load_ship(path).manoeuvring is None
    for text in (ship, least):
        path.write_text(text + estimate, encoding="utf-8")
        assert load_ship(path).manoeuvring is not None
    path.write_text(least, encoding="utf-8")
    assert len(load_ship(path).estimated) > 10


def test_the_tables_of_the_guide_are_the_ship_of_its_file(tmp_path: Path) -> None:
    """The dict and the file of the fewest numbers; and the variant."""
    path = tmp_path / "least.toml"
    path.write_text(blocks("ships.md")[1], encoding="utf-8")
    names: dict[str, Any] = {}
    exec(blocks("ships.md", "python")[0], names)
    assert (names["ship"].M == load_ship(path).M).all()
    assert names["ship"].estimated == load_ship(path).estimated
    assert names["deeper"].L_pp == load_ship("kvlcc2").L_pp


def test_the_models_of_the_guide_collide(capsys: pytest.CaptureFixture[str]) -> None:
    (loop,) = (block for block in blocks("run.md", "python") if "ShipManoeuvring" in block)
    names: dict[str, Any] = {}
    exec(loop, names)
    time, dissipated = map(float, capsys.readouterr().out.split()[:2])
    assert time == pytest.approx(2.76, abs=0.01)
    assert dissipated == pytest.approx(1.706e9, rel=1e-3)
    assert 1.0 < names["own"].outputs.velocity[0] < 2.0


@pytest.mark.parametrize("more", range(len(blocks("scenarios.md"))))
def test_the_scenarios_of_the_guide_are_loaded(tmp_path: Path, more: int) -> None:
    """The first block, alone and with each of the others; a second [collision] joins the first."""
    first, *others = blocks("scenarios.md")
    added = others[more - 1] if more else ""
    text = first.replace("[collision]", added, 1) if added.startswith("[collision]") else first + added
    path = tmp_path / "mine.toml"
    path.write_text(text, encoding="utf-8")
    assert load_scenario(path).name == "mine"


def test_the_guide_lists_every_extra() -> None:
    """Without those of developers: `docs` and `dev`."""
    project = (GUIDE.parents[1] / "pyproject.toml").read_text(encoding="utf-8")
    extras = project.partition("[project.optional-dependencies]")[2].partition("\n[")[0]
    page = (GUIDE / "run.md").read_text(encoding="utf-8").partition("## Extras")[2].partition("\n## ")[0]
    listed = re.findall(r"^\| `(\w+)` \|", page, re.MULTILINE)
    assert sorted(listed) == sorted(set(re.findall(r"^(\w+) = \[", extras, re.MULTILINE)) - {"docs", "dev"})
