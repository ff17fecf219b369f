"""The folder of a finished live run: the ordinary files of a run, scenario.toml, and replay.html."""

from __future__ import annotations

from pathlib import Path

from ...errors import ShipCollisionError
from ...files import write_files
from ...show.page import write_page
from .live_run import LiveRun

__all__ = ["SCENARIO", "write_run"]

SCENARIO = "scenario.toml"


def write_run(run: LiveRun, out: Path) -> list[str]:
    """Write the files of a run into the folder `out`; lines on what could not be written, such as the page.

    Raises HostError when the folder cannot be written.
    """
    run.finish().write(out)
    write_files(out, {SCENARIO: run.write_scenario()})
    try:
        write_page(out)
    except ShipCollisionError as error:
        return [f"no page: {error}"]
    return []
