"""report.html: a study in one file that any browser shows, without a network and from a file: address.

The figures are inside it as SVG. All text from the study is escaped; a content security policy forbids every address.
"""

from __future__ import annotations

import base64
import html
import re
from collections.abc import Iterable, Sequence
from typing import TypeAlias

from .counts import count_cases, group
from .replays import find_replay
from .study_table import StudyTable
from .worst import Worst, format_command

__all__ = ["PageFigure", "build_page"]

PageFigure: TypeAlias = tuple[str, str, str, bytes | None]
"""Name of the files, heading, caption and SVG; without SVG the caption says why there is none."""

_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'"
_STYLE = """
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { font: 16px/1.5 system-ui, sans-serif; color: #1c2733; background: #fff; margin: 0 auto; max-width: 1180px;
  padding: 16px; }
h1 { font-size: 1.6rem; margin: 0.4em 0; }
h2 { font-size: 1.15rem; margin: 0 0 0.3em; }
p { max-width: 46rem; margin: 0.5em 0; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 440px), 1fr)); gap: 32px 40px;
  margin: 24px 0; }
figure { margin: 0; min-width: 0; }
figure img { width: 100%; max-width: 560px; height: auto; display: block; }
figcaption { font-size: 0.88rem; color: #44525f; max-width: 560px; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.92rem; }
th, td { text-align: left; padding: 4px 12px 4px 0; border-bottom: 1px solid #d5dce3; vertical-align: top; }
.cases th { vertical-align: bottom; }
.cases th.number { width: 1%; }
.cases td.number, code.line { white-space: nowrap; }
@media (max-width: 1000px) { .cases td { white-space: nowrap; } }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
code { font-size: 0.85em; background: #eef2f6; padding: 2px 5px; border-radius: 3px; }
code.line { user-select: all; }
a { color: #1f5a96; }
"""
_TEMPLATE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<title>Study {name}</title>
<link rel="icon" href="data:,">
<style>{style}</style>
</head>
<body>
<h1>Study {name}</h1>
{summary}
<div class="figures">
{figures}
</div>
{worst}
</body>
</html>
"""
_HEADINGS = (
    ("row", "row", "", 1.0), ("energy", "energy [MJ]", ".1f", 1e-6), ("situation", "situation", "", 1.0),
    ("own_ship", "own ship", "", 1.0),
    ("target_ship", "target", "", 1.0), ("kind", "kind", "", 1.0), ("angle_deg", "angle [deg]", ".1f", 1.0),
    ("at", "place (at)", ".3f", 1.0), ("own_speed", "own speed [m/s]", ".2f", 1.0),
    ("target_speed", "target speed [m/s]", ".2f", 1.0), ("closing_speed", "closing speed [m/s]", ".2f", 1.0),
)  # fmt: skip
"""Columns of the table of the worst cases: name, heading, format, factor to the heading's unit."""


def build_page(
    table: StudyTable,
    figures: Iterable[PageFigure],
    worst: Sequence[Worst],
    change: str,
) -> str:
    """The page. change: why no case can be run again; empty where each can."""
    return _TEMPLATE.format(
        policy=_POLICY,
        name=html.escape(table.name),
        style=_STYLE,
        summary=_describe(table),
        figures="\n".join(_format_figure(*figure) for figure in figures),
        worst=_format_worst(table, worst, change),
    )


