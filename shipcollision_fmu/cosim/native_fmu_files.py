"""Native FMUs of a run: made for it, with the prepared files of its scenario; their libraries are compiled once."""

from __future__ import annotations

from pathlib import Path

from ..errors import HostError
from ..files import write_files
from ..fmi.builder.native_fmus import NATIVE_FMUS, native_fmu_bytes, native_fmu_file
from ..ship.loading.library import list_ship_names
from ..toolchain.fmu_binaries import Binary, build_binaries, must_fetch_bullet
from ..toolchain.load import FETCHING, announce_compiling, say
from ..toolchain.platforms import Platform, find_own_platform
from .prepared_files import PreparedFiles

__all__ = ["require_own_platform", "write_native_fmus"]


def require_own_platform() -> Platform:
    """The platform of this machine. Raises HostError when native code is not for it."""
    platform = find_own_platform()
    if platform is None:
        raise HostError("native code is for Linux and macOS on x86-64 and ARM, and for Windows on x86-64")
    return platform


def write_native_fmus(out: Path, ships: tuple[str, ...], prepared: PreparedFiles, fmi: int = 2) -> dict[str, Path]:
    """Both FMUs for this machine, written into the folder `out`, by name.

    Lines on stderr announce what takes long at first use. Raises HostError when they cannot be built.
    """
    platform = require_own_platform()
    shipped = sorted(set(prepared.ships.values()) & set(list_ship_names()))
    files = {
        native_fmu_file(name, fmi): native_fmu_bytes(
            interface, _compile(name, platform)[fmi], ships, fmi,
            resources=prepared.list_collision_files(), shipped=shipped,
        )
        for name, interface in NATIVE_FMUS.items()
    }  # fmt: skip
    write_files(out, files)
    return {name: out / native_fmu_file(name, fmi) for name in NATIVE_FMUS}


def _compile(name: str, platform: Platform) -> dict[int, list[Binary]]:
    """The libraries of an FMU, by version of FMI; what takes long is announced."""
    if must_fetch_bullet(name, [platform]):
        say(FETCHING)
    return build_binaries(name, [platform], announce_compiling(f"native code of {name}"))
