"""Debian's stock osgviewer plays the scene: no complaint, and before, during and after the impact the right picture.

osgviewer runs by the clock, and a busy machine is late. So pictures are compared only where the clock does not matter:
before the ships start to move, which is put off for that, and after the run's end, when they stay where they are. In
between it is enough that fire is seen at some time where the ships touch. Each is waited for until it is as wanted, as
a picture may be taken while it is drawn. What should be seen comes from our own depth buffer (raster.py).
"""

from __future__ import annotations

import shlex
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.ship.frames import rotation_from_quaternion
from shipcollision_fmu.show.film.raster import Eye, find_nearest
from shipcollision_fmu.show.osg import osg, zup
from shipcollision_fmu.show.osg.osg import build_osg_files, format_viewer_command, write_osg
from shipcollision_fmu.show.scene.palette import convert_to_display, find_paint
from shipcollision_fmu.show.scene.parts import list_ship_parts
from shipcollision_fmu.show.scene.scene import Scene, Ship, load_scene

from .screen import SIZE, Screen, screen

pytestmark = [pytest.mark.slow, pytest.mark.needs("osgviewer")]

ANGLE = float(np.degrees(2.0 * np.arctan(0.26)))
"""Vertical angle that osgviewer sees: OSG takes a screen 0.26 m high, 0.5 m away."""
PATIENCE = 300.0
"""What a busy machine may take for a run of some seconds [s]."""
LYING_STILL = 12.0
"""First contact after the window opens [s]: a busy machine must see the ships before they move."""


