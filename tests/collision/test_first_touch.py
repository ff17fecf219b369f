"""First touch of fast and thin things: nothing passes through anything, and symmetric hits stop dead in every phase.

A substep in which a boat moves by more than a pole's radius must still find the side of the pole that was met.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from math import cos, pi, sin
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.collision.geometry.detection import Detector
from tests.collision.conftest import World
from tests.ship_files import ship_toml

MakeWorld = Callable[..., World]
Boats = Callable[..., str]

MOTOR_BOAT = (12.0, 3.0, 0.45, 8e3, {"shape": "parametric", "depth": 2.0, "bow_length": 5.0, "stern_length": 3.0})
DINGHY = (4.0, 1.5, 0.1, 500.0, {"shape": "box", "depth": 0.8})
LOG = (10.0, 0.3, 0.2, 500.0, {"shape": "box", "depth": 0.3})
FLARED = (12.0, 3.0, 0.45, 8e3, {
    "shape": "parametric", "depth": 2.0, "bow_length": 3.0, "stern_length": 3.0, "flare_deg": 5.0,
})  # fmt: skip


@pytest.fixture
def boat(tmp_path: Path) -> Boats:
    """Writes the file of (L, B, T, mass, hull) without added mass and returns its path."""

    def make(form: tuple, name: str = "boat") -> str:
        L, B, T, mass, hull = form
        path = tmp_path / f"{name}.toml"
        added = {"m_x": 0.0, "m_y": 0.0, "m_z": 0.0, "j_x": 0.0, "j_y": 0.0, "j_z": 0.0, "z_y": 0.0}
        path.write_text(
            ship_toml(
                ship={"name": name},
                particulars={"L_pp": L, "B": B, "T": T, "mass": mass, "r_bg": [0.0, 0.0, 0.0]},
                hull=hull,
                added_mass=added,
            )
        )
        return str(path)

    return make


def pole(diameter: float) -> str:
    return f'[pole]\nkind = "pole"\nshape = "cylinder"\ndiameter = {diameter}\nposition = [0.0, 0.0]\n'


def wall(thickness: float, heading_deg: float = 0.0) -> str:
    return (
        f'[wall]\nkind = "wall"\nshape = "box"\nlength = {thickness}\nbreadth = 60.0\nposition = [0.0, 0.0]\n'
        f"heading_deg = {heading_deg}\n"
    )


def start(distance: float, speed: float, course: float = 0.0, drift: float = 0.0, rate: float = 0.0) -> dict:
    """A ship so far before the origin [m] on its course [rad], pointing that much to starboard of it."""
    c, s = cos(drift), sin(drift)
    return {
        "position": [-distance * cos(course), -distance * sin(course), 0.0],
        "attitude": (0.0, 0.0, course + drift),
        "nu": [speed * c, -speed * s, 0.0, 0.0, 0.0, rate],
    }


def foremost(w: World, half_length: float, course: float) -> float:
    """How far the boat's middle is along its course, of a start before the origin [m]."""
    return float(w.x[0][0] * cos(course) + w.x[0][1] * sin(course)) + half_length


FEW = [
    (0.05, 0.0, 30.0, 0.05, 0.05),
    (0.2, 0.3, 30.0, 0.05, 0.05),
    (0.05, 0.61, 30.0, 0.05, 0.5),
    (0.2, 0.0, 25.0, 0.01, 0.1),
]
"""(thickness [m], phase, speed [m/s], substep [s], step [s])"""
MANY = list(product([0.05, 0.2, 1.0], [0.0, 0.13, 0.3, 0.48, 0.61, 0.77, 0.93], [2.0, 12.0, 25.0, 30.0, 120.0],
                    [0.005, 0.01, 0.02, 0.05], [0.02, 0.1, 0.5]))  # fmt: skip
PHASES = [
    pytest.param(FEW, id="few"),
    pytest.param(MANY[::11], id="many", marks=pytest.mark.slow),
    pytest.param(MANY, id="all", marks=pytest.mark.soak),
]


def runs(phases: list) -> list[tuple]:
    return [(size, 20.0 + phase * speed * min(h, H), speed, h, H) for size, phase, speed, h, H in phases]


