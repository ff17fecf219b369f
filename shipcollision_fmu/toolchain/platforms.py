"""Platforms that a native FMU can be built for, by the names that FMI 2.0 gives their folders."""

from __future__ import annotations

import platform
import sys
from dataclasses import dataclass

__all__ = ["PLATFORMS", "Platform", "Target", "find_own_platform", "find_own_target"]


@dataclass(frozen=True)
class Target:
    """One instruction set on one system.

    zig     what Zig's compiler calls it, with the oldest system that a library runs on
    folder  below binaries/ of an FMU of FMI 3.0
    """

    zig: str
    folder: str

    @property
    def is_windows(self) -> bool:
        """Whether libraries are PE files."""
        return self.folder.endswith("-windows")

    @property
    def is_macos(self) -> bool:
        """Whether libraries are Mach-O files."""
        return self.folder.endswith("-darwin")

    @property
    def suffix(self) -> str:
        """Of a shared library."""
        return ".dll" if self.is_windows else ".dylib" if self.is_macos else ".so"


@dataclass(frozen=True)
class Platform:
    """What goes into one folder of FMI 2.0; several targets share a universal file there."""

    name: str
    targets: tuple[Target, ...]


# glibc 2.17 is that of 2012; any later number leaves out older systems of the hosts' vendors.
_LINUX_X86 = Target("x86_64-linux-gnu.2.17", "x86_64-linux")
_LINUX_ARM = Target("aarch64-linux-gnu.2.17", "aarch64-linux")
_WINDOWS_X86 = Target("x86_64-windows-gnu", "x86_64-windows")
# macOS 11 is the first on both instruction sets.
_MACOS_X86 = Target("x86_64-macos.11.0", "x86_64-darwin")
_MACOS_ARM = Target("aarch64-macos.11.0", "aarch64-darwin")

PLATFORMS = {
    one.name: one
    for one in (
        Platform("linux64", (_LINUX_X86,)),
        Platform("win64", (_WINDOWS_X86,)),
        Platform("darwin64", (_MACOS_X86, _MACOS_ARM)),
        Platform("aarch64-linux", (_LINUX_ARM,)),
    )
}
"""By name. FMI 2.0 standardises the first three; hosts on ARM look for the fourth."""

_SYSTEMS = {"linux": "linux", "win32": "windows", "darwin": "darwin"}
_MACHINES = {"x86_64": "x86_64", "amd64": "x86_64", "aarch64": "aarch64", "arm64": "aarch64"}


def find_own_platform() -> Platform | None:
    """The platform that this Python runs on, None when it is none of PLATFORMS."""
    own = find_own_target()
    return next((one for one in PLATFORMS.values() if own in one.targets), None)


def find_own_target() -> Target | None:
    """The target that this Python runs on, None when it is none of PLATFORMS."""
    own = f"{_MACHINES.get(platform.machine().lower())}-{_SYSTEMS.get(sys.platform)}"
    return next((target for one in PLATFORMS.values() for target in one.targets if target.folder == own), None)
