"""The .fmu files.

An FMU is a zip archive. It is put together here from pythonfmu's parts (its Python files and its binaries) instead of
by pythonfmu's builder, which runs the slave's code, changes sys.path for good, and stamps time and a random GUID on
the result. Here the same inputs give the same bytes: names sorted, one date, one set of permissions, a GUID that is a
digest of everything else.

    modelDescription.xml
    binaries/linux64|win64/NAME.*           pythonfmu's wrapper
    documentation/                          a page for people, licences
    resources/slavemodule.txt, NAME.py      where the wrapper starts
    resources/pythonfmu/, shipcollision_fmu/, models/
    resources/build.json                    what it was built from (build_record)
    resources/requirements.txt              what the host's Python must have
"""

from __future__ import annotations

import io
import os
import zipfile
from collections.abc import Mapping
from hashlib import sha256
from importlib import import_module, metadata
from pathlib import Path
from uuid import UUID

import pythonfmu

from shipcollision_fmu import __version__
from shipcollision_fmu.errors import HostError
from shipcollision_fmu.fmi import build_record
from shipcollision_fmu.fmi.build_record import RECORD, BuildRecord, package_directory
from shipcollision_fmu.fmi.documentation import page
from shipcollision_fmu.fmi.interface import SHIPS, Interface
from shipcollision_fmu.fmi.model_description import model_description, to_bytes

__all__ = ["FMUS", "REQUIREMENTS", "build_fmus", "fmu_bytes", "fmus_current", "slave_directory"]

FMUS = {"ShipCollision": "ship_collision", "ShipManoeuvring": "ship_manoeuvring"}
"""Name of each FMU, and the module beside this one that holds its INTERFACE."""

REQUIREMENTS = ("numpy>=1.24", "pybullet>=3.2.5", "pydantic>=2.7", "tomli>=2.0; python_version < '3.11'")
"""What the slaves import besides what they carry: the project's dependencies without those of the master and the
command line."""

_DATE = (1980, 1, 1, 0, 0, 0)
"""The earliest that a zip archive can say."""
_BINARIES = (".so", ".dll", ".dylib")


def build_fmus(out: str | Path, *, ships: tuple[str, ...] = SHIPS) -> dict[str, Path]:
    """Write ShipCollision.fmu and ShipManoeuvring.fmu into the folder `out` and return their paths by name.

    `ships` are the names that the collision FMU gives its ships. Both files are written, or neither. Raises HostError.
    """
    built = {name: fmu_bytes(_interface(name), _slave(name).read_bytes(), ships) for name in FMUS}
    return _write(Path(out), built)


def fmus_current(directory: str | Path, *, ships: tuple[str, ...] = SHIPS) -> bool:
    """Whether both FMUs are in `directory` and made from the sources that run now; some ten milliseconds."""
    now = build_record.contents_digest(package_directory())
    return all(_is_current(Path(directory) / f"{name}.fmu", name, now, ships) for name in FMUS)


def fmu_bytes(interface: Interface, slave: bytes, ships: tuple[str, ...] = SHIPS) -> bytes:
    """One FMU as bytes; `slave` is the text of its slave module. Raises HostError when pythonfmu has no binaries."""
    name = interface.name
    files = {
        **_sources(),
        **_pythonfmu(name),
        f"resources/{name}.py": slave,
        "resources/slavemodule.txt": name.encode(),
        "resources/requirements.txt": "".join(f"{line}\n" for line in REQUIREMENTS).encode(),
        "documentation/index.html": page(interface, ships).encode(),
        **_licences(),
    }
    anonymous = to_bytes(model_description(interface, ships, guid=""))
    guid = str(UUID(build_record.digest({**files, "modelDescription.xml": anonymous})[:32]))
    files["modelDescription.xml"] = to_bytes(model_description(interface, ships, guid))
    contents = build_record.contents_digest(package_directory())
    record = BuildRecord(name, __version__, contents, _inputs(contents, slave, ships), ships, guid)
    files[f"resources/{RECORD}"] = record.to_json().encode()
    return _zipped(files)


