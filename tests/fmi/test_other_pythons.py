"""The FMUs on later versions of CPython, for which pybullet has no wheels."""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
from pathlib import Path

import pytest

from shipcollision_fmu.fmi.interface import Interface
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE
from shipcollision_fmu.toolchain.installed import COMPILED, STAMP, digest_native
from shipcollision_fmu.toolchain.platforms import find_own_target
from shipcollision_fmu.toolchain.sources import find_native
from tests.native.conftest import native_library
from tests.needs import find_python

__all__ = ["native_library"]

COMMON = """
import sys
from ctypes import CDLL, CFUNCTYPE, Structure, byref, c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p
from pathlib import Path

sys.modules["pybullet"] = None  # as if it were not installed
folder, guid, *references = sys.argv[1:]


class Callbacks(Structure):
    _fields_ = [(name, c_void_p) for name in ("logger", "allocate", "free", "finished", "environment")]


log = CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p)(lambda *said: print(said, file=sys.stderr))
from ctypes import cast
callbacks = Callbacks(cast(log, c_void_p))
dll = CDLL(next(Path(folder).glob("binaries/linux64/*.so")))
dll.fmi2Instantiate.restype = c_void_p
uri = b"file://" + (folder + "/resources").encode()
one = c_void_p(dll.fmi2Instantiate(b"one", 1, guid.encode(), uri, byref(callbacks), 0, 1))
assert one.value


def call(name, *arguments):
    status = getattr(dll, "fmi2" + name)(one, *arguments)
    assert status == 0, (name, status)


def one_of(reference):
    return (c_uint * 1)(int(reference)), c_size_t(1)


"""
"""A host in plain Python: the other interpreter needs the packages of requirements.txt and nothing else."""
SAILS = """
ship, water, surge, propeller, rudder, north, yaw = references
call("SetString", *one_of(ship), (c_char_p * 1)(b"caf\\xe9"))  # not UTF-8: refused, and the process goes on
call("Reset")
call("SetString", *one_of(ship), (c_char_p * 1)(b"kvlcc2"))
call("SetBoolean", *one_of(water), (c_int * 1)(1))
call("SetReal", *one_of(surge), (c_double * 1)(7.0))
call("SetReal", *one_of(propeller), (c_double * 1)(1.7))
call("SetReal", *one_of(rudder), (c_double * 1)(0.6))
call("SetupExperiment", 0, c_double(0.0), c_double(0.0), 0, c_double(0.0))
call("EnterInitializationMode")
call("ExitInitializationMode")
for k in range(40):
    call("DoStep", c_double(k * 0.5), c_double(0.5), 1)
values = (c_double * 2)()
call("GetReal", (c_uint * 2)(int(north), int(yaw)), c_size_t(2), values)
print(values[0].hex(), values[1].hex())
call("Terminate")
dll.fmi2FreeInstance(one)
"""
COLLIDES = """
own, target, east, heading, surge, other, count, impulse = references
for ship in (own, target):
    call("SetString", *one_of(ship), (c_char_p * 1)(b"kvlcc2"))
call("SetupExperiment", 0, c_double(0.0), c_double(0.0), 0, c_double(0.0))
call("EnterInitializationMode")
for reference, value in ((east, -200.0), (heading, 1.5), (surge, 3.0), (other, 0.0)):
    call("SetReal", *one_of(reference), (c_double * 1)(value))
call("ExitInitializationMode")
values, found = (c_double * 1)(), (c_int * 1)()
for k in range(100):
    call("SetReal", *one_of(east), (c_double * 1)(-200.0 + 0.3 * k))
    call("DoStep", c_double(k * 0.1), c_double(0.1), 1)
    call("GetInteger", *one_of(count), found)
    if found[0]:
        break
call("GetReal", *one_of(impulse), values)
print(float(k).hex(), values[0].hex())
call("Terminate")
dll.fmi2FreeInstance(one)
"""
SHIP = (
    "ship", "hydrodynamics", "initial.velocity.surge", "propeller_order", "rudder_order", "position.north",
    "attitude.yaw",
)  # fmt: skip
COLLISION_NAMES = (
    "own.ship", "target.ship", "own.position.east", "own.attitude.yaw", "own.velocity.surge", "target.position.north",
    "impact.count", "own.impulse.surge",
)  # fmt: skip


