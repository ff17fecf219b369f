"""Calls to an FMU, made in another process.

    findings = run_probes(fmu)

An FMU that crashes ends that process only; the crash is then the finding, and the other probes (probes.py) run in the
next process.

    python -m shipcollision_fmu.compliance.calls FOLDER PROBE ...      probes on an unpacked FMU; prints findings
"""

from __future__ import annotations

import json
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryFile, mkdtemp

from fmpy import extract, platform_tuple, read_model_description

from .probes import PROBES, Probe

__all__ = ["run_probes"]

TIME_OUT = 60.0
"""[s] Limit of a process with all its probes; a process that takes longer is ended and reported."""
_MARK = "finding "
"""Beginning of a line with findings, since the FMU may print lines of its own."""


def run_probes(fmu: Path) -> list[tuple[Probe, str]]:
    """Findings of all probes on an FMU file, with the probe of each.

    Empty for an FMU that is not for co-simulation, or has no library for this platform.
    """
    folder = Path(mkdtemp(prefix="shipcollision-"))
    try:
        extract(fmu, folder)
        description = read_model_description(str(folder), validate=False)
        fmi3 = description.fmiVersion.startswith("3")
        platform = platform_tuple if fmi3 else {"x86_64-linux": "linux64"}.get(platform_tuple, platform_tuple)
        if description.coSimulation is None or not (folder / "binaries" / platform).is_dir():
            return []
        return list(_run_all(folder))
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _run_all(folder: Path) -> Iterator[tuple[Probe, str]]:
    """Findings of all probes; after a probe that ends its process the others run in a new process."""
    left = list(PROBES)
    while left:
        said, ended = _run_process(folder, [probe.name for probe in left])
        for line in said:
            probe = left.pop(0)
            yield from ((probe, finding) for finding in line)
        if left:
            yield left[0], f"{ended}: {left.pop(0).demand}"


def _run_process(folder: Path, names: list[str]) -> tuple[list[list[str]], str]:
    """Findings of each probe that ended, and a line on a process that ended early."""
    with TemporaryFile("w+", encoding="utf-8", errors="replace") as errors:
        command = [sys.executable, "-m", __name__, str(folder), *names]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors, text=True, errors="replace") as process:
            try:
                said, _ = process.communicate(timeout=TIME_OUT)
                ended = ""
            except subprocess.TimeoutExpired:
                process.kill()
                said, _ = process.communicate()
                ended = f"no answer within {TIME_OUT:g} s"
        errors.seek(0)
        last = errors.read().strip().splitlines()[-1:] or ["no message"]
    if not ended and process.returncode < 0:
        ended = f"crashes the host ({signal.Signals(-process.returncode).name})"
    marked = [line[len(_MARK) :] for line in said.splitlines() if line.startswith(_MARK)]
    return [json.loads(line) for line in marked], ended or f"cannot be tried: {last[0]}"


def main() -> None:
    """Run probes; print the findings of each as a JSON list on a marked line."""
    folder, *names = sys.argv[1:]
    for name in names:
        probe = next(probe for probe in PROBES if probe.name == name)
        print(f"{_MARK}{json.dumps(list(probe.run(Path(folder))))}", flush=True)  # noqa: T201 - read by _run_process


if __name__ == "__main__":
    main()
