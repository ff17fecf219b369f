"""The .fmu files.

An FMU is a zip archive. It is put together here from pythonfmu's parts (its Python files and its binaries) instead of
by pythonfmu's builder, which runs the slave's code, changes sys.path for good, and stamps time and a random GUID on
the result. Here the same inputs give the same bytes: names sorted, one date, one set of permissions, a GUID that is a
digest of everything else.

    modelDescription.xml
    binaries/linux64|win64/NAME.*           pythonfmu's wrapper (FMI 3.0: x86_64-linux|windows, pythonfmu3's); for
                                            Windows only where all packages have wheels for it
    documentation/                          a page for people, licences, what the host must have
    model.png                               an icon (FMI 3.0: in terminalsAndIcons/, with the terminals)
    resources/slavemodule.txt, NAME_*.py    where the wrapper starts; * is a digest
    resources/pythonfmu/, shipcollision_fmu/, models/
    resources/build.json                    what it was built from (build_record)
    resources/start.json                    start values in place of the model's own, in an FMU made for one instance
    resources/requirements.txt              what the host's Python must have
"""

from __future__ import annotations

import json
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from hashlib import sha256
from importlib import import_module, metadata
from importlib.util import find_spec
from pathlib import Path
from typing import Any
from uuid import UUID
from xml.etree.ElementTree import Element

from ... import __version__
from ...collision.ship_names import check_ship_names
from ...errors import HostError, InputError, describe_installation
from ...files import write_files
from .. import build_record
from ..build_record import RECORD, START, BuildRecord, package_directory
from ..interface import SHIPS, Interface
from .documentation import describe_dependencies, describe_licences, make_page
from .model_description import to_bytes
from .model_description_fmi2 import model_description as model_description_fmi2
from .model_description_fmi3 import model_description as model_description_fmi3
from .terminals import describe_terminals
from .zip_archive import LIBRARIES, zip_bytes

__all__ = [
    "FMUS",
    "VERSIONS",
    "are_fmus_current",
    "build_fmus",
    "choose_version",
    "fmu_bytes",
    "fmu_file",
    "instance_fmu",
    "list_icons",
    "read_own_licence",
    "slave_directory",
]  # fmt: skip

FMUS = {"ShipCollision": "ship_collision", "ShipManoeuvring": "ship_manoeuvring"}
"""Name of each FMU, and the module of the room fmi that holds its INTERFACE."""


@dataclass(frozen=True)
class _Version:
    """What a version of FMI changes in the file: its number, the package of the wrapper, the folder of its slaves in
    fmu_src/, the end of the file's name, modelDescription.xml, and whether arrays are taken apart."""

    fmi: int
    wrapper: str
    slaves: str
    suffix: str
    description: Callable[[Interface, tuple[str, ...], str, Mapping[str, Any] | None], Element]
    scalar: bool = False


VERSIONS = {
    2: _Version(2, "pythonfmu", ".", ".fmu", model_description_fmi2),
    3: _Version(3, "pythonfmu3", "fmi3", ".fmi3.fmu", model_description_fmi3),
}
"""Versions of FMI that FMUs can be built for."""
_SCALAR = replace(
    VERSIONS[3], suffix=".fmi3-scalar.fmu", description=partial(model_description_fmi3, scalar=True), scalar=True
)


def fmu_file(name: str, fmi: int = 2, scalar: bool = False) -> str:
    """File name of an FMU; all versions may lie in one folder."""
    return f"{name}{choose_version(fmi, scalar).suffix}"


def build_fmus(
    out: str | Path, *, ships: tuple[str, ...] = SHIPS, fmi: int = 2, scalar: bool = False
) -> dict[str, Path]:
    """Write ShipCollision.fmu and ShipManoeuvring.fmu into the folder `out` and return their paths by name.

    `ships` are the names that the collision FMU gives its ships; one ship is enough where it meets obstacles. With
    fmi = 3 the files are ShipCollision.fmi3.fmu and ShipManoeuvring.fmi3.fmu, for FMI 3.0; with `scalar` they end in
    .fmi3-scalar.fmu and have the variables of FMI 2.0, for hosts that do not pass arrays. Both files are written, or
    neither. Raises HostError, and InputError for another version and for names that ships cannot have.
    """
    version, ships = choose_version(fmi, scalar), check_ship_names(ships)
    built = {
        name: fmu_bytes(_interface(name), _slave(name, version).read_bytes(), ships, fmi, scalar=scalar)
        for name in FMUS
    }
    write_files(Path(out), {f"{name}{version.suffix}": data for name, data in built.items()})
    return {name: Path(out) / f"{name}{version.suffix}" for name in built}


