"""A program of this package in a process of its own: arrays in, arrays out.

There are two reasons for a process. Once CoACD's library is loaded, an FMU of a Python wrapper that is instantiated
next waits for the interpreter for ever. And a process can be ended when it takes too long.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ...errors import HostError, describe_installation

__all__ = ["Arrays", "OutOfTimeError", "ProgramError", "check_installed", "read_arrays", "run_program", "write_arrays"]

Arrays = dict[str, npt.NDArray[Any]]


class OutOfTimeError(Exception):
    """The program is ended: it has not come to an end in time."""


class ProgramError(Exception):
    """The program has failed; with the last line that it said."""


def run_program(program: str, arguments: tuple[object, ...], given: Mapping[str, Any], longest: float) -> Arrays:
    """Arrays that `program`, a module of this folder, makes from others within `longest` seconds.

    Its command line is GIVEN.npz MADE.npz LONGEST and the arguments. It ends itself too, should this process die before
    it. Raises OutOfTimeError and ProgramError, and HostError where there is no Python program.
    """
    command = [_find_interpreter(), "-m", f"{__package__}.{program}"]
    with tempfile.TemporaryDirectory(prefix="shipcollision-") as folder:
        files = Path(folder, "given.npz"), Path(folder, "made.npz")
        files[0].write_bytes(write_arrays(given))
        try:
            done = subprocess.run(
                [*command, *map(str, files), str(longest), *map(str, arguments)],
                stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", check=False,
                timeout=longest, env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            raise OutOfTimeError from None
        if done.returncode != 0 or not files[1].is_file():
            raise ProgramError((done.stderr.strip().splitlines()[-1:] or [f"exit status {done.returncode}"])[0])
        return read_arrays(files[1].read_bytes())


def check_installed(package: str, purpose: str) -> None:
    """Raise HostError, with the remedy, when a package that a program needs is missing."""
    if find_spec(package) is None:
        raise HostError(
            f"{package} cannot be imported (it is not installed), and {purpose}: {describe_installation('mesh')}"
        )


def _find_interpreter() -> str:
    """Python's program. In a simulator that embeds Python, sys.executable may be the simulator or empty."""
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    candidates = [Path(sys.executable)] if Path(sys.executable).name.startswith("python") else []
    for prefix in (sys.prefix, sys.exec_prefix, sys.base_exec_prefix):
        candidates += [Path(prefix, "bin", version), Path(prefix, "bin", "python3"), Path(prefix, "python.exe")]
    for candidate in candidates:
        if candidate.is_file():
            return str(candidate)
    raise HostError(
        f"no Python program is found below {sys.exec_prefix}, and a hull that is not convex is cut in a process of its "
        "own: load the ship once with `shipcollision ships`, which keeps its parts"
    )


def write_arrays(arrays: Mapping[str, Any]) -> bytes:
    """The content of a file of arrays by name."""
    file = BytesIO()
    np.savez(file, **arrays)
    return file.getvalue()


def read_arrays(content: bytes) -> Arrays:
    """The arrays of write_arrays. Raises ValueError, KeyError, EOFError, OSError or BadZipFile for anything else."""
    opened = np.load(BytesIO(content), allow_pickle=False)
    if not isinstance(opened, np.lib.npyio.NpzFile):
        raise ValueError("not a file of several arrays")
    with opened:
        return {name: opened[name] for name in opened.files}
