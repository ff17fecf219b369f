"""write_case(): a row as a scenario file, whose run has the numbers of the row."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu import load_scenario, run_encounters
from shipcollision_fmu.errors import StudyError
from shipcollision_fmu.ship.loading.library import read_ship_tables
from shipcollision_fmu.study.definition.study import Study, parse_study
from shipcollision_fmu.study.rows.case_scenario import write_case
from shipcollision_fmu.study.rows.compute import compute_rows
from tests.study.rows import test_situations
from tests.study.rows.test_cases import HEAD, write_mesh_ship
from tests.study.rows.test_levels import TEXT

POOL = """[[own.sampled]]
kind = "tanker"
count = 3
weight = 1.0
L_pp = {{distribution = "uniform", least = 100.0, most = 250.0}}
L_over_B = 6.0
B_over_T = 2.6
C_b = 0.8
loading = 0.7
[run]"""


def read(level: str, more: str = "") -> Study:
    return parse_study(TEXT.replace("[run]", POOL).format(level=level, more=more, freedom=3))


def run(study: Study, row: int, folder: Path, separation: float | None = 8.0) -> tuple[dict[str, Any], Any]:
    """The row, and the tables of the run of its scenario file."""
    path = write_case(study, row, folder)
    (line,) = compute_rows(study, row, 1).encounters.to_pylist()
    scenario = load_scenario(path)
    assert scenario.name == path.stem == f"{study.name}_{row}"
    return line, run_encounters([scenario], separation=separation)


def test_a_mesh_goes_with_the_case(tmp_path: Path) -> None:
    """The case runs where neither the study's ship file nor this process' copy of the mesh is."""
    write_mesh_ship(tmp_path)
    study = parse_study(HEAD.format(rows=9, sampler="random").replace("kcs", "my.toml"), "s.toml", tmp_path)
    path = write_case(study, 1, tmp_path / "case")
    for role in ("own", "target"):
        ship = read_ship_tables(path.parent / f"{path.stem}_{role}.toml")
        assert Path(ship["hull"]["file"]).resolve() == path.parent / f"{path.stem}_{role}.obj"
        assert Path(ship["hull"]["file"]).read_bytes() == (tmp_path / "box.obj").read_bytes()
    assert run_encounters([load_scenario(path)]).encounters[0]["collisions"] >= 1


@pytest.mark.parametrize("row", [3, 4, 5])
def test_an_encounter_runs_again(row: int, tmp_path: Path) -> None:
    study = read("encounter", "target_sway = 0.3\nangle_deg = 75.0\nheading_deg = 40.0")
    line, tables = run(study, row, tmp_path)
    assert line["collisions"] == tables.encounters[0]["collisions"]
    for name in ("energy", "energy_tangential", "clearance"):
        assert line[name] == pytest.approx(tables.encounters[0][name], rel=1e-5)


def test_a_sailed_case_runs_again_to_the_bit(tmp_path: Path) -> None:
    study = read("sailed", 'kind = "drifting-target"\nown_speed = 4.0')
    line, tables = run(study, 11, tmp_path)
    assert line["status"] == "done"
    for name in ("energy", "energy_tangential", "clearance", "time"):
        assert line["duration" if name == "time" else name] == tables.encounters[0][name]


@pytest.mark.parametrize(
    ("motion", "freedom", "within"),
    [("", 3, 1e-9), ("", 6, 1e-9), ("own_yaw_rate = 0.001\ntarget_sway = 0.2", 4, 1e-5)],  # they turn meanwhile
)
def test_an_impact_is_the_first_contact_of_its_run(motion: str, freedom: int, within: float, tmp_path: Path) -> None:
    """Speeds, angle and place are those of the row; so is the energy where the hulls do not touch again."""
    more = f'{motion}\nangle_deg = {{distribution = "uniform", least = 30, most = 150}}'
    study, once = parse_study(TEXT.format(level="impact", more=more, freedom=freedom)), 0
    for row in range(8):
        line, tables = run(study, row, tmp_path, None)
        first = tables.collisions[0]
        assert first["start"] == pytest.approx(1e-3, abs=1e-9)
        assert first["closing_speed"] == pytest.approx(line["closing_speed"], rel=within)
        assert np.linalg.norm(first["relative_velocity"]) == pytest.approx(line["relative_speed"], rel=within)
        assert np.degrees(first["angle"]) == pytest.approx(line["collision_angle_deg"], abs=1e-6)
        for letter, role in (("a", "own"), ("b", "target")):
            place = [line[f"{role}_{axis}"] for axis in "xyz"]
            assert first[f"{letter}_point"] == pytest.approx(place, abs=1e-5)
        if tables.encounters[0]["energy"] == pytest.approx(line["energy"], rel=1e-3):
            once += 1
            assert tables.encounters[0]["energy"] == pytest.approx(line["energy"], rel=1e-4)
    assert once >= 2 or freedom == 6  # there the ships roll, and touch again


def test_a_situation_runs_again_to_the_bit(tmp_path: Path) -> None:
    test_situations.write_situations(tmp_path)
    line, tables = run(test_situations.read(tmp_path), 0, tmp_path, None)
    assert line["energy"] == tables.encounters[0]["energy"] > 0.0


def test_a_case_that_is_refused_is_not_written(tmp_path: Path) -> None:
    study = read("impact", "angle_deg = 0.0\nown_speed = 1.0")
    with pytest.raises(StudyError, match=r"study: row 2 is refused: at the place they close at .* change the angle"):
        write_case(study, 2, tmp_path)
    test_situations.write_situations(tmp_path)
    with pytest.raises(StudyError, match=r"row 1 is refused: other.json"):
        write_case(test_situations.read(tmp_path), 1, tmp_path)
    for row, said in (("x", "'x'"), (1.0, "1.0"), (-1, "-1")):
        with pytest.raises(StudyError, match=rf"^study: row = {said} is not in the study: it has rows 0 to 999$"):
            write_case(study, row, tmp_path)  # type: ignore[arg-type]  # what is refused
    with pytest.raises(StudyError, match="row = 1000 is not in the study: it has rows 0 to 999"):
        write_case(study, 1000, tmp_path)
    assert not list(tmp_path.glob("*.toml"))
