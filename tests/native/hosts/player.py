"""Platforms that can be run here, Windows under Wine and ARM under QEMU, and play.c for each."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from urllib.parse import quote

import pytest

from shipcollision_fmu.toolchain.sources import find_fmi_headers
from tests.compiler import compile_c, compile_for_windows
from tests.native.hosts.script import Script

__all__ = ["PLATFORMS", "ROOT", "TARGETS", "Play", "Player", "Wine"]

TARGETS = {"linux64": "x86_64-linux-gnu.2.17", "win64": "x86_64-windows-gnu", "aarch64-linux": "aarch64-linux-gnu.2.17"}
PLATFORMS = [
    "linux64", pytest.param("win64", marks=pytest.mark.needs("wine")),
    pytest.param("aarch64-linux", marks=pytest.mark.needs("qemu-aarch64")),
]  # fmt: skip
"""TARGETS, as values of a parameter."""
FOLDERS = {
    2: {"linux64": "linux64", "win64": "win64", "aarch64-linux": "aarch64-linux"},
    3: {"linux64": "x86_64-linux", "win64": "x86_64-windows", "aarch64-linux": "aarch64-linux"},
}
"""Below binaries/, by version of FMI."""
ROOT = "/usr/aarch64-linux-gnu"
"""Where Debian puts the C library of ARM for QEMU."""

Play = Callable[[str, Path, Script], list[str]]
"""Lines that play.c prints, by platform, folder of an unpacked FMU, and script."""
Wine = Callable[[], dict[str, str]]
"""The environment of Wine."""


class Player:
    """play.c, compiled once for each platform. home: folder of the programs."""

    def __init__(self, home: Path, wine: Wine) -> None:
        self._home, self._wine = home, wine
        self._programs: dict[str, Path] = {}

    def play(self, platform: str, unpacked: Path, script: Script) -> list[str]:
        """What the program prints; it may log nothing but events."""
        (library,) = (unpacked / "binaries" / FOLDERS[script.fmi][platform]).glob("*.[ds]*")
        command, environment, drive = [str(self._find_program(platform))], dict[str, str](), ""
        if platform == "win64":
            command, environment, drive = ["wine", *command], self._wine(), "Z:"
        if platform == "aarch64-linux":
            command = [str(shutil.which("qemu-aarch64")), "-L", ROOT, *command]
        resources = f"{unpacked}/resources"
        location = f"file:///{drive}{quote(resources)}" if script.fmi == 2 else f"{drive}{resources}/"
        done = subprocess.run(
            [*command, str(script.fmi), f"{drive}{library}", script.token, location.replace("file:////", "file:///")],
            input=script.text.encode(), capture_output=True, check=False, timeout=600, env=environment,
        )  # fmt: skip
        logged = [line for line in done.stderr.decode().splitlines() if "logEvents]" not in line]
        assert (done.returncode, logged) == (0, []), done.stderr
        return done.stdout.decode().splitlines()

    def _find_program(self, platform: str) -> Path:
        if platform not in self._programs:
            include, source = f"-I{find_fmi_headers()}", Path(__file__).with_name("play.c")
            if platform == "win64":
                self._programs[platform] = self._home / "win64.exe"
                compile_for_windows(self._programs[platform], source, flags=[include])
            else:
                self._programs[platform] = self._home / platform
                compile_c("-O1", include, "-o", self._programs[platform], source, target=TARGETS[platform])
        return self._programs[platform]
