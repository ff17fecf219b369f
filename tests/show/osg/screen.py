"""A screen without hardware: Xvfb, whose pixels are read from the file that it keeps them in (an X window dump)."""

from __future__ import annotations

import os
import struct
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

SIZE = (640, 360)
START = 200.0
"""How long Xvfb may take to come up [s]: a hundred times what it takes on a quiet machine."""


class Screen:
    """A running Xvfb: `display`, and what is on it."""

    def __init__(self, display: str, folder: Path) -> None:
        self.display = display
        self._file = folder / "Xvfb_screen0"

    def pixels(self) -> np.ndarray:
        """(height, width, 3) of red, green, blue. The header of xwd is 25 big-endian words, a name and a colour map."""
        data = self._file.read_bytes()
        header = struct.unpack(">25I", data[:100])
        size, width, height, order, bits, line, colours = (header[i] for i in (0, 4, 5, 7, 11, 12, 19))
        assert (order, bits) == (0, 32)  # blue, green, red, nothing
        rows = np.frombuffer(data, np.uint8, line * height, size + 12 * colours).reshape(height, line)
        return rows[:, : 4 * width].reshape(height, width, 4)[..., 2::-1].copy()

    @property
    def environment(self) -> dict[str, str]:
        """For programs that draw on it, without a GPU."""
        return {**os.environ, "DISPLAY": self.display, "LIBGL_ALWAYS_SOFTWARE": "1"}


@contextmanager
def screen(folder: Path) -> Iterator[Screen]:
    """Xvfb on a display of its own choice, ended afterwards; its files are in `folder`."""
    reading, writing = os.pipe()
    width, height = SIZE
    command = ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{width}x{height}x24", "-fbdir", str(folder)]
    server = subprocess.Popen(
        [*command, "-nolisten", "tcp"], pass_fds=[writing], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    os.close(writing)
    try:
        number = b""
        end = time.monotonic() + START
        os.set_blocking(reading, False)
        while not number.endswith(b"\n"):
            assert server.poll() is None, "Xvfb has ended"
            assert time.monotonic() < end, "Xvfb does not come up"
            time.sleep(0.05)
            try:
                number += os.read(reading, 16)
            except BlockingIOError:
                continue
        yield Screen(f":{number.decode().strip()}", folder)
    finally:
        os.close(reading)
        server.terminate()
        server.wait(timeout=200)