def _describe(table: StudyTable) -> str:
    done = len(table.row)
    how = f"at level {table.level}, engine {table.engine}"
    if table.present == 1:
        lines = [f"The only case is done, {how}."]
    else:
        lines = [f"{group(done)} of {count_cases(table.present)} {'is' if done == 1 else 'are'} done, {how}."]
    if table.present < table.rows:
        lines.append(f"The study is not finished: it has {count_cases(table.rows)}.")
    if table.refused:
        lines.append(
            f"{count_cases(table.refused)} ({100.0 * table.refused / table.present:.3g} %) "
            f"{'is' if table.refused == 1 else 'are'} refused: the column `reason` of the encounters says why."
        )
        reason = table.find_reason()
        if reason is not None and table.refused > 1:
            lines.append(f"The commonest reason, {reason.cases} times: {reason.text}.")
        elif reason is not None:
            lines.append(f"{reason.text[:1].upper()}{reason.text[1:]}.")
        lines.append(
            "Refused cases are left out here: every share is one of the cases that are done, which all weigh the same."
        )
    elif table.present > 1:
        lines.append("None is refused. All cases weigh the same.")
    if table.contact_at_end:
        lines.append(
            f"{count_cases(table.contact_at_end)} {'ends' if table.contact_at_end == 1 else 'end'} with hulls that "
            "touch (column `contact_at_end`): the energy may not be the whole. A longer `after` in [run] gives more "
            "of it."
        )
    lines.append(f"Sampler: {table.sampler}.")
    if table.sampler != "random":
        lines.append(
            "It spreads the cases more evenly than chance, so the bands are, as a rule, wider than they need to be."
        )
    return f"<p>{_escape(' '.join(lines))}</p>"


def _format_figure(name: str, title: str, caption: str, svg: bytes | None) -> str:
    if svg is None:
        return f"<section>\n<h2>{html.escape(title)}</h2>\n<p>{html.escape(caption)}</p>\n</section>"
    links = ", ".join(f'<a href="figures/{name}.{kind}">{kind.upper()}</a>' for kind in ("png", "svg", "csv"))
    return (
        f'<figure>\n<h2>{html.escape(title)}</h2>\n<img alt="{html.escape(title)}" '
        f'src="data:image/svg+xml;base64,{base64.b64encode(svg).decode()}">\n'
        f"<figcaption>{html.escape(caption)} {links}</figcaption>\n</figure>"
    )


def _format_worst(table: StudyTable, worst: Sequence[Worst], change: str) -> str:
    columns = [
        heading for heading in _HEADINGS
        if heading[0] == "row" or any(case.values.get(heading[0]) is not None for case in worst)
    ]  # fmt: skip
    head = "<th>replay</th>" + "".join(f"<th{_mark(spec)}>{html.escape(title)}</th>" for _, title, spec, _ in columns)
    what, lines = "case" if len(worst) == 1 else f"{len(worst)} cases", []
    for case in worst:
        values = {**case.values, "row": case.row}
        cells = "".join(
            f"<td{_mark(spec)}>{html.escape(_format_value(values.get(key), spec, factor))}</td>"
            for key, _, spec, factor in columns
        )
        found = find_replay(table, case.row)
        replay = (
            f'<a href="{found}">replay</a>'
            if found
            else f'<code class="line">{html.escape(format_command(case.row))}</code>'
        )
        lines.append(f"<tr><td>{replay}</td>{cells}</tr>")
    return (
        f"<h2>The {what} of most energy</h2>\n<p>{_describe_replays(table, worst, change)}</p>\n"
        f'<div class="wide"><table class="cases">\n<tr>{head}</tr>\n' + "\n".join(lines) + "\n</table></div>"
    )


def _describe_replays(table: StudyTable, worst: Sequence[Worst], change: str) -> str:
    if change:
        return _escape(f"No case can be run again: {change}. Put back what was there, and show the study again.")
    text = "Each case was run again for its replay."
    if any(find_replay(table, case.row) is None for case in worst):
        text = "In the folder of this page, the line beside a case runs it again, and writes its replay."
    if table.level == "impact":
        text += (
            " A replay begins with the impact of the row, and goes on with ships that coast: where they touch again, "
            "they lose more energy."
        )
    return text


def _escape(text: str) -> str:
    """Text as HTML, with the names in backticks as code."""
    return re.sub(r"`([^`]*)`", r"<code>\1</code>", html.escape(text))


def _mark(spec: str) -> str:
    return ' class="number"' if spec else ""


def _format_value(value: object, spec: str, factor: float) -> str:
    if value is None:
        return ""
    return format(value * factor, spec) if spec and isinstance(value, float) else str(value)
