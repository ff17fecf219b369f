"""Waterline and bow wave of every kind of ship: numbers of the page's modules, beside the hull that is drawn."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import trimesh

from .live.javascript import run_javascript
from .scene.drawn_ships import KINDS, draw_ship

G = 9.81
SPEEDS = (0.5, 2.0, 4.0, 7.0, 10.0)


def outline(kind: str) -> dict[str, list[float]]:
    plating = draw_ship(kind).looks.plating
    body = "const found = []; for (const corners of data) crossWater(corners, found); return traceOutline(found);"
    found: dict[str, list[float]] = run_javascript(
        "outline.js", "crossWater, traceOutline", body, plating.vertices[plating.triangles].tolist()
    )
    return found


def bow_waves(kind: str, speeds: tuple[float, ...]) -> list[dict[str, Any]]:
    """At each speed the wave, and over s (rows) and distance from the plating: height, whiteness, opacity."""
    drawn = draw_ship(kind)
    body = """
    const side = traceSide(data.x, data.starboard), entrance = findEntrance(side);
    return data.speeds.map((speed) => {
      const wave = measureBowWave(speed, data.draught, entrance), rows = data.shares.map((share) => share * wave.crest);
      const of = (f) => rows.map((s) => data.outs.map((out) => f(wave, s, out)));
      const height_at = of(heightOf), opacity = height_at.map((row) => row.map(opacityOf));
      return { ...wave, entrance, height_at, opacity, white: of(whitenessOf) };
    });
    """
    found: list[dict[str, Any]] = run_javascript(
        "bow_wave.js",
        "traceSide, findEntrance, measureBowWave, heightOf, whitenessOf, opacityOf",
        body,
        outline(kind)
        | {
            "speeds": speeds,
            "draught": float(drawn.hull.vertices[:, 2].max()),
            "shares": np.linspace(-0.7, 18.0, 60).tolist(),
            "outs": np.linspace(0.0, 40.0, 401).tolist(),
        },
    )
    return found


@pytest.mark.parametrize("kind", KINDS)
def test_the_waterline_is_that_of_the_drawn_hull_and_nowhere_outside_it(kind: str) -> None:
    plating = draw_ship(kind).looks.plating
    section = trimesh.Trimesh(plating.vertices, plating.triangles).section([0, 0, 1], [0, 0, 1e-6])
    assert section is not None
    x, y = section.vertices[:, 0], section.vertices[:, 1]
    found = outline(kind)
    stations = np.array(found["x"])
    assert stations[0] == pytest.approx(x.min(), abs=0.01)
    assert stations[-1] == pytest.approx(x.max(), abs=0.01)
    for side, sign in (("starboard", 1.0), ("port", -1.0)):
        mine = sign * y >= 0.0
        for segment in section.vertices[np.vstack([entity.nodes for entity in section.entities])]:
            middle = segment.mean(axis=0)
            if sign * middle[1] > 0.05 and np.ptp(segment[:, 0]) > 0.05:
                reached = np.interp(middle[0], stations, found[side])
                assert reached == pytest.approx(sign * middle[1], abs=0.02 * np.ptp(y))
        assert max(found[side]) == pytest.approx((sign * y[mine]).max(), abs=0.01)


@pytest.mark.parametrize("kind", KINDS)
def test_no_hull_shows_below_the_crest_of_the_bow_wave(kind: str) -> None:
    """A level view from abeam meets water at every height up to the crest: the sheet is opaque, and reaches the sea."""
    for wave in bow_waves(kind, SPEEDS):
        for height, opacity in zip(np.array(wave["height_at"]), np.array(wave["opacity"]), strict=True):
            assert height[-1] < 0.01
            for level in np.linspace(0.12, 0.99 * height.max(), 20) if height.max() > 0.15 else ():
                outermost = np.flatnonzero(height >= level)[-1]
                assert opacity[outermost] > 0.99


@pytest.mark.parametrize("kind", KINDS)
def test_a_bow_wave_grows_with_speed_stays_below_the_stagnation_head_and_is_none_at_rest(kind: str) -> None:
    still, astern, *under_way = bow_waves(kind, (0.0, -3.0, *SPEEDS))
    assert still["height"] == astern["height"] == 0.0
    assert not np.any([still["height_at"], astern["height_at"]])
    heights = [wave["height"] for wave in under_way]
    assert np.all(np.diff(heights) > 0.0)
    for speed, wave in zip(SPEEDS, under_way, strict=True):
        assert wave["height"] < 0.5 * speed**2 / G
        assert 0.0 < wave["crest"] < 1.1 * speed**2 / G
        top = np.array(wave["height_at"])
        assert top.max() <= wave["height"] + 1e-9
        assert top[-1].max() < 0.1 * wave["height"]  # it ends by itself, not at an edge
    white = [np.array(wave["white"]).max() for wave in under_way]
    assert white[0] == 0.0
    assert np.all(np.diff(white) >= 0.0)
    assert white[SPEEDS.index(7.0)] > 0.2


def test_a_blunt_bow_pushes_up_more_water_than_a_fine_one() -> None:
    fine, blunt = (bow_waves(kind, (7.0,))[0] for kind in ("naval ship", "tanker"))
    assert fine["entrance"] < 0.6 * blunt["entrance"]
    assert fine["height"] < 0.9 * blunt["height"]
