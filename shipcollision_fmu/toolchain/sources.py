"""What libraries are compiled from: native/, Bullet's source and the headers of FMI."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from ..errors import HostError, describe_installation
from .bullet_sources import DEFINES, SHAPES, find_bullet_sources

__all__ = [
    "COLLISION", "FMUS", "Part", "find_fmi_headers", "find_native", "list_fmu_parts", "list_library_parts",
]  # fmt: skip

_WARNINGS = ("-Wall", "-Wextra", "-Werror")

COLLISION = "ShipCollision"
_FOLDERS = {COLLISION: "collision", "ShipManoeuvring": "manoeuvring"}
"""Folder of native/ with the model of an FMU, by its name."""
_OF_FMI = {
    COLLISION: ("fmi/framed_collision.cpp", "fmi/ship_collision.cpp"),
    "ShipManoeuvring": ("fmi/ship_manoeuvring.cpp",),
}
"""What makes an FMU of it."""
FMUS = tuple(_FOLDERS)
"""Names of the FMUs that there are libraries for."""


@dataclass(frozen=True)
class Part:
    """Sources that are compiled alike.

    root      folder that they are compiled in, so that no object has a path of this machine
    files     names of the .cpp files, below root
    flags     beside those that all parts have
    includes  folders with headers of others
    """

    root: Path
    files: tuple[str, ...]
    flags: tuple[str, ...] = _WARNINGS
    includes: tuple[Path, ...] = ()


def find_native() -> Path:
    """Folder of the C++ sources: inside an installed package, beside the package in a working copy."""
    package = Path(__file__).resolve().parents[1]
    inside = package / "native"
    found = inside if inside.is_dir() else package.parent / "native"
    if not found.is_dir():
        raise HostError(f"{found} is missing: the installation of shipcollision_fmu is not complete, install it again")
    return found


def find_fmi_headers() -> Path:
    """Folder of the headers of FMI 2.0 and 3.0, which fmpy carries."""
    found = find_spec("fmpy")
    folder = Path(found.origin).parent / "c-code" if found is not None and found.origin is not None else None
    if folder is None or not (folder / "fmi3Functions.h").is_file():
        raise HostError(f"the headers of FMI, which fmpy carries, are missing: {describe_installation()}")
    return folder


def list_library_parts(cache: Path) -> list[Part]:
    """Of the library for Python: all models, without the functions of FMI. Bullet's source is kept in `cache`. Raises
    HostError when it cannot be fetched."""
    return [Part(find_native(), _list_sources(without=("fmi", "collision"))), *_list_collision_parts(cache)]


def list_fmu_parts(name: str, cache: Path) -> list[Part]:
    """Of the library inside the FMU of that name: its model and the functions of FMI, without what Python alone calls.
    That of ShipCollision has Bullet in it, whose source is kept in `cache`. Raises HostError when it cannot be
    fetched."""
    others = tuple(file for fmu, files in _OF_FMI.items() if fmu != name for file in files)
    found = _list_sources(without=("batch", *_FOLDERS.values()))
    own = _list_sources(only=_FOLDERS[name]) if name != COLLISION else ()
    files = sorted(file for file in (*found, *own) if not file.startswith("python") and file not in others)
    collision = _list_collision_parts(cache) if name == COLLISION else []
    return [Part(find_native(), tuple(files), includes=(find_fmi_headers(),)), *collision]


def _list_collision_parts(cache: Path) -> list[Part]:
    """The collision model, and Bullet."""
    bullet = find_bullet_sources(cache)
    defines = tuple(f"-D{name}" for name in DEFINES)
    return [
        Part(find_native(), _list_sources(only="collision"), (*_WARNINGS, *defines), (bullet,)),
        Part(bullet, tuple(f"{name}.cpp" for name in SHAPES), ("-w", *defines), (bullet,)),
    ]


def _list_sources(without: tuple[str, ...] = (), only: str = "") -> tuple[str, ...]:
    native = find_native()
    found = (path.relative_to(native) for path in (native / only).rglob("*.cpp"))
    return tuple(sorted(path.as_posix() for path in found if path.parts[0] not in without))
