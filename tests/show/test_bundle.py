"""The page's bundle is made from the sources that are here, and a build that cannot fetch says what it needs."""

from __future__ import annotations

import importlib.util
import shutil
from pathlib import Path
from types import ModuleType

import pytest

PROJECT = Path(__file__).parents[2]
PAGE = PROJECT / "shipcollision_fmu" / "show" / "page"


@pytest.fixture(scope="module")
def hook() -> ModuleType:
    """hatch_build.py as a module."""
    spec = importlib.util.spec_from_file_location("hatch_build", PROJECT / "hatch_build.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    return Path(shutil.copytree(PAGE, tmp_path / "page", ignore=shutil.ignore_patterns("node_modules")))


def test_the_bundle_that_the_tests_see_is_that_of_the_present_sources(hook: ModuleType) -> None:
    assert hook.is_current(PAGE), "run `python hatch_build.py`"


@pytest.mark.parametrize("name", ["src/sea.js", "src/style.css", "src/live/main.js", "package-lock.json", "build.mjs"])
def test_a_change_asks_for_a_new_bundle(hook: ModuleType, copy: Path, name: str) -> None:
    assert hook.is_current(copy)
    with (copy / name).open("a") as file:
        file.write("\n")
    assert not hook.is_current(copy)


def test_a_missing_bundle_is_noticed(hook: ModuleType, copy: Path) -> None:
    (copy / "bundle" / "page.css").unlink()
    assert not hook.is_current(copy)


def test_npm_that_reaches_nobody_is_one_clear_line(
    hook: ModuleType, copy: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("npm_config_registry", "http://127.0.0.1:9")
    monkeypatch.setenv("npm_config_cache", str(tmp_path / "cache"))
    monkeypatch.setenv("npm_config_fetch_retries", "0")
    shutil.rmtree(copy / "bundle")
    with pytest.raises(SystemExit) as caught:
        hook.bundle(copy)
    said = str(caught.value)
    assert said.startswith("the replay page cannot be bundled: npm ci failed. It needs three.js, uPlot and esbuild")
    assert "\n" not in said
    assert not (copy / "bundle").exists()


def test_lock_files_name_no_registry() -> None:
    for folder in (PAGE, PROJECT / "tests" / "show" / "gltf"):
        text = (folder / "package-lock.json").read_text(encoding="utf-8")
        assert '"resolved"' not in text
        assert '"integrity"' in text