def are_fmus_current(directory: str | Path, *, ships: tuple[str, ...] = SHIPS, fmi: int = 2) -> bool:
    """Whether both FMUs are in `directory` and made from the sources that run now; some ten milliseconds."""
    now, version = build_record.digest_contents(package_directory()), VERSIONS[fmi]
    return all(_is_current(Path(directory) / f"{name}{version.suffix}", name, now, ships, version) for name in FMUS)


def instance_fmu(
    interface: Interface,
    ships: tuple[str, ...],
    start: Mapping[str, Any],
    files: Mapping[str, bytes] | None = None,
    fmi: int = 2,
    scalar: bool = False,
) -> bytes:
    """ShipCollision or ShipManoeuvring for one instance in a system: it starts from `start` (values by name). The
    default experiment of `interface` may be the system's own.

    Some hosts ignore a system's parameter values; an FMU's own start values are honoured by all. `files` go into its
    resources, where ship files are looked for first. Raises HostError, and InputError for what cannot be set.
    """
    slave = _slave(interface.name, choose_version(fmi, scalar)).read_bytes()
    return fmu_bytes(interface, slave, ships, fmi, start=start, resources=files, scalar=scalar)


def fmu_bytes(
    interface: Interface,
    slave: bytes,
    ships: tuple[str, ...] = SHIPS,
    fmi: int = 2,
    *,
    start: Mapping[str, Any] | None = None,
    resources: Mapping[str, bytes] | None = None,
    scalar: bool = False,
) -> bytes:
    """One FMU as bytes; `slave` is the text of its slave module. Raises HostError when the wrapper is not installed or
    has no binaries.

    `start` and `resources`: see instance_fmu; `scalar`: see build_fmus.
    """
    version, name = choose_version(fmi, scalar), interface.name
    own = {f"resources/{inside}": data for inside, data in (resources or {}).items()}
    if start:
        own[f"resources/{START}"] = (json.dumps(dict(start), indent=1) + "\n").encode()
    contents = build_record.digest_contents(package_directory())
    inputs = _inputs(contents, slave, ships, version)
    module = f"{name}_{inputs[:12]}"  # of its own: another FMU's module of the same name would run in its place
    files = {
        **own,
        **_sources(),
        **_wrapper(version.wrapper, interface),
        f"resources/{module}.py": slave,
        "resources/slavemodule.txt": module.encode(),
        "resources/requirements.txt": "".join(f"{line}\n" for line in interface.requirements).encode(),
        "documentation/index.html": make_page(interface, ships, fmi, scalar).encode(),
        "documentation/externalDependencies.txt": describe_dependencies(interface).encode(),
        **_licences(version),
        **list_icons(interface, ships, fmi, scalar),
    }
    anonymous = to_bytes(version.description(interface, ships, "", start))
    guid = str(UUID(build_record.digest({**files, "modelDescription.xml": anonymous})[:32]))
    files["modelDescription.xml"] = to_bytes(version.description(interface, ships, guid, start))
    record = BuildRecord(name, __version__, contents, inputs, ships, guid, _identity(version), scalar)
    files[f"resources/{RECORD}"] = record.to_json().encode()
    return zip_bytes(files)


def slave_directory() -> Path:
    """Where the slave modules lie: inside the package when installed, beside it in a checkout."""
    installed = package_directory() / "fmu_src"
    return installed if installed.is_dir() else package_directory().parent / "fmu_src"


def _interface(name: str) -> Interface:
    found = import_module(f"shipcollision_fmu.fmi.{FMUS[name]}").INTERFACE
    assert isinstance(found, Interface)
    return found


def choose_version(fmi: int, scalar: bool) -> _Version:
    """What a version of FMI changes in the file. Raises InputError for another one."""
    if fmi not in VERSIONS:
        raise InputError(f"fmi = {fmi!r} is not a version that FMUs can be built for: give one of 2, 3")
    if scalar and fmi != 3:
        raise InputError(f"scalar = {scalar!r} is for FMI 3.0 alone, since FMI {fmi}.0 has no arrays: leave it out")
    return _SCALAR if scalar else VERSIONS[fmi]


