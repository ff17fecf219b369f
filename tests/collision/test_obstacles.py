"""Obstacles: their tables, and ships that meet them. An obstacle is a ship of infinite mass."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.collision.obstacles import (
    CYLINDER_SIDES,
    ObstacleTable,
    build_obstacle,
    format_obstacles,
    read_obstacles,
)
from shipcollision_fmu.errors import InputError, StepError
from shipcollision_fmu.ship.frames import attitude_from_rotation
from shipcollision_fmu.ship.hull.solid import HullMesh
from tests.collision.conftest import BOX, FORMS, LANGUAGES, NO_ADDED_MASS, World

Make = Callable[..., str]
MakeWorld = Callable[..., World]

WALL = """
[wall]
kind = "quay"
shape = "box"
length = 300.0
breadth = 20.0
position = [110.5, 0.0]
heading_deg = 90.0
"""
PIER = """
[pier]
kind = "bridge pier"
shape = "cylinder"
diameter = 12.0
position = [110.0, 9.0]
"""
STERN_ON = [{"position": [0.0, 0.0, 0.0], "nu": [2.0, 0, 0, 0, 0, 0]}]  # the stem of a 200 m box is at 100 m


def read(text: str) -> ObstacleTable:
    (found,) = read_obstacles(text)
    assert found
    return ObstacleTable.model_validate(_content(text))


def _content(text: str) -> dict:
    from shipcollision_fmu.ship.loading.toml import parse_toml

    (table,) = parse_toml(text, "test", InputError).values()
    return table


# -- shapes -----------------------------------------------------------------------------------------


def is_closed(mesh: HullMesh) -> bool:
    """Every edge is passed once in either sense."""
    edges = [(int(t[i]), int(t[(i + 1) % 3])) for t in mesh.triangles for i in range(3)]
    return len(set(edges)) == len(edges) and all((b, a) in set(edges) for a, b in edges)


@pytest.mark.parametrize(
    ("shape", "area"),
    [
        ('shape = "box"\nlength = 30.0\nbreadth = 4.0', 120.0),
        ('shape = "cylinder"\ndiameter = 10.0', 0.5 * CYLINDER_SIDES * 25.0 * np.sin(2 * pi / CYLINDER_SIDES)),
        ('shape = "polygon"\npoints = [[0, 0], [10, 0], [10, 6], [0, 6]]', 60.0),
        ('shape = "polygon"\npoints = [[0, 0], [0, 6], [10, 0]]', 30.0),
    ],
)
def test_a_prism_is_closed_and_has_its_volume(shape: str, area: float) -> None:
    (found,) = read_obstacles(f'[it]\nkind = "x"\nposition = [1.0, 2.0]\ntop = 3.0\nbottom = 9.0\n{shape}')
    assert found.solid.volume == pytest.approx(12.0 * area, rel=1e-12)
    assert is_closed(found.solid)
    assert found.solid.vertices[:, 2].min() == -3.0
    assert found.solid.vertices[:, 2].max() == 9.0


def test_height_counts_down_from_the_top() -> None:
    (found,) = read_obstacles('[deck]\nkind = "bridge"\nshape = "box"\nlength = 9.0\nbreadth = 9.0\n'
                              "position = [0, 0]\ntop = 40.0\nheight = 10.0")  # fmt: skip
    assert found.solid.vertices[:, 2].max() == -30.0


def test_text_and_back_gives_the_same_obstacles(tmp_path: Path) -> None:
    text = WALL + "fender = {stiffness = 1e6, thickness = 0.7}\n" + PIER.replace("9.0", "0.1")
    tables = {o.name: ObstacleTable.model_validate(t) for o, t in zip(
        read_obstacles(text), [_content(WALL + "fender = {stiffness = 1e6, thickness = 0.7}"),
                               _content(PIER.replace("9.0", "0.1"))], strict=True)}  # fmt: skip
    again = read_obstacles(format_obstacles(tables))
    path = tmp_path / "walls.toml"
    path.write_text(text)
    for one, two, three in zip(read_obstacles(text), again, read_obstacles(str(path)), strict=True):
        assert (one.name, one.kind, one.heading, one.fender) == (two.name, two.kind, two.heading, two.fender)
        np.testing.assert_array_equal(one.solid.vertices, two.solid.vertices)
        np.testing.assert_array_equal(one.solid.vertices, three.solid.vertices)
        np.testing.assert_array_equal(one.position, two.position)


def test_names_of_kinds_survive_any_character() -> None:
    table = ObstacleTable(kind='a "quay"\\\n\x7f', shape="cylinder", diameter=1.0, position=[0.0, 0.0])
    assert read_obstacles(format_obstacles({"q": table}))[0].kind == table.kind
    assert build_obstacle("q", table).kind == table.kind


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (WALL + "hight = 3.0", r"obstacles: \[obstacles.wall\] hight is not a known key: did you mean height\?$"),
        (WALL + "diameter = 3.0", r"wall\] shape = 'box' takes length and breadth: remove diameter"),
        (WALL.replace("breadth = 20.0", ""), r"shape = 'box' takes length and breadth: give breadth"),
        (WALL.replace("20.0", "-20.0"), r"\[obstacles.wall\] breadth = -20.0 must be greater than 0: it is the box's"),
        (WALL.replace("20.0", "nan"), r"\[obstacles.wall\] breadth = nan must be a finite number"),
        (WALL + "bottom = -6.0", r"bottom = -6 m below the waterline is not below top = 5 m above it"),
        (WALL.replace("20.0", "1e300"), r"wall\] has a length or place of 1e\+300 m, the limit is 1e\+06: give metres"),
        (WALL + "bottom = 1e300", r"wall\] has a length or place of 1e\+300 m, the limit is 1e\+06: give metres"),
        ('[p]\nkind = "x"\nshape = "cylinder"\nposition = [0, 1e300]\ndiameter = 3.0',
         r"p\] has a length or place of 1e\+300 m, the limit is 1e\+09: give metres"),
        ('[p]\nkind = "x"\nshape = "polygon"\nposition = [0, 0]\npoints = [[0, 0], [1e200, 0], [9, 9]]',
         r"p\] has a length or place of 1e\+200 m, the limit is 1e\+06: give metres"),
        (WALL + "bottom = 6.0\nheight = 3.0", r"gives both bottom and height: keep one"),
        (WALL + "fender = {stiffness = 0.0, thickness = 1.0}", r"wall.fender\] stiffness = 0.0 must be greater than 0"),
        ('[p]\nkind = "x"\nshape = "polygon"\nposition = [0, 0]\npoints = [[0, 0], [9, 0], [9, 9], [8, 1]]',
         r"points are not the corners of a convex polygon: 3 of 4 are on its outside"),
        ('[p]\nkind = "x"\nshape = "polygon"\nposition = [0, 0]\npoints = [[0, 0], [1, 0], [2, 0]]',
         r"points lie on one line"),
        ("wall = 3", r"obstacles: \[obstacles\] wall = 3 must be a table"),
        ("[wall", r"obstacles: is not valid TOML"),
        ("nowhere.toml", r"obstacles: file nowhere.toml does not exist: give TOML text, or the path"),
    ],
)  # fmt: skip
def test_what_is_no_obstacle_is_refused_in_one_line(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message) as error:
        read_obstacles(text)
    assert "\n" not in str(error.value)


def test_an_obstacle_named_like_a_ship_is_refused(make_ship: Make) -> None:
    model = ShipCollision(("wall",))
    model.parameters.ships[0].ship = make_ship("a")
    model.parameters.obstacles = WALL
    with pytest.raises(InputError, match="'wall' is the name of a ship: give the obstacle another name"):
        model.initialise()


# -- ships that meet them ---------------------------------------------------------------------------


@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
@FORMS
def test_head_on_a_wall_takes_all_momentum_and_all_energy(
    make_ship: Make, world: MakeWorld, response: str, algorithm: str
) -> None:
    """Minorsky's and AASHTO's limit of a rigid, fixed structure: E = 1/2 m (1 + m_x) v^2."""
    ship = make_ship("box", BOX, NO_ADDED_MASS if response == "bullet" else "")
    w = world([ship], STERN_ON, obstacles=WALL, response=response, algorithm=algorithm).run(1.0, 0.05)
    m = w.M[0][0, 0]
    # Bullet holds the flat stem at one or two corners, by chance, and the ship pitches.
    tolerance = 1e-9 if response == "pgs" else 0.1
    np.testing.assert_allclose(w.nu[0], np.zeros(6), atol=tolerance)
    assert w.model.outputs.ships[0].impulse[0] == pytest.approx(-2.0 * m, rel=tolerance)
    assert w.model.outputs.energy.dissipated == pytest.approx(2.0 * m, rel=tolerance)
    out = w.model.outputs
    assert (out.collision_count, out.impact.ship_a, out.impact.ship_b) == (1, 1, 2)


@LANGUAGES
def test_elastic_rebound_from_a_wall(make_ship: Make, world: MakeWorld) -> None:
    w = world([make_ship("box", BOX)], STERN_ON, obstacles=WALL, restitution=1.0).run(1.0, 0.05)
    np.testing.assert_allclose(w.nu[0], [-2.0, 0, 0, 0, 0, 0], atol=1e-9)


def test_a_fixed_body_is_the_limit_of_a_heavy_ship(make_ship: Make, world: MakeWorld) -> None:
    """Blow off the centre of a box with the mass of a billion ships, and of the same box as an obstacle."""
    start = [{"position": [0.0, 8.0, 0.0], "attitude": (0, 0, 0.2), "nu": [3.0, 0.3, 0, 0, 0, 0.001]},
             {"position": [118.0, 0.0, 0.0], "attitude": (0, 0, pi / 2), "nu": [0.0] * 6}]  # fmt: skip
    ships = [make_ship("a"), make_ship("box", BOX)]
    heavy = world(ships, start)
    body = heavy.model._bodies[1]
    heavy.model._bodies[1] = replace(body, upright_inverse=1e-9 * body.upright_inverse)
    heavy.upright[1] = 1e-9 * heavy.upright[1]
    wall = '[wall]\nkind = "x"\nshape = "box"\nlength = 200.0\nbreadth = 30.0\nposition = [118.0, 0.0]\n' \
           "heading_deg = 90.0\ntop = 10.0\nbottom = 10.0"  # fmt: skip
    fixed = world(ships[:1], start[:1], obstacles=wall)
    heavy.run(3.0, 0.05)
    fixed.run(3.0, 0.05)
    assert fixed.model.outputs.collision_count == 1
    np.testing.assert_allclose(fixed.nu[0], heavy.nu[0], atol=1e-5)


@pytest.mark.slow
def test_a_ship_that_scrapes_past_a_pier_loses_energy_only(make_ship: Make, world: MakeWorld) -> None:
    w = world([make_ship("a")], [{"position": [0.0, 0.0, 0.0], "nu": [4.0, 0, 0, 0, 0, 0]}], obstacles=PIER)
    lows = []
    for _ in range(600):
        w.step(0.1)
        lows.append(w.model.outputs.clearance)
    assert w.model.outputs.collision_count >= 1
    assert sum(w.work) < 0.0
    assert max(w.work) <= 1e-9 * abs(sum(w.work))
    assert min(lows) > -0.1
    assert w.nu[0][:2] @ w.nu[0][:2] < 16.0


@LANGUAGES
def test_two_ships_and_two_obstacles_are_numbered_in_order(make_ship: Make, world: MakeWorld) -> None:
    box = make_ship("box", BOX)
    start = [STERN_ON[0], {"position": [0.0, 400.0, 0.0], "nu": [0.0, 0, 0, 0, 0, 0]}]
    far = WALL.replace("wall", "far").replace("110.5", "9000.0")
    w = world([box, box], start, obstacles=far + WALL)
    seen = set()
    for _ in range(20):
        w.step(0.05)
        seen |= {(s.ship_a, s.ship_b) for s in w.model.outputs.contacts[: w.model.outputs.contact_count]}
    assert seen == {(1, 4)}  # ships 1 and 2, far 3, wall 4
    np.testing.assert_array_equal(w.applied[1], np.zeros(6))


@LANGUAGES
def test_a_light_buoy_changes_a_ships_speed_by_its_share(make_ship: Make, world: MakeWorld) -> None:
    """Central plastic impact: the ship loses m_b / (m_a + m_b) of her speed, masses with water."""
    start = [STERN_ON[0], {"position": [101.4, 0.0, 0.0], "nu": [0.0] * 6}]
    w = world([make_ship("box", BOX), "buoy"], start, degrees_of_freedom=3, friction=0.0).run(1.0, 0.05)
    m_a, m_b = w.M[0][0, 0], w.M[1][0, 0]
    assert m_b == pytest.approx(1.5 * 6038.0)
    assert 2.0 - w.nu[0][0] == pytest.approx(2.0 * m_b / (m_a + m_b), rel=1e-6)
    assert w.nu[1][0] == pytest.approx(w.nu[0][0], abs=1e-9)


@LANGUAGES
def test_a_log_struck_at_its_end_turns_away(make_ship: Make, world: MakeWorld) -> None:
    """The log lies across, its last half metre before the corner of the flat stem. The corner, 4.5 m abaft the log's
    centre and 15 m to starboard of the ship's, stops it; abaft of that the log swings away faster than the stem comes:

        P = V / (1/m + 4.5^2/I + 1/M + 15^2/I_ship),      yaw rate of the log + 4.5 P/I
    """
    start = [STERN_ON[0], {"position": [100.8, 19.5, 0.0], "attitude": (0, 0, pi / 2), "nu": [0.0] * 6}]
    w = world([make_ship("box", BOX), "floating_log"], start, degrees_of_freedom=3, friction=0.0)
    while not w.model.outputs.contact_active:
        w.step(0.01)  # one substep: the first impulse alone
    ship, log = w.M
    assert (ship[1, 5], log[1, 5]) == (0.0, 0.0)
    P = 2.0 / (1.0 / log[1, 1] + 4.5**2 / log[5, 5] + 1.0 / ship[0, 0] + 15.0**2 / ship[5, 5])
    np.testing.assert_allclose(w.applied[1][[0, 1, 5]], [0.0, -P, 4.5 * P], rtol=0.0, atol=1e-6 * P)
    assert w.nu[1][5] == pytest.approx(4.5 * P / log[5, 5], rel=1e-6)
    assert 2.0 - w.nu[0][0] == pytest.approx(P / ship[0, 0], rel=1e-6)
    assert max(w.work) <= 1e-9 * abs(sum(w.work))


def test_a_breakwater_of_two_boxes_stops_a_ship_as_one(make_ship: Make, world: MakeWorld) -> None:
    """The flat stem hits both at once, straddling their joint: all of m V is taken, in shares, and nothing turns."""
    parts = "".join(
        WALL.replace("wall", name).replace("300.0", "100.0").replace("[110.5, 0.0]", f"[110.5, {east}]")
        for name, east in (("west", -50.0), ("east", 50.0))
    )
    w = world([make_ship("box", BOX)], STERN_ON, obstacles=parts)
    w.run(1.0, 0.05)
    assert w.model.obstacles == ("west", "east")
    np.testing.assert_allclose(w.nu[0], np.zeros(6), atol=1e-9)
    np.testing.assert_allclose(w.applied[0], [-2.0 * w.M[0][0, 0], 0, 0, 0, 0, 0], atol=1.0)
    assert w.model.outputs.energy.dissipated == pytest.approx(2.0 * w.M[0][0, 0], rel=1e-9)


@LANGUAGES
def test_a_lock_chamber_holds_a_ship_by_both_walls(make_ship: Make, world: MakeWorld) -> None:
    """A box of 200 x 30 m that yaws in a chamber a hand wider: a bow corner and a quarter touch opposite walls at once,
    two equal forces a pair apart. That takes all of the yaw and, being a couple, no way sideways."""
    width = 30.5
    walls = "".join(
        f'[{name}]\nkind = "lock"\nshape = "box"\nlength = 400.0\nbreadth = 10.0\nposition = [0.0, {east}]\n'
        for name, east in (("port", -5.0 - 0.5 * width), ("starboard", 5.0 + 0.5 * width))
    )
    w = world(
        [make_ship("box", BOX)], [{"position": [0.0, 0.0, 0.0], "nu": [0.0, 0.0, 0.0, 0.0, 0.0, 0.002]}],
        obstacles=walls, degrees_of_freedom=3, friction=0.0,
    )  # fmt: skip
    touched = set()
    for _ in range(80):
        w.step(0.05)
        touched |= {s.ship_b for s in w.model.outputs.contacts[: w.model.outputs.contact_count]}
    assert touched == {2, 3}
    np.testing.assert_allclose(w.nu[0], np.zeros(6), atol=1e-9)
    np.testing.assert_allclose(w.applied[0], [0, 0, 0, 0, 0, -0.002 * w.M[0][5, 5]], atol=1e-6 * w.M[0][5, 5])
    # She stops where the corner meets the wall: 100 sin(psi) + 15 cos(psi) = half the width.
    psi = attitude_from_rotation(w.R[0])[2]
    assert 100.0 * np.sin(psi) + 15.0 * np.cos(psi) == pytest.approx(0.5 * width, abs=0.02)


# -- bad input, and the state -----------------------------------------------------------------------


@LANGUAGES
def test_a_start_inside_a_wall_parts_sideways_and_adds_no_energy(make_ship: Make, world: MakeWorld) -> None:
    """5 m deep: least overlap in space might be anything; the ship is stopped on the level, and not thrown out."""
    deep = [{"position": [5.5, 3.0, 0.0], "nu": [2.0, 0.1, 0, 0, 0, 0]}]
    w = world([make_ship("box", BOX)], deep, obstacles=WALL)
    w.step(0.05)
    slot = w.model.outputs.contacts[0]
    np.testing.assert_allclose(slot.normal, [1.0, 0.0, 0.0], atol=1e-12)
    w.run(2.0, 0.05)
    assert w.nu[0][0] == pytest.approx(0.0, abs=1e-9)
    assert max(w.work) <= 1e-9 * abs(sum(w.work))


@LANGUAGES
def test_ships_that_start_on_top_of_each_other_give_a_defined_result(make_ship: Make, world: MakeWorld) -> None:
    rest = [{"position": [1.0, 0.0, 0.0], "nu": [0.0] * 6}] * 2
    w = world([make_ship("a"), make_ship("b")], rest).run(0.5, 0.05)
    np.testing.assert_array_equal(w.nu, np.zeros((2, 6)))
    assert w.model.outputs.clearance < -1.0


def test_ships_of_which_nothing_was_heard_do_not_collide(make_ship: Make, world: MakeWorld) -> None:
    """As in an FMU whose inputs were never set, or in the first step of FMPy's SSP master: all at the origin."""
    nought = {"position": [0.0, 0.0, 0.0], "nu": [0.0] * 6}
    third = {"position": [0.0, 500.0, 0.0], "nu": [0.0] * 6}
    w = world([make_ship("a"), make_ship("b"), make_ship("c")], [nought, nought, third]).run(0.5, 0.05)
    outputs = w.model.outputs
    assert (outputs.contact_count, outputs.collision_count, outputs.scratch_id) == (0, 0, 0)
    assert outputs.clearance == w.model.parameters.clearance_range
    w = world([make_ship("a"), make_ship("b")], [nought, nought | {"position": [0.0, 0.5, 0.0]}]).run(0.5, 0.05)
    assert w.model.outputs.collision_count == 1


