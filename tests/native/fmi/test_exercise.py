"""The FMI layer under a host in C that misuses it (exercise.c): sanitizers, threads, growth, rounding."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path
from zlib import crc32

import pytest
from fmpy import extract

from shipcollision_fmu.fmi.arrays import gather_arrays
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE
from shipcollision_fmu.toolchain.libraries import native_cache
from shipcollision_fmu.toolchain.sources import list_fmu_parts

from .native_fmus import TOKEN, build_exercise

CACHE = native_cache()
pytestmark = pytest.mark.needs("g++")
ADDRESS = ("-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
CONTACT = (*ADDRESS[1:], "-O1")
"""For the collision, which is much code; lines have no numbers then."""
THREAD = ("-g", "-fsanitize=thread")


@pytest.fixture(scope="session")
def watched(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The program under the sanitizers of addresses and undefined behaviour; leaks are found as well."""
    return build_exercise(CACHE, tmp_path_factory.mktemp("watched"), *ADDRESS)


@pytest.fixture(scope="session")
def plain(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_exercise(CACHE, tmp_path_factory.mktemp("plain"))


def rewrite_table(folder: Path, *changes: tuple[bytes, bytes]) -> None:
    """Change an unpacked FMU's table of variables by regular expressions, each of which must be found once."""
    table = folder / "resources" / "variables.txt"
    text = table.read_bytes().rpartition(b"crc32")[0]
    for pattern, replacement in changes:
        text, found = re.subn(pattern, replacement, text)
        assert found == 1, pattern
    table.write_bytes(text + f"crc32 {crc32(text):08x}\n".encode())


@pytest.fixture(scope="session")
def ships(native_fmus: dict[str, Path], tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Unpacked FMUs of the ship by flavour, with the tests' token; she sails and turns."""
    folders = {}
    for flavour in ("2", "3"):
        folder = folders[flavour] = Path(extract(native_fmus[flavour], tmp_path_factory.mktemp("ship")))
        sails = [(rb'("parameters.hydrodynamics" -) false', rb"\1 true")]
        if flavour == "2":
            for name, value in (("rudder_order", 0.2), ("propeller_order", 1.5)):
                sails.append((rb'("inputs.%s" -) 0x0.0p\+0' % name.encode(), rb"\1 " + value.hex().encode()))
        rewrite_table(folder, (rb'token "[^"]*"', f'token "{TOKEN}"'.encode()), *sails)
    return folders


@pytest.fixture(scope="session")
def collisions(native_collisions: dict[str, Path], tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Unpacked FMUs of the collision likewise; its ships are where they touch in the first step."""
    table = COLLISION.table(("own", "target"))
    presets = " ".join(str(k) for k, line in enumerate(table) if line.path.startswith("inputs.ships."))
    changes = [(rb"\npresets\n", f"\npresets {presets}\n".encode()), (rb'token "[^"]*"', f'token "{TOKEN}"'.encode())]
    for name, index, value in (("position", 0, -194.9), ("velocity", 0, 5.0)):
        path = f'("inputs.ships.0.{name}" {index}) ' + r"0x0.0p\+0"
        changes.append((path.encode(), rb"\1 " + value.hex().encode()))
    changes.append((rb'("inputs.ships.1.attitude" 2) 0x0.0p\+0', rb"\1 " + (1.0).hex().encode()))
    folders = {}
    for flavour in ("2", "3"):
        folder = folders[flavour] = Path(extract(native_collisions[flavour], tmp_path_factory.mktemp("collision")))
        rewrite_table(folder, *changes)
    return folders


def run(program: Path, command: str, folders: dict[str, Path], *numbers: int, second: Path | None = None) -> str:
    """What it printed; it must end well and write nothing else."""
    first = folders["3" if command == "locations" else "2"] / "resources"
    second = second or folders["3"] / "resources"
    done = subprocess.run(
        [program, command, first, second, *map(str, numbers)],
        capture_output=True, text=True, errors="replace", check=False, timeout=3600, env={},
    )  # fmt: skip
    assert (done.returncode, done.stderr[-3000:]) == (0, ""), done.stdout
    return done.stdout


@pytest.mark.slow
def test_random_calls(watched: Path, native_dummies: dict[str, Path]) -> None:
    """10 000 sequences take 2 s."""
    said = run(watched, "calls", native_dummies, 0, 10_000)
    assert re.match(r"10000 sequences, [1-9]\d{4} lines", said)


@pytest.mark.soak
def test_a_million_random_sequences(watched: Path, native_dummies: dict[str, Path]) -> None:
    run(watched, "calls", native_dummies, 10_000, 1_000_000)


@pytest.mark.slow
def test_random_locations_and_damaged_tables(watched: Path, native_dummies: dict[str, Path], tmp_path: Path) -> None:
    said = run(watched, "locations", native_dummies, 0, 2000, second=tmp_path)
    made, read = map(int, re.findall(r"(\d+) with", said))
    assert 10 < made < 200  # both happens
    assert 1 < read < 200


@pytest.mark.slow
def test_two_threads(native_dummies: dict[str, Path], tmp_path: Path) -> None:
    program = build_exercise(CACHE, tmp_path, *THREAD)
    assert run(program, "threads", native_dummies, 7, 100) == "2 threads, 100 instances each\n"


@pytest.mark.slow
def test_random_calls_on_the_ship(ships: dict[str, Path], tmp_path: Path) -> None:
    program = build_exercise(CACHE, tmp_path, *ADDRESS, parts=list_fmu_parts("ShipManoeuvring", CACHE))
    said = run(program, "calls", ships, 0, 3000, len(INTERFACE.table(())) + 5)
    assert re.match(r"3000 sequences, [1-9]\d{4} lines", said)


@pytest.mark.slow
def test_two_threads_with_a_ship_each(ships: dict[str, Path], tmp_path: Path) -> None:
    program = build_exercise(CACHE, tmp_path, *THREAD, parts=list_fmu_parts("ShipManoeuvring", CACHE))
    names = [line.name for line in INTERFACE.table(())]
    arrays = [array.name for array in gather_arrays(INTERFACE.table(()))]
    inputs = names.index("force.surge"), arrays.index("force") + 1
    assert run(program, "threads", ships, 7, 50, *inputs) == "2 threads, 50 instances each\n"


@pytest.mark.slow
def test_random_calls_on_a_collision(collisions: dict[str, Path], tmp_path: Path) -> None:
    program = build_exercise(CACHE, tmp_path, *CONTACT, parts=list_fmu_parts("ShipCollision", CACHE))
    said = run(program, "calls", collisions, 0, 200, len(COLLISION.table(("own", "target"))) + 5)
    assert re.match(r"200 sequences, [1-9]\d{2,} lines", said)


@pytest.mark.soak
def test_more_random_calls_on_a_collision(collisions: dict[str, Path], tmp_path: Path) -> None:
    program = build_exercise(CACHE, tmp_path, *CONTACT, parts=list_fmu_parts("ShipCollision", CACHE))
    run(program, "calls", collisions, 1000, 20_000, len(COLLISION.table(("own", "target"))) + 5)


@pytest.mark.soak
def test_two_threads_with_a_collision_each(collisions: dict[str, Path], tmp_path: Path) -> None:
    """A minute to compile."""
    program = build_exercise(CACHE, tmp_path, *THREAD, parts=list_fmu_parts("ShipCollision", CACHE))
    table = COLLISION.table(("own", "target"))
    names = [line.name for line in table]
    arrays = [array.name for array in gather_arrays(table)]
    inputs = names.index("own.velocity.surge"), arrays.index("own.velocity") + 1
    assert run(program, "threads", collisions, 7, 50, *inputs) == "2 threads, 50 instances each\n"


def assert_flat(said: str, steps: int = 1_000_000) -> None:
    """Assert that memory is as at the first tenth, and that only each thousandth step, without a number, is refused."""
    assert said.startswith(f"{steps} steps, {steps // 1000} refused")
    before, after, first, last = (int(size) for size in re.findall(r"(\d+) (?:to|kB)", said))
    assert after - before < 200, said  # kB: the C library's own
    assert last - first < 200, said


@pytest.mark.slow
def test_nothing_grows(plain: Path, native_dummies: dict[str, Path]) -> None:
    said = run(plain, "growth", native_dummies, 1_000_000, 10_000)
    assert_flat(said)


@pytest.mark.slow
def test_nothing_grows_with_a_ship_that_sails(ships: dict[str, Path], tmp_path: Path) -> None:
    program = build_exercise(CACHE, tmp_path, parts=list_fmu_parts("ShipManoeuvring", CACHE))
    names = [line.name for line in INTERFACE.table(())]
    said = run(
        program, "growth", ships, 1_000_000, 10_000, names.index("force.surge"), names.index("position.north"), -1
    )
    assert_flat(said)


@pytest.mark.slow
def test_nothing_grows_with_ships_in_contact(collisions: dict[str, Path], tmp_path: Path) -> None:
    program = build_exercise(CACHE, tmp_path, parts=list_fmu_parts("ShipCollision", CACHE))
    names = [line.name for line in COLLISION.table(("own", "target"))]
    inputs, outputs = names.index("target.impulse_applied.surge"), names.index("target.post.position.north")
    assert_flat(run(program, "growth", collisions, 10_000, 200, inputs, outputs, -1), 10_000)


@pytest.mark.slow
def test_a_host_that_rounds_otherwise_gets_the_same_bits(plain: Path, native_dummies: dict[str, Path]) -> None:
    assert run(plain, "rounding", native_dummies) == "4 control words\n"
