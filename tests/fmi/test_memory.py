"""Instances give their memory back: rounds of instantiate, step, terminate, free in a process of their own.

What is counted are the bytes that malloc has given out, Python's objects among them (PYTHONMALLOC). The resident memory
depends on the kernel's pages and on what else the machine does.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROUNDS = """
import ctypes, gc, json, sys
sys.path.insert(0, sys.argv[1])
from pathlib import Path
from fuzz import Fmu

fmu, rounds, failing = Fmu(Path(sys.argv[2])), int(sys.argv[3]), sys.argv[4] == "failing"


class Mallinfo(ctypes.Structure):
    _fields_ = [(name, ctypes.c_size_t) for name in (
        "arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks", "fordblks", "keepcost")]


mallinfo = ctypes.CDLL(None).mallinfo2
mallinfo.restype = Mallinfo
used = []
for k in range(rounds):
    one = fmu.instantiate(False)
    if failing:
        fmu.set("String", one, fmu.kinds["String"][:1], [b"nobody"])
        fmu.enter(one, 0.0, 1.0)
        assert fmu.call("ExitInitializationMode")(one) == 4
        assert fmu.call("Reset")(one) == 0
    assert fmu.enter(one, 0.0, 1.0) == 0
    assert fmu.call("ExitInitializationMode")(one) == 0, fmu.said
    for j in range(3):
        assert fmu.step(one, 0.05 * j, 0.05) == 0, fmu.said
    state = fmu.saved(one)
    again = fmu.from_bytes(one, fmu.to_bytes(one, state))
    assert fmu.restored(one, again) == 0
    fmu.freed(one, state)
    fmu.freed(one, again)
    fmu.call("Terminate")(one)
    fmu.free(one)
    fmu.said.clear()
    if k % 10 == 9:
        gc.collect()
        now = mallinfo()
        used.append((now.uordblks + now.hblkhd) / 1e6)
print(json.dumps(used))
"""

WHICH = [(name, fmi) for name in ("ShipManoeuvring", "ShipCollision") for fmi in (2, 3)]


def grown(folder: Path, rounds: int, kind: str) -> float:
    """Growth of the memory in use [MB] after the first ten rounds."""
    done = subprocess.run(
        [sys.executable, "-c", ROUNDS, Path(__file__).parent, folder, str(rounds), kind],
        capture_output=True, text=True, timeout=600, check=False, env=os.environ | {"PYTHONMALLOC": "malloc"},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    used = json.loads(done.stdout.splitlines()[-1])
    assert len(used) == rounds // 10
    return float(max(used[1:]) - used[0])


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["plain", "failing"])
@pytest.mark.parametrize("which", WHICH)
def test_a_hundred_rounds_grow_by_less_than_2_mb(
    real_unpacked: dict[tuple[str, int], Path], which: tuple[str, int], kind: str
) -> None:
    """That tells a leak of 25 kB a round from what the wrappers keep, up to 15 kB."""
    assert grown(real_unpacked[which], 100, kind) < 2.25