@LANGUAGES
@pytest.mark.parametrize(
    ("quantity", "value", "message"),
    [
        ("velocity", 1e4, r"s0.velocity is 10000 m/s at t = 0.05 s, above 1000 m/s: check the signal and its unit"),
        ("rate", 1e3, r"s0.rate is 101612 m/s at the ship's ends at t = 0.05 s, above 1000 m/s"),
        ("position", 1e12, r"s0.position is 1e\+12 m from the origin at t = 0.05 s, above 1e\+09 m"),
        ("position", float("nan"), r"s0.position = \[nan, .* is not finite: check the ship model's output"),
    ],
)
def test_absurd_input_beside_a_wall_leaves_the_state_before(
    make_ship: Make, world: MakeWorld, quantity: str, value: float, message: str
) -> None:
    w = world([make_ship("box", BOX)], STERN_ON, obstacles=WALL)
    w.step(0.05)
    before, outputs = w.model.get_state(), repr(w.model.outputs)
    w.send()
    getattr(w.model.inputs.ships[0], quantity)[0] = value
    with pytest.raises(StepError, match=message):
        w.model.step(w.t, 0.05)
    assert (w.model.get_state(), repr(w.model.outputs)) == (before, outputs)


@LANGUAGES
@pytest.mark.parametrize("obstacles", [WALL, WALL + "fender = {stiffness = 5e7, damping = 1e6, thickness = 0.4}"])
def test_saved_state_repeats_every_bit_against_a_wall(make_ship: Make, world: MakeWorld, obstacles: str) -> None:
    w = world([make_ship("a")], [{"position": [0.0, 2.0, 0.0], "nu": [3.0, 0.2, 0, 0, 0, 0]}], obstacles=obstacles)
    while not w.model.outputs.contact_count:
        w.step(0.05)
    saved = json.loads(json.dumps(w.model.get_state()))
    w.send()
    runs = []
    for _ in range(3):
        w.model.set_state(saved)
        w.model.step(w.t, 0.05)
        w.model.step(w.t + 0.05, 0.05)
        runs.append(repr(w.model.outputs) + repr(w.model.get_state()))
        w.model.step(w.t + 0.1, 0.3)  # something else in between
    assert runs[0] == runs[1] == runs[2]