@pytest.mark.parametrize("form", [MOTOR_BOAT, FLARED], ids=["one part", "two parts"])
@pytest.mark.parametrize("phases", PHASES)
def test_a_boat_stops_dead_at_a_thin_pole(world: MakeWorld, boat: Boats, phases: list, form: tuple) -> None:
    """Head-on in line with the pole, plastic: the impulse is m V, and nothing turns the boat."""
    for size, distance, speed, h, H in runs(phases):
        w = world([boat(form)], [start(distance, speed)], degrees_of_freedom=3, obstacles=pole(size), substep=h)
        w.run(distance / speed + 2 * H, H)
        case = (size, distance, speed, h, H)
        assert w.model.outputs.collision_count == 1, case
        assert w.model.outputs.ships[0].impulse[0] == pytest.approx(-form[3] * speed, rel=1e-6), case
        assert np.abs(w.nu[0]).max() <= 1e-6 * speed, case
        assert foremost(w, 0.5 * form[0], 0.0) <= -0.5 * size + 1e-2, case  # never beyond the pole's near side
        w.model.close()


@pytest.mark.parametrize("phases", PHASES)
def test_a_dinghy_stops_dead_side_on_at_a_thin_wall(world: MakeWorld, boat: Boats, phases: list) -> None:
    for size, distance, speed, h, H in runs(phases):
        at = start(distance, speed, drift=pi / 2)
        w = world([boat(DINGHY)], [at], degrees_of_freedom=3, obstacles=wall(size), substep=h)
        w.run(distance / speed + 2 * H, H)
        case = (size, distance, speed, h, H)
        assert w.model.outputs.collision_count == 1, case
        assert np.abs(w.nu[0]).max() <= 1e-6 * speed, case
        assert foremost(w, 0.5 * DINGHY[1], 0.0) <= -0.5 * size + 1e-2, case
        w.model.close()


@pytest.mark.parametrize("phases", PHASES)
def test_a_parallel_master_stops_a_boat_dead_where_it_is_then(world: MakeWorld, boat: Boats, phases: list) -> None:
    """The impulse reaches the boat one step late, V H past the touch. It takes all of the speed and turns nothing, but
    no model can put the boat back: from V H above the thickness on, the boat stands behind the pole, and is warned of.
    """
    for size, distance, speed, h, H in runs(phases):
        w = world([boat(MOTOR_BOAT)], [start(distance, speed)], algorithm="jacobi", degrees_of_freedom=3,
                  obstacles=pole(size), substep=h)  # fmt: skip
        case, warnings = (size, distance, speed, h, H), []
        while w.t < distance / speed + 4 * H:
            w.step(H)
            warnings += [w.model.warning] if w.model.warning else []
        assert bool(warnings) is (speed * H > size * cos(pi / 32)), case
        assert all("moved" in warning and "may have passed the other" in warning for warning in warnings), case
        assert w.model.outputs.collision_count == 1, case
        assert np.abs(w.nu[0]).max() <= 1e-6 * speed, case
        assert foremost(w, 6.0, 0.0) <= speed * H - 0.5 * size + 1e-2, case
        w.model.close()


def test_two_thin_boats_meet_whatever_their_speed(world: MakeWorld, boat: Boats) -> None:
    """Two logs of 0.3 m cross each other's way side-on at up to 120 m/s, 6 m in a substep. A plastic impact of equal
    masses: both keep the mean of their velocities."""
    for speed, phase, h in product([60.0, 120.0], [0.1, 0.8], [0.05]):
        at = [start(20.0 + phase * speed * h, speed, drift=pi / 2), start(0.0, 0.0, drift=pi / 2)]
        w = world([boat(LOG)] * 2, at, degrees_of_freedom=3, substep=h, friction=0.0)
        w.run(20.0 / speed + 4 * h, h)
        assert w.model.outputs.collision_count == 1, (speed, phase, h)
        for nu in w.nu:
            np.testing.assert_allclose(nu, [0.0, -0.5 * speed, 0, 0, 0, 0], atol=1e-6 * speed)
        w.model.close()


