"""Hull: closed, outward, convex parts that are the solid, and main dimensions that are those asked for."""

from __future__ import annotations

import re
from itertools import pairwise

import numpy as np
import pytest

from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.hull.solid import HullMesh
from shipcollision_fmu.ship.tables.hull import HullTable

L_OA, B, T = 288.1, 44.0, 10.5
FORMS = {
    "box": {"shape": "box", "depth": 24.0},
    "plumb": {"shape": "parametric", "depth": 24.0, "bow_length": 40.0, "stern_length": 60.0},
    "raked": {"shape": "parametric", "depth": 24.0, "bow_length": 40.0, "stern_length": 60.0, "stem_rake_deg": 12.0},
    "bilge": {"shape": "parametric", "depth": 24.0, "bow_length": 40.0, "stern_length": 60.0, "bilge": 2.0},
    "wedge": {"shape": "parametric", "depth": 24.0, "bow_length": 40.0, "bow_exponent": 1.0, "stern_length": 60.0,
              "stern_exponent": 1.0},
    "barge": {"shape": "parametric", "depth": 24.0, "bow_length": 40.0, "stern_length": 60.0, "transom_fraction": 1.0},
    "full": {
        "shape": "parametric", "depth": 24.0, "bow_length": 50.0, "bow_exponent": 2.5, "stem_rake_deg": 8.0,
        "stern_length": 70.0, "stern_exponent": 3.0, "transom_fraction": 0.4,
        "flare_deg": 5.0, "bilge": 1.5, "trim_x": 3.0,
    },
}  # fmt: skip


def hull(name: str) -> HullMesh:
    return build_hull(L_OA, B, T, HullTable.model_validate(FORMS[name]))


@pytest.fixture(params=FORMS)
def mesh(request: pytest.FixtureRequest) -> HullMesh:
    return hull(request.param)


def test_every_edge_belongs_to_two_triangles_in_opposite_directions(mesh: HullMesh) -> None:
    edges = [(int(a), int(b)) for t in mesh.triangles for a, b in zip(t, np.roll(t, -1), strict=True)]
    assert len(set(edges)) == len(edges)
    assert {(b, a) for a, b in edges} == set(edges)


def test_normals_point_outwards(mesh: HullMesh) -> None:
    assert mesh.volume > 0.5 * L_OA * B * 24.0
    p, q, r = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    normals, centres = np.cross(q - p, r - p), (p + q + r) / 3
    inside = np.array([0.0, 0.0, T - 12.0])
    if len(mesh.parts) == 1:  # of a convex solid every face looks away from any point inside
        assert np.einsum("ij,ij->i", normals, centres - inside).min() > 0.0


def test_box_has_the_volume_of_a_box() -> None:
    assert hull("box").volume == pytest.approx(L_OA * B * 24.0, rel=1e-12)


def test_plumb_hull_has_the_volume_of_its_plan() -> None:
    """Parabolas enclose 2/3 of their box; the chords of the polygon lose 1/(6 n^2) of that side."""
    bow, stern, middle = 40.0, 60.0, L_OA - 100.0
    full_bow = B * bow * 2 / 3
    full_stern = B * stern * (1 - 0.5 / 3)
    expected = (full_bow + full_stern + B * middle) * 24.0
    assert hull("plumb").volume == pytest.approx(expected, rel=1e-3)
    assert hull("plumb").volume < expected


def test_raked_bow_shears_and_loses_a_wedge_of_midbody() -> None:
    """Every level below the deck is shorter by its shift, of full breadth."""
    lost = B * 0.5 * 24.0**2 * np.tan(np.radians(12.0))
    assert hull("plumb").volume - hull("raked").volume == pytest.approx(lost, rel=1e-9)


def test_parts_are_convex_and_together_the_solid(mesh: HullMesh) -> None:
    """No point of a part lies before any face of that part, and the parts' height ranges join without a gap."""
    for part in mesh.parts:
        z_top, z_bottom = part[:, 2].min(), part[:, 2].max()
        corners = mesh.vertices[mesh.triangles]
        own = corners[(corners[..., 2] >= z_top).all(axis=1) & (corners[..., 2] <= z_bottom).all(axis=1)]
        normals = np.cross(own[:, 1] - own[:, 0], own[:, 2] - own[:, 0])
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        before = np.einsum("ij,kij->ki", normals, part[:, None, :] - own[None, :, 0, :])
        assert before.max() < 1e-9
    ends = sorted((part[:, 2].min(), part[:, 2].max()) for part in mesh.parts)
    assert (ends[0][0], ends[-1][1]) == (mesh.vertices[:, 2].min(), mesh.vertices[:, 2].max())
    assert all(upper[1] == lower[0] for upper, lower in pairwise(ends))


@pytest.mark.parametrize("name", ["plumb", "raked", "bilge", "wedge", "barge", "full"])
def test_main_dimensions(name: str) -> None:
    x, y, z = hull(name).vertices.T
    trim = FORMS[name].get("trim_x", 0.0)
    assert x.max() == pytest.approx(L_OA / 2 + float(trim))
    assert x.min() == pytest.approx(-L_OA / 2 + float(trim))
    assert (y.min(), y.max()) == (pytest.approx(-B / 2), pytest.approx(B / 2))
    assert (z.min(), z.max()) == (T - 24.0, T)


def test_hull_is_symmetric_about_the_centreplane(mesh: HullMesh) -> None:
    mirrored = {tuple(np.round(v * [1, -1, 1], 6) + 0.0) for v in mesh.vertices}
    assert mirrored == {tuple(np.round(v, 6) + 0.0) for v in mesh.vertices}


def test_flare_alone_splits_the_hull_and_at_the_waterline() -> None:
    assert [len(hull(name).parts) for name in FORMS] == [1, 1, 1, 1, 1, 1, 2]
    below, above = hull("full").parts
    assert below[:, 2].min() == 0.0
    assert above[:, 2].max() == 0.0


def test_levels_have_parallel_edges() -> None:
    mesh = hull("full")
    n = int((mesh.vertices[:, 2] == T).sum())
    rings = mesh.vertices.reshape(-1, n, 3)
    directions = [np.roll(ring, -1, axis=0) - ring for ring in rings]
    for a, b in pairwise(directions):
        assert np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).max() < 1e-8


ROOMLESS = {
    "too short a bow": {"flare_deg": 60.0, "bow_length": 10.0},
    "too long a bow": {"flare_deg": 20.0, "bow_length": 150.0, "stem_rake_deg": 15.0},
    "every one too large": {"flare_deg": 50.0, "stem_rake_deg": 60.0, "bilge": 10.0, "bow_length": 100.0},
}


@pytest.mark.parametrize("name", ROOMLESS)
def test_a_bow_without_room_is_refused_with_remedies_that_give_room(name: str) -> None:
    """Lengthening the bow, once the advice, made "too long a bow" worse."""
    form = {**FORMS["full"], **ROOMLESS[name]}
    with pytest.raises(ShipError, match=r"leave no room for the bow: bow_length = \d+\.0 m.*; give ") as raised:
        build_hull(L_OA, B, T, HullTable.model_validate(form))
    remedies = str(raised.value).split("; give ")[1].split(" or ")
    for remedy in remedies:
        changes = {key: float(value) for key, value in re.findall(r"(\w+) (?:at most|=) ([\d.]+)", remedy)}
        assert changes
        build_hull(L_OA, B, T, HullTable.model_validate({**form, **changes}))
    assert ("bow_length =" in str(remedies[-1])) == (name == "too long a bow")
