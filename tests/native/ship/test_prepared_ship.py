"""Prepared ships as the native model reads them: what is damaged or foreign is refused in one line with the remedy."""

from __future__ import annotations

import ctypes
import os
import shutil
from pathlib import Path
from random import Random
from zlib import crc32

import pytest

from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from shipcollision_fmu.ship.loading.library import list_ship_names
from tests.native.kernels import load_kernels
from tests.native.native_ship import NativeShip, RefusedError
from tests.ship_files import ship_tables

KVLCC2 = prepare_ship("kvlcc2")
AGAIN = "; prepare the ship again"


def read(content: bytes) -> str:
    """The name of the ship, in quotes, or why it is refused."""
    message = ctypes.create_string_buffer(4096)
    load_kernels().shipcollision_read_ship(content, ctypes.c_size_t(len(content)), message)
    return message.value.decode(errors="replace")


def seal(content: bytes) -> bytes:
    """The content with a checksum that is right."""
    return content + f"crc32 {crc32(content):08x}\n".encode()


@pytest.mark.parametrize("name", [name for name in list_ship_names() if name != "mesh_example"])
def test_every_shipped_ship_is_read(name: str) -> None:
    content = prepare_ship(name)
    assert read(content) == content.decode().splitlines()[1].removeprefix('name "').removesuffix('"')


def test_a_name_is_read_as_it_is() -> None:
    name = 'Fram\'s "II" \\ Ærø'
    assert read(prepare_ship(ship_tables(ship={"name": name}))) == repr(name)


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"", "some.ship is no prepared ship: write one with `shipcollision prepare SHIP`"),
        (b"[ship]\nname = 'x'\n", "some.ship is no prepared ship: write one with `shipcollision prepare SHIP`"),
        (
            KVLCC2.replace(b"ship 2", b"ship 3", 1),
            "some.ship is a prepared ship of version 3, this FMU reads version 2: prepare the ship with the "
            "shipcollision that built the FMU, or build the FMU again",
        ),
        (
            KVLCC2[:-200],
            "some.ship is damaged: its last line must be its checksum, `crc32` and eight digits" + AGAIN,
        ),
        (
            KVLCC2.replace(b"\n", b"\r\n"),
            "some.ship is damaged: its line ends were changed, as git and editors of Windows do; copy it as a binary "
            "file, or prepare the ship again with `shipcollision prepare SHIP`",
        ),
        (
            seal(KVLCC2[:-15].replace(b"\nM_A ", b"\nM_B ", 1)),
            "some.ship is damaged: line 7 must be the key 'M_A' with its values" + AGAIN,
        ),
        (
            seal(KVLCC2[:-15].replace(b"r_bg ", b"r_bg 0x0.0p+0 ", 1)),
            "some.ship is damaged: line 5 must be the key 'r_bg' with its values" + AGAIN,
        ),
        (
            seal(b"shipcollision prepared ship 2\n"),
            "some.ship is damaged: line 2 must be the key 'name' with its values" + AGAIN,
        ),
    ],
    ids=["empty", "TOML", "newer", "truncated", "line ends", "another key", "one number more", "nothing"],
)
def test_other_content_is_refused(content: bytes, why: str) -> None:
    assert read(content) == why


def test_one_changed_byte_is_found() -> None:
    content = KVLCC2.replace(b"0x1.4", b"0x1.5", 1)
    found, stated = crc32(content[:-15]), KVLCC2[-9:-1].decode()
    assert read(content) == (
        f"some.ship is damaged: its last line states the checksum '{stated}', its content gives {found:08x}{AGAIN} "
        "with `shipcollision prepare SHIP`"
    )


