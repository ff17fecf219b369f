"""Bullet's source: what pip fetches is checked, unpacked and kept."""

from __future__ import annotations

import hashlib
import io
import subprocess
import tarfile
from pathlib import Path
from types import SimpleNamespace

import pytest

from shipcollision_fmu.errors import HostError
from shipcollision_fmu.toolchain import bullet_sources
from shipcollision_fmu.toolchain.bullet_sources import ARCHIVE, FILES, LICENCE, find_bullet_sources


def make_archive(folder: Path) -> None:
    """An archive with the files that are wanted, and more."""
    root = ARCHIVE.removesuffix(".tar.gz")
    with tarfile.open(folder / ARCHIVE, "w:gz") as packed:
        for name in (*FILES, "BulletSoftBody/btSoftBody.h"):
            member = tarfile.TarInfo(f"{root}/{name}" if name == LICENCE else f"{root}/src/{name}")
            content = f"// {name}\n".encode()
            member.size = len(content)
            packed.addfile(member, io.BytesIO(content))


def test_the_files_that_are_needed_are_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fetched = []

    def fetch(folder: Path) -> None:
        fetched.append(folder)
        make_archive(folder)
        monkeypatch.setattr(bullet_sources, "SHA_256", hashlib.sha256((folder / ARCHIVE).read_bytes()).hexdigest())

    folder = find_bullet_sources(tmp_path, fetch)
    assert find_bullet_sources(tmp_path, fetch) == folder
    assert len(fetched) == 1
    assert sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()) == sorted(FILES)
    assert (folder / FILES[1]).read_text() == f"// {FILES[1]}\n"
    (folder / FILES[1]).unlink()
    assert find_bullet_sources(tmp_path, fetch) == folder
    assert (folder / FILES[1]).is_file()
    assert [path.name for path in folder.parent.iterdir()] == [folder.name]


def test_another_archive_is_refused(tmp_path: Path) -> None:
    with pytest.raises(HostError, match=r"^Bullet's source cannot be used: .* is not pybullet-3.2.7.tar.gz"):
        find_bullet_sources(tmp_path, make_archive)
    assert not any(tmp_path.rglob("*.h"))


def test_when_pip_fails_its_reason_is_given(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[list[str]] = []

    def fail(command: list[str], **options: object) -> SimpleNamespace:
        asked.append(command)
        said = "WARNING: slow\nERROR: No matching distribution found for pybullet==3.2.7\n"
        return SimpleNamespace(returncode=1, stderr=said, stdout="")

    monkeypatch.setattr(subprocess, "run", fail)
    with pytest.raises(HostError) as refused:
        find_bullet_sources(tmp_path)
    assert asked[0][1:4] == ["-m", "pip", "download"]
    said = str(refused.value)
    assert "(ERROR: No matching distribution found for pybullet==3.2.7)" in said
    assert "-m pip` works" in said
    assert str(tmp_path / "bullet-3.26") in said
    assert "\n" not in said
