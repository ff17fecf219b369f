"""Windows for programs that hosts of native FMUs are: Wine's."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable

import pytest


@pytest.fixture(scope="session")
def wine(tmp_path_factory: pytest.TempPathFactory) -> Callable[[], dict[str, str]]:
    """The environment of Wine, with a Windows of its own, which takes a moment to make."""
    home = tmp_path_factory.mktemp("wine")
    made = {"WINEPREFIX": str(home / "wine"), "WINEDEBUG": "-all", "PATH": os.environ["PATH"], "HOME": str(home),
            "LC_ALL": "C.UTF-8"}  # fmt: skip

    def begin() -> dict[str, str]:
        if not (home / "wine").exists():  # it says so when it makes one
            subprocess.run(["wine", "wineboot", "--init"], env=made, capture_output=True, check=True, timeout=600)
        return made

    return begin
