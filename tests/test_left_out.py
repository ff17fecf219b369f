"""A machine that lacks something runs the rest of the tests, says in a line what it left out, and may fail."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.hosts.masters import libtbb
from tests.needs import describe_left_out

ROOT = Path(__file__).parents[1]


def test_a_line_says_how_many_where_and_what_installs_it() -> None:
    left = [
        ("tests/a.py::one[1]", ["chromium"]),
        ("tests/a.py::two", ["chromium"]),
        ("tests/b.py::three", ["chromium"]),
        ("tests/c.py::four", ["libpython", "chromium"]),
    ]
    assert describe_left_out(left) == [
        "left out: 3 tests in tests/a.py, tests/b.py: no Chromium with its driver here; apt-get install chromium "
        "chromium-driver",
        "left out: 1 test in tests/c.py: no shared libpython here; "
        f"apt-get install libpython3.{sys.version_info.minor}, or a CPython built with --enable-shared",
    ]
    assert describe_left_out([]) == []


@pytest.mark.slow
@pytest.mark.parametrize("workers", ["0", "2"])
def test_without_a_browser_the_rest_passes_and_the_gate_fails(tmp_path: Path, workers: str) -> None:
    """Two tests of a module, one of which is in a browser; a third is skipped."""
    (tmp_path / "test_skipped.py").write_text("import pytest\n\ndef test_it():\n    pytest.skip('why')\n")
    environment = {key: value for key, value in os.environ.items() if key != "PYTEST_ADDOPTS"}
    run = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "--nothing-left-out", "-q", "-n", workers]
    done = subprocess.run(
        [*run, "tests/docs/test_site_search.py", tmp_path / "test_skipped.py"],
        cwd=ROOT, env=environment | {"PATH": str(tmp_path)}, capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert "1 passed, 1 skipped" in done.stdout, done.stdout + done.stderr
    assert "left out: 1 test in tests/docs/test_site_search.py: no Chromium with its driver here;" in done.stdout
    assert done.returncode == 1


def test_ecos_has_the_libtbb_that_pip_installed() -> None:
    """Whether Debian's is there or not."""
    code = "import ctypes, sys; ctypes.CDLL(sys.argv[1]); import ecospy; print(open('/proc/self/maps').read())"
    done = subprocess.run([sys.executable, "-c", code, libtbb()], capture_output=True, text=True, check=True)
    mapped = {line.split()[-1] for line in done.stdout.splitlines() if "libtbb.so" in line}
    assert mapped == {str(Path(libtbb()).resolve())}
