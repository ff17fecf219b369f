"""What strangers' meshes have: faces given twice, gaps, holes, inner walls. Mended, or refused with the place."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.errors import HostError, ShipError
from shipcollision_fmu.ship.hull import mending
from shipcollision_fmu.ship.hull.mending import count
from tests.ship.hull.mesh_files import BOX, DEPTH, L_OA, SHIP, B, box, read, together

VOLUME = L_OA * B * DEPTH


@pytest.fixture(autouse=True)
def _own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


def said(caplog: pytest.LogCaptureFixture) -> str:
    return "\n".join(record.getMessage() for record in caplog.records)


def refusal(folder: Path, vertices: np.ndarray, triangles: np.ndarray) -> str:
    with pytest.raises(ShipError) as raised:
        read(folder, vertices, triangles)
    assert "\n" not in str(raised.value)
    return str(raised.value)


# -- faces given twice ------------------------------------------------------------------------------


@pytest.mark.parametrize("again", [BOX.triangles[:1], BOX.triangles[:1, [2, 0, 1]], BOX.triangles])
def test_a_face_given_twice_is_dropped(tmp_path: Path, caplog: pytest.LogCaptureFixture, again: np.ndarray) -> None:
    got = read(tmp_path, BOX.vertices, np.vstack([BOX.triangles, again]))
    assert (len(got.triangles), got.volume) == (12, pytest.approx(VOLUME))
    assert f"hull.obj: {count(len(again), 'face')} of {12 + len(again)}, given twice, dropped" in said(caplog)


def test_a_surface_drawn_from_both_sides_is_one(tmp_path: Path) -> None:
    got = read(tmp_path, BOX.vertices, np.vstack([BOX.triangles, BOX.triangles[:, ::-1]]))
    assert (len(got.triangles), got.volume) == (12, pytest.approx(VOLUME))


def test_the_wall_between_two_blocks_goes(tmp_path: Path) -> None:
    """Both blocks have it, in opposite directions: what is left bounds both."""
    fore, aft = box((0, -15, -10), (100, 15, 10)), box((-100, -15, -10), (0, 15, 10))
    got = read(tmp_path, *together(fore, aft))
    assert (len(got.triangles), got.volume, len(got.parts)) == (20, pytest.approx(VOLUME), 1)


def test_an_inner_wall_of_one_face_is_refused_with_its_place(tmp_path: Path) -> None:
    fore, aft = box((0, -15, -10), (100, 15, 10)), box((-100, -15, -10), (0, 15, 10))
    vertices, triangles = together(fore, aft)
    wall = np.flatnonzero((vertices[triangles][:, :, 0] == 0.0).all(axis=1))
    assert len(wall) == 4
    message = refusal(tmp_path, vertices, np.delete(triangles, wall[2:], axis=0))
    assert re.search(r"4 edges belong to an odd number of faces, more than two, one at \(0, .*\) in the file", message)
    assert message.endswith("remove inner walls and doubled faces, or set convex_hull = true")
    assert read(tmp_path, vertices, np.delete(triangles, wall[2:], axis=0), convex_hull=True).volume == pytest.approx(
        VOLUME
    )


# -- gaps -------------------------------------------------------------------------------------------


def apart(gap: float) -> tuple[np.ndarray, np.ndarray]:
    """The box, whose deck lies beside its sides by `gap`."""
    deck = (BOX.vertices[BOX.triangles][:, :, 2] < 0.0).all(axis=1)
    vertices = np.vstack([BOX.vertices, BOX.vertices + [gap, 0.0, 0.0]])
    return vertices, np.where(deck[:, None], BOX.triangles + len(BOX.vertices), BOX.triangles)


def test_vertices_of_open_edges_are_joined_within_the_tolerance(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    got = read(tmp_path, *apart(0.0019))
    assert (len(got.vertices), got.volume) == (8, pytest.approx(VOLUME, rel=1e-4))
    assert "vertices of open edges at most 0.002 (in the file's unit) from others joined with them: 4" in said(caplog)


def test_a_wider_gap_is_refused_with_a_tolerance_that_closes_it(tmp_path: Path) -> None:
    message = refusal(tmp_path, *apart(0.015))
    assert re.search(r"is not closed: 8 open edges around 2 holes, the largest 202\.2 across around \(", message)
    weld = float(re.search(r"set weld = (\S+),", message)[1])  # type: ignore[index]  # the match above
    assert weld == 0.02
    assert len(read(tmp_path, *apart(0.015), weld=weld).vertices) == 8
    assert "weld = " not in refusal(tmp_path, *apart(0.3))


def test_near_vertices_of_a_closed_surface_stay_apart(tmp_path: Path) -> None:
    """Two closed boxes a millimetre apart are not joined to one another."""
    fore, aft = box((0.001, -15, -10), (100, 15, 10)), box((-100, -15, -10), (0, 15, 10))
    vertices, triangles = together(fore, aft)
    assert len(read(tmp_path, vertices, triangles).vertices) == 16


def test_a_vertex_on_the_edge_of_another_face_is_a_seam(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """One of the two faces at an edge is split at its middle, the other is not: no hole, and no volume between."""
    a, b, c = BOX.triangles[0]
    vertices = np.vstack([BOX.vertices, 0.5 * (BOX.vertices[a] + BOX.vertices[b])])
    got = read(tmp_path, vertices, np.vstack([BOX.triangles[1:], [[a, 8, c], [8, b, c]]]))
    assert got.volume == pytest.approx(VOLUME)
    assert len(got.parts) == 1
    assert "1 seam closed, where vertices of one face lie on the edge of another" in said(caplog)


# -- holes ------------------------------------------------------------------------------------------


def without_deck(hull: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    return triangles[~(hull[triangles][:, :, 2] == T_DECK).all(axis=1)]


T_DECK = -10.0


def test_an_open_deck_is_refused_with_its_place_and_closed_on_demand(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    shell = without_deck(SHIP.vertices, SHIP.triangles)
    message = refusal(tmp_path, SHIP.vertices, shell)
    assert re.search(r"open edges around 1 hole, the largest 202\.2 across around \(0, 0, 10\) in the file", message)
    assert "set fill_holes = true, or convex_hull = true, or close deck" in message
    got = read(tmp_path, SHIP.vertices, shell, fill_holes=True)
    assert got.volume == pytest.approx(SHIP.volume, rel=1e-9)
    assert len(got.triangles) == len(SHIP.triangles)
    assert "1 hole closed, the largest 202.2 across around (0, 0, 10) in the file" in said(caplog)


@pytest.mark.slow
def test_several_holes_are_counted_and_closed(tmp_path: Path) -> None:
    shell = BOX.triangles[2:-1]
    assert "around 2 holes" in refusal(tmp_path, BOX.vertices, shell)
    assert read(tmp_path, BOX.vertices, shell, fill_holes=True).volume == pytest.approx(VOLUME)


def eight() -> tuple[np.ndarray, np.ndarray]:
    """A fan over a loop that crosses itself, seen from anywhere."""
    s = 2 * np.pi * (np.arange(24) + 0.3) / 24
    ring = np.column_stack([100 * np.cos(s), 15 * np.sin(2 * s), 10 * np.cos(3 * s)])  # a figure of eight
    return np.vstack([ring, [[0.0, 0.0, 10.0]]]), np.array([(i, (i + 1) % 24, 24) for i in range(24)])


def test_a_hole_that_is_no_polygon_is_refused_with_its_place(tmp_path: Path) -> None:
    with pytest.raises(ShipError, match=r"the hole .* across around \(.*\) in the file is not a simple polygon, and"):
        read(tmp_path, *eight(), fill_holes=True)
    message = refusal(tmp_path, *eight())
    assert "fill_holes" not in message
    assert "convex_hull = true" in message


def test_a_missing_package_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "manifold3d", None)
    with pytest.raises(HostError, match=r"manifold3d cannot be imported .*pip install 'shipcollision-fmu\[mesh\]'"):
        read(tmp_path, BOX.vertices, BOX.triangles[1:], fill_holes=True)
    assert "set convex_hull = true" in refusal(tmp_path, BOX.vertices, BOX.triangles[1:])


def test_loose_triangles_are_refused_without_a_search(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Hundreds of thousands of open edges took minutes to be refused."""
    monkeypatch.setattr(mending, "MOST_OPEN_EDGES", 30)
    monkeypatch.setattr(mending, "_find_closing_weld", None)
    loose = (
        BOX.vertices[BOX.triangles].reshape(-1, 3) + np.repeat(np.eye(3), 12, axis=0) * 0.03 * np.arange(36)[:, None]
    )
    triangles = np.arange(36).reshape(-1, 3)
    message = refusal(tmp_path, loose, triangles)
    assert re.search(r"is not closed: 36 open edges, one at \(.*\) in the file, as of loose triangles: join", message)
    assert read(tmp_path, BOX.vertices[BOX.triangles].reshape(-1, 3), triangles).volume == pytest.approx(VOLUME)


