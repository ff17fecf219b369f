"""NORSOK N-004 (2004), Design of steel structures, annex A: impact energy of a supply vessel, as in DNV-RP-C204.

    E = 1/2 (M + a) v^2          a = 0.1 M by bow or stern, 0.4 M sideways; a rigid installation, a central blow

5000 t at 2 m/s: 14 MJ sideways, 11 MJ by bow or stern (the rule of the Norwegian Petroleum Directorate before).
10 000 t: bow at 3 m/s 50 MJ, side at 2 m/s 28 MJ, stern at 2 m/s 22 MJ (the later editions). The standards print whole
MJ. 14 MJ is read in Amdahl and Eberg (1993), the others are recalled; the arithmetic of all five closes.
"""

from __future__ import annotations

from typing import Any

import pytest

from tests.oracles.conftest import Collide, box_ship

CASES = [
    ("side", 5e6, 2.0, 14.0), ("bow", 5e6, 2.0, 11.0), ("stern", 5e6, 2.0, 11.0),
    ("bow", 10e6, 3.0, 50.0), ("side", 10e6, 2.0, 28.0), ("stern", 10e6, 2.0, 22.0),
]  # fmt: skip
"""Part of the ship that strikes, its mass [kg], speed [m/s], published energy [MJ]."""

L, B = 83.0, 19.0
COURSE: dict[str, tuple[float, float, float]] = {"bow": (1.0, 0.0, L), "stern": (-1.0, 0.0, L), "side": (0.0, 1.0, B)}
"""Share of the speed ahead and to starboard, and the hull's length along the course [m]."""


def blow(collide: Collide, part: str, mass: float, speed: float, **parameters: Any) -> float:
    """Energy [J] that the model loses when the part meets a rigid wall that is as high as the ship."""
    ahead, across, length = COURSE[part]
    wall = (
        '[platform]\nkind = "platform"\nshape = "box"\nlength = 200.0\nbreadth = 200.0\n'
        f"position = [{ahead * (0.5 * length + 100.05)}, {across * (0.5 * length + 100.05)}]\n"
    )
    w = collide(
        [box_ship(L, B, 7.0, mass, m_x=0.1, m_y=0.4)],
        [{"position": (0.0, 0.0, 0.0), "nu": (ahead * speed, across * speed, 0, 0, 0, 0)}], 0.5,
        obstacles=wall, restitution=0.0, **parameters,
    )  # fmt: skip
    assert w.model.outputs.collision_count == 1
    return w.model.outputs.energy.dissipated


@pytest.mark.one_in(3)
@pytest.mark.parametrize(("part", "mass", "speed", "published"), CASES)
@pytest.mark.parametrize("degrees_of_freedom", [3, 6])
@pytest.mark.parametrize("response", ["pgs", "closed_form"])
def test_energy_of_a_supply_vessel(
    collide: Collide, part: str, mass: float, speed: float, published: float, degrees_of_freedom: int, response: str
) -> None:
    energy = blow(collide, part, mass, speed, degrees_of_freedom=degrees_of_freedom, response=response)
    factor = 1.4 if part == "side" else 1.1
    assert energy == pytest.approx(0.5 * factor * mass * speed**2, rel=1e-9)
    assert energy / 1e6 == pytest.approx(published, rel=0.011)  # 49.5 MJ are printed as 50
