"""Lights by the numbers of COLREG: rule 21 (arcs, colours), 22 (ranges), 23 (which), annex I 2 and 3 (places)."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from trimesh.proximity import closest_point_naive

from shipcollision_fmu.show.scene.lights import Light
from shipcollision_fmu.show.scene.solids import join_surfaces

from .drawn_ships import KINDS, draw_ship


def lights_of(kind: str, L: float) -> dict[str, Light]:
    return {light.kind: light for light in draw_ship(kind, L).looks.lights}


def is_red(light: Light) -> bool:
    r, g, b = (int(light.colour[i : i + 2], 16) for i in (1, 3, 5))
    return r > 3 * max(g, b)


def is_green(light: Light) -> bool:
    r, g, b = (int(light.colour[i : i + 2], 16) for i in (1, 3, 5))
    return g > 2 * max(r, b)


@pytest.mark.one_in(4)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("L", [16.0, 45.0, 120.0, 260.0])
def test_arcs_colours_and_ranges(kind: str, L: float) -> None:
    lights = lights_of(kind, L)
    mastheads = {"masthead fore", "masthead aft"} if L >= 50.0 else {"masthead"}
    assert set(lights) == mastheads | {"starboard", "port", "stern"}
    assert {lights[name].arc for name in mastheads} == {225.0}
    assert (lights["starboard"].arc, lights["port"].arc, lights["stern"].arc) == (112.5, 112.5, 135.0)
    assert is_green(lights["starboard"])
    assert is_red(lights["port"])
    assert not any(is_red(lights[name]) or is_green(lights[name]) for name in (*mastheads, "stern"))
    assert next(lights[name].range for name in sorted(mastheads)) == (6.0 if L >= 50.0 else 5.0 if L >= 20.0 else 3.0)
    assert lights["stern"].range == lights["port"].range == (3.0 if L >= 50.0 else 2.0)


@pytest.mark.parametrize(
    ("bearing", "seen"),
    [
        (0.5, {"masthead fore", "masthead aft", "starboard"}), (-0.5, {"masthead fore", "masthead aft", "port"}),
        (112.0, {"masthead fore", "masthead aft", "starboard"}), (113.0, {"stern"}), (180.0, {"stern"}),
        (-113.0, {"stern"}), (-112.0, {"masthead fore", "masthead aft", "port"}),
    ],
)  # fmt: skip
def test_who_stands_where_sees_which(bearing: float, seen: set[str]) -> None:
    """Exactly one of the sidelights and the sternlight, from every bearing."""
    lights = lights_of("tanker", 260.0)
    far = 1e6 * np.array([np.cos(np.radians(bearing)), np.sin(np.radians(bearing)), 0.0])
    assert {name for name, light in lights.items() if light.is_seen_from(light.point + far)} == seen
    for light in lights.values():
        assert light.is_seen_from(light.point + light.direction)


@pytest.mark.one_in(3)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("L", [60.0, 120.0, 260.0])
def test_places_of_a_ship_of_50_m_and_more(kind: str, L: float) -> None:
    drawn = draw_ship(kind, L)
    lights = {light.kind: light.point for light in drawn.looks.lights}
    up = {name: drawn.z_deck - point[2] for name, point in lights.items()}
    assert up["masthead fore"] >= min(max(6.0, drawn.B), 12.0) - 1e-9
    assert up["masthead aft"] >= up["masthead fore"] + 4.5 - 1e-9
    apart = lights["masthead fore"][0] - lights["masthead aft"][0]
    fore = drawn.hull.vertices[:, 0].max()
    if kind == "naval ship":  # their masts are where they are: rule 1(e)
        assert apart > 0.2 * L
    else:
        assert apart >= min(0.5 * L, 100.0) - 1e-9
        assert fore - lights["masthead fore"][0] <= 0.25 * L
    assert up["starboard"] == up["port"] <= 0.75 * up["masthead fore"]
    assert lights["starboard"][1] == pytest.approx(0.5 * drawn.B)
    assert lights["port"][1] == pytest.approx(-0.5 * drawn.B)
    assert lights["starboard"][0] <= lights["masthead fore"][0]
    assert lights["stern"][0] < drawn.hull.vertices[:, 0].min() + 0.05 * L


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("L", [16.0, 32.0, 45.0, 120.0, 260.0])
def test_every_lamp_is_borne_by_something_that_is_drawn(kind: str, L: float) -> None:
    """No lamp hangs in the air: a hand's breadth around its glass there is a mast, a wall, a post or a bracket."""
    looks = draw_ship(kind, L).looks
    surfaces = [surface for _, surface in looks.shell] + [fitting.surface for fitting in looks.fittings]
    joined = join_surfaces(surfaces)
    drawn = trimesh.Trimesh(joined.vertices, joined.triangles, process=False)
    points = np.array([light.point for light in looks.lights])
    _, distance, _ = closest_point_naive(drawn, points)
    assert {light.kind for light, far in zip(looks.lights, distance, strict=True) if far > 0.35} == set()


@pytest.mark.parametrize("kind", KINDS)
def test_what_bears_a_lamp_stands_on_the_ship(kind: str) -> None:
    """Posts and brackets touch another part, and do not reach beyond the side."""
    drawn = draw_ship(kind, 120.0)
    joined = join_surfaces([surface for paint, surface in drawn.looks.shell if paint in ("mast", "house")])
    pieces = trimesh.Trimesh(np.round(joined.vertices, 6), joined.triangles).split()
    assert len(pieces) >= 1
    others = [surface for paint, surface in drawn.looks.shell if paint not in ("mast", "house")]
    rest = join_surfaces([*others, *(fitting.surface for fitting in drawn.looks.fittings)])
    ship = trimesh.Trimesh(rest.vertices, rest.triangles, process=False)
    for piece in pieces:
        _, distance, _ = closest_point_naive(ship, piece.vertices)
        assert distance.min() < 0.25
        assert np.abs(piece.vertices[:, 1]).max() <= 0.5 * drawn.B + 0.01
