"""What people read in an FMU, below documentation/: index.html, externalDependencies.txt and licenses/license.txt."""

from __future__ import annotations

from html import escape

from ... import __version__
from ..arrays import TYPES, ArrayVariable, gather_arrays
from ..interface import Interface
from ..variables import Variable

__all__ = ["describe_dependencies", "describe_licences", "describe_native_licences", "make_page"]

_STYLE = (
    "body{font:16px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em}"
    "td,th{text-align:left;padding:.1em 1em .1em 0}"
)

_FMI3 = """<p>Arrays are given row by row. Do not call what the model description does not offer, not even for no
variables: the wrapper ends the process at fmi3GetFloat32, fmi3SetFloat32, the same of Int8, UInt8, Int16, UInt16,
UInt32, Binary and Clock, and at the functions of clocks, of dependencies and of adjoint derivatives.</p>
"""


def describe_dependencies(interface: Interface) -> str:
    """What the FMU needs of the machine that it runs on (FMI 3.0: documentation/externalDependencies.txt)."""
    first, last = interface.pythons
    systems = " or ".join({"linux": "Linux", "win": "Windows"}[system] for system in interface.systems)
    packages = "".join(f"    {line}\n" for line in interface.requirements)
    instead = f"\n{interface.instead}\n" if interface.instead else ""
    return f"""{interface.name} runs Python and needs of the host:

- {systems}, x86-64
- CPython {first} to {last}. A host that is a Python process has it. Any other host loads its shared library,
  on Linux with LD_PRELOAD=libpython{last}.so.1.0; on Windows python3.dll must be on PATH.
- the packages of resources/requirements.txt, which PYTHONPATH leads to where the host is no Python process:

{packages}{instead}"""


def describe_licences(wrapper: str) -> str:
    """Which licence is for what; `wrapper` is package and version."""
    package = wrapper.partition(" ")[0]
    return f"""SPDX-License-Identifier: MIT

shipcollision_fmu {__version__}    MIT    shipcollision_fmu.txt
    resources/shipcollision_fmu, the slave module beside it, documentation, modelDescription.xml; resources/models,
    where each ship file names the source of its numbers
{wrapper}    MIT    {package}.txt
    binaries, resources/{package}
"""


def describe_native_licences(bullet: str = "") -> str:
    """Which licence is for what in a native FMU; `bullet` is the version of Bullet that is in it."""
    collision = f"""{bullet}    Zlib    bullet.txt
    closest points of hulls in binaries, and BulletCollision and LinearMath in sources
"""
    return f"""SPDX-License-Identifier: MIT

shipcollision_fmu {__version__}    MIT    shipcollision_fmu.txt
    binaries, sources, documentation, modelDescription.xml; resources/ships, where the ship files that they are made
    from name the sources of their numbers
headers of FMI 2.0 and 3.0    BSD-2-Clause    fmi_headers.txt
    declarations in binaries, and fmi2*.h and fmi3*.h in sources
{collision if bullet else ""}
Nothing of a compiler's or a system's library is linked into the binaries.
"""


def make_page(
    interface: Interface, ships: tuple[str, ...], fmi: int = 2, scalar: bool = False, native: tuple[str, ...] = ()
) -> str:
    """What the FMU does, what it needs, and its variables. `native` are the platforms of an FMU without Python."""
    table = interface.table(ships)
    lines = map(_row, table) if fmi == 2 else map(_array_row, gather_arrays(table, scalar))
    rows = "\n".join(lines)
    about = _describe_native(ships, fmi, native) if native else _describe_python(interface, fmi)
    return f"""<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>{escape(interface.name)}</title><style>{_STYLE}</style></head>
<body>
<h1>{escape(interface.name)}</h1>
<p>{escape(interface.description)}</p>
<p>FMI {fmi}.0 for co-simulation, made by shipcollision_fmu {escape(__version__)}. SI units and radians throughout.
Frame n is north, east, down at the scenario's origin; frame b is forward, starboard, down at CO: midship, centreline,
design waterline.</p>
{about}<h2>Variables</h2>
<table>
<tr><th>Name</th><th>Causality</th><th>Type</th><th>Unit</th><th>Description</th></tr>
{rows}
</table>
</body>
</html>
"""


def _describe_python(interface: Interface, fmi: int) -> str:
    return f"""<p>It runs Python {" to ".join(interface.pythons)} in the process of the host, with the packages of
<code>resources/requirements.txt</code>: {escape(", ".join(interface.requirements))}. {interface.instead}
A host that is not itself Python
finds the interpreter through <code>LD_PRELOAD</code> and the packages through <code>PYTHONPATH</code>:
<a href="externalDependencies.txt">externalDependencies.txt</a>.</p>
<p>A step that cannot be made answers fmi{fmi}Discard and leaves the state before it; the reason is logged. So does the
step after a call that was refused, such as setting an output. Initialisation that fails answers fmi{fmi}Fatal, the only
failure that the Python wrapper can report there; the instance may still be reset or freed.</p>
{_FMI3 if fmi == 3 else ""}"""


def _describe_native(ships: tuple[str, ...], fmi: int, platforms: tuple[str, ...]) -> str:
    return f"""<p>It is native code for {escape(", ".join(platforms))}.
It needs the system's C library alone: glibc 2.17 or later on Linux, Windows 10 or later, macOS 11 or later.</p>
<p>Ships are read from <code>resources/ships</code>. A ship of your own is a prepared file, which
<code>shipcollision prepare SHIP</code> writes: give its path as the parameter <code>ship</code>, or put it there and
give its name.{" Obstacles are a prepared file as well." if ships else ""}</p>
<p>A call that is refused answers fmi{fmi}Error and changes nothing; the reason is logged. A step that the model cannot
make answers fmi{fmi}Discard and leaves the state before it. With the environment variable
<code>SHIPCOLLISION_LOG=stderr</code> the log is printed as well.</p>
"""


def _row(variable: Variable) -> str:
    kind = " | ".join(variable.items) if variable.items else variable.kind
    return _cells(variable.name, variable.causality, kind, variable.unit or "", variable.description)


def _array_row(array: ArrayVariable) -> str:
    line = array.line
    kind = " | ".join(line.items) if line.items else TYPES[line.kind]
    shape = f"[{', '.join(map(str, array.shape))}]" if array.shape else ""
    return _cells(array.name, line.causality, kind + shape, line.unit or "", array.description)


def _cells(*cells: str) -> str:
    return "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>"
