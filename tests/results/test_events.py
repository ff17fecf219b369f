"""Collisions and scratches from a record made by hand, two pairs at once, several points; and from runs."""

from __future__ import annotations

from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.fmi.names import STATE
from shipcollision_fmu.results.events import build_events
from shipcollision_fmu.results.record import CONTACT_COLUMNS, SIGNALS, CollisionStart, Record
from shipcollision_fmu.ship.loading.library import load_ship
from tests.ship_files import NO_ADDED_MASS, ship_toml

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


def record(
    rows: list[tuple[Any, ...]], issued: dict[int, list[list[float]]],
    impacts: dict[int, CollisionStart] | None = None,
) -> Record:  # fmt: skip
    columns = [("time", float), *((f"{name}.{state}", float) for name in NAMES for state in STATE)]
    contact_type = [("time", float), ("ship_a", "U6"), ("ship_b", "U6"), ("impact", int), ("scratch", int)]
    states = np.zeros(6, dtype=columns)
    states["time"] = np.arange(6) * STEP
    return Record(
        states=states,
        signals=np.zeros(6, dtype=[("time", float), *((name, float) for name in SIGNALS)]),
        machinery=np.zeros(0, dtype=[("time", float)]),
        contacts=np.array(rows, dtype=[*contact_type, *((column, float) for column in CONTACT_COLUMNS)]),
        issued={k: np.array(value) for k, value in issued.items()},
        starts=impacts or {row[3]: CollisionStart(0.2, 1.0, 0.0, (0.0, 9.0, 0.0)) for row in rows},
        energy=(0.0, 0.0, 0.0), issued_at_end=np.zeros((3, 6)), applied=np.zeros((3, 6)), clearance=0.0,
    )  # fmt: skip


def found(made: Record) -> dict[str, Any]:
    return build_events(made, dict.fromkeys(NAMES, SHIP), dict.fromkeys(NAMES, 3))


def sway(impulse: float) -> list[float]:
    return [0.0, impulse, 0.0, 0.0, 0.0, 0.0]


def test_no_contact_no_events() -> None:
    assert found(record([], {})) == {"collisions": [], "scratches": []}


def test_a_collision_sums_over_its_points_and_steps() -> None:
    rows = [
        contact(2, ("left", "middle"), (1, 1), 5.0, 2e6),
        contact(2, ("left", "middle"), (1, 1), 6.0, 3e6),
        contact(3, ("left", "middle"), (1, 1), 7.0, 1e6),
    ]
    issued = {2: [sway(-5e6), sway(5e6), sway(0)], 3: [sway(-6e6), sway(6e6), sway(0)]}
    (collision,) = found(record(rows, issued, {1: CollisionStart(0.8, 1.5, 0.1, (0.0, 5.5, 0.0))}))["collisions"]
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
    made = record(rows, issued)
    first, second = found(made)["collisions"]
    M = SHIP.M[np.ix_([0, 1, 5], [0, 1, 5])]
    on_b = np.linalg.solve(M, [0.0, 4e6, -20.0 * 4e6])[1]
    on_a = np.linalg.solve(M, [0.0, -4e6, -10.0 * 4e6])[1]
    assert first["delta_v"]["middle"][1] == pytest.approx(on_b, rel=1e-12)
    assert second["delta_v"]["middle"][1] == pytest.approx(on_a, rel=1e-12)


def test_the_relative_velocity_is_that_of_the_first_point_on_either_ship() -> None:
    """Left goes sideways; middle, on the same spot, turns: its side 5 m to starboard goes astern."""
    made = record([contact(1, ("left", "middle"), (1, 1), 5.0, 4e6)], {1: [sway(0.0)] * 3},
                  {1: CollisionStart(0.0, 1.5, 0.0, (0.0, 5.0, 0.0))})  # fmt: skip
    made.states["left.velocity.sway"][0], made.states["middle.rate.yaw"][0] = 1.5, 0.02
    (collision,) = found(made)["collisions"]
    assert collision["relative_velocity"] == pytest.approx([0.02 * 5.0, 1.5, 0.0], rel=1e-12)


