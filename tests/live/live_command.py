"""The command `shipcollision live` as people start it, in a process of its own."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from subprocess import PIPE, Popen
from urllib.parse import parse_qs, urlsplit

__all__ = ["LiveCommand", "live_command"]


@dataclass(frozen=True)
class LiveCommand:
    """The running command and the addresses of its bridge: of the page, and of the socket."""

    process: Popen[str]
    page: str
    socket: str


@contextmanager
def live_command(folder: Path, *options: str) -> Iterator[LiveCommand]:
    """`kvlcc2_crossing` on a free port; its run and its last words (`errors.txt`) are in `folder`."""
    command = [
        *(sys.executable, "-m", "shipcollision_fmu", "live", "kvlcc2_crossing", "--no-browser", "--port", "0"),
        *("--out", str(folder / "run"), *options),
    ]
    with (folder / "errors.txt").open("w") as errors, Popen(command, stdout=PIPE, stderr=errors, text=True) as process:
        try:
            assert process.stdout is not None
            said = iter(process.stdout.readline, "")
            page = next(line.split(": ")[1].strip() for line in said if line.startswith("bridge of own: "))
            bridge = urlsplit(page)
            token = parse_qs(bridge.query)["token"][0]
            yield LiveCommand(process, page, f"ws://{bridge.netloc}/ws?token={token}&role=bridge")
        finally:
            process.kill()
