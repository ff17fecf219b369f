"""The libraries inside native FMUs, as files below binaries/. One serves every version and flavour of an FMU."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..errors import InputError
from . import libraries
from .bullet_sources import has_bullet_sources
from .compilers import find_compiler
from .libraries import Report, build_libraries, ignore_progress
from .mach_o import join_libraries
from .platforms import PLATFORMS, Platform
from .sources import COLLISION, list_fmu_parts

__all__ = ["Binary", "build_binaries", "choose_platforms", "must_fetch_bullet"]

_EXPORTS = ("fmi2*", "fmi3*")
"""What a host calls."""


@dataclass(frozen=True)
class Binary:
    """A library of an FMU: its folder below binaries/, the end of its name, and the file."""

    folder: str
    suffix: str
    content: bytes


def choose_platforms(names: Sequence[str]) -> tuple[Platform, ...]:
    """The platforms of these names, without repetitions. Raises InputError for an unknown name, and without any."""
    for name in names:
        if name not in PLATFORMS:
            raise InputError(f"platform {name!r} is unknown: give some of {', '.join(PLATFORMS)}")
    if not names:
        raise InputError(f"an FMU needs a platform: give some of {', '.join(PLATFORMS)}")
    return tuple(PLATFORMS[name] for name in dict.fromkeys(names))


def must_fetch_bullet(name: str, platforms: Sequence[Platform]) -> bool:
    """Whether Bullet's source, which takes pip half a minute, is missing for the FMU of that name. Raises HostError
    where it would be fetched in vain, since nothing here compiles for a platform."""
    if name != COLLISION or has_bullet_sources(libraries.native_cache()):
        return False
    for platform in platforms:
        for target in platform.targets:
            find_compiler(target)
    return True


def build_binaries(
    name: str, platforms: Sequence[Platform], report: Report = ignore_progress
) -> dict[int, list[Binary]]:
    """The libraries of the FMU of that name, by version of FMI.

    The folders of FMI 2.0 hold the universal file of all targets of a platform, those of FMI 3.0 the targets one by
    one. Raises HostError when nothing here compiles for a target, and when Bullet's source is needed and cannot be
    fetched.
    """
    targets = [target for platform in platforms for target in platform.targets]
    must_fetch_bullet(name, platforms)
    built = build_libraries(name, list_fmu_parts(name, libraries.native_cache()), targets, _EXPORTS, report=report)
    contents = {target: path.read_bytes() for target, path in built.items()}
    joined = []
    for platform in platforms:
        slices = [contents[target] for target in platform.targets]
        whole = slices[0] if len(slices) == 1 else join_libraries(slices)
        joined.append(Binary(platform.name, platform.targets[0].suffix, whole))
    return {2: joined, 3: [Binary(target.folder, target.suffix, data) for target, data in contents.items()]}