def test_a_scratch_has_one_point_per_step_that_of_the_largest_impulse() -> None:
    rows = [
        contact(1, ("left", "middle"), (1, 1), 5.0, 2e6),
        contact(1, ("left", "middle"), (1, 1), 6.0, 3e6),
        contact(2, ("left", "middle"), (1, 1), 7.0, 1e6),
        contact(4, ("left", "middle"), (1, 2), 8.0, 1e6),
    ]
    nothing = [sway(0), sway(0), sway(0)]
    first, second = found(record(rows, {1: nothing, 2: nothing, 4: nothing}))["scratches"]
    assert (first["id"], first["collision"], first["time"]) == (1, 1, [0.5, 1.0])
    assert first["b_a"] == [[10.0, 6.0, 0.0], [10.0, 7.0, 0.0]]
    assert first["b_b"] == [[-20.0, -6.0, 0.0], [-20.0, -7.0, 0.0]]
    assert first["first_point"]["n"] == [0.0, 6.0, 0.0]
    assert (second["id"], second["start"], second["end"]) == (2, 2.0, 2.0)


def test_an_obstacle_that_stands_across_is_at_rest() -> None:
    made = record([contact(1, ("left", "quay"), (1, 1), 5.0, 4e6)], {1: [sway(0.0)] * 3})
    made.states["left.velocity.sway"][0] = 2.0
    (collision,) = build_events(made, dict.fromkeys(NAMES, SHIP), dict.fromkeys(NAMES, 3), None, {"quay": pi / 2})[
        "collisions"
    ]
    assert collision["relative_velocity"] == pytest.approx([0.0, 2.0, 0.0])


FLEET = 4
HEAD_ON = """
[scenario]
name = "fleet"
description = "pairs of boxes that meet head-on in one step, a kilometre apart"
duration = 2.0
step = 0.5
[collision]
friction = 0.0
"""


def test_pairs_that_meet_in_one_step_lose_nothing(tmp_path: Path) -> None:
    """Equal boxes head-on at 5 m/s each: 1/2 m v^2 of both is lost, m v is exchanged, each stops; in every pair."""
    (tmp_path / "box.toml").write_text(BOX)
    text = HEAD_ON
    for k in range(FLEET):
        for name, north, heading in (("a", -104.0, 0.0), ("b", 104.0, 180.0)):
            text += (
                f'[ships.{name}{k}]\nship = "box.toml"\nposition = [{north}, {1000.0 * k}]\nheading_deg = {heading}\n'
                "speed = 5.0\nhydrodynamics = false\ndegrees_of_freedom = 3\n"
            )
    (tmp_path / "fleet.toml").write_text(text)
    run = simulate(load_scenario(tmp_path / "fleet.toml"), in_process=True)
    collisions = run.events["collisions"]
    assert [(c["ship_a"], c["ship_b"]) for c in collisions] == [(f"a{k}", f"b{k}") for k in range(FLEET)]
    for collision in collisions:
        assert collision["energy"] == pytest.approx(4e7 * 25.0, rel=1e-9)
        assert collision["impulse"]["magnitude"] == pytest.approx(4e7 * 5.0, rel=1e-9)
        assert collision["closing_speed"] == pytest.approx(10.0, rel=1e-9)
        assert np.linalg.norm(collision["relative_velocity"]) == pytest.approx(10.0, rel=1e-9)
        assert collision["angle"] == pytest.approx(pi)
        for gained in collision["delta_v"].values():
            assert np.linalg.norm(gained) == pytest.approx(5.0, rel=1e-9)
    assert len({c["start"] for c in collisions}) == 1  # images of each other start alike: 8 m at 10 m/s
    assert collisions[0]["start"] == pytest.approx(0.8, abs=0.011)
    assert sum(c["energy"] for c in collisions) == pytest.approx(run.summary["energy"]["dissipated"], rel=1e-9)


