"""The picture without a GPU: depth buffer, sea, camera, puffs, and what a frame of a run shows."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.ship.frames import rotation_from_quaternion
from shipcollision_fmu.show.film import sea
from shipcollision_fmu.show.film.film import Film
from shipcollision_fmu.show.film.puffs import make_puffs
from shipcollision_fmu.show.film.raster import NOTHING, Eye, find_nearest
from shipcollision_fmu.show.scene.camera import ANGLE, place_camera
from shipcollision_fmu.show.scene.palette import convert_to_display, find_paint
from shipcollision_fmu.show.scene.scene import Scene, load_scene
from tests.show.conftest import GUAN2014

EYE = Eye(np.array([-120.0, -60.0, -45.0]), np.array([3.0, 7.0, -2.0]), 32.0, 160, 90)


@pytest.fixture(scope="module")
def scene(guan2014: Path) -> Scene:
    return load_scene(guan2014)


def first_hit(eye: Eye, ray: np.ndarray, triangles: np.ndarray) -> tuple[int, float]:
    """Triangle and depth along a ray, by Moeller and Trumbore (1997)."""
    a, b, c = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    h = np.cross(ray, c)
    det = (b * h).sum(axis=1)
    s = eye.position - a
    u = (s * h).sum(axis=1) / det
    q = np.cross(s, b)
    v = q @ ray / det
    depth = np.where((u >= 0) & (v >= 0) & (u + v <= 1), (c * q).sum(axis=1) / det, np.inf)
    return (int(depth.argmin()), float(depth.min())) if np.isfinite(depth).any() else (NOTHING, np.inf)


def test_each_pixel_sees_what_a_ray_through_its_middle_meets_first() -> None:
    rng = np.random.default_rng(5)
    triangles = rng.uniform(-40.0, 40.0, (60, 1, 3)) + rng.uniform(-15.0, 15.0, (60, 3, 3))
    seen, rays = find_nearest(EYE, triangles), EYE.rays().astype(float)
    hits = 0
    for row in range(0, 90, 3):
        for column in range(0, 160, 3):
            triangle, depth = first_hit(EYE, rays[row, column], triangles)
            if seen.triangle[row, column] != triangle:  # on an edge, to rounding
                beside = find_nearest(EYE, triangles).triangle[
                    max(row - 1, 0) : row + 2, max(column - 1, 0) : column + 2
                ]
                assert triangle in beside
                continue
            hits += triangle != NOTHING
            assert seen.depth[row, column] == pytest.approx(depth, rel=1e-5)
    assert hits > 200


def test_projection_and_rays_are_each_others_inverse() -> None:
    places = EYE.position + 80.0 * EYE.rays()[::7, ::7]
    x, y, depth = np.moveaxis(EYE.project(places), -1, 0)
    np.testing.assert_allclose(x[0], np.arange(160)[::7] + 0.5, atol=1e-3)
    np.testing.assert_allclose(y[:, 0], np.arange(90)[::7] + 0.5, atol=1e-3)
    np.testing.assert_allclose(depth, 80.0, rtol=1e-5)


def test_east_is_to_the_right_of_one_who_looks_north() -> None:
    eye = Eye(np.array([-100.0, 0.0, -20.0]), np.zeros(3), 40.0, 200, 100)
    x, y, _ = eye.project(np.array([[0.0, 10.0, 0.0], [0.0, -10.0, 0.0], [0.0, 0.0, -10.0]])).T
    assert x[0] > 100.0 > x[1]
    assert y[2] < 50.0


def test_the_sea_is_met_at_depth_nought_and_the_sky_is_not() -> None:
    rays = EYE.rays().astype(float)
    depth = sea.find_depth(EYE, rays)
    wet = np.isfinite(depth)
    np.testing.assert_allclose((EYE.position + rays[wet] * depth[wet][:, None])[:, 2], 0.0, atol=1e-9)
    assert not np.isfinite(sea.find_depth(EYE, np.array([[1.0, 0.0, -0.01]]))).any()


def test_water_hides_by_beer_and_lambert() -> None:
    near, far = sea.find_clarity(np.array([2.0, 4.0]))
    assert far == pytest.approx(near**2)
    assert sea.find_clarity(np.zeros(1))[0] == 1.0


@pytest.mark.parametrize(
    "run",
    [
        GUAN2014,
        pytest.param("kvlcc2_crossing", marks=pytest.mark.slow),
    ],
)
def test_the_camera_sees_the_first_contact(run: str, request: pytest.FixtureRequest) -> None:
    """In the middle of the picture, and no hull between: what is seen there is no nearer than a ship's breadth."""
    scene = load_scene(request.getfixturevalue(run))
    first = scene.effects[0]
    eye, target = place_camera(scene).at(first.time)
    view = Eye(eye, target, ANGLE, 320, 180)
    position, quaternion = scene.ship(first.ship).track.at(first.time)
    point = position + rotation_from_quaternion(quaternion) @ first.point
    x, y, depth = view.project(point)
    assert abs(x - 160) < 40
    assert abs(y - 90) < 40
    triangles = [
        (ship.track.at(first.time)[0] + ship.hull.vertices @ rotation_from_quaternion(ship.track.at(first.time)[1]).T)[
            ship.hull.triangles
        ]
        for ship in scene.ships
    ]
    assert find_nearest(view, np.concatenate(triangles)).depth[int(y), int(x)] > depth - 45.0


