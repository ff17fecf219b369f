"""A finished run in memory: its tables and events, written into a folder, shown in a notebook or as data frames."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy.typing as npt

from ..files import write_files
from ..results.run_text import csv_parts, json_text
from .run_frames import RunFrames, data_frames
from .run_page import RunPage, run_page
from .run_repr import run_html, run_text

__all__ = ["RUN_FILES", "Run"]

RUN_FILES = (
    "states.csv", "contacts.csv", "events.json", "summary.json", "signals.csv", "bodies.json", "timing.json",
    "machinery.csv", "surroundings.csv",
)  # fmt: skip
"""Files of a run in its folder."""


@dataclass(frozen=True, repr=False)
class Run:
    """A finished run.

    states, contacts    NumPy structured arrays; the columns are those of states.csv and contacts.csv
    events, summary     contents of events.json and summary.json
    signals             structured array, that of signals.csv: clearance and dissipated energy over time
    machinery           structured array, that of machinery.csv: rudder and revolutions of ships that sail
    surroundings        structured array, that of surroundings.csv: current and wind from the times at which they change
    bodies              contents of bodies.json: hulls, inertias and obstacles
    timing              what differs between runs of the same scenario: mode, wall time [s], real-time factor
    """

    states: npt.NDArray[Any]
    contacts: npt.NDArray[Any]
    events: dict[str, Any]
    summary: dict[str, Any]
    signals: npt.NDArray[Any]
    machinery: npt.NDArray[Any]
    surroundings: npt.NDArray[Any]
    bodies: dict[str, Any]
    timing: dict[str, Any] = field(compare=False)

    def write(self, out: str | Path) -> None:
        """Write the run's files into the folder `out`, all or none. Raises HostError.

        Everything but timing.json is the same, to the byte, for the same scenario and software.
        """
        texts = (
            csv_parts(self.states), csv_parts(self.contacts), json_text(self.events), json_text(self.summary),
            csv_parts(self.signals), json_text(self.bodies), json_text(self.timing),
            csv_parts(self.machinery), csv_parts(self.surroundings),
        )  # fmt: skip
        write_files(Path(out), dict(zip(RUN_FILES, texts, strict=True)))

    def to_pandas(self) -> RunFrames:
        """The tables as pandas DataFrames: `states` and `signals` by time [s], `contacts` by row.

        Raises HostError, with the command that installs it, when pandas is missing.
        """
        return data_frames(self.states, self.contacts, self.signals)

    def page(self, height: int = 640) -> RunPage:
        """The replay page for a notebook, in a frame `height` pixels high; it needs no network.

        Raises HostError when the package was installed without the page's bundle.
        """
        return run_page(self.write, height)

    def __repr__(self) -> str:
        return run_text(self.summary, self.events, self.timing)

    def _repr_html_(self) -> str:
        return run_html(self.summary, self.events, self.timing)