def _slave(name: str, version: _Version) -> Path:
    path = slave_directory() / version.slaves / f"{name}.py"
    if not path.is_file():
        raise HostError(f"{path} is missing: the installation of shipcollision_fmu is not complete, install it again")
    return path


def _sources() -> dict[str, bytes]:
    return {
        f"resources/{name}": path.read_bytes() for name, path in build_record.list_contents(package_directory()).items()
    }


def _home(wrapper: str) -> Path:
    """Where a wrapper's package is installed."""
    found = find_spec(wrapper)
    if found is None or found.origin is None:
        raise HostError(
            f"{wrapper}, which the FMUs are wrapped with, is not installed: "
            f"{describe_installation('fmi3' if wrapper == 'pythonfmu3' else '')}"
        )
    return Path(found.origin).parent


def _identity(version: _Version) -> str:
    """Package and version of a wrapper; the version is that of its own text, not of its distribution."""
    return f"{version.wrapper} {import_module(version.wrapper).__version__}"


def _wrapper(wrapper: str, interface: Interface) -> dict[str, bytes]:
    """The wrapper's Python files, and its libraries under the FMU's name, for the systems that the model runs on."""
    home = _home(wrapper)
    binaries = home / "resources" / "binaries"
    files = {f"resources/{wrapper}/{path.name}": path.read_bytes() for path in home.glob("*.py")}
    found = {
        f"binaries/{path.parent.name}/{interface.name}{path.suffix}": path.read_bytes()
        for path in binaries.rglob("*")
        if path.suffix in LIBRARIES and any(system in path.parent.name for system in interface.systems)
    }
    if not found:
        raise HostError(f"{wrapper} has no binaries under {binaries}: install {wrapper} from its wheel")
    return files | found


def _licences(version: _Version) -> dict[str, bytes]:
    """Of this project and of the wrapper, as their distributions carry them; a checkout has its own at its root.
    license.txt, where FMI has readers begin, says which is for what."""
    texts = {
        "license": describe_licences(_identity(version)),
        "shipcollision_fmu": read_own_licence(),
        version.wrapper: read_licence(version.wrapper),
    }
    return {f"documentation/licenses/{name}.txt": text.encode() for name, text in texts.items() if text}


def list_icons(interface: Interface, ships: tuple[str, ...], fmi: int, scalar: bool) -> dict[str, bytes]:
    """The icon where this version of FMI has it, and the terminals of FMI 3.0; nothing for an FMU without an icon."""
    drawn = {kind: slave_directory() / "icons" / f"{interface.name}.{kind}" for kind in ("png", "svg")}
    if not drawn["png"].is_file():
        return {}
    if fmi == 2:
        return {"model.png": drawn["png"].read_bytes()}
    terminals = describe_terminals(interface.table(ships), interface.terminals(ships), scalar)
    icons = {f"terminalsAndIcons/icon.{kind}": path.read_bytes() for kind, path in drawn.items()}
    return {"terminalsAndIcons/terminalsAndIcons.xml": to_bytes(terminals), **icons}


def read_own_licence() -> str | None:
    """The text of this project's licence."""
    root = package_directory().parent / "LICENSE"
    return root.read_text(encoding="utf-8") if root.is_file() else read_licence("shipcollision-fmu")


def read_licence(distribution: str) -> str | None:
    """The text of a distribution's licence, as it carries it."""
    try:
        found = metadata.distribution(distribution)
    except metadata.PackageNotFoundError:
        return None
    return found.read_text("licenses/LICENSE") or found.read_text("LICENSE")


def _inputs(contents: str, slave: bytes, ships: tuple[str, ...], version: _Version) -> str:
    """Digest of everything an FMU is made from, this room included; what the wrapper gives goes by its version."""
    _home(version.wrapper)
    builder = build_record.digest({path.name: path.read_bytes() for path in Path(__file__).parent.glob("*.py")})
    parts = (contents, builder, sha256(slave).hexdigest(), ships, _identity(version), __version__, version.suffix)
    return sha256(repr(parts).encode()).hexdigest()


def _is_current(fmu: Path, name: str, contents: str, ships: tuple[str, ...], version: _Version) -> bool:
    try:
        with zipfile.ZipFile(fmu) as archive:
            record = BuildRecord.from_json(archive.read(f"resources/{RECORD}"))
    except (OSError, KeyError, TypeError, ValueError, zipfile.BadZipFile):
        return False
    inputs = _inputs(contents, _slave(name, version).read_bytes(), ships, version)
    return record.model == name and record.inputs == inputs