def test_damage_of_any_kind_is_refused() -> None:
    """With a checksum that is right, a ship may come out; what is read never leaves its place."""
    random = Random(1)
    small = prepare_ship(ship_tables())
    for _ in range(500):
        content = bytearray(small)
        for _ in range(random.randrange(1, 4)):
            begin = random.randrange(len(content))
            end = begin + random.choice([0, 1, 1, 30])
            content[begin:end] = random.randbytes(random.choice([0, 1, 1, 5]))
        assert bytes(content) == small or read(bytes(content)).startswith("some.ship is ")
        assert len(read(seal(bytes(content[:-15])))) < 4096


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Resources with two ships, a folder beside them with a third; the current folder is another one."""
    (tmp_path / "resources" / "ships").mkdir(parents=True)
    (tmp_path / "resources" / "ships" / "kvlcc2.ship").write_bytes(KVLCC2)
    (tmp_path / "resources" / "ships" / "barge.ship").write_bytes(prepare_ship(ship_tables()))
    (tmp_path / "resources" / "mine.ship").write_bytes(prepare_ship(ship_tables(ship={"name": "below"})))
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / "mine.ship").write_bytes(prepare_ship(ship_tables(ship={"name": "here"})))
    (tmp_path / "here" / "ærø.ship").write_bytes(KVLCC2)
    monkeypatch.chdir(tmp_path / "here")
    return tmp_path


def start(folder: Path, ship: str) -> str:
    """'' for a ship that starts, else the refusal."""
    native = NativeShip(load_kernels(), str(folder / "resources"), find_ship=str)
    native.parameters.ship = ship
    try:
        native.initialise()
    except RefusedError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("ship", ["kvlcc2", "barge", "mine.ship", "./mine.ship", "ærø.ship", "ships/kvlcc2.ship"])
def test_ships_are_found(folder: Path, ship: str) -> None:
    assert start(folder, ship) == ""
    assert start(folder, str(folder / "here" / "mine.ship")) == ""


def test_a_relative_path_begins_in_the_resources(folder: Path) -> None:
    (folder / "resources" / "mine.ship").write_bytes(b"damaged")
    assert start(folder, "mine.ship").startswith("mine.ship is no prepared ship")


def test_an_unknown_name_lists_what_is_there(folder: Path) -> None:
    assert start(folder, "kvlcc3") == (
        "unknown ship 'kvlcc3': known: barge, kvlcc2; or give the path of a prepared ship, which `shipcollision "
        "prepare SHIP` writes"
    )


def test_a_missing_file_says_where_it_was_looked_for(folder: Path) -> None:
    assert start(folder, "no.ship") == (
        "ship file no.ship does not exist or cannot be read: give the path of a prepared ship (looked for in "
        f"{folder / 'resources'} and the current folder)"
    )
    assert start(folder, "/no.ship") == (
        "ship file /no.ship does not exist or cannot be read: give the path of a prepared ship"
    )
    for path in (str(folder), "../here", f"{folder}/"):
        assert start(folder, path) == f"ship file {path} is a folder: give the path of a prepared ship"


def test_toml_is_refused_with_the_remedy(folder: Path) -> None:
    assert start(folder, "my/ship.toml") == (
        "ship file my/ship.toml: a native FMU reads no TOML; write a prepared ship with `shipcollision prepare "
        "my/ship.toml` and give its path"
    )
    assert 'with `shipcollision prepare "my ship.toml"` and' in start(folder, "my ship.toml")
    assert start(folder, "") == "ship = '' is no ship: give a name or the path of a prepared ship"


def test_a_pipe_is_no_ship(folder: Path) -> None:
    """It is refused at once: nobody may ever write to it."""
    os.mkfifo(folder / "pipe.ship")
    path = str(folder / "pipe.ship")
    assert start(folder, path) == f"ship file {path} does not exist or cannot be read: give the path of a prepared ship"


def test_resources_on_a_long_path(folder: Path) -> None:
    """Longer than a message can be; no path of a file may have 4096 bytes, wherever temporary files are."""
    deep, name = folder, "x" * 200
    while len(str(deep)) < 3400:
        deep /= name
    deep /= "x" * (3601 - len(str(deep)))
    shutil.copytree(folder / "resources", deep / "resources")
    for ship in ("kvlcc2", "mine.ship", "ships/barge.ship", str(deep / "resources" / "mine.ship")):
        assert start(deep, ship) == ""
    said = start(deep, "kvlcc3")
    assert said.startswith("unknown ship 'kvlcc3': known: barge, kvlcc2; or give")
    said = start(deep, "no.ship")
    assert said.startswith(
        "ship file no.ship does not exist or cannot be read: give the path of a prepared ship (looked for in "
        f"{folder}/xxx"
    )
    assert said.endswith("xxx/resources and the current folder)")
    assert start(deep / name / name, "kvlcc2").startswith("unknown ship 'kvlcc2': give the path of a prepared ship")