@pytest.mark.parametrize("index", range(4))
def test_an_effect_is_a_function_of_time_alone(scene: Scene, index: int) -> None:
    """Nothing before it begins, the same at the same time in whatever order, nothing long after."""
    effect = scene.effects[index]
    assert len(make_puffs(effect, effect.time - 0.01).radius) == 0
    late = make_puffs(effect, effect.time + 0.9)
    assert len(make_puffs(effect, effect.time + 0.3).radius) > 0
    again = make_puffs(effect, effect.time + 0.9)
    np.testing.assert_array_equal(late.offset, again.offset)
    assert len(make_puffs(effect, effect.time + effect.duration + 60.0).radius) == 0
    assert np.ptp(late.colour) <= 1.0
    assert late.opacity.min() >= 0.0
    assert np.linalg.norm(late.offset, axis=1).max() < 20.0 * effect.size


def test_smoke_rises_and_debris_falls(scene: Scene) -> None:
    kinds = {effect.kind: effect for effect in scene.effects}
    smoke = make_puffs(kinds["smoke"], kinds["smoke"].time + 6.0)
    assert smoke.offset[:, 2].mean() < -10.0
    debris = [make_puffs(kinds["debris"], kinds["debris"].time + age).offset[:, 2].mean() for age in (0.5, 1.5, 3.0)]
    assert debris[0] < 0.0 < debris[2]


def test_a_frame_shows_the_explosion_where_the_ships_touch(scene: Scene) -> None:
    """The same frame with and without effects: what differs is round the projected contact point."""
    time, bare = scene.effects[0].time + 0.6, replace(scene, effects=())
    with_fire, without = (Film(s, 160, 90).draw(time).astype(int) for s in (scene, bare))
    changed = np.abs(with_fire - without).max(axis=2) > 25
    eye, target = place_camera(scene).at(time)
    x, y, _ = Eye(eye, target, ANGLE, 160, 90).project(scene.events[0].point)
    rows, columns = np.nonzero(changed)
    assert 20 < changed.sum() < 1500
    assert np.hypot(columns - x, rows - y).max() < 30.0
    red, green, blue = with_fire[changed].mean(axis=0)
    assert red > green > blue


def test_a_scratch_is_seen_once_it_is_there_and_not_through_the_hull(scene: Scene) -> None:
    """On the target's starboard side, which the camera sees: seen after, not before, and not from the other side."""
    bare = replace(scene, effects=())
    colour = np.array(convert_to_display(find_paint("scratch").colour)) * 255

    def painted(film: Film, time: float) -> int:
        return int((np.abs(film.draw(time) - colour).max(axis=2) < 40).sum())

    film = Film(bare, 960, 540)
    assert painted(film, min(scratch.times[0] for scratch in scene.scratches) - 0.1) == 0
    assert painted(film, scene.end) > 5
    away = Film(bare, 960, 540)
    object.__setattr__(away._camera, "direction", away._camera.direction * [-1, -1, 1])
    assert painted(away, scene.end) == 0


def test_a_film_with_a_fixed_camera_keeps_what_does_not_move(scene: Scene) -> None:
    film = Film(scene, 160, 90, fixed=scene.effects[0].time)
    first, last = film.draw(scene.start), film.draw(scene.end)
    np.testing.assert_array_equal(first[-15:, :60], last[-15:, :60])  # the sea in a corner
    assert np.abs(first.astype(int) - last).max() > 60
