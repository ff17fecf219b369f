"""What an FMU was built from, and whether that is what is running.

All FMUs in a process share one interpreter and its imported modules: the second FMU that brings a package of the same
name silently runs the first one's code, and a package that the host has imported before wins over both. So every FMU
carries a record of the sources it was built from, and refuses to run on others.

    resources/build.json    {"model", "version", "contents", "inputs", "ships", "guid", "wrapper",
                             "scalar"}

`contents` is a digest of the packed sources and ship data, `inputs` one of everything the file was made from, `wrapper`
the package and version whose binaries call the slave: an FMU of somebody else may bring another version of it.
"""

from __future__ import annotations

import json
import sys
from dataclasses import asdict, dataclass, fields
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import shipcollision_fmu

from ..errors import HostError

__all__ = [
    "CARRIED",
    "RECORD",
    "START",
    "BuildRecord",
    "confirm_build",
    "digest",
    "digest_contents",
    "list_contents",
    "name_running_build",
    "package_directory",
    "read_start_values",
]  # fmt: skip

RECORD = "build.json"
"""Name of the record among the resources of an FMU."""
START = "start.json"
"""Name of the start values, in an FMU that has its own."""

CARRIED = (
    "__init__.py", "errors.py", "files.py", "collision/**/*.py", "fmi/*.py", "manoeuvring/*.py", "ship/**/*.py",
    "toolchain/__init__.py", "toolchain/installed.py", "toolchain/load.py", "toolchain/platforms.py",
)  # fmt: skip
"""Files of the package that travel in an FMU: the models with all that they import, and the slaves. What is not named
here stays at home, as the rooms inside fmi and manoeuvring do. A module that a slave imports and that is missing here
makes the FMU fail in a host without the package."""
_DATA = ("hulls/**/*", "ships/**/*")
"""Files under models/ that ships are made from."""


@dataclass(frozen=True)
class BuildRecord:
    """What an FMU was built from."""

    model: str
    version: str
    contents: str
    inputs: str
    ships: tuple[str, ...]
    guid: str
    wrapper: str
    scalar: bool = False
    """FMI 3.0 without arrays."""

    def to_json(self) -> str:
        """As it is stored."""
        return json.dumps(asdict(self), indent=1, sort_keys=True) + "\n"

    @classmethod
    def from_json(cls, text: str | bytes) -> BuildRecord:
        """Raises ValueError, KeyError or TypeError for anything else than a record.

        What another version of the package records besides is left out, and what it does not is empty: it is read to
        say which version that is.
        """
        data = json.loads(text)
        known = {"inputs": "", "wrapper": "", **{f.name: data[f.name] for f in fields(cls) if f.name in data}}
        return cls(**{**known, "ships": tuple(data["ships"])})


def package_directory() -> Path:
    """Where the package that runs was imported from."""
    return Path(shipcollision_fmu.__file__).parent


def list_contents(package: Path) -> dict[str, Path]:
    """Files of the package that an FMU carries, by their name inside its resources, in order.

    The ship data lies in package/models when installed and beside the package in a checkout and in an FMU; inside an
    FMU it has one name.
    """
    models = package / "models" if (package / "models").is_dir() else package.parent / "models"
    found: dict[str, Path] = {}
    for root, top, patterns in ((package, package.name, CARRIED), (models, "models", _DATA)):
        for path in (path for pattern in patterns for path in root.glob(pattern)):
            inside = path.relative_to(root)
            if path.is_file() and not any(part == "__pycache__" or part.startswith(".") for part in inside.parts):
                found[f"{top}/{inside.as_posix()}"] = path
    return dict(sorted(found.items()))


def digest(files: dict[str, bytes]) -> str:
    """One number for named contents, whatever their order."""
    total = sha256()
    for name, data in sorted(files.items()):
        total.update(f"{name}\0{len(data)}\0".encode() + data)
    return total.hexdigest()


def digest_contents(package: Path) -> str:
    """Digest of what an FMU of this package carries; a few milliseconds."""
    return digest({name: path.read_bytes() for name, path in list_contents(package).items()})


@cache
def confirm_build(resources: str, wrapper: str) -> BuildRecord:
    """The record of the FMU unpacked at `resources`, after a check of the running package and of the wrapper.

    The running package must be the package that the FMU was built from. `wrapper` is the imported "package version"
    around the slave; its series must be that of the build. Raises HostError with what was imported and from where.
    """
    here = Path(resources)
    try:
        record = BuildRecord.from_json((here / RECORD).read_bytes())
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise HostError(f"{here} has no record of what the FMU was built from ({error!r}); build it again") from None
    version, running = shipcollision_fmu.__version__, _running_digest()
    if (version, running) != (record.version, record.contents):
        raise HostError(
            f"{record.model}.fmu was built from shipcollision_fmu {record.version} ({record.contents[:12]}), but "
            f"this process has imported {version} ({running[:12]}) from {package_directory()}; build the FMU again "
            "from that package, or keep the host from importing it"
        )
    if _series(wrapper) != _series(record.wrapper):
        raise HostError(
            f"{record.model}.fmu was built with {record.wrapper}, but this process has imported {wrapper}, perhaps "
            "from another FMU: install the same version in the host, or run the two in processes of their own"
        )
    if not package_directory().is_dir():
        _relocate(here)
    return record


def _series(wrapper: str) -> str:
    """Package and version without its last part: "pythonfmu 0.7.1" -> "pythonfmu 0.7"."""
    return wrapper.rpartition(".")[0]


def read_start_values(resources: str) -> dict[str, Any]:
    """Start values by name that replace the model's own in the FMU unpacked at `resources`; most FMUs have none."""
    path = Path(resources) / START
    found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    return found


def name_running_build() -> str:
    """The package that runs, for people and for comparison: its version and the first digits of its digest."""
    return f"{shipcollision_fmu.__version__} {_running_digest()[:12]}"


@cache
def _running_digest() -> str:
    """Of the package that runs, when first asked: its folder may be gone later."""
    return digest_contents(package_directory())


def _relocate(resources: Path) -> None:
    """Point the imported modules to this copy of their sources and data.

    Hosts delete the folder of an FMU after use, the modules loaded from it stay, and so does their idea of where the
    ship data is. The copies are known to be the same.
    """
    gone = package_directory()
    for name, module in list(sys.modules.items()):
        if name == gone.name or name.startswith(f"{gone.name}."):
            file = getattr(module, "__file__", None)
            if file:
                moved = resources / gone.name / Path(file).relative_to(gone)
                module.__file__ = str(moved)
                if hasattr(module, "__path__"):
                    module.__path__ = [str(moved.parent)]
