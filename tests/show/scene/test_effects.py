"""Effects are as large as the energy of their scratch says."""

from __future__ import annotations

from pathlib import Path

import pytest

from shipcollision_fmu.show.scene.scene import load_scene
from tests.show.live.javascript import run_javascript
from tests.show.scene.test_dents import change_energy

FULL = 1e9
"""[J] Energy of an effect at full strength, 13 m."""


@pytest.mark.needs("pybullet")
@pytest.mark.parametrize("energy", [1e8, 8e8, 27e9])
def test_a_fire_grows_with_the_cube_root_of_the_energy(guan2014: Path, tmp_path: Path, energy: float) -> None:
    """Hopkinson's law of blasts, up to the largest that is drawn; the live bridge makes the same of the same energy."""
    fire = next(effect for effect in load_scene(guan2014).effects if effect.kind == "fire")
    now = FULL * fire.intensity**3
    changed = load_scene(change_energy(guan2014, tmp_path / "changed", energy / now)).effects
    size = 13.0 * min(1.0, (energy / FULL) ** (1.0 / 3.0))
    burning = [effect for effect in changed if effect.scratch == fire.scratch]
    assert [effect.size for effect in burning] == pytest.approx(len(burning) * [size], rel=1e-6)
    live = run_javascript(
        "live/effects_live.js", "effectsOf",
        "return effectsOf(data, [{name: 'target', L_pp: 100}], 0, data.energy, true);",
        {"id": 1, "ship_a": "own", "ship_b": "target", "a": [0, 0, 0], "b": [0, 5, 0], "energy": energy},
    )  # fmt: skip
    of_run = {effect.kind: (effect.size, effect.duration) for effect in burning}
    for effect in live:
        assert (effect["size"], effect["duration"]) == pytest.approx(of_run[effect["kind"]], rel=1e-6)
