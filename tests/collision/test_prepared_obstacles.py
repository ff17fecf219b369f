"""Prepared obstacles: every number is exact, and the command tells obstacles from ships."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from shipcollision_fmu.cli import main
from shipcollision_fmu.collision.obstacles import read_obstacles
from shipcollision_fmu.collision.prepared_obstacles import prepare_obstacles
from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.ship.loading.library import load_ship

PIER = """
[pier]
kind = "pier"
shape = "box"
length = 40.0
breadth = 10.0
position = [20.0, 165.3]
heading_deg = 30.0
fender = { stiffness = 4e6, damping = 1e5, thickness = 1.5 }
"""


def test_every_number_is_exact() -> None:
    lines = prepare_obstacles(PIER).decode().splitlines()
    (pier,) = read_obstacles(PIER)
    assert lines[:3] == ["shipcollision prepared obstacles 1", "count 1", 'name "pier"']
    numbers = {
        key: [float.fromhex(word) for word in words.split()] for key, _, words in (x.partition(" ") for x in lines[3:8])
    }
    assert numbers["place"] == [20.0, 165.3, 0.0, pier.heading]
    assert numbers["fender"] == [4e6, 1e5, 1.5]
    assert numbers["part"] == pier.solid.vertices.ravel().tolist()
    assert lines[5].startswith("hull 1 ")
    assert len(numbers["planes"]) == 6 * 4
    assert prepare_obstacles("") == prepare_obstacles(" ")


@pytest.mark.parametrize("text", [PIER, PIER.replace("[pier]", "[obstacles.pier]")])
def test_the_command_writes_obstacles(text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("harbour.toml").write_text(text)
    done = CliRunner().invoke(main, ["prepare", "harbour.toml"])
    assert (done.exit_code, done.output) == (0, "harbour.obstacles\n")
    assert Path("harbour.obstacles").read_bytes() == prepare_obstacles(PIER)
    refused = CliRunner().invoke(main, ["prepare", "harbour.toml", "--out", "harbour.ship"])
    assert "call it harbour.obstacles" in refused.output


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ('[obstacles.quay]\nkind = "quay"\n', "[obstacles.quay] shape is missing"),
        ('[quay]\nlength = 9.0\n[log]\nkind = "log"\nshape = "box"\n', "[obstacles.quay]"),
        ("[obstacles]\nquay = 1\n", "obstacles in harbour.toml: "),
        (PIER.replace("[pier]", "[obstacle.pier]"), "harbour.toml: [obstacle] holds tables: did you mean obstacles?"),
        (PIER.replace("[pier]", "[Obstacels.pier]"), "harbour.toml: [Obstacels] holds tables: did you mean obstacles?"),
        (PIER.replace("[pier]", "[walls.pier]"), "harbour.toml: [walls] holds tables: call it obstacles, or leave it"),
        (PIER.replace("shape", "shap"), "[obstacles.pier] shap is not a known key: did you mean shape?"),
        (PIER.replace("[pier]", ""), "harbour.toml: kind stands in no table: begin the obstacle with its name, [NAME]"),
    ],
)
def test_what_lacks_keys_is_refused_as_an_obstacle_and_not_as_a_ship(
    text: str, line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("harbour.toml").write_text(text)
    done = CliRunner().invoke(main, ["prepare", "harbour.toml"])
    assert done.exit_code == 2
    assert line in done.output
    assert "particulars" not in done.output
    assert sorted(path.name for path in tmp_path.iterdir()) == ["harbour.toml"]


@pytest.mark.parametrize("table", ["[obstacle.pier]", "[obstacles.pier]", "[pier]", ""])
def test_obstacles_in_place_of_a_ship_are_named(table: str, tmp_path: Path) -> None:
    path = tmp_path / "harbour.toml"
    path.write_text(PIER.replace("[pier]", table))
    with pytest.raises(ShipError, match=r"^harbour\.toml has obstacles, and no ship: name a ship file"):
        load_ship(path)


def test_a_wrong_obstacle_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("harbour.toml").write_text(PIER.replace("length = 40.0", ""))
    done = CliRunner().invoke(main, ["prepare", "harbour.toml"])
    assert done.exit_code == 2
    assert "[obstacles.pier] shape = 'box' takes length and breadth: give length" in done.output
