"""Where FMUs are found, and when they are built."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

import shipcollision_fmu
from shipcollision_fmu.cosim import fmu_files
from shipcollision_fmu.cosim.fmu_files import fmu_directory, ready_fmus  # the real rule; conftest replaces it

CHECKOUT = Path(shipcollision_fmu.__file__).resolve().parent.parent


def test_a_checkout_keeps_its_fmus_in_build() -> None:
    assert fmu_directory() == CHECKOUT / "build"
    assert fmu_directory(("a", "b", "c")) == CHECKOUT / "build" / "a-b-c"


def test_an_installed_package_keeps_its_fmus_in_the_users_cache(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(fmu_files, "_PACKAGE", tmp_path / "site-packages" / "shipcollision_fmu")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    assert fmu_directory() == tmp_path / "cache" / "shipcollision-fmu"
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    assert fmu_directory() == tmp_path / "home" / ".cache" / "shipcollision-fmu"


@pytest.mark.one_in(2)
@pytest.mark.parametrize("name", ["ShipCollision", "ShipManoeuvring"])
def test_fmus_are_built_when_missing_or_broken_and_kept_when_current(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, name: str
) -> None:
    monkeypatch.setattr(fmu_files, "fmu_directory", lambda ships: tmp_path / "fmus")
    path = ready_fmus()[name]
    first = path.read_bytes()
    os.utime(path, (0, 0))
    assert ready_fmus()[name] == path
    assert path.stat().st_mtime == 0  # kept
    path.write_bytes(first[:1000])
    assert ready_fmus()[name].read_bytes() == first
    path.unlink()
    assert ready_fmus()[name].read_bytes() == first


def test_fmus_for_other_ships_are_others(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(fmu_files, "fmu_directory", lambda ships: tmp_path)
    first = ready_fmus(("own", "target"))["ShipCollision"].read_bytes()
    assert ready_fmus(("tug", "tow"))["ShipCollision"].read_bytes() != first
    assert ready_fmus(("own", "target"))["ShipCollision"].read_bytes() == first
