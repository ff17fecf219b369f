"""Film and still: files that others can read, the same each time."""

from __future__ import annotations

import io
import subprocess
from pathlib import Path

import imageio_ffmpeg
import numpy as np
import pytest
from PIL import Image

from shipcollision_fmu.errors import InputError
from shipcollision_fmu.show.film import animation
from shipcollision_fmu.show.film.animation import choose_frame_times, make_gif, make_still, write_mp4
from shipcollision_fmu.show.scene.scene import Scene, load_scene
from tests.show.conftest import MakeRun
from tests.show.foreign import with_many_collisions, with_names

SMALL = (96, 54)


@pytest.fixture(scope="module")
def scene(guan2014: Path) -> Scene:
    return load_scene(guan2014)


@pytest.mark.slow
def test_the_film_is_of_the_first_contact(scene: Scene, kvlcc2_crossing: Path) -> None:
    times = choose_frame_times(load_scene(kvlcc2_crossing))
    assert times[0] == pytest.approx(25.05 - 2.0)
    assert times[-1] == pytest.approx(25.05 + 10.0)
    np.testing.assert_allclose(np.diff(times), 0.1, atol=1e-3)  # in real time
    assert choose_frame_times(scene)[[0, -1]].tolist() == [0.0, 6.0]  # a run of six seconds has no more


def test_gif(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(animation, "RATE", 2.5)
    data = make_gif(scene, SMALL)
    film = Image.open(io.BytesIO(data))
    assert isinstance(film, Image.Image)
    count = len(choose_frame_times(scene))
    assert (film.format, film.size, film.n_frames) == ("GIF", SMALL, count)  # type: ignore[attr-defined]  # of a GIF
    assert film.info["duration"] == 400
    assert film.info["loop"] == 0
    first = np.asarray(film.convert("RGB")).astype(int)
    film.seek(count // 4)
    assert np.abs(np.asarray(film.convert("RGB")) - first).max() > 80
    assert data == make_gif(scene, SMALL)


def test_mp4(scene: Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(animation, "RATE", 2.5)
    monkeypatch.setattr(animation.make_mp4, "__defaults__", (SMALL, None))
    path = write_mp4(scene, tmp_path)
    assert imageio_ffmpeg.count_frames_and_secs(path)[0] == len(choose_frame_times(scene))
    command = [imageio_ffmpeg.get_ffmpeg_exe(), "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    pixels = subprocess.run(command, check=True, capture_output=True).stdout
    frames = np.frombuffer(pixels, np.uint8).reshape(-1, SMALL[1], SMALL[0], 3).astype(int)
    assert np.abs(frames[0] - frames[3]).max() > 80
    assert [p.name for p in tmp_path.iterdir()] == ["impact.mp4"]


def test_still(scene: Scene) -> None:
    image = Image.open(io.BytesIO(make_still(scene, 1.0, SMALL)))
    assert (image.format, image.size) == ("PNG", SMALL)


@pytest.mark.parametrize("time", [-0.1, 6.1, float("nan")])
def test_a_still_of_no_time_of_the_run_is_refused(scene: Scene, time: float) -> None:
    with pytest.raises(InputError, match=f"time {time:g} s is not in the run: give one from 0 to 6 s"):
        make_still(scene, time)


def test_no_contact_is_a_film_of_the_whole_run(meeting: MakeRun) -> None:
    scene = load_scene(meeting(("speed = 4.0", "speed = 0.5")))
    assert choose_frame_times(scene)[[0, -1]].tolist() == [0.0, 3.0]
    assert make_still(scene, 3.0, SMALL)


@pytest.mark.slow
def test_hundred_collisions_and_odd_names(guan2014: Path, tmp_path: Path) -> None:
    names = {"own": "<script>alert(1)</script>", "target": "船\x1b[31m" + 60 * "x"}
    many = with_many_collisions(guan2014, tmp_path / "many", 100)
    scene = load_scene(with_names(many, tmp_path / "named", names))
    assert make_still(scene, 5.9, SMALL)


@pytest.mark.slow
def test_the_picture_of_the_guide_is_the_still_that_its_command_makes(scene: Scene) -> None:
    """docs/images/guan2014.png, by `shipcollision show runs/guan2014 --still 1.4`; other versions of numpy and Pillow
    may round otherwise."""
    path = Path(__file__).parents[3] / "docs" / "images" / "guan2014.png"
    assert path.stat().st_size < 300_000
    there = np.asarray(Image.open(path).convert("RGB")).astype(int)
    made = np.asarray(Image.open(io.BytesIO(make_still(scene, 1.4))).convert("RGB")).astype(int)
    assert there.shape == made.shape == (720, 1280, 3)
    assert np.abs(there - made).mean() < 2.0
