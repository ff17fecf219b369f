"""A host's process ends without a write to freed memory, which pythonfmu's wrapper would do (fmi/wrapper_library.py).

guard.c makes that write a SIGSEGV, each time, where it otherwise corrupts the heap now and then.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from tests.compiler import compile_c

from .encounter import MASTERS as SCRIPT
from .encounter import Encounter
from .masters import MASTERS

HOSTS = [host for host in MASTERS if host not in ("fmpy-simulate", "libcosim-ssp", "ecos-api")]
WITHOUT = "import shipcollision_fmu.fmi.wrapper_library as w; w.make_library_safe = lambda *given: None; "
RUN = "import sys, runpy; sys.argv = sys.argv[1:]; runpy.run_path(sys.argv[0], run_name='__main__')"


@pytest.fixture(scope="module")
def guard(tmp_path_factory: pytest.TempPathFactory) -> Path:
    library = tmp_path_factory.mktemp("guard") / "guard.so"
    compile_c("-O1", "-shared", "-fPIC", "-o", library, Path(__file__).with_name("guard.c"))
    return library


@pytest.mark.slow
def test_a_process_ends_well_in_every_host(encounters: dict[str, Encounter], guard: Path, tmp_path: Path) -> None:
    def ended(host: str, before: str = "") -> int:
        cases, results = tmp_path / f"{host}{bool(before)}.json", tmp_path / f"{host}{bool(before)}.result.json"
        cases.write_text(json.dumps([encounters["guan2014"].case() | {"steps": 12}]))
        return subprocess.run(
            [sys.executable, "-c", before + RUN, SCRIPT, host, cases, results],
            env=os.environ | {"LD_PRELOAD": str(guard)}, capture_output=True, check=False, timeout=600,
        ).returncode  # fmt: skip

    with ThreadPoolExecutor(2) as pool:
        control = pool.submit(ended, "fmpy-loop", WITHOUT)
        assert dict(zip(HOSTS, pool.map(ended, HOSTS), strict=True)) == dict.fromkeys(HOSTS, 0)
        assert control.result() == -11
