"""The native ship under a host without memory (scarce.c): refused calls, no crash, and no harm when memory is back."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

from fmpy import extract, read_model_description

from shipcollision_fmu.toolchain.sources import find_fmi_headers
from tests.compiler import compile_c


def test_each_request_for_memory_may_fail(native_fmus: dict[str, Path], tmp_path: Path) -> None:
    folder = Path(extract(native_fmus["2"], tmp_path / "unpacked"))
    guid = read_model_description(folder).guid
    source, program = Path(__file__).with_name("scarce.c"), tmp_path / "scarce"
    compile_c("-std=c11", "-D_GNU_SOURCE", "-O1", f"-I{find_fmi_headers()}", source, "-o", program, "-ldl")
    (library,) = (folder / "binaries" / "linux64").glob("*.so")
    done = subprocess.run(
        [program, library, guid, (folder / "resources").as_uri()],
        capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    numbers = re.fullmatch(r"(\d+) refused, (\d+) requests\n", done.stdout)
    assert numbers is not None
    assert min(map(int, numbers.groups())) > 20