def slave_directory() -> Path:
    """Where the slave modules lie: inside the package when installed, beside it in a checkout."""
    installed = package_directory() / "fmu_src"
    return installed if installed.is_dir() else package_directory().parent / "fmu_src"


def _interface(name: str) -> Interface:
    found = import_module(f"shipcollision_fmu.fmi.{FMUS[name]}").INTERFACE
    assert isinstance(found, Interface)
    return found


def _slave(name: str) -> Path:
    path = slave_directory() / f"{name}.py"
    if not path.is_file():
        raise HostError(f"{path} is missing: the installation of shipcollision_fmu is not complete, install it again")
    return path


def _sources() -> dict[str, bytes]:
    return {f"resources/{name}": path.read_bytes() for name, path in build_record.contents(package_directory()).items()}


def _pythonfmu(name: str) -> dict[str, bytes]:
    """pythonfmu's Python files, and its wrapper libraries under the FMU's name."""
    home = Path(pythonfmu.__file__).parent
    binaries = home / "resources" / "binaries"
    files = {f"resources/pythonfmu/{path.name}": path.read_bytes() for path in home.glob("*.py")}
    found = {
        f"binaries/{path.parent.name}/{name}{path.suffix}": path.read_bytes()
        for path in binaries.rglob("*")
        if path.suffix in _BINARIES
    }
    if not found:
        raise HostError(f"pythonfmu has no binaries under {binaries}: install pythonfmu 0.7 from its wheel")
    return files | found


def _licences() -> dict[str, bytes]:
    """Of this project and of pythonfmu, as their distributions carry them; a checkout has its own at its root."""
    root = package_directory().parent / "LICENSE"
    ours = root.read_text(encoding="utf-8") if root.is_file() else _distributed("shipcollision-fmu")
    texts = {"shipcollision_fmu": ours, "pythonfmu": _distributed("pythonfmu")}
    return {f"documentation/licenses/{name}.txt": text.encode() for name, text in texts.items() if text}


def _distributed(distribution: str) -> str | None:
    try:
        found = metadata.distribution(distribution)
    except metadata.PackageNotFoundError:
        return None
    return found.read_text("licenses/LICENSE") or found.read_text("LICENSE")


def _inputs(contents: str, slave: bytes, ships: tuple[str, ...]) -> str:
    """Digest of everything an FMU is made from; what pythonfmu gives goes by its version."""
    parts = (contents, sha256(slave).hexdigest(), ships, pythonfmu.__version__, __version__, REQUIREMENTS)
    return sha256(repr(parts).encode()).hexdigest()


def _is_current(fmu: Path, name: str, contents: str, ships: tuple[str, ...]) -> bool:
    try:
        with zipfile.ZipFile(fmu) as archive:
            record = BuildRecord.from_json(archive.read(f"resources/{RECORD}"))
    except (OSError, KeyError, TypeError, ValueError, zipfile.BadZipFile):
        return False
    return record.model == name and record.inputs == _inputs(contents, _slave(name).read_bytes(), ships)


def _zipped(files: Mapping[str, bytes]) -> bytes:
    """A zip archive that depends on names and contents only."""
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w") as archive:
        for name, data in sorted(files.items()):
            entry = zipfile.ZipInfo(name, _DATE)
            entry.create_system = 3  # Unix, also when built elsewhere
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if name.endswith(_BINARIES) else 0o100644) << 16
            archive.writestr(entry, data, compresslevel=9)
    return target.getvalue()


def _write(out: Path, built: Mapping[str, bytes]) -> dict[str, Path]:
    """All files, or none: each beside its place first, then moved there."""
    waiting: dict[Path, Path] = {}
    try:
        out.mkdir(parents=True, exist_ok=True)
        for name, data in built.items():
            path = out / f"{name}.fmu"
            aside = out / f".{name}.{os.getpid()}.tmp"
            waiting[aside] = path
            aside.write_bytes(data)
        for aside, path in waiting.items():
            aside.replace(path)
    except OSError as error:
        reason = error.strerror or error
        raise HostError(f"the FMUs cannot be written to {out}: {reason}; give another folder with --out") from None
    finally:
        for aside in waiting:
            if aside.exists():
                aside.unlink()
    return {path.stem: path for path in waiting.values()}