@contextmanager
def viewer(scene: Scene, folder: Path) -> Iterator[tuple[Screen, list[str]]]:
    """osgviewer on a screen, started by the very line that is printed; afterwards the list holds what it said."""
    write_osg(scene, folder)
    width, height = SIZE
    line = format_viewer_command(folder).replace("--window 80 80 1280 720", f"--window 0 0 {width} {height}")
    setting, *command = shlex.split(line)
    said: list[str] = []
    (folder / "screen").mkdir()
    with screen(folder / "screen") as shown:
        name, value = setting.split("=")
        program = subprocess.Popen(
            command, env={**shown.environment, name: value}, cwd="/", text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
        try:
            yield shown, said
        finally:
            program.terminate()
            said += [line for line in program.communicate(timeout=PATIENCE)[0].splitlines() if line.strip()]


def wait(shown: Screen, wanted: Callable[[np.ndarray], bool]) -> np.ndarray:
    """The first picture that is as wanted, or the last one there is patience for."""
    end = time.monotonic() + PATIENCE
    while not wanted(pixels := shown.pixels()) and time.monotonic() < end:
        time.sleep(0.1)
    return pixels


def eye_at(folder: Path, time_there: float) -> Eye:
    """The camera of camera.path."""
    rows = np.loadtxt(folder / "camera.path")
    position = np.array([np.interp(time_there, rows[:, 0], rows[:, k]) for k in (1, 2, 3)])
    turn = rotation_from_quaternion(rows[0, 4:])  # the camera does not turn
    assert np.ptp(rows[:, 4:], axis=0).max() < 1e-6
    return Eye(zup.convert_vectors(position), zup.convert_vectors(position + turn @ [0.0, 0.0, -1.0]), ANGLE, *SIZE)


def placed(ship: Ship, time: float, points: np.ndarray) -> np.ndarray:
    """Points of a ship's b in n."""
    position, quaternion = ship.track.at(time)
    return position + points @ rotation_from_quaternion(quaternion).T


def expected(scene: Scene, eye: Eye, time: float, paint: str) -> np.ndarray:
    """Pixels in which that paint should be seen, under water too."""
    surfaces, wanted = [], []
    for index, ship in enumerate(scene.ships):
        for part, surface in list_ship_parts(ship, index):
            surfaces.append(placed(ship, time, surface.vertices)[surface.triangles])
            wanted.append(np.full(len(surface.triangles), part.name == paint))
    seen = find_nearest(eye, np.concatenate(surfaces))
    return np.concatenate([*wanted, [False]])[seen.triangle]


def agreement(a: np.ndarray, b: np.ndarray) -> float:
    """What two sets of pixels have in common, over all of both."""
    return float((a & b).sum() / max((a | b).sum(), 1))


def red(pixels: np.ndarray) -> np.ndarray:
    """The target's topsides, in any light; its bottom, its hatches and fire are browner."""
    r, g, b = np.moveaxis(pixels.astype(int), 2, 0)
    return (r > 100) & (r > 4 * g) & (g < b + 20)


def blue(pixels: np.ndarray) -> np.ndarray:
    """The own ship's topsides; the sea is greener."""
    r, g, b = np.moveaxis(pixels.astype(int), 2, 0)
    return (b > 100) & (2 * b > 3.3 * g) & (b > 2.6 * r)


def fire(pixels: np.ndarray, before: np.ndarray) -> np.ndarray:
    """Yellow and orange flames, where there was another colour before."""
    r, g, b = np.moveaxis(pixels.astype(int), 2, 0)
    changed = np.abs(pixels.astype(int) - before).max(axis=2) > 40
    return changed & (r > 190) & (g > 95) & (b < 110) & (r > g + 20)


def around(eye: Eye, point: np.ndarray, radius: float) -> np.ndarray:
    """Pixels within so many pixels of where a point of n is seen."""
    x, y, _ = eye.project(point)
    columns, rows = np.meshgrid(np.arange(eye.width), np.arange(eye.height))
    return np.hypot(columns + 0.5 - x, rows + 0.5 - y) < radius


def test_the_impact_is_seen(guan2014: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Before: two ships. During: fire where they touch. Nothing is complained of. The decks are bare: some containers
    have the colour of fire."""
    scene = load_scene(guan2014)
    scene = replace(scene, ships=tuple(replace(ship, fittings=()) for ship in scene.ships))
    monkeypatch.setattr(osg, "FIRST_CONTACT", LYING_STILL)
    with viewer(scene, tmp_path) as (shown, said):
        eye = eye_at(tmp_path, 0.0)
        reds, blues = (expected(scene, eye, scene.start, f"topsides {k}") for k in (1, 0))
        place = around(eye, scene.events[0].point, 45.0)

        def lying_still(pixels: np.ndarray) -> bool:
            return agreement(red(pixels), reds) > 0.9 and agreement(blue(pixels), blues) > 0.85

        before = wait(shown, lying_still)
        assert lying_still(before)

        def burning(pixels: np.ndarray) -> bool:
            flames = fire(pixels, before)
            return bool(150 < (flames & place).sum() > 2 * (flames & ~place).sum())

        assert burning(wait(shown, burning))
    assert said == []


def painted(pixels: np.ndarray, name: str) -> np.ndarray:
    """Middles (k, 2) of the pixels in a paint that no light changes."""
    paint = np.array(convert_to_display(find_paint(name).colour)) * 255
    rows, columns = np.nonzero(np.abs(pixels.astype(int) - paint).max(axis=2) <= 3)
    return np.column_stack([columns, rows]) + 0.5


def find_least(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Distance (k,) of each point of `a` to the nearest of `b`; none is near where there are none."""
    return np.linalg.norm(a[:, None, :2] - b[:, :2], axis=2).min(axis=1, initial=np.inf)


def test_the_end_is_seen(guan2014: Path, tmp_path: Path) -> None:
    """After: the ships where the run ends, and what the bow leaves to be seen of the scratch, there and nowhere else.
    Without effects, which would hide it."""
    scene = replace(load_scene(guan2014), effects=())
    scratch = next(scratch for scratch in scene.scratches if scratch.ship == "target")
    with viewer(scene, tmp_path) as (shown, said):
        eye = eye_at(tmp_path, scene.end + build_osg_files(scene).delay)
        reds, blues = (expected(scene, eye, scene.end, f"topsides {k}") for k in (1, 0))
        line = eye.project(placed(scene.ship("target"), scene.end, scratch.points))

        def ended(pixels: np.ndarray) -> bool:
            in_place = agreement(red(pixels), reds) > 0.93 and agreement(blue(pixels), blues) > 0.85
            scratched = painted(pixels, "scratch")
            return in_place and len(scratched) > 0 and bool(find_least(scratched, line).max() < 6.0)

        assert ended(wait(shown, ended))
    assert said == []
    there = expected(scene, eye_at(tmp_path, 0.0), scene.start, "topsides 1")
    assert agreement(there, reds) < 0.8  # before the run the same picture would not do


def test_the_whole_scratch_is_seen_without_the_ship_that_made_it(guan2014: Path, tmp_path: Path) -> None:
    """Every point of its line, once the run is over, and none elsewhere."""
    whole = load_scene(guan2014)
    scratch = next(scratch for scratch in whole.scratches if scratch.ship == "target")
    scene = replace(whole, ships=(whole.ship("target"),), scratches=(scratch,), events=(), effects=())
    with viewer(scene, tmp_path) as (shown, said):
        eye = eye_at(tmp_path, scene.end + build_osg_files(scene).delay)
        line = eye.project(placed(scene.ship("target"), scene.end, scratch.points))

        def ended(pixels: np.ndarray) -> bool:
            scratched = painted(pixels, "scratch")
            return bool(find_least(line, scratched).max() < 2.0 and find_least(scratched, line).max() < 6.0)

        assert ended(wait(shown, ended))
    assert said == []


def test_osgconv_reads_it_and_makes_a_binary_scene(kvlcc2_crossing: Path, tmp_path: Path) -> None:
    """The other run, with a growing line of 200 steps."""
    write_osg(load_scene(kvlcc2_crossing), tmp_path)
    done = subprocess.run(
        ["osgconv", str(tmp_path / "scene.osgt"), str(tmp_path / "scene.osgb")], check=True, text=True,
        capture_output=True, cwd="/", env={"OSG_FILE_PATH": str(tmp_path), "PATH": "/usr/bin:/bin"},
    )  # fmt: skip
    assert done.stderr == ""
    assert done.stdout.replace(str(tmp_path), "").splitlines() == ["Data written to '/scene.osgb'."]
    assert (tmp_path / "scene.osgb").stat().st_size > 50_000


def test_osgconv_notices_what_is_wrong(guan2014: Path, tmp_path: Path) -> None:
    """That silence means something: with one word of the file spoiled OSG does complain."""
    write_osg(load_scene(guan2014), tmp_path)
    text = (tmp_path / "scene.osgt").read_text()
    (tmp_path / "spoiled.osgt").write_text(text.replace("osg::AnimationPath {", "osg::AnimationPad {", 1))
    done = subprocess.run(
        ["osgconv", str(tmp_path / "spoiled.osgt"), str(tmp_path / "scene.osgb")], check=False, text=True,
        capture_output=True, cwd="/", env={"OSG_FILE_PATH": str(tmp_path), "PATH": "/usr/bin:/bin"},
    )  # fmt: skip
    assert "AnimationPad" in done.stderr + done.stdout
