"""The page for people in an FMU: documentation/index.html."""

from __future__ import annotations

from html import escape

from shipcollision_fmu import __version__
from shipcollision_fmu.fmi.interface import Interface
from shipcollision_fmu.fmi.variables import Variable

__all__ = ["page"]

_STYLE = (
    "body{font:16px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em}"
    "td,th{text-align:left;padding:.1em 1em .1em 0}"
)


def page(interface: Interface, ships: tuple[str, ...]) -> str:
    """What the FMU does, what it needs, and its variables."""
    rows = "\n".join(_row(variable) for variable in interface.table(ships))
    return f"""<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>{escape(interface.name)}</title><style>{_STYLE}</style></head>
<body>
<h1>{escape(interface.name)}</h1>
<p>{escape(interface.description)}</p>
<p>FMI 2.0 for co-simulation, made by shipcollision_fmu {escape(__version__)}. SI units and radians throughout.
Frame n is north, east, down at the scenario's origin; frame b is forward, starboard, down at CO: midship, centreline,
design waterline.</p>
<p>It runs Python: the host process needs CPython with the packages of <code>resources/requirements.txt</code>. A host
that is not itself Python finds the interpreter through <code>LD_PRELOAD=libpython3.11.so</code> and the packages
through <code>PYTHONPATH</code>.</p>
<p>A step that cannot be made answers fmi2Discard and leaves the state before it; the reason is logged. So does the
step after a call that was refused, such as setting an output. Initialisation that fails answers fmi2Fatal, the only
failure that the Python wrapper can report there; the instance may still be reset or freed.</p>
<h2>Variables</h2>
<table>
<tr><th>Name</th><th>Causality</th><th>Type</th><th>Unit</th><th>Description</th></tr>
{rows}
</table>
</body>
</html>
"""


def _row(variable: Variable) -> str:
    kind = " | ".join(variable.items) if variable.items else variable.kind
    cells = (variable.name, variable.causality, kind, variable.unit or "", variable.description)
    return "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>"