# -- convex hull ------------------------------------------------------------------------------------


def test_a_convex_hull_says_what_it_adds(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """A hull and a house on it: the hull of both is that of their corners."""
    house = (-60.0, -10.0, -20.0), (-20.0, 10.0, -5.0)
    vertices, triangles = together((BOX.vertices, BOX.triangles), box(*house))
    got = read(tmp_path, vertices, triangles, convex_hull=True)
    # From the deck (200 by 30 m) to the house's roof (40 by 20 m, 10 m higher), each plane section in between is a box
    # whose sides shrink linearly: the prismatoid's volume is h (A_0 + 4 A_middle + A_1) / 6.
    frustum = 10.0 * (200 * 30 + 4 * 120 * 25 + 40 * 20) / 6
    added = frustum - 40 * 20 * 10.0
    assert got.volume == pytest.approx(VOLUME + frustum, rel=1e-9)
    assert len(got.parts) == 1
    assert f"adds {added:.4g} m3 to the mesh's 1.28e+05 m3 ({added / 128000:.1%})" in said(caplog)


def test_a_convex_hull_needs_no_agreement_of_normals(tmp_path: Path) -> None:
    triangles = BOX.triangles.copy()
    triangles[0] = triangles[0][::-1]
    message = refusal(tmp_path, BOX.vertices, triangles)
    assert message.endswith("(recalculate normals outside), or set convex_hull = true")
    assert read(tmp_path, BOX.vertices, triangles, convex_hull=True).volume == pytest.approx(VOLUME)


def test_a_convex_hull_needs_no_closed_surface(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """Where its holes can be closed, it is known what the hull adds."""
    got = read(tmp_path, BOX.vertices, BOX.triangles[3:], convex_hull=True)
    assert got.volume == pytest.approx(VOLUME)
    assert "adds 0 m3 to the mesh's 1.2e+05 m3 (0.0%)" in said(caplog)
    assert len(read(tmp_path, *eight(), convex_hull=True).parts) == 1
    assert "how much that adds is not known, for the mesh is not closed" in said(caplog)
