"""A prepared ship: every number of the ship, exact; refusals in their place; the same bytes each time."""

from __future__ import annotations

import re
from pathlib import Path
from zlib import crc32

import pytest
from click.testing import CliRunner

from shipcollision_fmu.cli import main
from shipcollision_fmu.errors import HostError, ShipError
from shipcollision_fmu.manoeuvring import prepared_ship
from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from shipcollision_fmu.ship.degrees_of_freedom import free_inverse
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.seakeeping import compute_seakeeping
from tests.ship_files import ship_tables

KVLCC2 = prepare_ship("kvlcc2")


def lines_of(content: bytes) -> dict[str, str]:
    """Values by key; of the hull's parts the last."""
    return dict(line.partition(" ")[::2] for line in content.decode().splitlines()[1:])


def numbers_of(content: bytes, key: str) -> list[float]:
    return [float.fromhex(text) for text in lines_of(content)[key].split()]


def test_every_number_is_exact() -> None:
    ship = load_ship("kvlcc2")
    assert KVLCC2.startswith(b"shipcollision prepared ship 2\n")
    assert numbers_of(KVLCC2, "size") == [ship.L_pp, ship.L_oa, ship.B, ship.T, ship.mass, ship.rho]
    assert numbers_of(KVLCC2, "M") == ship.M.ravel().tolist()
    assert numbers_of(KVLCC2, "M_A") == ship.M_A.ravel().tolist()
    for free in (3, 4, 6):
        assert numbers_of(KVLCC2, f"inverse_{free}") == free_inverse(ship.M, free).ravel().tolist()
    sea = compute_seakeeping(ship)
    assert numbers_of(KVLCC2, "seakeeping")[:3] == [sea.K_33, sea.K_44, sea.K_55]
    hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
    assert numbers_of(KVLCC2, "part") == hull.parts[-1].ravel().tolist()
    assert numbers_of(KVLCC2, "planes") == hull.planes[-1].ravel().tolist()
    assert len(numbers_of(KVLCC2, "series")) == 4 * 360 + 1


def test_the_last_line_is_the_checksum_of_all_before() -> None:
    content, last = KVLCC2[:-15], KVLCC2[-15:]
    assert last == f"crc32 {crc32(content):08x}\n".encode()


def test_the_same_ship_gives_the_same_bytes() -> None:
    assert prepare_ship(ship_tables()) == prepare_ship(ship_tables())


def test_a_table_that_is_missing_is_none() -> None:
    lines = lines_of(prepare_ship(ship_tables()))
    keys = ("manoeuvring", "propeller", "series", "torque", "rudder", "engine")
    assert [lines[key] for key in keys] == ["none"] * len(keys)


def test_a_refusal_stands_in_its_place() -> None:
    tables = ship_tables(particulars={"GM_T": 0.01})
    with pytest.raises(ShipError) as refusal:
        compute_seakeeping(load_ship(tables))
    assert lines_of(prepare_ship(tables))["seakeeping"] == f'refused "{refusal.value}"'


def test_text_is_one_line() -> None:
    lines = lines_of(prepare_ship(ship_tables(ship={"name": 'of\n"two\\\0'})))
    name = lines["name"]
    assert name == r'''"'of\\n\"two\\\\\\x00'"'''


def test_a_hull_that_cannot_be_made_leaves_the_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    """And no word of the machine on which the ship was prepared."""

    def refuse(*_: object) -> None:
        raise HostError("run /home/somebody/python -m pip install")

    monkeypatch.setattr(prepared_ship, "build_hull", refuse)
    content = prepare_ship(ship_tables())
    assert lines_of(content)["hull"] == (
        'refused "a package that reads meshes was missing when the ship was prepared: install shipcollision-fmu[mesh], '
        'and prepare the ship or build the FMU again"'
    )
    assert b"somebody" not in content
    with pytest.raises(HostError):
        prepare_ship(ship_tables(), needs_hull=True)


def test_a_mesh_that_is_missing_leaves_the_rest(tmp_path: Path) -> None:
    tables = ship_tables(hull={"shape": "mesh", "file": "hull.obj"})
    content = prepare_ship(tables, tmp_path)
    assert lines_of(content)["hull"] == (
        'refused "the mesh file was missing when the ship was prepared: put it in its place, '
        'and prepare the ship again"'
    )
    assert str(tmp_path).encode() not in content
    with pytest.raises(ShipError, match=r"hull\.obj: does not exist in"):
        prepare_ship(tables, tmp_path, needs_hull=True)


def called(*arguments: str) -> tuple[int, str]:
    result = CliRunner().invoke(main, ["prepare", *arguments])
    return result.exit_code, result.output


def test_the_command_writes_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert called("kvlcc2") == (0, "kvlcc2.ship\n")
    assert Path("kvlcc2.ship").read_bytes() == KVLCC2
    assert called("kvlcc2", "--out", "new/mine.ship") == (0, "new/mine.ship\n")
    assert Path("new/mine.ship").read_bytes() == KVLCC2


def test_the_command_refuses_in_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    status, said = called("kvlcc3")
    assert status == 2
    assert re.fullmatch(r"error: unknown ship 'kvlcc3': did you mean kvlcc2\?.*\n", said)
    status, said = called("kvlcc2", "--out", "kvlcc2.toml")
    assert status == 2
    assert "call it kvlcc2.ship" in said
    assert list(tmp_path.iterdir()) == []


def test_the_command_says_what_is_no_source_and_no_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("file").touch()
    Path("ships").mkdir()
    refused = {
        ("ships",): "ships is a folder: give the name of a ship or the path of a TOML file",
        ("mine.ship",): "mine.ship is called as a prepared ship is: give the TOML file that it was prepared from",
        ("kcs", "--out", "ships"): "--out ships is a folder: give the name of a file in it, such as ships/kcs.ship",
        ("kcs", "--out", "file/kcs.ship"): "cannot write to file: file is not a folder; give another folder with --out",
    }
    for arguments, reason in refused.items():
        status, said = called(*arguments)
        assert status != 0
        assert said.startswith(f"error: {reason}")
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["file", "ships"]
    Path("x.fmu").write_bytes(b"PK\x03\x04\xff\xfe")
    status, said = called("x.fmu")
    assert status != 0
    assert said.startswith("error: x.fmu is a zip archive, such as an FMU, and no ship file: give the ship's TOML file")
    Path("x.fmu").unlink()
    assert called("kcs", "--out", "ships/kcs.ship") == (0, "ships/kcs.ship\n")


def test_the_command_keeps_a_file_of_other_origin(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("kvlcc2.ship").write_text("notes")
    status, said = called("kvlcc2")
    assert status != 0
    assert "holds kvlcc2.ship of other origin (it does not begin with 'shipcollision prepared ship')" in said
    assert Path("kvlcc2.ship").read_text() == "notes"
    assert called("kvlcc2", "--overwrite") == called("kvlcc2") == (0, "kvlcc2.ship\n")
    assert Path("kvlcc2.ship").read_bytes() == KVLCC2


def test_a_folder_with_the_name_of_a_ship_does_not_hide_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("kcs").mkdir()
    assert called("kcs") == (0, "kcs.ship\n")


def test_the_command_says_what_is_suspicious(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("odd.toml").write_text(
        'ship.kind = "space ship"\nparticulars = {L_pp = 120.0, B = 20.0, T = 6.0, C_b = 0.61}\n'
    )
    status, said = called("odd.toml")
    assert status == 0
    assert said.startswith("note: [ship] kind = 'space ship' names no known type of ship")
    assert said.endswith("\nodd.ship\n")
