"""What some tests drive and pip cannot install. Tests whose need is not met are left out; one line says which.

A test names its need as `@pytest.mark.needs("osgviewer")`; the fixture `browser` names its own. `--nothing-left-out`
makes a run fail that leaves a test out or skips one: .ci/run takes it where all needs are met.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
from collections import defaultdict
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache, partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

__all__ = [
    "BY_FIXTURE",
    "NEEDS",
    "Need",
    "describe_left_out",
    "find_python",
    "find_unmet",
    "needs_program",
    "shared_libpython",
]


@dataclass(frozen=True)
class Need:
    """Something that a test drives."""

    name: str
    """As the line says it."""
    is_met: Callable[[], bool]
    remedy: str
    """What installs it."""


def are_programs(*names: str) -> bool:
    """Whether all programs are on the path."""
    return all(map(shutil.which, names))


def shared_libpython() -> Path | None:
    """The shared library of this CPython, which a host that is not Python loads; Debian has it in a package apart."""
    library = Path(str(sysconfig.get_config_var("LIBDIR")), str(sysconfig.get_config_var("INSTSONAME")))
    return library if ".so" in library.name and library.is_file() else None


@cache
def find_python(version: str) -> str | None:
    """A CPython of a version that runs, from PATH or from pyenv's folder."""
    home = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv"))
    found = [shutil.which(f"python{version}"), *home.glob(f"versions/{version}*/bin/python{version}")]
    for one in filter(None, map(str, filter(None, found))):
        if subprocess.run([one, "-c", ""], capture_output=True, check=False).returncode == 0:
            return one
    return None


def has_python(version: str) -> bool:
    """Whether there is one."""
    return find_python(version) is not None


_DEBIAN = "apt-get install "
NEEDS = {
    "chromium": Need(
        "Chromium with its driver", lambda: are_programs("chromium", "chromedriver"),
        f"{_DEBIAN}chromium chromium-driver",
    ),
    "osgviewer": Need(
        "osgviewer and Xvfb", lambda: are_programs("osgviewer", "osgconv", "Xvfb"), f"{_DEBIAN}openscenegraph xvfb"
    ),
    "wine": Need("Wine", partial(are_programs, "wine"), f"{_DEBIAN}--no-install-recommends wine wine64"),
    "qemu-aarch64": Need(
        "QEMU's user mode for ARM",
        lambda: are_programs("qemu-aarch64") and Path("/usr/aarch64-linux-gnu/lib/libc.so.6").is_file(),
        f"{_DEBIAN}qemu-user libc6-arm64-cross",
    ),
    "libpython": Need(
        "a shared libpython", lambda: shared_libpython() is not None,
        f"{_DEBIAN}libpython{sys.version_info.major}.{sys.version_info.minor}, or a CPython built with --enable-shared",
    ),
    "pybullet": Need(
        "pybullet", lambda: find_spec("pybullet") is not None,
        "take CPython 3.10 or 3.11 on Linux (x86-64), for which it has wheels",
    ),
    "gpsdecode": Need(
        "gpsdecode", partial(are_programs, "gpsdecode"), f"{_DEBIAN}--no-install-recommends gpsd-clients"
    ),
    "opendis": Need(
        "opendis", lambda: find_spec("opendis") is not None,
        "pip install --no-deps opendis: alone, as it asks for an old NumPy that it does not use",
    ),
    "g++": Need("g++ with its sanitizers", lambda: are_programs("gcc", "g++"), f"{_DEBIAN}g++"),
    **{
        f"python{version}": Need(
            f"CPython {version}", partial(has_python, version), f"put python{version} on the path"
        )
        for version in ("3.12", "3.13")
    },
}  # fmt: skip
BY_FIXTURE = {"browser": "chromium", "guan2014": "pybullet", "encounters": "pybullet"}
"""Fixtures that need something: all tests that use one do."""

OF_PYTHON = {"pybullet", "libpython"}
"""Needs that a Python meets or not, whatever programs there are."""


def needs_program(item: Any) -> bool:
    """Whether a test uses a program that pip cannot install."""
    return any(name not in OF_PYTHON for mark in item.iter_markers("needs") for name in mark.args)


def find_unmet(item: Any, is_met: Callable[[str], bool]) -> list[str]:
    """Needs of a test that are not met, by name; a name that is not in NEEDS is a mistake."""
    named = [name for mark in item.iter_markers("needs") for name in mark.args]
    for name in named:
        if name not in NEEDS:
            raise pytest.UsageError(f"{item.nodeid} needs {name!r}, which tests/needs.py does not have")
    return [name for name in dict.fromkeys(named) if not is_met(name)]


def describe_left_out(left: Iterable[tuple[str, list[str]]]) -> list[str]:
    """A line for each need that is not met, of (node id, needs) of the tests left out: how many, where, the remedy."""
    files: dict[str, list[str]] = defaultdict(list)
    for node, needs in left:
        files[needs[0]].append(node.partition("::")[0])
    return [
        f"left out: {len(found)} test{'s' if len(found) > 1 else ''} in {', '.join(dict.fromkeys(found))}: no "
        f"{NEEDS[name].name.removeprefix('a ')} here; {NEEDS[name].remedy}"
        for name, found in files.items()
    ]