def test_collisions_that_begin_in_one_step_keep_their_own_starts(tmp_path: Path) -> None:
    """Three pairs meet in one step of 0.5 s: at 0.82, 0.53 and 0.96 s, each at its own speed, place and angle. A pair
    that meets at an angle of 90 degrees touches with the middle of a bow of 30 m."""
    (tmp_path / "box.toml").write_text(BOX)
    pairs = [(8.2, 10.0, 180.0), (2.65, 5.0, 0.0), (3.84, 4.0, 90.0)]  # distance of the hulls [m], speed [m/s], angle
    text = HEAD_ON
    for k, (gap, speed, angle) in enumerate(pairs):
        half = 15.0 if angle == 90.0 else 100.0
        for name, north, heading, V in (("a", 0.0, 0.0, speed), ("b", 100.0 + gap + half, angle, 0.0)):
            text += (
                f'[ships.{name}{k}]\nship = "box.toml"\nposition = [{north}, {1000.0 * k}]\nheading_deg = {heading}\n'
                f"speed = {V}\nhydrodynamics = false\ndegrees_of_freedom = 3\n"
            )
    (tmp_path / "fleet.toml").write_text(text)
    found = {
        c["ship_a"]: c for c in simulate(load_scenario(tmp_path / "fleet.toml"), in_process=True).events["collisions"]
    }
    for k, (gap, speed, angle) in enumerate(pairs):
        collision = found[f"a{k}"]
        assert collision["start"] == pytest.approx(gap / speed, abs=0.011), k
        assert collision["closing_speed"] == pytest.approx(speed, rel=1e-9), k
        assert collision["angle"] == pytest.approx(np.radians(angle)), k
        north, east = collision["first_point"]["n"][:2]
        assert north == pytest.approx(100.0 + gap, abs=0.011 * speed), k
        assert east == pytest.approx(1000.0 * k, abs=1e-6), k
    assert [c["id"] for c in sorted(found.values(), key=lambda c: c["start"])] == [1, 2, 3]


@pytest.mark.parametrize("mirrored", [False, True])
def test_a_cause_starts_before_its_effect(tmp_path: Path, mirrored: bool) -> None:
    """Three KCS in a row: the first, 30 m off at 5 m/s, strikes the second, which reaches the third 0.01 m on in the
    same step. Their images, in which the third strikes, start alike."""
    text = HEAD_ON.replace("duration = 2.0", "duration = 7.0").replace("step = 0.5", "step = 0.05")
    rows = [("a", 0.0, 5.0), ("b", 260.0, 0.0), ("c", 490.01, 0.0)]
    if mirrored:
        rows = [("a", -490.01, 0.0), ("b", -260.0, 0.0), ("c", 0.0, 5.0)]
    for name, north, speed in rows:
        text += (
            f'[ships.{name}]\nship = "kcs"\nposition = [{north}, 0.0]\nheading_deg = {180.0 if mirrored else 0.0}\n'
            f"speed = {speed}\nhydrodynamics = false\ndegrees_of_freedom = 3\n"
        )
    (tmp_path / "row.toml").write_text(text)
    cause, effect = simulate(load_scenario(tmp_path / "row.toml"), in_process=True).events["collisions"][:2]
    pairs = [("b", "c"), ("a", "b")] if mirrored else [("a", "b"), ("b", "c")]
    assert [(c["ship_a"], c["ship_b"]) for c in (cause, effect)] == pairs
    assert 6.0 <= cause["start"] <= effect["start"] <= 6.0 + 3 * 0.01
    assert 0.0 < effect["closing_speed"] < cause["closing_speed"] <= 5.0


BOX = ship_toml(
    ship={"name": "Box"}, particulars={"L_pp": 200.0, "B": 30.0, "T": 10.0, "mass": 4e7}, added_mass=NO_ADDED_MASS,
    hull={"depth": 20.0},
)  # fmt: skip
