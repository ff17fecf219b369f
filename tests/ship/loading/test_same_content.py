"""One ship and one hull for one content; a file that changes gives another."""

from __future__ import annotations

import os
import re
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.errors import InputError, ShipError
from shipcollision_fmu.ship import file_stamp
from shipcollision_fmu.ship.hull import hull as hull_module
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.hull.solid import HullMesh
from shipcollision_fmu.ship.loading import library
from shipcollision_fmu.ship.loading.library import find_models, load_ship
from shipcollision_fmu.ship.loading.toml import parse_toml
from shipcollision_fmu.ship.ship import Ship
from tests.conftest import BARGE


def tables_of(text: str) -> dict[str, Any]:
    return parse_toml(text, "a ship of the tests", InputError)


BARGE_TABLES = tables_of(BARGE)
EXAMPLE = find_models() / "hulls" / "example.obj"
LONG_AGO = 1_000_000_000


@pytest.fixture
def counts(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """How often each ship file is read, and a hull built, with nothing remembered from before."""
    for cached in (library._read_unchanged, library._assemble_once, hull_module._build_once):
        cached.cache_clear()
    counted, read, built = Counter[str](), library.read_toml, hull_module._build

    def reading(path: Path, refusal: Any) -> Any:
        counted[path.name] += 1
        return read(path, refusal)

    def building(*of: Any) -> HullMesh:
        counted["hulls"] += 1
        return built(*of)

    monkeypatch.setattr(file_stamp, "SETTLED_NS", 0)  # files of a fresh checkout, too
    monkeypatch.setattr(library, "read_toml", reading)
    monkeypatch.setattr(hull_module, "_build", building)
    return counted


def settled(path: Path, text: str, time: int = LONG_AGO) -> Path:
    """Writes a file and dates it back: its content is taken for unchanged as long as its times are."""
    path.write_text(text, encoding="utf-8")
    os.utime(path, (time, time))
    return path


@pytest.fixture(autouse=True)
def _files_settle_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(file_stamp, "SETTLED_NS", 0)


def solid(ship: Ship) -> HullMesh:
    return build_hull(ship.L_oa, ship.B, ship.T, ship.hull)


def test_a_ship_is_read_and_built_once(counts: Counter[str], tmp_path: Path) -> None:
    settled(tmp_path / "barge.toml", BARGE)
    path = settled(tmp_path / "light.toml", 'extends = "barge"\n[particulars]\nmass = 6.0e6\n')
    first, second = load_ship(path), load_ship("light.toml", tmp_path)
    assert first is second
    assert solid(first) is solid(second)
    assert counts == {"barge.toml": 1, "light.toml": 1, "hulls": 1}


def test_ships_of_one_content_are_one(tmp_path: Path) -> None:
    """Whatever the file is called, and in whatever order its keys stand."""
    upside_down = {name: dict(reversed(table.items())) for name, table in reversed(BARGE_TABLES.items())}
    here = load_ship(settled(tmp_path / "here.toml", BARGE))
    assert here is load_ship(settled(tmp_path / "there.toml", BARGE + "# the same\n"))
    assert here is load_ship(BARGE_TABLES)
    assert here is load_ship(upside_down)


def test_a_base_that_changes_gives_another_ship(tmp_path: Path) -> None:
    settled(tmp_path / "barge.toml", BARGE)
    path = settled(tmp_path / "light.toml", 'extends = "barge"\n[ship]\nname = "Light"\n')
    assert load_ship(path).B == 20.0
    settled(tmp_path / "barge.toml", BARGE.replace("B = 20.0", "B = 21.0"))
    assert load_ship(path).B == 21.0


def test_a_file_that_was_just_written_is_read_again(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Its times may be those of an earlier version of the same size: the clock of a file system is coarse."""
    monkeypatch.setattr(file_stamp, "SETTLED_NS", 10**18)
    for B in ("20.0", "21.0", "22.0"):
        path = settled(tmp_path / "barge.toml", BARGE.replace("B = 20.0", f"B = {B}"))
        assert load_ship(path).B == float(B)  # noqa: SIM300  # the file's value first


def mesh_ship(mesh: Path, **changes: Any) -> dict[str, Any]:
    tables = tables_of((find_models() / "ships" / "mesh_example.toml").read_text(encoding="utf-8"))
    tables["hull"] |= {"file": str(mesh)} | changes
    return tables


@pytest.mark.slow
def test_a_mesh_that_changes_gives_another_ship_and_hull(counts: Counter[str], tmp_path: Path) -> None:
    mesh = settled(tmp_path / "hull.obj", EXAMPLE.read_text(encoding="utf-8"))
    ship = load_ship(mesh_ship(mesh))
    assert load_ship(mesh_ship(mesh)) is ship
    assert solid(ship) is solid(load_ship(mesh_ship(mesh)))
    assert counts["hulls"] == 1
    x = re.compile(r"^v (\S+)", re.MULTILINE)
    settled(mesh, x.sub(lambda found: f"v {1.001 * float(found[1])}", mesh.read_text(encoding="utf-8")), LONG_AGO + 9)
    longer = load_ship(mesh_ship(mesh))
    assert longer is not ship
    assert np.ptp(solid(longer).vertices[:, 0]) == pytest.approx(1.001 * 120.0, rel=1e-6)


@pytest.mark.slow
def test_options_of_a_mesh_give_another_ship_and_hull(tmp_path: Path) -> None:
    mesh = settled(tmp_path / "hull.obj", EXAMPLE.read_text(encoding="utf-8"))
    one, other = load_ship(mesh_ship(mesh)), load_ship(mesh_ship(mesh, origin=[60100.0, 0.0, 7000.0]))
    np.testing.assert_allclose(
        solid(one).vertices - solid(other).vertices, [[0.1, 0.0, 0.0]] * len(solid(one).vertices)
    )


def test_neither_ship_nor_hull_can_be_changed(tmp_path: Path) -> None:
    ship = load_ship(BARGE_TABLES)
    hull = solid(ship)
    for array in (ship.M, ship.M_A, ship.M_RB, ship.r_bg, hull.vertices, hull.triangles, *hull.parts, *hull.planes):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0.0
    assert isinstance(load_ship("mesh_example").hull.origin, tuple)


def test_tables_of_the_caller_stay_his_own() -> None:
    tables = tables_of(BARGE)
    ship = load_ship(tables)
    assert tables == BARGE_TABLES
    tables["particulars"]["B"] = 21.0
    assert (ship.B, load_ship(BARGE_TABLES).B, load_ship(tables).B) == (20.0, 20.0, 21.0)


def test_a_dict_takes_tuples_extends_and_meshes_beside_a_folder(tmp_path: Path) -> None:
    settled(tmp_path / "barge.toml", BARGE)
    (tmp_path / "meshes").mkdir()
    settled(tmp_path / "meshes" / "hull.obj", EXAMPLE.read_text(encoding="utf-8"))
    ship = load_ship({"extends": "barge", "particulars": {"r_bg": (1.0, 0.0, 0.5)}}, tmp_path)
    assert (ship.name, ship.r_bg.tolist()) == ("Barge", [1.0, 0.0, 0.5])
    mesh = load_ship({"extends": "mesh_example", "hull": {"file": "meshes/hull.obj"}}, tmp_path)
    assert mesh.hull.file == str(tmp_path / "meshes" / "hull.obj")


@pytest.mark.parametrize(
    ("tables", "message"),
    [
        ({"ship": BARGE_TABLES["ship"]}, r"\[particulars\] is missing: give the table \[particulars\] with L_pp"),
        ({**BARGE_TABLES, "sail": {}}, r"\[sail\] is not a known key"),
        ({**BARGE_TABLES, 3: {}}, r"\[3\] is not a known key"),
        ({"extends": "kvlc2"}, r"extends: unknown ship 'kvlc2': did you mean kvlcc2\?"),
        ({"extends": 3}, r"extends = 3 must be a ship's name or path in quotes"),
        (
            {**BARGE_TABLES, "added_mass": {"M_A": (-np.eye(6)).tolist()}},
            r"\[added_mass\] M_A is not positive semi-def",
        ),
    ],
)
def test_a_dict_is_refused_like_a_file(tables: dict[str, Any], message: str) -> None:
    with pytest.raises(ShipError, match="^ship given as a dict: " + message):
        load_ship(tables)
