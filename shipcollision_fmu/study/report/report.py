"""write_report(): the page and the figures of a study, in its folder."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Collection, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...errors import StudyError
from ...files import IN_PLACE, write_file, write_files
from ...show.extras import require
from ..extra import import_pyarrow

if TYPE_CHECKING:
    from .replays import Replay

__all__ = ["FIGURES", "REPORT", "replay_row", "write_report"]

REPORT, FIGURES = "report.html", "figures"
CHART_NAMES, KINDS = ("exceedance_*", "energy_by_*", "convergence", "sensitivity"), ("png", "svg", "csv")
"""Names and suffixes of all figures that a report can have."""


def write_report(
    folder: Path, *, replays: bool = True, progress: Callable[[int, int], None] | None = None,
    notify: Callable[[str], None] | None = None,
) -> Path:  # fmt: skip
    """The path of report.html, written into the folder of a study with figures/ beside it.

    replays: whether the worst cases are run again, each with a page in replays/; progress: called with the number of
    replays that are done and that of all; notify: called with lines for the user.

    Raises StudyError for a folder that cannot be shown, HostError without pyarrow or Matplotlib, and where nothing can
    be written. A replay that cannot be made is a line.
    """
    require("plots", "the report of a study")
    import_pyarrow()
    from .charts import make_charts
    from .figures import save_figure
    from .page import PageFigure, build_page
    from .replays import read_own_study, write_replays
    from .ship_names import name_ships
    from .study_table import StudyTable
    from .worst import find_worst

    table, files = StudyTable(folder), dict[str, bytes]()
    figures: list[PageFigure] = []
    for chart in make_charts(table):
        if chart.data is None:
            figures.append((chart.name, chart.title, chart.caption, None))
            continue
        svg = save_figure(chart.figure, "svg")
        files[f"{chart.name}.svg"], files[f"{chart.name}.png"] = svg, save_figure(chart.figure, "png")
        files[f"{chart.name}.csv"] = _format_csv(chart.data).encode()
        figures.append((chart.name, chart.title, chart.caption, svg))
    study, change = read_own_study(table)
    worst = find_worst(table, {} if study is None else name_ships(study))
    if replays and study is not None:
        write_replays(table, study, [case.row for case in worst], progress, notify)
    elif replays and notify is not None:
        notify(f"no replays: {change}")
    page = build_page(table, figures, worst, change)
    _remove_earlier(folder / FIGURES, files)
    write_files(folder / FIGURES, files, IN_PLACE)
    return write_file(folder / REPORT, page, IN_PLACE)


def replay_row(folder: Path, row: int) -> Replay:
    """The replay of a row, written into the folder of a study. Raises StudyError, HostError."""
    import_pyarrow()
    from .replays import read_own_study, write_replay
    from .study_table import StudyTable

    table = StudyTable(folder)
    study, change = read_own_study(table)
    if study is None:
        raise StudyError(f"{folder}: row {row} cannot be run again: {change}: put back what was there")
    return write_replay(table, study, row)


def _remove_earlier(folder: Path, files: Collection[str]) -> None:
    """Remove figures of an earlier report that this one does not have; files of other origin stay."""
    for pattern in CHART_NAMES:
        for kind in KINDS:
            for path in folder.glob(f"{pattern}.{kind}"):
                if path.name not in files:
                    path.unlink()


def _format_csv(data: dict[str, Iterable[Any]]) -> str:
    """Columns as CSV, numbers with all digits."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(data)
    columns = (values.tolist() if hasattr(values, "tolist") else values for values in data.values())
    writer.writerows(zip(*columns, strict=True))
    return text.getvalue()
