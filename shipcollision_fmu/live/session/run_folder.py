"""The folder of a finished live run: the ordinary files of a run, scenario.toml with its ships and recordings, and
replay.html. It needs no file elsewhere, so that it may be moved."""

from __future__ import annotations

from pathlib import Path

from ...errors import ShipCollisionError
from ...files import write_files
from ...show import outputs
from ...show.page import write_page
from .live_run import LiveRun

__all__ = ["SCENARIO", "write_run"]

SCENARIO = "scenario.toml"
LARGEST_PAGE = 200_000
"""Steps of a run that gets its page at once: 2.8 h at 0.05 s. The page is made in memory, some 10 kB a step."""


def write_run(run: LiveRun, out: Path) -> list[str]:
    """Write the files of a run into the folder `out`; lines on what could not be written, such as the page.

    Pages and pictures of an older run there go first: they must not stand for this one. Raises HostError or OSError
    when the folder cannot be written.
    """
    outputs.remove(out)
    run.inputs.write(out)
    finished = run.finish(out)
    finished.write(out)
    write_files(out, {SCENARIO: run.write_scenario()})
    if len(finished.states) > LARGEST_PAGE:
        return [f"no page of {len(finished.states)} steps: `shipcollision show {out}` makes one, which takes memory"]
    try:
        write_page(out)
    except ShipCollisionError as error:
        return [f"no page: {error}"]
    return []
