"""A disk that is full: a file system of some kilobytes in memory, mounted for one process alone.

Some systems let nobody mount, such as most containers. There these tests are not defined: in test_run.py a limit of the
size of files stands for the disk.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from shipcollision_fmu.study.engine.run import run_study
from tests.study.engine.cluster import DEADLINE, PROJECT
from tests.study.engine.folders import digest
from tests.study.engine.stand_in import StandIn, compute_stand_in

STUDY = StandIn(rows=6010)
"""31 parts. Two workers hold back four at most, which are lost with the one that finds no room."""

MOUNTED = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c"]
"""Runs a line of the shell with mounts of its own, which end with it."""
CLIENT = """
import shutil, sys
from pathlib import Path
from shipcollision_fmu.errors import HostError
from shipcollision_fmu.study.engine.run import run_study
from tests.study.engine.stand_in import compute_stand_in
from tests.study.engine.test_full_disk import STUDY

if __name__ == "__main__":
    workers, out, copy = int(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3])
    try:
        run_study(STUDY, out, workers=workers, resume=True, engine="python", compute=compute_stand_in)
    except HostError as error:
        print(error)
    shutil.copytree(out, copy)
"""


def can_mount() -> bool:
    """Whether a process may mount file systems for itself."""
    try:
        return subprocess.run([*MOUNTED, "mount -t tmpfs none /tmp"], capture_output=True, check=False).returncode == 0
    except OSError:
        return False


if can_mount():

    @pytest.mark.slow
    @pytest.mark.parametrize("workers", [0, 2])
    def test_a_full_disk_leaves_whole_parts_and_goes_on_with_room(tmp_path: Path, workers: int) -> None:
        """Room for half of the parts; then for all. Workers write there as well."""
        whole = tmp_path / "whole"
        run_study(STUDY, whole, workers=0, engine="python", compute=compute_stand_in)
        (tmp_path / "client.py").write_text(CLIENT, encoding="utf-8")
        (tmp_path / "disk").mkdir()
        pages = [-(-path.stat().st_size // 4096) for path in whole.rglob("*.parquet")]
        size = 4 * (sum(pages) // 2)
        run = f"{sys.executable} client.py {workers} disk/study"
        done = subprocess.run(
            [*MOUNTED, f"mount -t tmpfs -o size={size}k none disk && " + run + " full"
             + " && find disk -name '*.parquet' | wc -l && find disk -name '.ship*' | wc -l"
             + " && mount -o remount,size=2m disk && " + run + " enough"],
            cwd=tmp_path, env=os.environ | {"PYTHONPATH": str(PROJECT)}, capture_output=True, text=True,
            timeout=DEADLINE,
        )  # fmt: skip
        said, parts, left, *more = done.stdout.splitlines()
        assert said.startswith("cannot write to ") and "disk/study" in said, done.stderr  # noqa: PT018  one line
        assert said.endswith(
            ": No space left on device; make room on the disk, or its folder writable, then go on with --resume"
        )
        assert 2 * 8 <= int(parts) < 2 * 16  # of two files each
        assert (left, more) == ("0", [])
        assert digest(tmp_path / "full").items() < digest(whole).items()
        assert digest(tmp_path / "enough") == digest(whole)
