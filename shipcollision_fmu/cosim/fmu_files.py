"""Places of the FMUs of a run; they are built when they are missing or older than the sources."""

from __future__ import annotations

from pathlib import Path

from ..files import user_cache
from ..fmi.builder.package import FMUS, are_fmus_current, build_fmus, fmu_file
from ..fmi.interface import SHIPS

__all__ = ["fmu_directory", "ready_fmus"]

_PACKAGE = Path(__file__).resolve().parent.parent


def fmu_directory(ships: tuple[str, ...] = SHIPS) -> Path:
    """Folder of the FMUs for these names of ships: build/ of a checkout, else in the user's cache."""
    in_checkout = (_PACKAGE.parent / "pyproject.toml").is_file()
    home = _PACKAGE.parent / "build" if in_checkout else user_cache()
    return home if ships == SHIPS else home / "-".join(ships)


def ready_fmus(ships: tuple[str, ...] = SHIPS, fmi: int = 2) -> dict[str, Path]:
    """Both FMUs by name, up to date, for FMI 2.0 or 3.0. Raises HostError when they cannot be built."""
    directory = fmu_directory(ships)
    if not are_fmus_current(directory, ships=ships, fmi=fmi):
        return build_fmus(directory, ships=ships, fmi=fmi)
    return {name: directory / fmu_file(name, fmi) for name in FMUS}
