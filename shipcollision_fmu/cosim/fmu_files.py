"""Places of the FMUs of a run; they are built when they are missing or older than the sources."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

from ..errors import HostError
from ..files import user_cache
from ..fmi.builder.package import FMUS, are_fmus_current, build_fmus, fmu_file
from ..fmi.interface import SHIPS

__all__ = ["PYBULLET", "fmu_directory", "has_pybullet", "ready_fmus", "require_pybullet"]

_PACKAGE = Path(__file__).resolve().parent.parent


PYBULLET = "run `python -m pip install pybullet` with CPython 3.10 or 3.11 on Linux, for which it has wheels"
"""The remedy where it is missing."""


def has_pybullet() -> bool:
    """Whether pybullet is installed, which detects the contacts."""
    return find_spec("pybullet") is not None


def require_pybullet() -> None:
    """Raise HostError, with the command that installs it, when pybullet is missing."""
    if not has_pybullet():
        raise HostError(f"pybullet, which detects the contacts, is not installed: {PYBULLET}")


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
