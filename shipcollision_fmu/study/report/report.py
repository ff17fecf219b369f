"""write_report(): the page and the figures of a study, in its folder."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ...files import IN_PLACE, write_file, write_files
from ...show.extras import require
from ..extra import import_pyarrow

__all__ = ["FIGURES", "REPORT", "write_report"]

REPORT, FIGURES = "report.html", "figures"


def write_report(folder: Path) -> Path:
    """The path of report.html, written into the folder of a study with figures/ beside it.

    Raises StudyError for a folder that cannot be shown, HostError
    without pyarrow or Matplotlib, and where nothing can be written.
    """
    require("plots", "the report of a study")
    import_pyarrow()
    from .charts import make_charts
    from .figures import save_figure
    from .page import build_page
    from .study_table import StudyTable
    from .worst import can_repeat, find_worst

    table, figures, files = StudyTable(folder), [], {}
    for chart in make_charts(table):
        svg = save_figure(chart.figure, "svg")
        files[f"{chart.name}.svg"], files[f"{chart.name}.png"] = svg, save_figure(chart.figure, "png")
        files[f"{chart.name}.csv"] = _format_csv(chart.data).encode()
        figures.append((chart.name, chart.title, chart.caption, svg))
    page = build_page(table, figures, find_worst(table), can_repeat(table))
    write_files(folder / FIGURES, files, IN_PLACE)
    return write_file(folder / REPORT, page, IN_PLACE)


def _format_csv(data: dict[str, Iterable[Any]]) -> str:
    """Columns as CSV, numbers with all digits."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(data)
    columns = (values.tolist() if hasattr(values, "tolist") else values for values in data.values())
    writer.writerows(zip(*columns, strict=True))
    return text.getvalue()
