"""The .fmu files without Python: one file for all platforms.

    modelDescription.xml
    binaries/linux64|win64|...|NAME.*       one library for every version and flavour (FMI 3.0: x86_64-linux|...)
    documentation/                          a page for people, licences
    model.png                               an icon (FMI 3.0: in terminalsAndIcons/, with the terminals)
    resources/variables.txt                 the table of variables, with start values (native_variables)
    resources/ships/NAME.ship               the shipped ships, prepared; beside them those of one instance
    sources/                                with `sources`: what the libraries are compiled from (native_sources)

The same sources and compilers give the same bytes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, Literal
from uuid import UUID
from xml.etree.ElementTree import Element

from ... import __version__
from ...collision.ship_names import check_ship_names
from ...errors import InputError
from ...files import write_files
from ...manoeuvring.prepared_ship import SUFFIX, prepare_ship
from ...ship.loading.library import list_ship_names
from ...toolchain.bullet_sources import VERSION as BULLET
from ...toolchain.fmu_binaries import Binary, build_binaries, choose_platforms
from ...toolchain.installed import digest_native
from ...toolchain.libraries import Report, ignore_progress
from ...toolchain.platforms import PLATFORMS
from ...toolchain.sources import COLLISION, find_native
from .. import build_record, ship_collision, ship_manoeuvring
from ..interface import SHIPS as SHIP_NAMES
from ..interface import Interface
from ..variables import Table
from .documentation import describe_native_licences, make_page
from .model_description import to_bytes
from .model_description_fmi2 import model_description as model_description_fmi2
from .model_description_fmi3 import model_description as model_description_fmi3
from .native_sources import list_compiled, list_source_files, read_bullet_licence, read_fmi_licence
from .native_variables import VARIABLES, native_variables
from .package import choose_version, list_icons, read_own_licence
from .zip_archive import zip_bytes

__all__ = ["NATIVE_FMUS", "build_native_fmus", "native_fmu_bytes", "native_fmu_file", "native_instance_fmu"]

SHIPS = "ships"
"""Folder of prepared ships among the resources; native/ship/prepared_ship.cpp looks there."""
_SHIP = "Name of a ship in the FMU's resources, or path of a prepared ship"
_SHIP_OF = "Ship of {0}: a name in the FMU's resources, or path of a prepared ship"
_OBSTACLES = "Fixed obstacles: path of a prepared file, in the FMU's resources or elsewhere; empty for none"
_RESPONSE = "Solver of the contact problem; closed_form and bullet are refused, since they need Python"
"""What these parameters are in native code, which reads no TOML."""


def _tabulate_manoeuvring(ships: tuple[str, ...] = ()) -> Table:
    """The variables of ShipManoeuvring."""
    return _describe_lines(ship_manoeuvring.table(ships), {"ship": _SHIP})


def _tabulate_collision(ships: tuple[str, ...] = SHIP_NAMES) -> Table:
    """The variables of ShipCollision."""
    said = {"obstacles": _OBSTACLES, "response": _RESPONSE}
    said |= {f"{name}.ship": _SHIP_OF.format(name) for name in ships}
    return _describe_lines(ship_collision.table(ships), said)


def _describe_lines(lines: Table, said: Mapping[str, str]) -> Table:
    """The lines with other descriptions, by name."""
    return tuple(replace(line, description=said[line.name]) if line.name in said else line for line in lines)


NATIVE_FMUS = {
    interface.name: replace(interface, table=table)
    for interface, table in (
        (ship_collision.INTERFACE, _tabulate_collision),
        (ship_manoeuvring.INTERFACE, _tabulate_manoeuvring),
    )
}
"""Models that have a native form, by name."""


def native_fmu_file(name: str, fmi: int = 2, scalar: bool = False) -> str:
    """File name of a native FMU; all flavours, and the FMUs with Python, may lie in one folder."""
    return f"{name}.native{choose_version(fmi, scalar).suffix}"


def build_native_fmus(
    out: str | Path,
    *,
    ships: tuple[str, ...] = SHIP_NAMES,
    fmi: int = 2,
    scalar: bool = False,
    platforms: Sequence[str] = tuple(PLATFORMS),
    sources: bool = False,
    names: Sequence[str] = tuple(NATIVE_FMUS),
    report: Report = ignore_progress,
) -> dict[str, Path]:
    """Write ShipCollision.native.fmu and ShipManoeuvring.native.fmu into the folder `out` and return the paths by name.

    `ships`: see build_fmus. With fmi = 3 the files end in .native.fmi3.fmu, with `scalar` in .native.fmi3-scalar.fmu.
    `platforms` are some of linux64, win64, darwin64 and aarch64-linux; `sources`: the FMUs bring their C++ sources,
    too. `names`: build these alone. `report` is called with how many steps of how many are done. Raises HostError when
    nothing here compiles for a platform or Bullet's source cannot be fetched, and InputError for an unknown platform,
    version or ship name.
    """
    choose_version(fmi, scalar)
    check_ship_names(ships)
    targets = choose_platforms(platforms)
    built = {}
    for name in names:
        binaries = build_binaries(name, targets, report)[fmi]
        content = native_fmu_bytes(NATIVE_FMUS[name], binaries, ships, fmi, scalar, sources=sources)
        built[native_fmu_file(name, fmi, scalar)] = content
    write_files(Path(out), built)
    return {name: Path(out) / native_fmu_file(name, fmi, scalar) for name in names}


def native_instance_fmu(
    interface: Interface,
    ships: tuple[str, ...],
    start: Mapping[str, Any],
    files: Mapping[str, bytes] | None = None,
    fmi: int = 2,
    scalar: bool = False,
    platforms: Sequence[str] = tuple(PLATFORMS),
) -> bytes:
    """A native FMU for one instance in a system: see instance_fmu. Ships and obstacles among `files` are prepared."""
    if interface.name not in NATIVE_FMUS:
        raise InputError(f"{interface.name} has no native form: our models {' and '.join(NATIVE_FMUS)} have one")
    binaries = build_binaries(interface.name, choose_platforms(platforms))[fmi]
    native = replace(interface, table=NATIVE_FMUS[interface.name].table)
    return native_fmu_bytes(native, binaries, ships, fmi, scalar, start=start, resources=files)


def native_fmu_bytes(
    interface: Interface,
    binaries: Sequence[Binary],
    ships: tuple[str, ...] = SHIP_NAMES,
    fmi: int = 2,
    scalar: bool = False,
    *,
    start: Mapping[str, Any] | None = None,
    resources: Mapping[str, bytes] | None = None,
    sources: bool = False,
    shipped: Sequence[str] | None = None,
) -> bytes:
    """One native FMU as bytes, with the libraries of that version of FMI.

    `start` and `resources`: see instance_fmu; `scalar` and `sources`: see build_native_fmus. `shipped` are those of
    the shipped ships that are needed; without it all are there.
    """
    name = interface.name
    ships = ships if name == COLLISION else ()
    platforms = tuple(binary.folder for binary in binaries)
    files = {
        **{f"binaries/{one.folder}/{name}{one.suffix}": one.content for one in binaries},
        **{
            f"resources/{place}": content for place, content in {**_prepare_ships(shipped), **(resources or {})}.items()
        },
        "documentation/index.html": make_page(interface, ships, fmi, scalar, platforms).encode(),
        **_list_licences(name),
        **list_icons(interface, ships, fmi, scalar),
        **(list_source_files(name, fmi) if sources else {}),
    }
    version: Literal[2, 3] = 2 if fmi == 2 else 3
    build = f"{__version__} {digest_native(find_native())[:12]}"

    def describe(token: str) -> dict[str, bytes]:
        """The two files that hold the token."""
        table = native_variables(interface, ships, fmi=version, token=token, build=build, starts=start, scalar=scalar)
        description = to_bytes(_describe(interface, ships, token, fmi, scalar, start, sources))
        return {f"resources/{VARIABLES}": table, "modelDescription.xml": description}

    token = str(UUID(build_record.digest({**files, **describe("")})[:32]))
    return zip_bytes({**files, **describe(token)})


def _describe(
    interface: Interface,
    ships: tuple[str, ...],
    token: str,
    fmi: int,
    scalar: bool,
    start: Mapping[str, Any] | None,
    sources: bool,
) -> Element:
    if fmi == 3:
        return model_description_fmi3(interface, ships, token, start, scalar, native=True)
    compiled = list_compiled(interface.name) if sources else ()
    return model_description_fmi2(interface, ships, token, start, native=True, sources=compiled)


def _prepare_ships(names: Sequence[str] | None) -> dict[str, bytes]:
    """Shipped ships by their place among the resources, all without names; half a second at the first time."""
    chosen = list_ship_names() if names is None else names
    return {f"{SHIPS}/{name}{SUFFIX}": _prepare(name) for name in chosen}


_prepare = cache(prepare_ship)


def _list_licences(name: str) -> dict[str, bytes]:
    """license.txt, where FMI has readers begin, says which of the others is for what."""
    has_contact = name == COLLISION
    texts = {
        "license": describe_native_licences(BULLET if has_contact else ""),
        "shipcollision_fmu": read_own_licence(),
        "fmi_headers": read_fmi_licence(),
        "bullet": read_bullet_licence() if has_contact else "",
    }
    return {f"documentation/licenses/{name}.txt": text.encode() for name, text in texts.items() if text}
