"""Files of traffic as cases: the rows of the scenarios that they become, with the ships and numbers of the study."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from shipcollision_fmu import load_scenario, run_encounters, traffic_scenario
from shipcollision_fmu.study.definition.study import Study, parse_study
from shipcollision_fmu.study.rows.compute import compute_rows

STUDY = """
[study]
name = "traffic"
level = "{level}"
[situations]
folder = "traffic"
duration = 250.0
[encounter]
friction = 0.45
{more}
"""


def make_ship(number: int, south: float, heading: float, length: float) -> dict[str, Any]:
    """A ship on the meridian, from `south` deg north of 58.7, of constant speed."""
    other = south + (0.05 if heading == 0.0 else -0.05)
    return {
        "static": {"id": number, "dimensions": {"length": length, "width": length / 6.0, "draught": length / 18.0},
                   "shipType": "Cargo"},
        "initial": {"position": {"lon": 10.5, "lat": 58.7 + south}, "heading": heading, "cog": heading, "sog": 10.0,
                    "navStatus": 0},
        "waypoints": [{"position": {"lon": 10.5, "lat": 58.7 + south}},
                      {"position": {"lon": 10.5, "lat": 58.7 + other}, "leg": {"sog": 10.0}}],
    }  # fmt: skip


def write_situations(folder: Path) -> None:
    """Two that meet head-on, two of which one overtakes nobody, and a file that is none."""
    (folder / "traffic").mkdir()
    for name, heading in (("meeting", 180.0), ("parting", 0.0)):
        situation = {
            "version": "0.2.0", "title": name, "startTime": "2026-01-01T12:00:00Z", "environment": {},
            "ownShip": make_ship(1, 0.0, 0.0, 150.0), "targetShips": [make_ship(2, 0.015, heading, 120.0)],
        }  # fmt: skip
        (folder / "traffic" / f"{name}.json").write_text(json.dumps(situation))
    (folder / "traffic" / "other.json").write_text("{}")
    (folder / "traffic" / "notes.txt").write_text("no situation")


def read(folder: Path, level: str = "encounter", more: str = "") -> Study:
    return parse_study(STUDY.format(level=level, more=more), "s.toml", folder)


def test_each_file_is_a_case(tmp_path: Path) -> None:
    write_situations(tmp_path)
    study = read(tmp_path)
    lines = compute_rows(study, 0, study.rows).encounters.to_pylist()
    assert [line["situation"] for line in lines] == ["meeting.json", "other.json", "parting.json"]
    meeting, other, parting = lines
    assert (meeting["status"], meeting["kind"]) == ("done", "situation")
    assert (parting["status"], parting["collisions"], parting["energy"]) == ("done", 0, 0.0)
    assert parting["clearance"] > 50.0
    assert other["status"] == "refused"
    assert "other.json" in other["reason"]
    made = traffic_scenario(tmp_path / "traffic" / "meeting.json", out=tmp_path / "m.toml", duration=250.0)
    for name, text in {**made.ship_files, "m.toml": made.text}.items():
        (tmp_path / name).write_text(text)
    scenario = load_scenario(tmp_path / "m.toml")
    contact = scenario.collision.model_copy(update={"friction": 0.45, "restitution": 0.0})
    rows = run_encounters([scenario.model_copy(update={"collision": contact})])
    for name in ("energy", "energy_normal", "clearance", "collisions"):
        assert meeting[name] == rows.encounters[0][name]
    assert meeting["closing_speed"] == rows.collisions[0]["closing_speed"]
    assert meeting["target_surge_after"] == rows.collisions[0]["b_after"][0]


def test_the_folder_is_repeated_with_other_numbers(tmp_path: Path) -> None:
    write_situations(tmp_path)
    text = STUDY.format(level="encounter", more="").replace(
        "friction = 0.45", 'friction = {distribution = "uniform", least = 0.1, most = 0.6}'
    )
    study = parse_study(text.replace('"encounter"', '"encounter"\nrows = 9'), "s.toml", tmp_path)
    whole = compute_rows(study, 0, 9)
    lines = whole.encounters.to_pylist()
    assert [line["situation"] for line in lines] == ["meeting.json", "other.json", "parting.json"] * 3
    meetings = [line for line in lines if line["situation"] == "meeting.json"]
    assert len({line["friction"] for line in meetings}) == 3
    for first in (0, 4, 8):
        part = compute_rows(study, first, 1)
        assert part.encounters.to_pylist() == [lines[first]]


def test_ships_of_the_study_take_the_place_of_those_of_the_file(tmp_path: Path) -> None:
    write_situations(tmp_path)
    pool = '[[target.sampled]]\nkind = "tanker"\ncount = 1\nL_pp = 200.0\nB = 32.0\nT = 12.0\nC_b = 0.8'
    more = f'[own]\nships = ["kvlcc2"]\n{pool}'
    line, *_ = compute_rows(read(tmp_path, more=more), 0, 1).encounters.to_pylist()
    assert (line["own_ship"], line["target_ship"], line["target_L_pp"]) == ("kvlcc2", "tanker 1", 200.0)
    own_files = compute_rows(read(tmp_path), 0, 1).encounters.to_pylist()[0]
    assert own_files["own_ship"] is None
    assert line["energy"] > 2.0 * own_files["energy"] > 0.0


def test_a_sailed_situation_has_the_current_of_the_study(tmp_path: Path) -> None:
    """A current along the track of both changes nothing between them; one across it moves the place of impact."""
    write_situations(tmp_path)
    plain, current = (
        compute_rows(read(tmp_path, "sailed", more), 0, 1)
        for more in ("", "current_speed = 1.0\ncurrent_towards_deg = 90.0\nwind_speed = 20.0\nwind_from_deg = 80.0")
    )
    a, b = (tables.encounters.to_pylist()[0] for tables in (plain, current))
    assert a["status"] == b["status"] == "done"
    assert (a["current_speed"], b["current_speed"], b["wind_from_deg"]) == (None, 1.0, 80.0)
    assert a["energy"] != b["energy"]


@pytest.mark.needs("pybullet")
def test_the_python_engine_has_the_same_rows(tmp_path: Path) -> None:
    write_situations(tmp_path)
    study = read(tmp_path)
    native, python = (compute_rows(study, 0, 1, engine).encounters.to_pylist()[0] for engine in ("native", "python"))
    for name, value in native.items():
        if isinstance(value, float):
            assert python[name] == pytest.approx(value, rel=1e-6, abs=1e-9), name
        elif name != "engine":
            assert python[name] == value


def test_a_reason_names_no_place_on_this_machine(tmp_path: Path) -> None:
    """Bytes of rows would differ between workers; and options of another command would be no remedy."""
    write_situations(tmp_path)
    text = json.loads((tmp_path / "traffic" / "meeting.json").read_text())
    del text["ownShip"]["static"]["dimensions"]
    (tmp_path / "traffic" / "a.json").write_text(json.dumps(text))
    reason = compute_rows(read(tmp_path), 0, 1).encounters.to_pylist()[0]["reason"]
    assert "own has no length and width: give ships in [own] and [target]" in reason
    assert "/" not in reason.replace("m/s", "")
