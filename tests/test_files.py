"""A run's folder is written whole or not at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from shipcollision_fmu.errors import HostError
from shipcollision_fmu.files import check_writable, write_files

FILES = {"one.csv": "1\n", "two.json": "{}\n"}


def test_files_are_written_and_replaced_and_others_left_alone(tmp_path: Path) -> None:
    out = tmp_path / "runs" / "deep" / "name"
    write_files(out, FILES)
    (out / "notes.txt").write_text("mine")
    write_files(out, FILES | {"one.csv": "2\n"})
    assert {path.name: path.read_text() for path in out.iterdir()} == {
        "one.csv": "2\n", "two.json": "{}\n", "notes.txt": "mine",
    }  # fmt: skip
    assert [path.name for path in out.parent.iterdir()] == ["name"]


def test_a_writable_place_is_found_without_leaving_anything(tmp_path: Path) -> None:
    check_writable(tmp_path / "a" / "b")
    check_writable(tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("below", ["", "run", "deep/run"])
def test_a_file_in_the_way_is_named(tmp_path: Path, below: str) -> None:
    (tmp_path / "file").write_text("mine")
    out = tmp_path / "file" / below
    with pytest.raises(HostError, match=r"cannot write to .*: .*/file is not a folder; give another folder with --out"):
        check_writable(out)
    with pytest.raises(HostError, match=r"cannot write to .*; give another folder with --out"):
        write_files(out, FILES)
    assert (tmp_path / "file").read_text() == "mine"


def test_a_system_folder_that_takes_no_files_is_refused() -> None:
    """/proc takes no files, even from root."""
    with pytest.raises(HostError, match=r"cannot write to /proc/run: "):
        check_writable(Path("/proc/run"))


def test_a_failure_half_way_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written = []

    def full_disk(path: Path, data: bytes) -> int:
        if written:
            raise OSError(28, "No space left on device")
        written.append(path.name)
        return len(data)

    monkeypatch.setattr(Path, "write_bytes", full_disk)
    with pytest.raises(HostError, match="No space left on device"):
        write_files(tmp_path / "new" / "run", FILES)
    assert list(tmp_path.iterdir()) == []
