"""Collisions and scratches from a record made by hand: two pairs at once, several points, an impact that was missed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.cosim.events import events
from shipcollision_fmu.cosim.recorder import CONTACT_COLUMNS, SIGNALS, Impact, Record
from shipcollision_fmu.cosim.wiring import STATE
from shipcollision_fmu.ship.library import load_ship

STEP = 0.5
NAMES = ("left", "middle", "right")
SHIP = load_ship("kvlcc2")


def contact(k: int, pair: tuple[str, str], numbers: tuple[int, int], east: float, impulse: float) -> tuple[Any, ...]:
    """A contact point at (0, east, 0), normal and impulse to the east; the ships lie side by side, heading 0."""
    values = dict.fromkeys(CONTACT_COLUMNS, 0.0) | {
        "east": east, "normal.east": 1.0, "impulse_normal": impulse, "impulse.east": impulse, "energy": 1.0,
        "a.x": 10.0, "a.y": east, "b.x": -20.0, "b.y": -east,
    }  # fmt: skip
    return (k * STEP, *pair, *numbers, *values.values())


def record(rows: list[tuple[Any, ...]], issued: dict[int, list[list[float]]], impacts: dict[int, Impact]) -> Record:
    columns = [("time", float), *((f"{name}.{state}", float) for name in NAMES for state in STATE)]
    contact_type = [("time", float), ("ship_a", "U6"), ("ship_b", "U6"), ("impact", int), ("scratch", int)]
    states = np.zeros(6, dtype=columns)
    states["time"] = np.arange(6) * STEP
    return Record(
        states=states,
        signals=np.zeros(6, dtype=[("time", float), *((name, float) for name in SIGNALS)]),
        contacts=np.array(rows, dtype=[*contact_type, *((column, float) for column in CONTACT_COLUMNS)]),
        issued={k: np.array(value) for k, value in issued.items()},
        impacts=impacts,
        energy=(0.0, 0.0, 0.0), issued_finally=np.zeros((3, 6)), applied=np.zeros((3, 6)), clearance=0.0,
    )  # fmt: skip


def found(made: Record) -> dict[str, Any]:
    return events(made, dict.fromkeys(NAMES, SHIP), dict.fromkeys(NAMES, 3))


def sway(impulse: float) -> list[float]:
    return [0.0, impulse, 0.0, 0.0, 0.0, 0.0]


def test_no_contact_no_events() -> None:
    assert found(record([], {}, {})) == {"collisions": [], "scratches": []}


def test_a_collision_sums_over_its_points_and_steps() -> None:
    rows = [
        contact(2, ("left", "middle"), (1, 1), 5.0, 2e6),
        contact(2, ("left", "middle"), (1, 1), 6.0, 3e6),
        contact(3, ("left", "middle"), (1, 1), 7.0, 1e6),
    ]
    issued = {2: [sway(-5e6), sway(5e6), sway(0)], 3: [sway(-6e6), sway(6e6), sway(0)]}
    (collision,) = found(record(rows, issued, {1: Impact(0.8, 1.5, 0.1, (0.0, 5.5, 0.0))}))["collisions"]
    assert (collision["start"], collision["end"]) == (0.8, 1.5)
    assert (collision["closing_speed"], collision["angle"], collision["energy"]) == (1.5, 0.1, 3.0)
    assert collision["impulse"] == {"n": [0.0, 6e6, 0.0], "magnitude": 6e6}
    # The FMU's point, the middle of the two; seen from the ships, which are at n's origin.
    assert collision["first_point"] == {"n": [0.0, 5.5, 0.0], "b_a": [0.0, 5.5, 0.0], "b_b": [0.0, 5.5, 0.0]}
    gained = np.array(collision["delta_v"]["middle"])
    expected = np.linalg.solve(SHIP.M[np.ix_([0, 1, 5], [0, 1, 5])], [0.0, 6e6, 0.0])
    np.testing.assert_allclose(gained, [expected[0], expected[1], 0.0], rtol=1e-12)
    np.testing.assert_allclose(collision["delta_v"]["left"], -gained, rtol=1e-12)
    assert set(collision["delta_v"]) == {"left", "middle"}


def test_a_ship_hit_from_both_sides_at_once_takes_its_share_from_each() -> None:
    """The impulses on the middle ship cancel in the ledger, and must not in its two collisions."""
    rows = [contact(1, ("left", "middle"), (1, 1), 5.0, 4e6), contact(1, ("middle", "right"), (2, 2), 9.0, 4e6)]
    issued = {1: [sway(-4e6), sway(0.0), sway(4e6)]}
    first, second = found(record(rows, issued, {2: Impact(0.2, 1.0, 0.0, (0.0, 9.0, 0.0))}))["collisions"]
    M = SHIP.M[np.ix_([0, 1, 5], [0, 1, 5])]
    on_b = np.linalg.solve(M, [0.0, 4e6, -20.0 * 4e6])[1]
    on_a = np.linalg.solve(M, [0.0, -4e6, -10.0 * 4e6])[1]
    assert first["delta_v"]["middle"][1] == pytest.approx(on_b, rel=1e-12)
    assert second["delta_v"]["middle"][1] == pytest.approx(on_a, rel=1e-12)
    assert (first["start"], first["closing_speed"], first["angle"]) == (0.5, None, None)  # its start was overwritten
    assert second["start"] == 0.2


def test_a_scratch_has_one_point_per_step_that_of_the_largest_impulse() -> None:
    rows = [
        contact(1, ("left", "middle"), (1, 1), 5.0, 2e6),
        contact(1, ("left", "middle"), (1, 1), 6.0, 3e6),
        contact(2, ("left", "middle"), (1, 1), 7.0, 1e6),
        contact(4, ("left", "middle"), (1, 2), 8.0, 1e6),
    ]
    nothing = [sway(0), sway(0), sway(0)]
    first, second = found(record(rows, {1: nothing, 2: nothing, 4: nothing}, {}))["scratches"]
    assert (first["id"], first["collision"], first["time"]) == (1, 1, [0.5, 1.0])
    assert first["b_a"] == [[10.0, 6.0, 0.0], [10.0, 7.0, 0.0]]
    assert first["b_b"] == [[-20.0, -6.0, 0.0], [-20.0, -7.0, 0.0]]
    assert first["first_point"]["n"] == [0.0, 6.0, 0.0]
    assert (second["id"], second["start"], second["end"]) == (2, 2.0, 2.0)
