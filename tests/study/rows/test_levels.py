"""Levels `encounter` and `sailed`: the rows are those of direct calls of collide() and run_encounters()."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu import collide, encounter, impact, load_scenario, run_encounters, simulate
from shipcollision_fmu.study.definition.study import Study, parse_study
from shipcollision_fmu.study.rows.case_scenario import write_case
from shipcollision_fmu.study.rows.compute import compute_rows
from tests.study.rows.test_compute import as_bytes

TEXT = """
[study]
name = "levels"
level = "{level}"
rows = 1000
[own]
ships = ["kcs", "kvlcc2"]
[run]
degrees_of_freedom = {freedom}
after = 30.0
separation = 8.0
[encounter]
friction = {{distribution = "uniform", least = 0.1, most = 0.6}}
side = {{distribution = "discrete", values = ["port", "starboard"]}}
{more}
"""


def read(level: str, more: str, freedom: int = 3) -> Study:
    return parse_study(TEXT.format(level=level, more=more, freedom=freedom))


def compare(line: dict[str, Any], collisions: list[dict[str, Any]], tables: Any) -> None:
    """The numbers of a row beside those of the tables of one encounter."""
    (row,) = tables.encounters
    assert row["status"] == 0
    for name in ("energy", "energy_normal", "energy_tangential", "collisions", "clearance", "unconverged"):
        assert line[name] == row[name]
    assert line["duration"] == row["time"]
    assert len(collisions) == len(tables.collisions) > 0
    for mine, theirs in zip(collisions, tables.collisions, strict=True):
        for name in ("start", "end", "energy", "closing_speed", "contacts", "ship_a", "ship_b"):
            assert mine[name] == theirs[name]
        assert mine["impulse"] == np.hypot(*theirs["impulse"][:2])
        assert [mine[f"b_{axis}"] for axis in "xyz"] == theirs["b_point"].tolist()
        for when in ("before", "after"):
            assert mine[f"a_sway_{when}"] == theirs[f"a_{when}"][1]
            assert mine[f"b_yaw_rate_{when}"] == theirs[f"b_{when}"][5]
    assert line["own_surge_after"] == tables.collisions[0]["a_after"][0]
    assert line["target_y"] == tables.collisions[0]["b_point"][1]
    assert line["contacts"] == tables.collisions["contacts"].sum()


def find_collisions(tables: Any, row: int) -> list[dict[str, Any]]:
    return [line for line in tables.collisions.to_pylist() if line["row"] == row]


@pytest.mark.parametrize("freedom", [3, 4])
def test_encounters_are_those_of_collide(freedom: int) -> None:
    more = "angle_deg = 70.0\nown_sway = 0.2\nrestitution = 0.1\nheading_deg = 20.0"
    tables = compute_rows(read("encounter", more, freedom), 50, 4)
    for line in tables.encounters.to_pylist():
        given = {
            name: line[name] for name in (
                "angle_deg", "at", "own_speed", "target_speed", "side", "own_sway", "heading_deg", "friction",
                "restitution",
            )
        }  # fmt: skip
        direct = collide(
            line["own_ship"], line["target_ship"], **given, degrees_of_freedom=freedom, after=30.0, separation=8.0
        )
        compare(line, find_collisions(tables, line["row"]), direct)


def test_sailed_cases_are_those_of_encounter() -> None:
    tables = compute_rows(read("sailed", 'kind = "late-evasive"\nrudder_deg = 20.0\nangle_deg = 80.0'), 7, 2)
    for line in tables.encounters.to_pylist():
        given = {name: line[name] for name in ("angle_deg", "at", "own_speed", "target_speed", "side", "rudder_deg")}
        scenario = encounter(
            "late-evasive", own=line["own_ship"], target=line["target_ship"], **given, after=30.0
        ).scenario
        contact = scenario.collision.model_copy(update={"friction": line["friction"], "restitution": 0.0})
        direct = run_encounters([scenario.model_copy(update={"collision": contact})], separation=8.0)
        compare(line, find_collisions(tables, line["row"]), direct)


def find_last_contact(study: Study, row: int, folder: Path) -> tuple[float, float]:
    """Time of the last contact in a run of the Python models, and of the end; [s]."""
    run = simulate(load_scenario(write_case(study, row, folder)), in_process=True)
    return float(run.contacts["time"].max()), float(run.states["time"][-1])


@pytest.mark.needs("pybullet")
@pytest.mark.parametrize(("level", "first", "rows"), [("encounter", 14, 3), ("sailed", 0, 1)])
def test_contact_that_the_end_cuts_off_is_said(level: str, first: int, rows: int, tmp_path: Path) -> None:
    """Four seconds after the impact some ships still touch. Those that are sailed press on, and lose more energy."""
    more = 'angle_deg = {distribution = "uniform", least = 20.0, most = 160.0}'
    texts = [
        TEXT.format(level=level, more=more, freedom=3).replace("after = 30.0", f"after = {t}") for t in (4.0, 64.0)
    ]
    short, long = (parse_study(text.replace("separation = 8.0\n", "")) for text in texts)
    lines, longer = (compute_rows(study, first, rows).encounters.to_pylist() for study in (short, long))
    for line, later in zip(lines, longer, strict=True):
        last, end = find_last_contact(short, line["row"], tmp_path)
        assert line["contact_at_end"] is (end - last < 1.0)
        assert later["energy"] >= line["energy"]
    assert {line["contact_at_end"] for line in lines} >= {True}
    if level == "encounter":
        assert {line["contact_at_end"] for line in lines} == {True, False}
    else:
        assert longer[0]["energy"] > 1.001 * lines[0]["energy"]


def test_a_case_that_ends_by_separation_has_no_contact_at_its_end() -> None:
    text = TEXT.format(level="encounter", more="angle_deg = 60.0", freedom=3).replace(
        "separation = 8.0", "separation = 0.3"
    )
    lines = compute_rows(parse_study(text), 0, 8).encounters.to_pylist()
    assert {line["contact_at_end"] for line in lines} == {False}
    refused, *_ = compute_rows(read("encounter", "angle_deg = 0.0\nown_speed = 1.0"), 0, 1).encounters.to_pylist()
    touching, *_ = compute_rows(read("impact", ""), 0, 1).encounters.to_pylist()
    assert (refused["contact_at_end"], touching["contact_at_end"]) == (None, None)


SURROUNDED = """
kind = {distribution = "discrete", values = ["crossing", "drifting-target"]}
angle_deg = 80.0
current_speed = {distribution = "uniform", least = 0.5, most = 2.0}
current_towards_deg = {distribution = "uniform", least = 0.0, most = 360.0}
wind_speed = {distribution = "uniform", least = 5.0, most = 20.0}
wind_from_deg = {distribution = "uniform", least = 0.0, most = 360.0}
"""


@pytest.mark.parametrize(
    ("engine", "first", "rows"),
    [("native", 0, 4), pytest.param("python", 1, 2, marks=pytest.mark.needs("pybullet"))],  # both kinds, in a third
)
def test_sailed_cases_have_current_and_wind(engine: str, first: int, rows: int) -> None:
    """A drifting target has a current of its own. Angle and place are those of the row all the same."""
    lines = compute_rows(read("sailed", SURROUNDED), first, rows, engine).encounters.to_pylist()
    assert {line["kind"] for line in lines} == {"crossing", "drifting-target"}
    for line in lines:
        assert (line["status"], line["collisions"] >= 1) == ("done", True)
        assert (line["current_speed"] is None) == (line["kind"] == "drifting-target")
        assert line["wind_speed"] >= 5.0
        assert line["collision_angle_deg"] == pytest.approx(80.0, abs=2e-3)
        assert line["target_x"] == pytest.approx(0.0, abs=4.0)  # from the middle of L_oa to midship


@pytest.mark.parametrize("freedom", [4, 6])
def test_impacts_in_more_degrees_of_freedom(freedom: int) -> None:
    tables = compute_rows(read("impact", "", freedom), 0, 6)
    for line in tables.encounters.to_pylist():
        row = impact(
            line["own_ship"], line["target_ship"], side=line["side"], friction=line["friction"], target_speed=5.0,
            degrees_of_freedom=freedom,
        )  # fmt: skip
        assert line["energy"] == row["energy"]


@pytest.mark.parametrize(("level", "size"), [("encounter", 5), ("sailed", 1)])
def test_rows_do_not_depend_on_batches(level: str, size: int) -> None:
    study = read(level, 'own_speed = {distribution = "normal", mean = 5.0, sd = 1.0, least = 3.0, most = 8.0}')
    whole = as_bytes(compute_rows(study, 20, 2 * size))
    parts = [as_bytes(compute_rows(study, first, size)) for first in (20 + size, 20)]
    assert [parts[1][table] + parts[0][table] for table in (0, 1)] == whole
