"""The grid finds what comparing all with all finds, and no far pair is ever looked at."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.geometry import broad_phase
from shipcollision_fmu.collision.geometry.adapter import open_narrow_phase
from shipcollision_fmu.collision.geometry.broad_phase import Rectangle, near_pairs
from shipcollision_fmu.collision.geometry.narrow_phase import NarrowPhase
from tests.collision.conftest import BOX, World

Make = Callable[..., str]
MakeWorld = Callable[..., World]


def all_with_all(rectangles: list[Rectangle], moving: int) -> list[tuple[int, int]]:
    n = len(rectangles)
    meet = broad_phase._meet
    return [(a, b) for a in range(moving) for b in range(a + 1, n) if meet(rectangles[a], rectangles[b])]


PLACE = st.floats(-2000.0, 2000.0)
SIDE = st.floats(0.0, 400.0)


@given(
    st.lists(st.tuples(PLACE, PLACE, SIDE, SIDE), max_size=40), st.integers(0, 40),
    st.lists(st.tuples(PLACE, PLACE, st.floats(0.0, 30_000.0), SIDE), max_size=4), st.sampled_from([0, 64]),
)  # fmt: skip
def test_the_grid_finds_the_same_pairs(
    places: list[tuple[float, ...]], moving: int, quays: list[tuple[float, ...]], few: int
) -> None:
    rectangles = [(n, n + a, e, e + b) for n, e, a, b in places + quays]
    moving = min(moving, len(places))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(broad_phase, "FEW", few)
        assert near_pairs(rectangles, moving) == all_with_all(rectangles, moving)


def test_pairs_that_touch_at_a_cells_edge_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(broad_phase, "FEW", 0)
    assert near_pairs([(0.0, 10.0, 0.0, 10.0), (10.0, 20.0, -10.0, 0.0)], 2) == [(0, 1)]


@pytest.mark.parametrize("few", [0, 64])
def test_clearance_is_that_of_the_nearest_pair(
    make_ship: Make, world: MakeWorld, monkeypatch: pytest.MonkeyPatch, few: int
) -> None:
    """Boxes of 200 x 30 m side by side, 300 m apart but for one pair; a quay nearer still."""
    monkeypatch.setattr(broad_phase, "FEW", few)
    box = make_ship("box", BOX)
    easts = [0.0, 330.0, 660.0, 770.0, 1100.0]
    start = [{"position": [0.0, e, 0.0], "nu": [0.0] * 6} for e in easts]
    out = world([box] * 5, start).run(0.1, 0.05).model.outputs
    assert out.clearance == pytest.approx(80.0, abs=1e-6)
    assert (out.nearest_ship_a, out.nearest_ship_b) == (3, 4)
    quay = '[q]\nkind = "quay"\nshape = "box"\nlength = 5000.0\nbreadth = 10.0\nposition = [2000.0, -70.0]'
    w = world([box] * 5, start, obstacles=quay).run(0.1, 0.05)
    out = w.model.outputs
    assert out.clearance == pytest.approx(50.0, abs=1e-6)
    assert (out.nearest_ship_a, out.nearest_ship_b) == (1, 6)
    out = world([box] * 5, start, clearance_range=60.0).run(0.1, 0.05).model.outputs
    assert (out.clearance, out.nearest_ship_a, out.nearest_ship_b) == (60.0, 0, 0)


def test_ships_that_close_fast_are_found_before_they_meet(make_ship: Make, world: MakeWorld) -> None:
    """In one long step, from beyond the range of the clearance."""
    box = make_ship("box", BOX)
    start = [{"position": [0.0, 0.0, 0.0], "nu": [12.0, 0, 0, 0, 0, 0]},
             {"position": [260.0, 0.0, 0.0], "nu": [0.0] * 6}]  # fmt: skip
    w = world([box, box], start, clearance_range=1.0, substep=0.1)
    w.step(8.0)
    assert w.model.outputs.collision_count == 1
    assert w.model.outputs.impact.time == pytest.approx(5.0, abs=0.1)


def test_far_ships_are_never_given_to_the_narrow_phase(
    make_ship: Make, world: MakeWorld, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[tuple[int, int]] = []
    adapter = type(open_narrow_phase([]))
    closest, gap = adapter.closest, adapter.gap

    def counted(self: NarrowPhase, a: int, b: int, states: list[BodyState], distance: float) -> list:
        asked.append((a, b))
        return closest(self, a, b, states, distance)

    def measured(self: NarrowPhase, a: int, b: int, states: list[BodyState], cap: float) -> float:
        asked.append((a, b))
        return gap(self, a, b, states, cap)

    monkeypatch.setattr(adapter, "closest", counted)
    monkeypatch.setattr(adapter, "gap", measured)
    box = make_ship("box", BOX)
    grid = [{"position": [1000.0 * (k % 10), 1000.0 * (k // 10), 0.0], "nu": [5.0, 0, 0, 0, 0, 0]} for k in range(99)]
    near = [*grid, {"position": [150.0, 200.0, 0.0], "nu": [0.0] * 6}]
    world([box] * 100, near).run(0.1, 0.05)
    assert set(asked) == {(0, 99)}
    assert np.all([a < b for a, b in asked])
