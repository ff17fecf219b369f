"""Hosts of native FMUs: play.c for each platform, and Windows for those of Windows, which is Wine's."""

from __future__ import annotations

import os
import subprocess

import pytest

from tests.native.hosts.player import Play, Player, Wine


@pytest.fixture(scope="session")
def wine(tmp_path_factory: pytest.TempPathFactory) -> Wine:
    """The environment of Wine, with a Windows of its own, which takes a moment to make."""
    home = tmp_path_factory.mktemp("wine")
    made = {"WINEPREFIX": str(home / "wine"), "WINEDEBUG": "-all", "PATH": os.environ["PATH"], "HOME": str(home),
            "LC_ALL": "C.UTF-8"}  # fmt: skip

    def begin() -> dict[str, str]:
        if not (home / "wine").exists():  # it says so when it makes one
            subprocess.run(["wine", "wineboot", "--init"], env=made, capture_output=True, check=True, timeout=600)
        return made

    return begin


@pytest.fixture(scope="session")
def play(wine: Wine, tmp_path_factory: pytest.TempPathFactory) -> Play:
    """Plays scripts on an unpacked FMU."""
    return Player(tmp_path_factory.mktemp("host"), wine).play
