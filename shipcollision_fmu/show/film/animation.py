"""The film of a run as GIF or MP4, and a still as PNG, drawn by NumPy alone without a GPU or a display.

The film shows the first contact in real time, from BEFORE until AFTER it. Without a contact it shows the whole run,
faster where the run is longer than the film. picture.py draws the pictures. Pillow, an optional extra, adds time and
names and writes GIF and PNG; FFmpeg from imageio-ffmpeg writes the MP4. The same run gives the same GIF.
"""

from __future__ import annotations

import io
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ...errors import InputError
from ...files import IN_PLACE, write_file
from ..extras import require
from ..scene.palette import choose_topsides, convert_to_display
from ..scene.scene import Scene
from .film import Film

if TYPE_CHECKING:
    from PIL import Image

__all__ = ["choose_frame_times", "make_gif", "make_mp4", "make_still", "write_gif", "write_mp4", "write_still"]

Pixels = npt.NDArray[np.uint8]
Progress = Callable[[int, int], None]

SIZE = (640, 360)
"""Width and height of the film [pixels]; the GIF's size grows with their product."""
STILL_SIZE = (1280, 720)
RATE = 10.0
"""Pictures per second. GIF counts in hundredths of a second, so 100 must be a multiple of it."""
BEFORE, AFTER = 2.0, 10.0
"""Time shown before and after the first contact [s]."""
COLOURS = 240
"""Colours of the palette, chosen from PALETTE_FRAMES pictures and shared by all; own palettes would flicker."""
PALETTE_FRAMES = 12


def write_gif(scene: Scene, folder: Path, progress: Progress | None = None) -> Path:
    """Write impact.gif into a folder; returns its path. Raises HostError, also without Pillow."""
    require("film", "a GIF")
    return write_file(folder / "impact.gif", make_gif(scene, progress=progress), IN_PLACE)


def write_mp4(scene: Scene, folder: Path, progress: Progress | None = None) -> Path:
    """Write impact.mp4 into a folder; returns its path. Raises HostError, also without Pillow or imageio-ffmpeg."""
    require("mp4", "an MP4")
    return write_file(folder / "impact.mp4", make_mp4(scene, progress=progress), IN_PLACE)


def write_still(scene: Scene, folder: Path, time: float) -> Path:
    """Write still.png, the picture at `time` [s], into a folder; returns its path.

    Raises InputError for a time outside the run, HostError, also without Pillow.
    """
    require("film", "a still")
    return write_file(folder / "still.png", make_still(scene, time), IN_PLACE)


def choose_frame_times(scene: Scene) -> npt.NDArray[np.float64]:
    """Times of the film's pictures [s], 1 / RATE apart in the film."""
    first = min((scratch.times[0] for scratch in scene.scratches), default=None)
    if first is None:
        start, end = scene.start, scene.end
    else:
        start, end = max(scene.start, first - BEFORE), min(scene.end, first + AFTER)
    count = int(min(end - start, BEFORE + AFTER) * RATE) + 1
    return np.linspace(start, end, max(count, 2))


def make_gif(scene: Scene, size: tuple[int, int] = SIZE, progress: Progress | None = None) -> bytes:
    """The film as a GIF that repeats, of `size` (width, height) [pixels]."""
    from PIL import Image

    images = list(_draw_images(scene, size, progress))
    palette = _choose_palette(images)
    indexed = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    data = io.BytesIO()
    durations = [round(1000 / RATE)] * (len(indexed) - 1) + [1500]
    indexed[0].save(
        data, "GIF", save_all=True, append_images=indexed[1:], duration=durations, loop=0, optimize=True, disposal=1
    )
    return data.getvalue()


