"""Ctrl-C ends a command with one line and status 130 while its modules are imported, and harms none that is done."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from shipcollision_fmu.cosim import fmu_files

INTERRUPTED = """
import atexit, os, runpy, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell that starts the tests may have it ignored
class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Finder())
if not {module!r}:
    atexit.register(os.kill, os.getpid(), signal.SIGINT)
sys.argv = ["shipcollision", "--version"]
runpy.run_module("shipcollision_fmu", run_name="__main__", alter_sys=True)
"""


@pytest.mark.parametrize(("module", "status"), [("click", 130), ("rich.console", 130), ("", 0)])
def test_an_interrupt_outside_a_command_is_at_most_one_line(module: str, status: int) -> None:
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED.format(module=module)],
        env=os.environ | {"PYTHONPATH": str(fmu_files._PACKAGE.parent)}, capture_output=True, text=True, timeout=600,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (status, "error: interrupted\n" if status else "")


def test_the_command_is_the_guarded_one() -> None:
    """pyproject.toml names it for the script `shipcollision`."""
    text = (fmu_files._PACKAGE.parent / "pyproject.toml").read_text(encoding="utf-8")
    assert 'shipcollision = "shipcollision_fmu.__main__:main"' in text
