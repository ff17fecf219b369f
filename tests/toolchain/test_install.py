"""The library that comes with the package: when it is compiled, where it lies, and when it is stale."""

from __future__ import annotations

import importlib.util
import platform
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

from shipcollision_fmu.errors import HostError
from shipcollision_fmu.toolchain import install, installed, load
from shipcollision_fmu.toolchain.installed import find_installed_library, find_library_of, has_pybullet_wheels
from shipcollision_fmu.toolchain.platforms import find_own_target

PROJECT = Path(__file__).parents[2]


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package with one C++ source, and what compiles it."""
    folder = tmp_path / "site-packages" / "shipcollision_fmu"
    (folder / "native" / "numbers").mkdir(parents=True)
    (folder / "native" / "numbers" / "one.cpp").write_text("int one = 1;\n")
    target = find_own_target()
    assert target is not None
    compiled = tmp_path / f"shipcollision{target.suffix}"
    compiled.write_bytes(b"a library")
    monkeypatch.setattr(install, "build_own_library", lambda: compiled)
    monkeypatch.setattr(install, "find_native", lambda: folder / "native")
    return folder


@pytest.fixture(scope="module")
def hook() -> ModuleType:
    """hatch_build.py as a module."""
    spec = importlib.util.spec_from_file_location("hatch_build", PROJECT / "hatch_build.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_it_is_compiled_once_and_again_after_a_change_of_the_sources(package: Path) -> None:
    assert find_library_of(package) is None
    made = install.install_library(package)
    assert made.read_bytes() == b"a library"
    assert find_library_of(package) == made
    inode = made.stat().st_ino
    assert install.install_library(package).stat().st_ino == inode
    (package / "native" / "numbers" / "two.hpp").write_text("#pragma once\n")
    assert find_library_of(package) is None
    assert install.install_library(package).stat().st_ino != inode
    assert find_library_of(package) == made


def test_an_fmu_takes_that_of_the_package_on_the_path(
    package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    unpacked = tmp_path / "fmu" / "resources" / "shipcollision_fmu" / "toolchain" / "installed.py"
    monkeypatch.setattr(installed, "__file__", str(unpacked))
    monkeypatch.setattr(sys, "path", [str(tmp_path / "fmu" / "resources"), str(package.parent)])
    assert find_installed_library() is None
    made = install.install_library(package)
    assert find_installed_library() == made


@pytest.mark.parametrize(
    ("version", "system", "machine", "there"),
    [
        ((3, 10), "linux", "x86_64", True), ((3, 11), "linux", "x86_64", True), ((3, 12), "linux", "x86_64", False),
        ((3, 11), "linux", "aarch64", False), ((3, 11), "win32", "AMD64", False), ((3, 11), "darwin", "arm64", False),
    ],
)  # fmt: skip
def test_it_is_compiled_where_pybullet_has_no_wheels(
    version: tuple[int, int], system: str, machine: str, there: bool, hook: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "version_info", version)
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(platform, "machine", lambda: machine)
    assert has_pybullet_wheels() is there
    fake = SimpleNamespace(
        has_compiler=lambda: machine == "aarch64", install_library=lambda package: package / "compiled" / "x" / "y.so"
    )
    installed_there = SimpleNamespace(has_pybullet_wheels=lambda: there, find_library_of=lambda package: None)
    monkeypatch.setattr(hook, "import_toolchain", lambda root: (installed_there, fake))
    assert hook.make_library("/root", pytest.fail) == ([] if there else ["/shipcollision_fmu/compiled/x/*"])
    needs = [] if there else ["pip"] if machine == "aarch64" else ["pip", hook.ZIG]
    assert hook.needs_of_library("/root") == needs


def test_without_it_the_package_is_installed_all_the_same(hook: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(package: Path) -> Path:
        raise HostError("Bullet's source cannot be fetched")

    monkeypatch.setattr(install, "install_library", refuse)
    monkeypatch.setattr(installed, "has_pybullet_wheels", lambda: False)
    said: list[str] = []
    assert hook.make_library(str(PROJECT), said.append) == []
    assert said == [
        "installed without the native library, which detects contacts on this Python: Bullet's source cannot be fetched"
    ]


def test_a_library_with_other_signatures_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(load, "find_installed_library", lambda: tmp_path / "shipcollision.so")
    monkeypatch.setattr(load.ctypes, "CDLL", lambda path: SimpleNamespace(shipcollision_interface=lambda: 0))
    with pytest.raises(HostError, match=r"has version 0 of its interface, and \d+ is needed: install the same version"):
        load.load_library.__wrapped__()


def test_an_fmu_without_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    """An FMU carries nothing that compiles."""
    monkeypatch.setattr(load, "find_installed_library", lambda: None)
    monkeypatch.setitem(sys.modules, "shipcollision_fmu.toolchain.bullet_sources", None)
    with pytest.raises(HostError, match=r"^an FMU has no native library .*`python -m pip install shipcollision-fmu`$"):
        load.load_library.__wrapped__()