def printed(python: str, unpacked: Path, packages: str = "") -> list[float]:
    """What the host prints with that interpreter; packages: a folder with them."""
    code, names, interface = (
        (COLLIDES, COLLISION_NAMES, COLLISION) if "ShipCollision" in unpacked.name else (SAILS, SHIP, INTERFACE)
    )
    references = map(str, interface.make_access().references(names))
    guid = (unpacked / "modelDescription.xml").read_text(encoding="utf-8").partition('guid="')[2].partition('"')[0]
    clean = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    clean["PYTHONPATH"] = packages
    done = subprocess.run(
        [python, "-W", "error", "-c", COMMON + code, str(unpacked), guid, *references], env=clean, cwd="/",
        capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return list(map(float.fromhex, done.stdout.split()))


@pytest.fixture
def installed(native_library: ctypes.CDLL, tmp_path: Path) -> Path:
    """A folder with what an installed package has besides its modules: the library, as hatch_build.py places it."""
    target, library = find_own_target(), Path(native_library._name)
    assert target is not None
    folder = tmp_path / "installed" / "shipcollision_fmu" / COMPILED / target.folder
    folder.mkdir(parents=True)
    (folder / library.name).write_bytes(library.read_bytes())
    (folder / STAMP).write_text(digest_native(find_native()) + "\n")
    return tmp_path / "installed"


def test_it_sails_without_pybullet(real_unpacked: dict[tuple[str, int], Path]) -> None:
    north, yaw = printed(sys.executable, real_unpacked["ShipManoeuvring", 2])
    assert north == pytest.approx(20.0 * 7.0, rel=0.05)  # 20 s, begun at 7 m/s
    assert yaw != 0.0


def test_it_collides_without_pybullet(real_unpacked: dict[tuple[str, int], Path], installed: Path) -> None:
    """By the library of the package that is installed in the host's Python."""
    steps, surge = printed(sys.executable, real_unpacked["ShipCollision", 2], str(installed))
    assert 10 <= steps <= 40  # 11 m at 3 m/s, less the flare of the bow
    assert surge < -1e8  # 3e8 kg at 3 m/s


@pytest.fixture(
    scope="module",
    params=[
        pytest.param("3.13", marks=[pytest.mark.slow, pytest.mark.needs("python3.13")]),
        pytest.param("3.12", marks=[pytest.mark.soak, pytest.mark.needs("python3.12")]),
    ],
)
def later(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """A version of CPython, and a folder with the packages that the FMUs require there, and no other. Those of
    ShipCollision are the same, as pip takes markers for those of its own Python."""
    folder = tmp_path_factory.mktemp("site")
    needs = "".join(f"{line}\n" for line in INTERFACE.requirements)
    (folder / "requirements.txt").write_text(needs)
    options = ["--target", folder, "--python-version", request.param, "--only-binary", ":all:"]
    subprocess.run(
        [sys.executable, "-m", "pip", "install", "--quiet", *options, "-r", folder / "requirements.txt"],
        check=True, capture_output=True,
    )  # fmt: skip
    return request.param, folder


@pytest.mark.parametrize(("name", "interface"), [("ShipManoeuvring", INTERFACE), ("ShipCollision", COLLISION)])
def test_it_gives_the_same_on_later_pythons(
    name: str,
    interface: Interface,
    later: tuple[str, Path],
    real_unpacked: dict[tuple[str, int], Path],
    installed: Path,
) -> None:
    """Two versions of NumPy may differ in the last bit."""
    version, packages = later
    first, last = (tuple(map(int, one.split("."))) for one in interface.pythons)
    assert first <= tuple(map(int, version.split("."))) <= last
    python = find_python(version)
    assert python is not None
    here = printed(sys.executable, real_unpacked[name, 2], str(installed))
    there = printed(python, real_unpacked[name, 2], f"{packages}{os.pathsep}{installed}")
    assert there == pytest.approx(here, rel=1e-12)
