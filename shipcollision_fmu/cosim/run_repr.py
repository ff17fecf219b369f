"""A run in three lines, and as HTML with a table of its collisions.

guan2014: 120 steps of 0.01 s, gauss-seidel, FMU, 0.41 s of wall time
1 collision, 12.3 MJ lost to contact: own and target at 0.42 s
next: .events, .states, .contacts, .summary, .to_pandas(), .page(), .write("DIR")
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from html import escape
from math import degrees, hypot
from typing import Any

__all__ = ["run_html", "run_text"]

MJ = 1e6
LISTED = 3
"""Collisions that the second line names; with more it would not fit a terminal."""
NEXT = '.events, .states, .contacts, .summary, .to_pandas(), .page(), .write("DIR")'
HEADINGS = ("collision", "ships", "start [s]", "closing speed [m/s]", "angle [deg]", "energy [MJ]", "Δv [m/s]")


def run_text(summary: Mapping[str, Any], events: Mapping[str, Any], timing: Mapping[str, Any]) -> str:
    """Three lines: scenario and steps, collisions, where to look next."""
    return "\n".join((_first_line(summary, timing), _collisions_line(summary, events), f"next: {NEXT}"))


def run_html(summary: Mapping[str, Any], events: Mapping[str, Any], timing: Mapping[str, Any]) -> str:
    """The same as HTML, with a row for each collision; all text of the run is escaped."""
    lines = [f"<p><strong>{escape(_first_line(summary, timing))}</strong></p>"]
    if events["collisions"]:
        lines.append(_row("th", HEADINGS).join(("<table><thead>", "</thead><tbody>")))
        lines.extend(_row("td", _cells(collision)) for collision in events["collisions"])
        lines.append("</tbody></table>")
    else:
        lines.append(f"<p>{escape(_collisions_line(summary, events))}</p>")
    lines.append(f"<p>next: <code>{escape(NEXT)}</code></p>")
    return "\n".join(lines)


def _first_line(summary: Mapping[str, Any], timing: Mapping[str, Any]) -> str:
    return (
        f"{_printable(summary['scenario'])}: {summary['steps']} steps of {summary['step']:g} s, "
        f"{summary['algorithm']}, {timing['mode']}, {timing['wall_time']:.3g} s of wall time"
    )


def _collisions_line(summary: Mapping[str, Any], events: Mapping[str, Any]) -> str:
    collisions = events["collisions"]
    if not collisions:
        return f"no collision; least clearance {summary['least_clearance']:.3g} m"
    places = [f"{c['ship_a']} and {c['ship_b']} at {c['start']:.4g} s" for c in collisions[:LISTED]]
    count, more = len(collisions), ", ..." if len(collisions) > LISTED else ""
    energy = sum(collision["energy"] for collision in collisions) / MJ
    return f"{count} collision{'s'[: count > 1]}, {energy:.4g} MJ lost to contact: {', '.join(places)}{more}"


def _cells(collision: Mapping[str, Any]) -> Iterator[str]:
    yield str(collision["id"])
    yield f"{collision['ship_a']}, {collision['ship_b']}"
    yield f"{collision['start']:.4g}"
    yield f"{collision['closing_speed']:.3g}"
    yield f"{degrees(collision['angle']):.4g}"
    yield f"{collision['energy'] / MJ:.4g}"
    yield ", ".join(f"{ship} {hypot(*delta_v):.3g}" for ship, delta_v in collision["delta_v"].items())


def _row(tag: str, cells: Any) -> str:
    return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"


def _printable(text: str) -> str:
    """A scenario's name may hold control characters, which would break the line or drive the terminal."""
    return "".join(c if c.isprintable() else " " for c in text)