def test_a_spinning_log_does_not_sweep_over_a_pole(world: MakeWorld, boat: Boats) -> None:
    """A log of 10 m spins at 10 rad/s, 4.5 m from a pole of 0.05 m: there it moves by 2.2 m in a substep. Plastic: the
    impulse P = omega r / (1/m + r^2/I) stops the place that was met, and the pole stays to starboard."""
    r, omega, m = 4.5, 10.0, LOG[3]
    for phase, h in product([0.0, 0.11, 0.3], [0.01, 0.05]):
        at = start(r, 0.0, drift=-1.2 - phase, rate=omega)
        w = world([boat(LOG)], [at], degrees_of_freedom=3, obstacles=pole(0.05), substep=h, friction=0.0)
        w.run(0.3, h)
        inertia = w.M[0][5, 5]
        assert w.model.outputs.collision_count == 1, (phase, h)
        assert (w.R[0].T @ -w.x[0])[1] > 0.15, (phase, h)
        assert w.nu[0][5] == pytest.approx(omega * (1.0 - r * r / (inertia / m + r * r)), abs=0.02 * omega), (phase, h)
        w.model.close()


def test_a_log_that_was_hit_at_one_end_meets_with_the_other(world: MakeWorld, boat: Boats) -> None:
    """Nearly flush with a wall of 0.1 m, at 25 m/s: one end touches, and the other follows within a substep of 0.05 s,
    by 1.25 m if it were not looked for."""
    for tilt in (0.02, -0.05):
        at = start(3.0, 25.0, drift=pi / 2 + tilt)
        w = world([boat(LOG)], [at], degrees_of_freedom=3, obstacles=wall(0.1), substep=0.05, friction=0.0)
        w.run(1.0, 0.05)
        corners = w.x[0] + np.array([[s * 5.0, t * 0.15, 0.0] for s in (-1, 1) for t in (-1, 1)]) @ w.R[0].T
        assert corners[:, 0].max() <= 0.0, tilt
        assert w.model.outputs.collision_count == 1, tilt


