"""Closed forms beside the simulation: where both solve the same problem they agree; elsewhere the causes are known."""

from __future__ import annotations

from math import cos, radians, sin
from typing import Any

import numpy as np
import pyarrow.compute as pc
import pytest

from shipcollision_fmu import load_ship
from shipcollision_fmu.errors import StudyError
from shipcollision_fmu.study.closed_forms.comparison import Spread, compare_by_angle, compare_by_knowledge
from shipcollision_fmu.study.closed_forms.energies import estimate_energies
from shipcollision_fmu.study.closed_forms.planar_impact import PlanarShips
from shipcollision_fmu.study.closed_forms.popov import popov_energy
from shipcollision_fmu.study.closed_forms.read_impacts import read_column, read_impacts
from shipcollision_fmu.study.definition.study import parse_study, read_study
from shipcollision_fmu.study.rows.compute import compute_rows

SHIPS = {name: load_ship(name) for name in ("kvlcc2", "kcs")}
TEXT = """
[study]
name = "sample"
level = "{level}"
rows = 200
[own]
ships = ["kvlcc2", "kcs"]
[encounter]
angle_deg = {{ distribution = "uniform", least = 15.0, most = 165.0 }}
at = {{ distribution = "uniform", least = -0.45, most = 0.45 }}
side = {{ distribution = "discrete", values = ["port", "starboard"] }}
target_speed = {{ distribution = "uniform", least = 0.0, most = 8.0 }}
{more}
"""


def compute(more: str, level: str = "impact", rows: int = 200) -> Any:
    return compute_rows(parse_study(TEXT.format(level=level, more=more)), 0, rows).encounters


@pytest.fixture(scope="module")
def sample() -> Any:
    """The first 300 rows of the shipped study."""
    return compute_rows(read_study("closed_forms"), 0, 300).encounters


def inertia(encounters: Any) -> list[PlanarShips]:
    return [
        PlanarShips.of([SHIPS[name] for name in encounters.column(f"{role}_ship").to_pylist()])
        for role in ("own", "target")
    ]


def test_the_same_problem_has_the_same_energy(sample: Any) -> None:
    """Own inertia, one point, level normal, slip that does not turn back: Pedersen and Zhang to rounding."""
    last = compare_by_knowledge(sample, SHIPS)[5]
    assert last.all.cases > 40
    assert min(last.stick.cases, last.slide.cases) > 5
    for spread in (last.all, last.stick, last.slide):
        assert [spread.low, spread.median, spread.high] == pytest.approx([1.0] * 3, abs=1e-8)


def test_each_part_that_is_known_brings_the_formula_nearer(sample: Any) -> None:
    """The yaw inertia makes the median right, and the normal the scatter."""
    published, yaw, inert, place, normal, *parts = compare_by_knowledge(sample, SHIPS)
    assert published.all.median > 1.1
    for known in (yaw, inert, place, normal):
        assert known.all.median == pytest.approx(1.0, abs=0.02)
    assert place.all.high - place.all.low > 0.5
    assert normal.all.high - normal.all.low < 0.12
    assert sum(part.all.cases for part in parts) == normal.all.cases


@pytest.mark.parametrize("heading", [0.0, 200.0])
def test_without_friction_popovs_formula_is_the_simulation(heading: float) -> None:
    """With the ships' own inertia, at the place and normal found, also where the normal leans: it does no work down."""
    encounters = compute(f"friction = 0.0\nheading_deg = {heading}")
    one = encounters.filter((pc.field("status") == "done") & (pc.field("contacts") == 1))
    assert one.num_rows > 150
    assert np.abs(read_column(one, "normal_z")).max() > 0.3
    ratio = read_column(one, "energy") / popov_energy(read_impacts(one, *inertia(one), contact="found"))
    np.testing.assert_allclose(ratio, 1.0, atol=1e-8)


def test_at_the_place_and_normal_the_ships_close_as_the_simulation_says(sample: Any) -> None:
    """The closing speed and the relative speed of the table, from its motions and places."""
    done = sample.filter(pc.field("status") == "done")
    impacts = read_impacts(done, *inertia(done), contact="found")
    level = np.hypot(read_column(done, "normal_x"), read_column(done, "normal_y"))
    np.testing.assert_allclose(np.hypot(impacts.closing, impacts.slip), read_column(done, "relative_speed"), rtol=1e-9)
    upright = np.abs(level - 1.0) < 1e-6
    assert upright.sum() > 40
    np.testing.assert_allclose(impacts.closing[upright], read_column(done, "closing_speed")[upright], rtol=1e-6)


