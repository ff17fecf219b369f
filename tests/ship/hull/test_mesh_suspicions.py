"""What is only suspicious about a mesh is warned of, with a remedy that ends the warning."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.hull.mesh import build_mesh_hull
from shipcollision_fmu.ship.hull.self_crossing import find_crossings
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.tables.hull import HullTable
from tests.ship.hull.mesh_files import BOX, DEPTH, L_OA, SHIP, TO_FILE, B, box, obj, ours, read, together


@pytest.fixture(autouse=True)
def _own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


def warnings_of(folder: Path, caplog: pytest.LogCaptureFixture, v: np.ndarray, t: np.ndarray, **keys: Any) -> list[str]:
    """What is said of a mesh, the second time it is read: when it is not prepared any more."""
    read(folder, v, t, **keys)
    caplog.clear()
    read(folder, v, t, **keys)
    return [record.getMessage() for record in caplog.records]


MIRROR = np.array([-1.0, 1.0, 1.0])
RAKED = np.array(
    [(-50, -10, 0), (-50, 10, 0), (-50, -10, 8), (-50, 10, 8), (45, -8, 0), (45, 8, 0), (50, -10, 8), (50, 10, 8)],
    float,
)
"""Corners of a barge in the file's axes: at the deck as broad at both ends, its bow raked and finer below."""
RAKED_FACES = np.array(
    [(0, 4, 6), (0, 6, 2), (1, 7, 5), (1, 3, 7), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (4, 5, 7), (4, 7, 6),
     (0, 2, 3), (0, 3, 1)]
)  # fmt: skip


# -- which end is the bow ---------------------------------------------------------------------------