def test_slow_and_large_bodies_are_not_looked_after(
    world: MakeWorld, boat: Boats, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A search for the first touch costs several closest points: it is kept for what may move by a twentieth of the
    thinner hull in a substep."""
    searched = []
    search = Detector.first_touch
    monkeypatch.setattr(Detector, "first_touch", lambda *args: (searched.append(args), search(*args))[1])
    for speed, searches in ((4.0, False), (40.0, True)):
        searched.clear()
        w = world([boat(MOTOR_BOAT)], [start(9.0, speed)], degrees_of_freedom=3, obstacles=wall(5.0), substep=0.01)
        w.run(2.0 / speed, 0.05)
        assert w.model.outputs.collision_count == 1
        assert bool(searched) is searches
        w.model.close()


def test_more_touches_than_are_looked_for_are_warned_of(
    world: MakeWorld, boat: Boats, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An elastic log between two walls of 0.05 m, 0.1 m from either, at 120 m/s: 60 touches in a step of 0.1 s. The
    work of a step is bounded, and what the bound leaves out is said."""
    walls = "".join(wall(0.05).replace("wall]", f"wall{k}]").replace("[0.0, 0.0]", f"[{x}, 0.0]") for k, x in
                    enumerate((-0.275, 0.275)))  # fmt: skip
    examined = []
    contacts = Detector.contacts
    monkeypatch.setattr(Detector, "contacts", lambda *args: (examined.append(args), contacts(*args))[1])
    w = world([boat(LOG)], [start(0.0, 120.0, drift=pi / 2)], degrees_of_freedom=3, obstacles=walls, restitution=1.0,
              substep=0.01, friction=0.0)  # fmt: skip
    w.step(0.1)
    assert "touched 40 times in the step from t = 0 s by 0.1 s" in w.model.warning
    assert len(examined) <= 2 * (40 + 10)


SHIP = (100.0, 15.0, 5.0, 5e6, {"shape": "parametric", "depth": 9.0, "bow_length": 25.0, "stern_length": 15.0})


@pytest.mark.slow
def test_a_ship_slides_along_a_pole_that_is_inside_it(world: MakeWorld, boat: Boats) -> None:
    """Under a parallel master a turning ship strikes a pole of 0.5 m at 15 m/s, with steps of 0.02 s. It
    overlaps by up to 0.3 m from then on, and slides along. The normal follows the side; that of the first touch, of
    the pole, let the ship in by 7.7 m."""
    at = {
        "position": [30.61305, 83.14091, 0.0], "attitude": (0.0, 0.0, 0.4546444),
        "nu": [-10.1125, -11.07868, 0.0, 0.0, 0.0, -0.02],
    }  # fmt: skip
    obstacles = pole(0.5) + "heading_deg = 304.55328\n"
    w = world([boat(SHIP)], [at], algorithm="jacobi", degrees_of_freedom=3, obstacles=obstacles, substep=0.02)
    w.run(5.0, 0.02)
    clearances = []
    for _ in range(200):
        w.step(0.02)
        clearances.append(w.model.outputs.clearance)
    assert w.model.outputs.collision_count == 1
    assert min(clearances) >= -0.35


# -- thin overlaps: bodies of any size that overlap by less than they move in a substep ---------------------------

BARGE = (100.0, 20.0, 5.0, 5e6, {"shape": "box", "depth": 10.0})
SKIFF = (4.0, 1.5, 0.4, 1000.0, {"shape": "box", "depth": 0.8})


def rock(above_keel: float, keel: float) -> str:
    """A rock that stands so far above the keel's depth [m], its near side at the origin."""
    return (
        f'[rock]\nkind = "rock"\nshape = "box"\nlength = 2.0\nbreadth = 2.0\nposition = [1.0, 0.0]\n'
        f"top = {above_keel - keel}\n"
    )


def deck(below: float, height: float) -> str:
    """A bridge's deck whose underside is so far below the height of a ship's deck [m], its near side at the origin."""
    return (
        f'[deck]\nkind = "deck"\nshape = "box"\nlength = 10.0\nbreadth = 50.0\nposition = [5.0, 0.0]\n'
        f"top = 10.0\nbottom = {below - height}\n"
    )


THIN = [
    pytest.param(BARGE, 3.0, 0.01, rock(0.01, 5.0), id="rock 1 cm above the keel"),
    pytest.param(SKIFF, 5.0, 0.01, rock(0.005, 0.4), id="rock 5 mm above a boat's"),
    pytest.param(SKIFF, 5.0, 0.01, deck(0.02, 0.4), id="deck 2 cm below a boat's"),
    pytest.param(SKIFF, 25.0, 0.05, deck(0.005, 0.4), id="deck 5 mm below a boat's"),
]


@pytest.mark.one_in(2)
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
@pytest.mark.parametrize(("form", "speed", "h", "obstacle"), THIN)
def test_what_overlaps_little_in_height_stops_a_ship(
    world: MakeWorld, boat: Boats, form: tuple, speed: float, h: float, obstacle: str, algorithm: str
) -> None:
    """The normal is that of the first touch, the bow's, though the overlap in height is less from then on. A ship with
    three degrees of freedom stops dead: P = m V."""
    for phase in (0.03, 0.52):
        at = start(0.5 * form[0] + (2 + phase) * speed * h, speed)
        w = world([boat(form)], [at], degrees_of_freedom=3, obstacles=obstacle, substep=h, algorithm=algorithm)
        w.run(8 * h, 2 * h)
        assert w.model.outputs.collision_count == 1
        assert w.model.outputs.ships[0].impulse[0] == pytest.approx(-form[3] * speed, rel=1e-6)
        assert np.abs(w.nu[0]).max() <= 1e-6 * speed
        w.model.close()


def test_a_ship_that_is_driven_on_does_not_pass_over_a_low_rock(world: MakeWorld, boat: Boats) -> None:
    """A propeller that gains 0.1 m/s in a step of 0.1 s presses a ship on a rock that stands 1 cm above its keel. Under
    a parallel master it comes to overlap by 0.3 m along, more than in height: the normal remains the bow's."""
    for algorithm in ("gauss-seidel", "jacobi"):
        w = world([boat(BARGE)], [start(51.0, 3.0)], degrees_of_freedom=3, obstacles=rock(0.01, 5.0),
                  algorithm=algorithm, friction=0.0)  # fmt: skip
        for _ in range(60):
            w.step(0.1)
            w.nu[0][0] += 0.1
        assert w.model.outputs.contact_active
        assert foremost(w, 50.0, 0.0) <= 0.5, algorithm
        w.model.close()


def test_corners_that_graze_by_a_centimetre_meet_end_on(world: MakeWorld, boat: Boats) -> None:
    """A ship at 5 m/s, whose side overlaps a pier by 1 cm in plan. The end faces meet, at the lever y of their common
    strip: P = V / (1/m + y^2/I). Least overlap is across, from the first substep of 0.05 m on: nothing would happen."""
    V, overlap = 5.0, 0.01
    at = start(52.0, V)
    at["position"][1] = -10.0 + overlap
    pier = '[pier]\nkind = "pier"\nshape = "box"\nlength = 30.0\nbreadth = 20.0\nposition = [15.0, 10.0]\n'
    w = world([boat(BARGE)], [at], degrees_of_freedom=3, obstacles=pier, substep=0.01, friction=0.0)
    while w.model.outputs.collision_count == 0:
        w.step(0.01)
    y, inertia, m = 10.0 - 0.5 * overlap, w.M[0][5, 5], BARGE[3]
    assert w.model.outputs.ships[0].impulse[0] == pytest.approx(-V / (1 / m + y * y / inertia), rel=2e-3)


# -- within the substep, after the first touch --------------------------------------------------------------------


def test_a_corner_on_a_side_gives_the_impulse_of_the_side_and_slides_on(world: MakeWorld, boat: Boats) -> None:
    """A boat of 6 m at 24 m/s, set to starboard by 8 m/s, meets the corner of a pier with its side.

    Plastic, and sliding on: J_y = -v / (1/m + r_x^2/I - mu r_x r_y/I), J_x = mu J_y, at arms between those of the touch
    and of the start of the step, where the boat takes the impulse. Within the substep of 0.05 s the corner then slides
    along by 1.2 m and pushes on; what comes of it is within 7 % of that of a hundred substeps.
    """
    form = (6.0, 2.4, 0.7, 9000.0, {"shape": "box", "depth": 1.4})
    pier = '[pier]\nkind = "pier"\nshape = "box"\nlength = 2.0\nbreadth = 2.0\nheading_deg = 45.0\n' \
           f"position = [0.0, {2.0**0.5}]\n"  # fmt: skip
    u, v, mu, m, touch = 24.0, 8.0, 0.3, form[3], 0.015
    for x in (1.6, -0.7):
        found = []
        for H, substep in ((0.0151, 0.0151), (0.05, 0.05), (0.05, 0.0005)):
            at = {"position": [-x - u * touch, -1.2 - v * touch, 0.0], "nu": [u, v, 0.0, 0.0, 0.0, 0.0]}
            w = world([boat(form)], [at], degrees_of_freedom=3, obstacles=pier, substep=substep, friction=mu)
            w.step(H)
            found.append(np.array(w.model.outputs.ships[0].impulse)[[0, 1, 5]])
        inertia, r_x, r_y = w.M[0][5, 5], x + 0.5 * u * touch, 1.2 + 0.5 * v * touch
        J_y = -v / (1 / m + r_x * r_x / inertia - mu * r_x * r_y / inertia)
        J_x = mu * J_y
        expected = [J_x, J_y, r_x * J_y - r_y * J_x]
        np.testing.assert_allclose(found[0], expected, rtol=5e-3, err_msg=f"{x}")
        np.testing.assert_allclose(found[1], found[2], atol=0.07 * np.abs(found[2]).max(), err_msg=f"{x}")


def test_a_spinning_log_stops_with_its_end_at_a_wall(world: MakeWorld, boat: Boats) -> None:
    """A log of 10 m at 25 m/s, which spins: its ends approach by up to 5 m in a substep. The post-impact state has
    it before the wall, to a twentieth of its thickness and the 1 mm of each of some further touches."""
    met = 0
    for phase, rate in product((0.1, 0.9, 1.7, 2.6), (-20.0, -5.0, 8.0, 15.0)):
        w = world([boat(LOG)], [start(6.0, 25.0, drift=phase, rate=rate)], degrees_of_freedom=3, obstacles=wall(1.0),
                  substep=0.05, friction=0.0)  # fmt: skip
        while w.model.outputs.collision_count == 0:
            w.step(0.05)
        post = w.model.outputs.ships[0]
        c, s = cos(post.attitude[2]), sin(post.attitude[2])
        foremost_corner = post.position[0] + 5.0 * abs(c) + 0.15 * abs(s)
        assert foremost_corner <= -0.5 + 0.05 * 0.3 + 5e-3, (phase, rate)
        assert post.velocity[0] * c - post.velocity[1] * s < 24.0, (phase, rate)
        met += 1
    assert met == 16
