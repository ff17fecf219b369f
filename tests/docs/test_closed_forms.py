"""The page Validation has the tables that benchmarks/closed_forms.py prints, and what it says of them holds."""

from __future__ import annotations

import re
import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu import load_ship, read_study
from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.study.closed_forms.comparison import Knowledge, compare_by_knowledge
from shipcollision_fmu.study.closed_forms.energies import estimate_energies
from shipcollision_fmu.study.closed_forms.pedersen_zhang import pedersen_zhang
from shipcollision_fmu.study.closed_forms.planar_impact import PlanarShips
from shipcollision_fmu.study.closed_forms.read_impacts import read_column, read_impacts
from shipcollision_fmu.study.rows.compute import compute_rows

ROOT = Path(__file__).parents[2]
SECTION = (ROOT / "docs" / "validation.md").read_text(encoding="utf-8").partition("## Closed forms beside")[2]
TEXT = " ".join(SECTION.partition("\n## ")[0].split())
SHIPS = {name: load_ship(name) for name in ("kvlcc2", "kcs")}


def split(table: str) -> list[list[str]]:
    """Cells of the lines of the Markdown tables in a text, without those below the headers."""
    lines = re.findall(r"^\| (.+) \|$", table, re.MULTILINE)
    return [line.split(" | ") for line in lines if "---" not in line]


def test_the_tables_are_those_of_the_command() -> None:
    """Words to the letter; numbers to one unit of their last digit, as rounding differs between processors."""
    printed = "\n".join(runpy.run_path(str(ROOT / "benchmarks" / "closed_forms.py"))["make_tables"]())
    on_page, computed = split(SECTION.partition("\n## ")[0]), split(printed)
    assert len(on_page) == len(computed) == 20
    number = re.compile(r"\d+\.?\d*")
    for there, here in zip(on_page, computed, strict=True):
        assert [number.sub("", cell).strip() for cell in there] == [number.sub("", cell).strip() for cell in here]
        for a, b in zip(there, here, strict=True):
            unit = 0.0101 if "." in a else 1.0
            assert [*map(float, number.findall(a))] == pytest.approx([*map(float, number.findall(b))], abs=unit)


def find_inertia(encounters: Any) -> list[PlanarShips]:
    """Own and target of each row with their own inertia."""
    return [
        PlanarShips.of([SHIPS[name] for name in encounters.column(f"{role}_ship").to_pylist()])
        for role in ("own", "target")
    ]


@pytest.fixture(scope="module")
def encounters() -> Any:
    study = read_study("closed_forms")
    return compute_rows(study, 0, study.rows).encounters


@pytest.fixture(scope="module")
def lines(encounters: Any) -> list[Knowledge]:
    return compare_by_knowledge(encounters, SHIPS)


def test_the_same_problem_has_the_same_energy(lines: list[Knowledge], encounters: Any) -> None:
    """In every case with one point, a level normal, and slip that does not turn back."""
    assert f"{read_study('closed_forms').rows - lines[0].all.cases} cases, in which the ships do not close" in TEXT
    assert "agree to 1e-9, sticking and sliding" in TEXT
    answers = pedersen_zhang(read_impacts(encounters, *find_inertia(encounters), contact="found"))
    same = (read_column(encounters, "contacts") == 1.0) & ~answers.turns_back
    same &= np.abs(read_column(encounters, "normal_z")) < 1e-6
    assert same.sum() == lines[5].all.cases > 300
    np.testing.assert_allclose(answers.energy[same], read_column(encounters, "energy")[same], rtol=1e-9)


def test_the_yaw_inertia_makes_the_median(lines: list[Knowledge]) -> None:
    found = {}
    for name, ship in SHIPS.items():
        of = PlanarShips.of([ship])
        found[name] = float(of.J_z[0]) / (ship.mass * ship.L_pp**2 / 16.0)
    assert "1.21 M L²/16. KVLCC2 has {kvlcc2:.2f}, KCS {kcs:.2f} with".format(**found) in TEXT
    assert "a fifth more energy" in TEXT
    assert lines[0].all.median == pytest.approx(1.2, abs=0.01)
    assert lines[1].all.median == pytest.approx(1.0, abs=0.01)


def test_where_and_how_the_hulls_meet(encounters: Any) -> None:
    """Shares of the cases that are done, and the steepest normal."""
    inertia = find_inertia(encounters)
    nominal, found = (read_impacts(encounters, *inertia, contact=contact) for contact in ("nominal", "found"))
    off = np.linalg.norm(nominal.own_point - found.own_point, axis=1)
    done = np.isfinite(off)
    across = np.degrees(np.arccos(np.clip(np.sum(nominal.normal * found.normal, axis=1), -1.0, 1.0)))

    def share(which: Array) -> str:
        return f"{100.0 * which[done].mean():.0f} %"

    assert f"in {share(off > 1.0)} of the cases not the stem touches" in TEXT
    assert f"in {share(across > 1.0)} of the cases the normal is more than 1 degree off" in TEXT
    lean = np.degrees(np.arcsin(np.nanmax(np.abs(read_column(encounters, "normal_z")))))
    assert f"at up to {lean:.0f} degrees" in TEXT


def test_minorsky_has_too_much_off_midship_and_too_little_on_opposite_courses(encounters: Any) -> None:
    assert "Off midship the simulation loses less, on opposite courses more." in TEXT
    ratio = read_column(encounters, "energy") / estimate_energies(encounters).minorsky
    angle, place = read_column(encounters, "angle_deg"), np.abs(read_column(encounters, "at"))
    across = (angle > 75.0) & (angle < 105.0)
    central, off = (np.nanmedian(ratio[across & where]) for where in (place < 0.1, place > 0.3))
    assert off < 0.8 * central
    assert np.nanmedian(ratio[angle > 135.0]) > 1.5 * np.nanmedian(ratio[across])
