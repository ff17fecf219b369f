"""Random calls with random values never crash the host, and a restored state or a reset works after them: see fuzz.py.

A failure names the seed. To look at it: `python tests/fmi/fuzz.py FOLDER STATES.json --seed N --count 1 --trace`.
"""

from __future__ import annotations

import base64
import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

from shipcollision_fmu.fmi.slave_base import state_to_bytes

from .saved_states import saved_states

FUZZ = Path(__file__).with_name("fuzz.py")
WHICH = [("Dummy", 2), ("Dummy", 3), ("ShipManoeuvring", 2), ("ShipManoeuvring", 3),
         ("ShipCollision", 2), ("ShipCollision", 3)]  # fmt: skip

Fuzz = Callable[[tuple[str, int], int, int], None]


@pytest.fixture(scope="session")
def states(dummy: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Files with saved states by name of the FMU."""
    access = dummy.INTERFACE.make_access()
    found = {"Dummy": [state_to_bytes(access.save())], **saved_states()}
    access.initialise()
    for k in range(3):
        found["Dummy"].append(state_to_bytes(access.save()))
        access.do_step(k * 0.1, 0.1)
    del found["Dummy"][0]  # of before initialisation: no step follows
    folder = tmp_path_factory.mktemp("states")
    for name, made in found.items():
        (folder / f"{name}.json").write_text(json.dumps([base64.b64encode(data).decode() for data in made]))
    return {name: folder / f"{name}.json" for name in found}


@pytest.fixture
def fuzz(unpacked: Path, unpacked3: Path, real_unpacked: dict[tuple[str, int], Path], states: dict[str, Path]) -> Fuzz:
    folders = {("Dummy", 2): unpacked, ("Dummy", 3): unpacked3, **real_unpacked}

    def run(which: tuple[str, int], seed: int, count: int) -> None:
        done = subprocess.run(
            [sys.executable, "-X", "faulthandler", FUZZ, folders[which], states[which[0]],
             "--seed", str(seed), "--count", str(count)],
            capture_output=True, text=True, timeout=7200, check=False,
        )  # fmt: skip
        said = done.stdout.splitlines()
        print(*said[-3:], done.stderr[-3000:], sep="\n")  # noqa: T201 - the seed
        assert done.returncode == 0, f"{which}: exit status {done.returncode} at {said[-1:]}"
        assert f"seed {seed + count - 1}" in said
        assert f"done: {count} sequences" in said[-2]

    return run


@pytest.mark.parametrize(("which", "count"), [*zip(WHICH[:4:2], (50, 25), strict=True)])
def test_random_calls_never_crash_the_host(fuzz: Fuzz, which: tuple[str, int], count: int) -> None:
    fuzz(which, 0, count)


@pytest.mark.slow
@pytest.mark.parametrize(("which", "count"), [*zip(WHICH, (1000, 1000, 300, 300, 100, 100), strict=True)])
def test_more_random_sequences(fuzz: Fuzz, which: tuple[str, int], count: int) -> None:
    fuzz(which, 1000, count)


@pytest.mark.soak
@pytest.mark.parametrize(("which", "count"), [*zip(WHICH, (3500, 3500, 1000, 1000, 500, 500), strict=True)])
def test_ten_thousand_random_sequences(fuzz: Fuzz, which: tuple[str, int], count: int) -> None:
    """75 s of processor time."""
    fuzz(which, 10_000, count)


@pytest.mark.soak
@pytest.mark.parametrize("which", WHICH)
def test_ten_thousand_random_sequences_of_each(fuzz: Fuzz, which: tuple[str, int]) -> None:
    fuzz(which, 100_000, 10_000)


QUIET_END = """
import sys
sys.path.insert(0, sys.argv[1])
from pathlib import Path
from fuzz import Fmu
assert "numpy" not in sys.modules
fmu = Fmu(Path(sys.argv[2]))
kept = [fmu.instantiate(False) for _ in range(3)]
fmu.free(kept.pop())
assert "numpy" in sys.modules
"""


@pytest.mark.slow
@pytest.mark.parametrize("fmi", [2, 3])
def test_the_host_ends_well(real_unpacked: dict[tuple[str, int], Path], fmi: int) -> None:
    """The wrappers' libraries free memory twice at the end of a process: see fmi/wrapper_library.py."""
    folder = real_unpacked["ShipManoeuvring", fmi]
    done = subprocess.run(
        [sys.executable, "-c", QUIET_END, FUZZ.parent, folder], capture_output=True, text=True, timeout=600, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
