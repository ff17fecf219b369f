"""A hull from a mesh file is prepared once for one content and one set of keys, and kept in the user's cache."""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from shipcollision_fmu.cli import main
from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.ship.hull import hull_cache, mesh
from shipcollision_fmu.ship.hull.mesh import build_mesh_hull
from shipcollision_fmu.ship.hull.solid import HullMesh
from shipcollision_fmu.ship.tables.hull import HullTable
from tests.ship.hull.mesh_files import BAR, obj
from tests.ship_files import ship_toml

Loader = Callable[..., HullMesh]


@pytest.fixture
def load(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Loader:
    """Loads the angle bar as a hull, with a user's cache of its own. CO lies in the middle of its box."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    path = tmp_path / "bar.obj"
    path.write_text(obj(*BAR))

    def go(**keys: Any) -> HullMesh:
        table = {"shape": "mesh", "depth": 1.0, "file": str(path), "origin": [2.0, 1.5, 0.5], **keys}
        return build_mesh_hull(4.0, 3.0, 0.5, HullTable(**table))

    return go


def refuse(*_: Any, **__: Any) -> Any:
    raise AssertionError("prepared again")


def is_same(a: HullMesh, b: HullMesh) -> bool:
    arrays = [(h.vertices, h.triangles, *h.parts, *h.planes) for h in (a, b)]
    return (a.volume_error, a.bulge) == (b.volume_error, b.bulge) and all(map(np.array_equal, *arrays))


def test_a_hull_is_prepared_once_and_needs_no_package_then(load: Loader, monkeypatch: pytest.MonkeyPatch) -> None:
    first = load()
    assert len(first.parts) == 2
    monkeypatch.setattr(mesh, "_prepare", refuse)
    for package in ("trimesh", "coacd", "manifold3d"):
        monkeypatch.setitem(sys.modules, package, None)
    assert is_same(load(), first)


def test_other_keys_and_other_content_are_prepared_anew(
    load: Loader, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    load(convex_hull=True)
    monkeypatch.setattr(mesh, "_prepare", refuse)
    load(convex_hull=True)
    for keys in ({"convex_hull": True, "weld": 0.001}, {"convex_hull": True, "max_parts": 3}):
        with pytest.raises(AssertionError, match="prepared again"):
            load(**keys)
    (tmp_path / "bar.obj").write_text(obj(BAR[0] * 1.001, BAR[1]))
    with pytest.raises(AssertionError, match="prepared again"):
        load(convex_hull=True)


def test_another_program_prepares_anew(load: Loader, monkeypatch: pytest.MonkeyPatch) -> None:
    load(convex_hull=True)
    monkeypatch.setattr(mesh, "_prepare", refuse)
    monkeypatch.setattr(hull_cache, "_digest_program", lambda: "another")
    with pytest.raises(AssertionError, match="prepared again"):
        load(convex_hull=True)


def test_what_is_suspicious_is_said_at_every_load(load: Loader, caplog: pytest.LogCaptureFixture) -> None:
    load(convex_hull=True)
    first = {record.getMessage() for record in caplog.records}
    caplog.clear()
    load(convex_hull=True)
    again = {record.getMessage() for record in caplog.records}
    assert again <= first
    assert any("its convex hull of" in line for line in again)


@pytest.mark.slow
@pytest.mark.parametrize("content", [b"", b"junk", b"PK\x03\x04junk"])
def test_a_kept_file_that_is_broken_is_made_again(load: Loader, tmp_path: Path, content: bytes) -> None:
    first = load(convex_hull=True)
    (kept,) = (tmp_path / "cache").rglob("*.npz")
    whole = kept.read_bytes()
    kept.write_bytes(content or whole[: len(whole) // 2])
    assert is_same(load(convex_hull=True), first)
    assert kept.read_bytes() == whole


def test_without_a_place_for_the_hull_it_is_prepared_all_the_same(
    load: Loader, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "cache").write_text("a file, where a folder should be")
    assert len(load(convex_hull=True).parts) == 1
    (said,) = (record for record in caplog.records if "cannot write" in record.getMessage())
    assert said.levelno == logging.WARNING
    assert said.getMessage().startswith("bar.obj: cannot write to ")
    assert said.getMessage().endswith("its parts are cut again in every process until it is writable")


def test_a_refused_mesh_is_not_kept(load: Loader, tmp_path: Path) -> None:
    (tmp_path / "bar.obj").write_text(obj(BAR[0], BAR[1][:-3]))
    for _ in range(2):
        with pytest.raises(ShipError, match="is not closed"):
            load()
    assert not list((tmp_path / "cache").rglob("*.npz"))


def test_a_file_that_may_not_be_read_is_refused(load: Loader, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(path: Path) -> str:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(mesh, "digest_content", fail)
    with pytest.raises(ShipError, match=r"^bar.obj: cannot be read \(Permission denied\): make the file readable$"):
        load()


def test_the_command_ships_refuses_a_mesh_and_keeps_a_good_one(load: Loader, tmp_path: Path) -> None:
    """What the message about a missing Python program advises."""
    text = ship_toml(
        particulars={"L_pp": 4.0, "B": 3.0, "T": 0.5, "mass": 4e3},
        hull={"shape": "mesh", "depth": 1.0, "file": "bar.obj", "origin": [2.0, 1.5, 0.5]},
    )
    (tmp_path / "bar.toml").write_text(text)
    (tmp_path / "bar.obj").write_text(obj(BAR[0], BAR[1][1:]))
    command = ["ships", str(tmp_path / "bar.toml")]
    refused = CliRunner().invoke(main, command)
    assert refused.exit_code == 2
    assert "bar.obj: is not closed: 3 open edges" in " ".join(refused.output.split())
    (tmp_path / "bar.obj").write_text(obj(*BAR))
    shown = CliRunner().invoke(main, command)
    assert shown.exit_code == 0
    assert "note: bar.obj: 6 m3 in 20 faces, convex parts: 2, which add" in shown.output
    assert len(list((tmp_path / "cache").rglob("*.npz"))) == 1
