"""The files that the user guide shows are accepted as they stand."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from shipcollision_fmu import load_scenario, load_ship

GUIDE = Path(__file__).parents[2] / "docs" / "guide"


def blocks(page: str) -> list[str]:
    """The TOML blocks of a page, in their order."""
    return re.findall(r"^```toml\n(.*?)^```", (GUIDE / page).read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def test_the_ship_of_the_guide_is_loaded(tmp_path: Path) -> None:
    ship, estimate = blocks("ships.md")
    path = tmp_path / "mine.toml"
    path.write_text(ship, encoding="utf-8")
    assert load_ship(path).manoeuvring is None
    path.write_text(ship + estimate, encoding="utf-8")
    assert load_ship(path).manoeuvring is not None


@pytest.mark.parametrize("more", range(len(blocks("scenarios.md"))))
def test_the_scenarios_of_the_guide_are_loaded(tmp_path: Path, more: int) -> None:
    """The first block, alone and with each of the others; a second [collision] joins the first."""
    first, *others = blocks("scenarios.md")
    added = others[more - 1] if more else ""
    text = first.replace("[collision]", added, 1) if added.startswith("[collision]") else first + added
    path = tmp_path / "mine.toml"
    path.write_text(text, encoding="utf-8")
    assert load_scenario(path).name == "mine"
