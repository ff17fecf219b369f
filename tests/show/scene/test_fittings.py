"""The kind of a ship decides its fittings, which stand on its deck."""

from __future__ import annotations

import pytest
import trimesh

from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.ship_type import SHIP_TYPES
from shipcollision_fmu.show.scene.fittings import Fitting, make_fittings
from shipcollision_fmu.show.scene.run_folder import ShipBody
from shipcollision_fmu.show.scene.surface import Surface


def fit_out(kind: str, L: float = 120.0) -> tuple[Surface, tuple[Fitting, ...]]:
    """Hull and fittings of a ship from main dimensions alone."""
    size = {"L_pp": L, "B": L / 6.0, "T": L / 18.0, "C_b": 0.65}
    ship = load_ship({"ship": {"name": kind, "kind": kind, "source": "a sketch"}, "particulars": size})
    hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
    surface = Surface(hull.vertices, hull.triangles)
    body = ShipBody(
        vertices=hull.vertices.tolist(), triangles=hull.triangles.tolist(), kind=kind, L_pp=L, L_oa=L, B=ship.B,
        T=ship.T, shape="parametric", inertia=ship.M.tolist(),
    )  # fmt: skip
    return surface, make_fittings(body, surface)


@pytest.mark.parametrize("kind", SHIP_TYPES)
@pytest.mark.parametrize("L", [16.0, 120.0])
def test_fittings_of_every_type_stand_on_deck_within_the_hull(kind: str, L: float) -> None:
    hull, fittings = fit_out(kind, L)
    assert bool(fittings) == (kind != "speed boat")
    deck, low, high = hull.vertices[:, 2].min(), hull.vertices.min(axis=0), hull.vertices.max(axis=0)
    for fitting in fittings:
        at = fitting.surface.vertices
        assert trimesh.Trimesh(at, fitting.surface.triangles, process=False).volume > 0.0
        assert at[:, 2].max() <= deck + 1e-9
        assert (at[:, :2] >= low[:2]).all()
        assert (at[:, :2] <= high[:2]).all()


def test_kinds_of_ship_look_different() -> None:
    """Ferry, tanker, bulk carrier, container ship, tug and naval ship."""
    looks = {}
    for kind in ("ferry", "tanker", "bulk carrier", "container ship", "tug", "naval ship"):
        hull, fittings = fit_out(kind)
        house = [fitting.surface.vertices[:, 0].mean() for fitting in fittings if fitting.part == "house"]
        parts = frozenset(fitting.part.split("-")[0] for fitting in fittings)
        looks[kind] = (parts, len(fittings), round(sum(house) / len(house) / hull.vertices[:, 0].max(), 1))
    assert len(set(looks.values())) == 6
    assert looks["tanker"][2] < -0.7 < 0.1 < looks["tug"][2]  # the house: aft and forward