def test_a_row_by_hand(sample: Any) -> None:
    """Sides, signs and places of one row to port and one to starboard, and Minorsky's energy."""
    for side, sign in (("port", 1.0), ("starboard", -1.0)):
        number = next(i for i, line in enumerate(sample.to_pylist()) if line["side"] == side)
        one = sample.slice(number, 1)
        (line,) = one.to_pylist()
        of = read_impacts(one, *inertia(one), contact="nominal")
        angle = radians(line["angle_deg"])
        assert of.target_point.tolist() == [[line["at"] * line["target_L_pp"], -sign * 0.5 * line["target_B"]]]
        assert of.own_point.tolist() == [[0.5 * line["own_L_pp"], 0.0]]
        assert of.normal.tolist() == [[0.0, sign]]
        assert of.closing == pytest.approx(line["own_speed"] * sin(angle))
        assert np.abs(of.slip) == pytest.approx(abs(line["own_speed"] * cos(angle) - line["target_speed"]))
        expected = (
            line["own_mass"] * line["target_mass"] * (line["own_speed"] * sin(angle)) ** 2
            / (2.0 * line["target_mass"] + 1.43 * line["own_mass"])
        )  # fmt: skip
        assert estimate_energies(one).minorsky == pytest.approx(expected, rel=1e-12)


def test_refused_rows_have_formulas_and_no_ratio() -> None:
    """A row that the simulation refuses is left out of the comparison, and does not stop it."""
    encounters = compute("own_speed = 0.6")
    refused = encounters.filter(pc.field("status") == "refused")
    assert 10 < refused.num_rows < 190
    assert np.isfinite(estimate_energies(refused).minorsky).all()
    cases = compare_by_knowledge(encounters, SHIPS)[0].all.cases
    assert cases == encounters.num_rows - refused.num_rows
    assert sum(of.minorsky.cases for of in compare_by_angle(encounters)) == cases


def test_classes_hold_every_case_once(sample: Any) -> None:
    classes = compare_by_angle(sample)
    done = sample.filter(pc.field("status") == "done").num_rows
    assert sum(of.pedersen_zhang.cases for of in classes) == done
    assert {of.sticks for of in classes} == {True, False}
    assert all(of.minorsky.cases == of.popov.cases == of.pedersen_zhang.cases > 0 for of in classes)


def test_a_spread() -> None:
    ratios = np.append(np.arange(101.0), [np.nan, np.inf])[::-1]
    assert Spread.of(ratios) == Spread(101, 50.0, 5.0, 95.0)
    assert Spread.of(np.array([np.nan])).cases == 0


@pytest.mark.parametrize(
    ("level", "more", "why"),
    [
        ("impact", "restitution = 0.1", r"rows have restitution = 0\.1, must be 0\.0: give a study with restitution"),
        ("encounter", "", "rows have level = 'encounter', must be 'impact': give a study of level impact"),
    ],
)
def test_rows_that_have_no_closed_form_are_refused(level: str, more: str, why: str) -> None:
    with pytest.raises(StudyError, match=f"closed forms: {why}"):
        estimate_energies(compute(more, level, rows=1))


@pytest.mark.parametrize("library", ["pandas", "polars"])
def test_frames_of_other_libraries_have_the_same_estimates(sample: Any, library: str) -> None:
    frame = sample.to_pandas() if library == "pandas" else pytest.importorskip("polars").from_arrow(sample)
    expected, found = estimate_energies(sample), estimate_energies(frame)
    assert np.array_equal(found.minorsky, expected.minorsky)
    assert np.array_equal(found.popov, expected.popov, equal_nan=True)
    assert np.array_equal(found.pedersen_zhang.energy, expected.pedersen_zhang.energy, equal_nan=True)


@pytest.mark.parametrize("given", ["quick/encounters", 5, None, {"energy": [1.0]}])
def test_what_is_no_table_of_encounters_is_refused(given: Any) -> None:
    message = rf"closed forms: a {type(given).__name__} without the column 'angle_deg' is no table of encounters: give"
    with pytest.raises(StudyError, match=message):
        estimate_energies(given)
