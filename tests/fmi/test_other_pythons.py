"""ShipManoeuvring on later versions of CPython, for which pybullet has no wheels."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE
from tests.needs import find_python

HOST = """
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


ship, water, surge, propeller, rudder, north, yaw = references
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
"""A host in plain Python: the other interpreter needs the packages of requirements.txt and nothing else."""
NAMES = (
    "ship", "hydrodynamics", "initial.velocity.surge", "propeller_order", "rudder_order", "position.north",
    "attitude.yaw",
)  # fmt: skip


def sailed(python: str, unpacked: Path, packages: str = "") -> str:
    """What the host prints with that interpreter; packages: a folder with them."""
    access = INTERFACE.make_access()
    references = map(str, access.references(NAMES))
    guid = (unpacked / "modelDescription.xml").read_text(encoding="utf-8").partition('guid="')[2].partition('"')[0]
    clean = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    clean["PYTHONPATH"] = packages
    done = subprocess.run(
        [python, "-W", "error", "-c", HOST, str(unpacked), guid, *references], env=clean, cwd="/",
        capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_it_sails_without_pybullet(real_unpacked: dict[tuple[str, int], Path]) -> None:
    north, yaw = map(float.fromhex, sailed(sys.executable, real_unpacked["ShipManoeuvring", 2]).split())
    assert north == pytest.approx(20.0 * 7.0, rel=0.05)  # 20 s, begun at 7 m/s
    assert yaw != 0.0


@pytest.mark.parametrize(
    "version",
    [
        pytest.param("3.13", marks=[pytest.mark.slow, pytest.mark.needs("python3.13")]),
        pytest.param("3.12", marks=[pytest.mark.soak, pytest.mark.needs("python3.12")]),
    ],
)
def test_it_gives_the_same_on_later_pythons(
    version: str, real_unpacked: dict[tuple[str, int], Path], tmp_path: Path
) -> None:
    """With the packages of its requirements and no other. Two versions of NumPy may differ in the last bit."""
    first, last = (tuple(map(int, one.split("."))) for one in INTERFACE.pythons)
    assert first <= tuple(map(int, version.split("."))) <= last
    python = find_python(version)
    assert python is not None
    needs = real_unpacked["ShipManoeuvring", 2] / "resources" / "requirements.txt"
    packages = ["--target", tmp_path, "--python-version", version, "--only-binary", ":all:", "-r", needs]
    subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", *packages], check=True, capture_output=True)
    here = sailed(sys.executable, real_unpacked["ShipManoeuvring", 2])
    there = sailed(python, real_unpacked["ShipManoeuvring", 2], str(tmp_path))
    for ours, theirs in zip(here.split(), there.split(), strict=True):
        assert float.fromhex(theirs) == pytest.approx(float.fromhex(ours), rel=1e-12)
    assert COLLISION.pythons[1] == "3.11"