def make_mp4(scene: Scene, size: tuple[int, int] = SIZE, progress: Progress | None = None) -> bytes:
    """The film as MP4 (H.264, 4:2:0), of `size` (width, height), both even [pixels]."""
    import imageio_ffmpeg

    with tempfile.TemporaryDirectory(prefix="shipcollision-") as folder:
        path = Path(folder, "impact.mp4")
        writer = imageio_ffmpeg.write_frames(
            str(path), size, fps=RATE, codec="libx264", quality=7, macro_block_size=2, ffmpeg_log_level="error"
        )
        writer.send(None)
        try:
            for image in _draw_images(scene, size, progress):
                writer.send(np.ascontiguousarray(image))
        finally:
            writer.close()
        return path.read_bytes()


def make_still(scene: Scene, time: float, size: tuple[int, int] = STILL_SIZE) -> bytes:
    """The picture at `time` [s] as PNG. Raises InputError for a time outside the run."""
    if not scene.start <= time <= scene.end:
        raise InputError(f"time {time:g} s is not in the run: give one from {scene.start:g} to {scene.end:g} s")
    from PIL import Image

    data = io.BytesIO()
    image = _add_caption(Film(scene, *size).draw(time), scene, time)
    image.quantize(palette=_choose_palette([image]), dither=Image.Dither.NONE).save(data, "PNG", optimize=True)
    return data.getvalue()


def _draw_images(scene: Scene, size: tuple[int, int], progress: Progress | None) -> Iterator[Image.Image]:
    first = min((float(scratch.times[0]) for scratch in scene.scratches), default=None)
    film, times = Film(scene, *size, fixed=first), choose_frame_times(scene)
    for i, time in enumerate(times):
        yield _add_caption(film.draw(float(time)), scene, float(time))
        if progress is not None:
            progress(i + 1, len(times))


def _choose_palette(images: list[Image.Image]) -> Image.Image:
    """An image with a palette for the whole film.

    Only the middle of the pictures counts, where the contact is, except in the last: the sea would take nearly all
    colours.
    """
    from PIL import Image

    chosen = [images[i] for i in np.unique(np.linspace(0, len(images) - 1, PALETTE_FRAMES).round().astype(int))]
    width, height = chosen[0].size
    middle = (width // 3, height // 4, width - width // 3, height - height // 4)
    pieces = [*(image.crop(middle) for image in chosen), chosen[-1]]
    sheet = Image.new("RGB", (width, sum(piece.height for piece in pieces)))
    y = 0
    for piece in pieces:
        sheet.paste(piece.resize((width, piece.height), Image.Resampling.NEAREST), (0, y))
        y += piece.height
    return _quantise(sheet, COLOURS)


def _quantise(image: Image.Image, colours: int) -> Image.Image:
    """The image with its own palette: median cut, then each colour moved to the mean of its pixels (k-means)."""
    from PIL import Image

    return image.quantize(colours, method=Image.Quantize.MEDIANCUT, kmeans=4, dither=Image.Dither.NONE)


def _add_caption(pixels: Pixels, scene: Scene, time: float) -> Image.Image:
    """The picture with the time and the ships' names, each beside its colour."""
    from PIL import Image, ImageDraw, ImageFont

    image = Image.fromarray(pixels)
    draw = ImageDraw.Draw(image)
    unit = image.height / 360
    font: Any = ImageFont.load_default(12 * unit)
    x, y = 10 * unit, 8 * unit
    _draw_text(draw, (x, y), f"t = {time:.2f} s", font)
    for i, ship in enumerate(scene.ships[:6]):
        y += 18 * unit
        colour = tuple(round(255 * part) for part in convert_to_display(choose_topsides(i).colour))
        draw.rectangle((x, y + 3 * unit, x + 10 * unit, y + 12 * unit), fill=colour, outline="white")
        _draw_text(draw, (x + 16 * unit, y), _shorten_name(ship.name), font)
    return image


def _draw_text(draw: Any, place: tuple[float, float], text: str, font: Any) -> None:
    draw.text(place, text, fill="white", font=font, stroke_width=1, stroke_fill="#10202c")


def _shorten_name(name: str) -> str:
    """A name on one line, of bounded length."""
    plain = "".join(c if c.isprintable() else " " for c in name)
    return plain if len(plain) <= 32 else plain[:31] + "…"
