"""Whitecaps: how many a wind makes, by numbers of the page's module, and in the full picture."""

from __future__ import annotations

from pathlib import Path
from statistics import NormalDist

import pytest
from selenium.webdriver import Chrome

from shipcollision_fmu.show.page import write_page
from tests.show.browser import Page

from .live.javascript import run_javascript

WHITE = """
    const canvas = document.getElementById("picture"), gl = canvas.getContext("webgl2");
    const { width, height } = canvas, low = Math.floor(height / 3), pixels = new Uint8Array(4 * width * low);
    gl.readPixels(0, 0, width, low, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let white = 0;
    for (let i = 0; i < pixels.length; i += 4) white += Math.min(pixels[i], pixels[i + 1], pixels[i + 2]) > 170;
    return (4 * white) / pixels.length;
"""
"""Share of white pixels in the lower third of the picture, which is water."""


def test_coverage_is_that_of_monahan_and_none_in_a_light_breeze() -> None:
    found = run_javascript("whitecaps.js", "coverageOf", "return data.map(coverageOf);", [0.0, 3.0, 10.0, 15.0, 40.0])
    calm, light, fresh, gale, storm = found
    assert calm == 0.0
    assert light < 0.0002
    assert fresh == pytest.approx(0.0099, rel=0.01)
    assert gale == pytest.approx(0.039, rel=0.02)
    assert storm <= 0.08


def test_as_many_crests_break_as_are_white() -> None:
    shares = [0.08, 0.01, 0.001, 0.0001]
    found = run_javascript("whitecaps.js", "breakingHeight", "return data.map(breakingHeight);", shares)
    assert found == pytest.approx([NormalDist().inv_cdf(1.0 - share) for share in shares], abs=0.004)
    assert run_javascript("whitecaps.js", "breakingHeight", "return String(breakingHeight(0));") == "Infinity"


def test_a_gale_makes_the_sea_white_in_places_and_a_calm_does_not(
    browser: Chrome, kvlcc2_crossing: Path, tmp_path: Path
) -> None:
    text = write_page(kvlcc2_crossing).read_text(encoding="utf-8")
    assert '"wind":[0.0,0.0]' in text
    white = {}
    for wind in (0.0, 15.0):
        path = tmp_path / f"wind_{wind:.0f}.html"
        path.write_text(text.replace('"wind":[0.0,0.0]', f'"wind":[{wind},0.0]'), encoding="utf-8")
        page = Page(browser, path, "plain=no&t=1&camera=all&bare", (920, 560))
        page.run("replay.drawn()")
        white[wind] = page.run(WHITE)
    assert white[0.0] < 0.001
    assert 0.003 < white[15.0] < 0.1
