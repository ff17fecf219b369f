"""A run's folder is read whole or refused in one line that says what is wrong with it."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.errors import InputError
from shipcollision_fmu.show.scene.run_folder import FILES, read_run_folder
from tests.show.conftest import MakeRun


@pytest.fixture
def folder(guan2014: Path, tmp_path: Path) -> Path:
    """A copy of a run to spoil."""
    return Path(shutil.copytree(guan2014, tmp_path / "copy"))


def refusal(folder: Path) -> str:
    with pytest.raises(InputError) as caught:
        read_run_folder(folder)
    said = str(caught.value)
    assert "\n" not in said
    assert "shipcollision run" in said
    return said.replace(str(folder), "DIR")


def test_what_was_written_is_read(folder: Path) -> None:
    run = read_run_folder(folder)
    header = (folder / "states.csv").read_text().splitlines()[0].split(",")
    table = np.loadtxt(folder / "states.csv", delimiter=",", skiprows=1)
    assert list(run.bodies.ships) == ["own", "target"]
    assert np.array_equal(run.times, table[:, 0])
    assert np.array_equal(run.states[:, 1, 5], table[:, header.index("target.attitude.yaw")])
    assert len(run.contacts["time"]) == len((folder / "contacts.csv").read_text().splitlines()) - 1 > 1


def test_a_run_of_an_earlier_build_has_six_degrees_of_freedom(folder: Path) -> None:
    bodies = json.loads((folder / "bodies.json").read_text())
    for ship in bodies["ships"].values():
        assert ship.pop("degrees_of_freedom") == 6
    (folder / "bodies.json").write_text(json.dumps(bodies) + "\n")
    assert [ship.degrees_of_freedom for ship in read_run_folder(folder).bodies.ships.values()] == [6, 6]


def test_no_folder_and_an_empty_and_a_foreign_one(tmp_path: Path) -> None:
    assert refusal(tmp_path / "nowhere").startswith("DIR does not exist")
    assert refusal(tmp_path).startswith("DIR is empty")
    (tmp_path / "holiday.jpg").touch()
    assert refusal(tmp_path).startswith("DIR is not the folder of a run")
    assert refusal(tmp_path / "holiday.jpg").startswith("DIR is not a folder")


@pytest.mark.parametrize("name", FILES)
def test_a_missing_file_is_named(folder: Path, name: str) -> None:
    (folder / name).unlink()
    assert f"has no {name}, so it is not the whole folder of a run" in refusal(folder)


@pytest.mark.parametrize("name", FILES)
def test_a_file_cut_short_is_named(folder: Path, name: str) -> None:
    whole = (folder / name).read_bytes()
    for length in (0, 1, len(whole) // 2, len(whole) - 1):
        (folder / name).write_bytes(whole[:length])
        assert refusal(folder).startswith(f"DIR/{name}: ")


@pytest.mark.parametrize("name", ["states.csv", "signals.csv"])
def test_a_table_cut_between_two_lines_is_noticed(folder: Path, name: str) -> None:
    lines = (folder / name).read_text().splitlines(keepends=True)
    (folder / name).write_text("".join(lines[:-1]))
    assert "has 120 rows, summary.json says 121: it is not whole" in refusal(folder)


def test_contacts_that_miss_a_scratch_are_noticed(folder: Path) -> None:
    header = (folder / "contacts.csv").read_text().splitlines(keepends=True)[0]
    (folder / "contacts.csv").write_text(header)
    assert "scratch 1 is in events.json and not in contacts.csv" in refusal(folder)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("\n0.05,", "\nnan,", "row 2: time = nan is not finite"),
        ("\n0.05,", "\n7.5,", "row 3: time does not increase"),
        ("\n0.05,", "\nearly,", "could not convert string 'early'"),
        ("own.attitude", "own.attitudes", "has no column 'own.attitude.roll'"),
    ],
)
def test_numbers_that_are_none_are_refused(folder: Path, old: str, new: str, said: str) -> None:
    text = (folder / "states.csv").read_text()
    (folder / "states.csv").write_text(text.replace(old, new))
    assert said in refusal(folder)


def spoilt(folder: Path, name: str, change: Callable[[Any], None]) -> str:
    data = json.loads((folder / name).read_text())
    change(data)
    (folder / name).write_text(json.dumps(data) + "\n")
    return refusal(folder)


def test_json_that_says_something_else_is_refused(folder: Path) -> None:
    assert spoilt(folder, "bodies.json", lambda d: d.update(ships={})).startswith("DIR/bodies.json: ships: ")


def test_bodies_that_do_not_fit_are_refused(folder: Path) -> None:
    def beyond(data: Any) -> None:
        data["ships"]["own"]["triangles"][0][0] = 10_000

    assert "a triangle of own names vertex 10000 of" in spoilt(folder, "bodies.json", beyond)


def test_events_of_strangers_are_refused(folder: Path) -> None:
    def stranger(data: Any) -> None:
        data["scratches"][0]["ship_a"] = "Flying Dutchman"

    assert "'Flying Dutchman' is not in bodies.json" in spoilt(folder, "events.json", stranger)


def test_a_run_without_any_contact_is_whole(meeting: MakeRun) -> None:
    run = read_run_folder(meeting(("speed = 4.0", "speed = 0.5")))
    assert run.events.collisions == []
    assert len(run.contacts["time"]) == 0
