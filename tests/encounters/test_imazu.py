"""Imazu's 22 cases: the tabulated positions, one meeting point, and a collision in every case."""

from __future__ import annotations

from itertools import combinations
from math import cos, hypot, sin
from pathlib import Path

import pytest

from shipcollision_fmu import simulate
from shipcollision_fmu.encounters.imazu import COURSES, imazu
from shipcollision_fmu.errors import ScenarioError
from shipcollision_fmu.scenario.scenario import parse_scenario

NM = 1852.0

SAWADA_2021_TABLE_4 = {
    # X (north), Y (east) [NM] of the targets at the start, as printed by Sawada, Sato and Majima (2021), table 4
    1: [(6, 0)], 2: [(0, 6)], 3: [(-4.2, 0)], 4: [(-4.243, -4.243)], 5: [(6, 0), (0, 6)],
    6: [(-5.909, 1.042), (-4.243, 4.243)], 7: [(-4.2, 0), (-4.243, 4.243)], 8: [(6, 0), (0, 6)],
    9: [(-5.196, 3), (0, 6)], 10: [(0, 6), (-5.796, -1.553)], 11: [(0, -6), (-5.196, 3)],
    12: [(-4.243, 4.243), (-5.909, 1.042)], 13: [(6, 0), (-5.909, -1.042), (-4.243, -4.243)],
    14: [(-5.909, 1.042), (-4.243, 4.243), (0, 6)], 15: [(-4.2, 0), (-4.243, 4.243), (0, 6)],
    16: [(-2.97, -2.97), (0, -6), (0, 6)], 17: [(-4.2, 0), (-5.909, -1.042), (-4.243, 4.243)],
    18: [(4.243, 4.243), (-5.796, 1.553), (-5.196, 3)], 19: [(-5.796, -1.553), (-5.796, 1.553), (4.243, 4.243)],
    20: [(-4.2, 0), (-5.796, 1.553), (0, 6)], 21: [(-5.796, 1.553), (-5.796, -1.553), (0, 6)],
    22: [(-4.2, 0), (-4.243, 4.243), (0, 6)],
}  # fmt: skip


@pytest.mark.parametrize("case", list(COURSES))
def test_positions_are_those_of_the_table(case: int) -> None:
    ships = imazu(case).scenario.ships
    own, *targets = ships.values()
    assert own.start.position[:2] == pytest.approx([-6 * NM, 0.0], abs=1.0)
    assert len(targets) == len(SAWADA_2021_TABLE_4[case])
    for target, (x, y) in zip(targets, SAWADA_2021_TABLE_4[case], strict=True):
        assert target.start.position[:2] == pytest.approx([x * NM, y * NM], abs=1.0)


@pytest.mark.parametrize("case", list(COURSES))
def test_all_are_bound_for_the_origin_at_one_time(case: int) -> None:
    made = imazu(case)
    for ship in made.scenario.ships.values():
        start = ship.start
        north = start.position[0] + start.velocity[0] * cos(start.attitude[2]) * made.time
        east = start.position[1] + start.velocity[0] * sin(start.attitude[2]) * made.time
        assert hypot(north, east) < 0.1


@pytest.mark.parametrize(("case", "meet"), [(4, 120.0), (8, 124.5), (18, 97.0)])
def test_a_case_ends_in_a_collision(case: int, meet: float) -> None:
    """With a twelfth of the time, and only until the first hulls have met at `meet` [s]: the geometry is the same."""
    text = imazu(case, time=150.0, after=1.0, step=0.5).text
    assert "duration = 151.0" in text
    scenario = parse_scenario(text.replace("duration = 151.0", f"duration = {meet}"), "a shorter case")
    run = simulate(scenario, in_process=True)
    assert run.summary["collisions"] >= 1


@pytest.mark.soak
@pytest.mark.parametrize("case", list(COURSES))
def test_every_case_ends_in_a_collision_under_way(case: int) -> None:
    run = simulate(imazu(case, time=180.0, after=1.0, step=0.1, hydrodynamics=True).scenario, in_process=True)
    assert run.summary["collisions"] >= 1


def test_cases_differ_but_for_the_two_pairs_that_the_table_repeats() -> None:
    alike = [pair for pair in combinations(COURSES, 2) if COURSES[pair[0]] == COURSES[pair[1]]]
    assert alike == [(5, 8), (15, 22)]
    assert [len(COURSES[case]) for case in COURSES] == [1] * 4 + [2] * 8 + [3] * 10


def test_what_cannot_be_is_refused() -> None:
    with pytest.raises(ScenarioError, match=r"Imazu case 23 does not exist: take 1 to 22"):
        imazu(23)
    with pytest.raises(ScenarioError, match=r"Imazu case 6: .* overlap by .* at the start"):
        imazu(6, time=60.0)
    with pytest.raises(ScenarioError, match=r"Imazu case 1: own_speed = 80 must be 0.1 to 50: give SI units"):
        imazu(1, speed=80.0)
    with pytest.raises(ScenarioError, match=r"ship 'guan2014_own' can only coast, .* leave out --hydrodynamics"):
        imazu(1, own="guan2014_own", hydrodynamics=True)


def test_a_case_is_a_file(tmp_path: Path) -> None:
    made = imazu(13, hydrodynamics=True, directory=tmp_path)
    assert made.text.count("[ships.target_") == 3
    assert "rev_per_s" in made.text
    assert made.scenario.name == "imazu_13"


def test_the_ships_have_the_degrees_of_freedom_that_are_asked_for() -> None:
    made = imazu(1, hydrodynamics=True, degrees_of_freedom=6, time=60.0, step=0.5)
    assert [ship.free for ship in made.scenario.ships.values()] == [6, 6]