def test_a_bow_that_points_aft_is_warned_of(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    assert warnings_of(tmp_path, caplog, SHIP.vertices, SHIP.triangles) == []
    (said,) = warnings_of(tmp_path, caplog, SHIP.vertices * MIRROR, SHIP.triangles[:, ::-1])
    assert re.match(
        r'hull.obj: forward = "\+x" points to its fuller end \(\S+ m broad over the last tenth of the length, '
        r"the other \S+\), as if it sailed with the transom first: unless it does, set forward = \"-x\"$",
        said,
    )
    assert warnings_of(tmp_path, caplog, SHIP.vertices * MIRROR, SHIP.triangles[:, ::-1], forward="-x") == []


def test_a_raked_bow_as_broad_as_the_stern_is_told_by_its_sections(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "hull.obj").write_text(obj(RAKED, RAKED_FACES))
    keys: dict[str, Any] = {
        "shape": "mesh",
        "depth": 8.0,
        "file": str(tmp_path / "hull.obj"),
        "origin": [0.0, 0.0, 4.0],
    }
    build_mesh_hull(100.0, 20.0, 4.0, HullTable(**keys))
    assert caplog.records == []
    build_mesh_hull(100.0, 20.0, 4.0, HullTable(forward="-x", **keys))
    (record,) = caplog.records
    assert re.search(
        r'forward = "-x" points to its fuller end \(160 m2 in section .*, the other 11\d\), ', record.getMessage()
    )
    assert record.getMessage().endswith('set forward = "+x"')


def test_a_broad_bow_with_the_smaller_sections_is_one(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """A flared bow, at the deck broader than the stern, and finer by its sections."""
    moved = RAKED.copy()
    moved[:4, 1] *= 0.7  # the stern, broad 14 m
    moved[4:6, 1] *= 0.1  # the bow at the keel
    (tmp_path / "hull.obj").write_text(obj(moved, RAKED_FACES))
    for forward in ("+x", "-x"):
        table = HullTable(
            shape="mesh", depth=8.0, file=str(tmp_path / "hull.obj"), origin=[0.0, 0.0, 4.0], forward=forward,
            convex_hull=True,
        )  # fmt: skip
        build_mesh_hull(100.0, 20.0, 4.0, table)
        assert not any(" points to its fuller end " in record.getMessage() for record in caplog.records)


def test_ends_that_are_alike_are_not_told_apart(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    assert warnings_of(tmp_path, caplog, BOX.vertices, BOX.triangles, forward="-x") == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["ferry", "tanker", "bulk carrier", "container ship", "tug", "naval ship", "kcs"])
def test_usual_hulls_sail_bow_first(tmp_path: Path, caplog: pytest.LogCaptureFixture, kind: str) -> None:
    """The hulls that are estimated of every kind, as meshes: no word; turned round: warned of."""
    particulars = {"L_pp": 120.0, "B": 20.0, "T": 6.0, "C_b": 0.65}
    about = {"name": "usual", "kind": kind, "source": "a test"}
    ship = load_ship("kcs" if kind == "kcs" else {"ship": about, "particulars": particulars})
    hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
    for turn, faces, words in ((1.0, hull.triangles, 0), (-1.0, hull.triangles[:, ::-1], 1)):
        path = tmp_path / f"hull{words}.obj"
        middle = [0.5 * (hull.vertices[:, 0].min() + hull.vertices[:, 0].max()), 0.0, 0.0]
        path.write_text(obj((hull.vertices - middle) * [turn, 1.0, 1.0] * TO_FILE, faces))
        caplog.clear()
        table = HullTable(shape="mesh", depth=ship.hull.depth, file=str(path), convex_hull=True)
        build_mesh_hull(ship.L_oa, ship.B, ship.T, table)
        said = [r.getMessage() for r in caplog.records if "convex hull" not in r.getMessage()]
        assert len(said) == words
        assert all(" points to its fuller end " in line for line in said)


# -- which way is up, and where CO is ---------------------------------------------------------------


def test_a_hull_upside_down_is_warned_of(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """With T half the depth its place is right: the deck lies where the keel should."""
    turned = SHIP.vertices * [1.0, -1.0, -1.0]
    (said,) = warnings_of(tmp_path, caplog, turned, SHIP.triangles)
    assert re.match(
        r'hull.obj: up = "\+z" points to its keel: its plan near the lowest point \(\d+ m2\) is larger than near the '
        r'deck \(\d+ m2\); unless it is built so, set up = "-z"$',
        said,
    )
    assert warnings_of(tmp_path, caplog, turned, SHIP.triangles, up="-z") == []


@pytest.mark.parametrize("off", [(8.0, 0.0, 0.0), (0.0, 0.5, 0.0), (0.0, 0.0, 1.5), (-8.0, -0.5, -1.5)])
def test_a_hull_off_its_place_is_warned_of(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, off: tuple[float, ...]
) -> None:
    moved = SHIP.vertices + off
    (said,) = warnings_of(tmp_path, caplog, moved, SHIP.triangles)
    x, y, z = off
    assert f"lies {x:.3g} m forward and {y:.3g} m to starboard of CO, and its keel {z:.3g} m below" in said
    origin = [float(v) for v in re.search(r"set origin = \[(.*)\]$", said)[1].split(",")]  # type: ignore[index]  # the match above
    assert warnings_of(tmp_path, caplog, moved, SHIP.triangles, origin=origin) == []
    placed = read(tmp_path, moved, SHIP.triangles, origin=origin).vertices
    assert placed.mean(axis=0) == pytest.approx(SHIP.vertices.mean(axis=0))


# -- parts that pass through each other -------------------------------------------------------------


def test_a_house_that_cuts_into_the_hull_is_one_solid_with_it(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """24 faces that took minutes to cut, with their common volume counted twice."""
    house = box((-60.0, -10.0, -20.0), (-20.0, 10.0, -7.0))  # 3 m of it below the deck
    both = together((BOX.vertices, BOX.triangles), house)
    (said,) = warnings_of(tmp_path, caplog, *both)
    assert said == (
        "hull.obj: 2 closed surfaces pass through each other, two of them around (-40, 0, 8.5) in the file: they are "
        "one solid, and the 2400 m3 that they share count once"
    )
    got = read(tmp_path, *both)
    assert got.volume == pytest.approx(L_OA * B * DEPTH + 40 * 20 * 10, rel=1e-9)
    assert len(got.parts) == 2
    assert got.volume_error == pytest.approx(0.0, abs=1e-3)


def test_surfaces_that_do_not_touch_are_parts_of_their_own(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """A catamaran, one of whose hulls is inside out."""
    port, starboard = box((-100, -15, -10), (100, -5, 10)), box((-100, 5, -10), (100, 15, 10))
    both = together(port, (starboard[0], starboard[1][:, ::-1]))
    got = read(tmp_path, *both)
    assert [r.getMessage() for r in caplog.records] == ["hull.obj: normals of 1 of 2 closed surfaces turned outwards"]
    assert got.volume == pytest.approx(2 * 200 * 10 * 20)
    assert (len(got.parts), got.volume_error) == (2, 0.0)


def test_a_surface_inside_another_is_filled(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """A tank, whose surface looks into it: nothing touches it from outside."""
    tank = box((-50, -10, -5), (50, 10, 5))
    got = read(tmp_path, *together((BOX.vertices, BOX.triangles), (tank[0], tank[1][:, ::-1])))
    assert got.volume == pytest.approx(L_OA * B * DEPTH)
    assert len(got.parts) == 1
    assert [r.getMessage() for r in caplog.records] == ["hull.obj: 1 closed surface inside others filled (2e+04 m3)"]


def crossing() -> np.ndarray:
    """Vertices of the box, one corner of its deck pushed down through the bottom."""
    vertices = BOX.vertices.copy()
    vertices[int(np.argmax(vertices @ [1.0, 1.0, -1.0]))] = [20.0, 5.0, 14.0]
    return vertices


def test_where_a_surface_passes_through_itself() -> None:
    """Edges of the corner pass through the bottom, which lies at z = 10; convex and flared hulls have no such place."""
    places = find_crossings(crossing(), BOX.triangles)
    assert len(places) > 0
    assert places[:, 2] == pytest.approx(10.0)
    for hull in (BOX, SHIP, ours(shape="parametric", bow_length=40.0, stern_length=50.0, flare_deg=8.0)):
        assert len(find_crossings(hull.vertices, hull.triangles)) == 0


@pytest.mark.slow
def test_a_surface_that_passes_through_itself_is_told(tmp_path: Path) -> None:
    """Its parts hold too much, and the message says why."""
    message = r"parts hold .*; its surface passes through itself at \d+ places?, one at \(.*, -10\) in the file, and"
    with pytest.raises(ShipError, match=message):
        read(tmp_path, crossing(), BOX.triangles)
    assert len(read(tmp_path, crossing(), BOX.triangles, convex_hull=True).parts) == 1
