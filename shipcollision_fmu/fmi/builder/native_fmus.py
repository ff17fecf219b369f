"""The .fmu files without Python: one file for all platforms.

    modelDescription.xml
    binaries/linux64|win64|...|NAME.*       one library for every FMU, version and flavour (FMI 3.0: x86_64-linux|...)
    documentation/                          a page for people, licences
    model.png                               an icon (FMI 3.0: in terminalsAndIcons/, with the terminals)
    resources/variables.txt                 the table of variables, with start values (native_variables)
    resources/ships/NAME.ship               the shipped ships, prepared; beside them those of one instance
    sources/                                with `sources`: what the libraries are compiled from (native_sources)

The same sources and compilers give the same bytes. ShipCollision is not among them: contact runs Python.
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
from ...errors import InputError
from ...files import write_files
from ...manoeuvring.prepared_ship import SUFFIX, prepare_ship
from ...ship.loading.library import list_ship_names
from ...toolchain.fmu_binaries import Binary, build_binaries, choose_platforms
from ...toolchain.installed import digest_native
from ...toolchain.libraries import Report, ignore_progress
from ...toolchain.platforms import PLATFORMS
from ...toolchain.sources import find_native
from .. import build_record, ship_manoeuvring
from ..interface import Interface
from ..variables import Table
from .documentation import describe_native_licences, make_page
from .model_description import to_bytes
from .model_description_fmi2 import model_description as model_description_fmi2
from .model_description_fmi3 import model_description as model_description_fmi3
from .native_sources import list_compiled, list_source_files, read_fmi_licence
from .native_variables import VARIABLES, native_variables
from .package import choose_version, list_icons, read_own_licence
from .zip_archive import zip_bytes

__all__ = ["NATIVE_FMUS", "build_native_fmus", "native_fmu_bytes", "native_fmu_file", "native_instance_fmu"]

SHIPS = "ships"
"""Folder of prepared ships among the resources; native/ship/prepared_ship.cpp looks there."""
_SHIP = "Name of a ship in the FMU's resources, or path of a prepared ship"
"""What the parameter `ship` is in native code, which reads no TOML."""


def _table(ships: tuple[str, ...] = ()) -> Table:
    """The variables of ShipManoeuvring."""
    lines = ship_manoeuvring.table(ships)
    return tuple(replace(line, description=_SHIP) if line.name == "ship" else line for line in lines)


NATIVE_FMUS = {ship_manoeuvring.INTERFACE.name: replace(ship_manoeuvring.INTERFACE, table=_table)}
"""Models that have a native form, by name."""


def native_fmu_file(name: str, fmi: int = 2, scalar: bool = False) -> str:
    """File name of a native FMU; all flavours, and the FMUs with Python, may lie in one folder."""
    return f"{name}.native{choose_version(fmi, scalar).suffix}"


def build_native_fmus(
    out: str | Path,
    *,
    fmi: int = 2,
    scalar: bool = False,
    platforms: Sequence[str] = tuple(PLATFORMS),
    sources: bool = False,
    report: Report = ignore_progress,
) -> dict[str, Path]:
    """Write ShipManoeuvring.native.fmu into the folder `out` and return the paths by name.

    With fmi = 3 the file ends in .native.fmi3.fmu, with `scalar` in .native.fmi3-scalar.fmu: see build_fmus.
    `platforms` are some of linux64, win64, darwin64 and aarch64-linux; `sources`: the FMU brings its C++ sources, too.
    `report` is called with how many steps of how many are done. Raises HostError when nothing here compiles for a
    platform, and InputError for an unknown platform or version.
    """
    choose_version(fmi, scalar)
    binaries = build_binaries(choose_platforms(platforms), report)[fmi]
    built = {
        native_fmu_file(name, fmi, scalar): native_fmu_bytes(interface, binaries, fmi, scalar, sources=sources)
        for name, interface in NATIVE_FMUS.items()
    }
    write_files(Path(out), built)
    return {name: Path(out) / native_fmu_file(name, fmi, scalar) for name in NATIVE_FMUS}


def native_instance_fmu(
    interface: Interface,
    ships: tuple[str, ...],
    start: Mapping[str, Any],
    files: Mapping[str, bytes] | None = None,
    fmi: int = 2,
    scalar: bool = False,
    platforms: Sequence[str] = tuple(PLATFORMS),
) -> bytes:
    """A native FMU for one instance in a system: see instance_fmu. A ship among `files` is a prepared one."""
    if interface.name not in NATIVE_FMUS:
        raise InputError(f"{interface.name} has no native form: of our models {', '.join(NATIVE_FMUS)} has one")
    del ships  # these models are one ship
    binaries = build_binaries(choose_platforms(platforms))[fmi]
    native = replace(interface, table=_table)
    return native_fmu_bytes(native, binaries, fmi, scalar, start=start, resources=files)


def native_fmu_bytes(
    interface: Interface,
    binaries: Sequence[Binary],
    fmi: int = 2,
    scalar: bool = False,
    *,
    start: Mapping[str, Any] | None = None,
    resources: Mapping[str, bytes] | None = None,
    sources: bool = False,
) -> bytes:
    """One native FMU as bytes, with the libraries of that version of FMI.

    `start` and `resources`: see instance_fmu; `scalar` and `sources`: see build_native_fmus.
    """
    name = interface.name
    platforms = tuple(binary.folder for binary in binaries)
    files = {
        **{f"binaries/{one.folder}/{name}{one.suffix}": one.content for one in binaries},
        **{f"resources/{place}": content for place, content in {**_prepare_ships(), **(resources or {})}.items()},
        "documentation/index.html": make_page(interface, (), fmi, scalar, platforms).encode(),
        **_list_licences(),
        **list_icons(interface, (), fmi, scalar),
        **(list_source_files(name, fmi) if sources else {}),
    }
    version: Literal[2, 3] = 2 if fmi == 2 else 3
    build = f"{__version__} {digest_native(find_native())[:12]}"

    def describe(token: str) -> dict[str, bytes]:
        """The two files that hold the token."""
        table = native_variables(interface, (), fmi=version, token=token, build=build, starts=start, scalar=scalar)
        description = to_bytes(_describe(interface, token, fmi, scalar, start, sources))
        return {f"resources/{VARIABLES}": table, "modelDescription.xml": description}

    token = str(UUID(build_record.digest({**files, **describe("")})[:32]))
    return zip_bytes({**files, **describe(token)})


def _describe(
    interface: Interface, token: str, fmi: int, scalar: bool, start: Mapping[str, Any] | None, sources: bool
) -> Element:
    if fmi == 3:
        return model_description_fmi3(interface, (), token, start, scalar, native=True)
    return model_description_fmi2(interface, (), token, start, native=True, sources=list_compiled() if sources else ())


def _prepare_ships() -> dict[str, bytes]:
    """The shipped ships by their place among the resources; half a second at the first time."""
    return {f"{SHIPS}/{name}{SUFFIX}": _prepare(name) for name in list_ship_names()}


_prepare = cache(prepare_ship)


def _list_licences() -> dict[str, bytes]:
    """license.txt, where FMI has readers begin, says which of the others is for what."""
    texts = {
        "license": describe_native_licences(),
        "shipcollision_fmu": read_own_licence(),
        "fmi_headers": read_fmi_licence(),
    }
    return {f"documentation/licenses/{name}.txt": text.encode() for name, text in texts.items() if text}
