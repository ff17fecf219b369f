"""Compilation of native FMUs' libraries into the user's cache, with progress."""

from __future__ import annotations

from collections.abc import Sequence

from .console import progress, say

__all__ = ["compile_native"]


def compile_native(platforms: Sequence[str] | None) -> tuple[str, ...]:
    """Compile for the platforms of these names, for all without; returns the names."""
    from ..toolchain import fmu_binaries
    from ..toolchain import platforms as known
    from ..toolchain.load import FETCHING
    from ..toolchain.sources import FMUS

    chosen = tuple(known.PLATFORMS) if platforms is None else tuple(platforms)
    targets = fmu_binaries.choose_platforms(chosen)
    for name in FMUS:
        if fmu_binaries.must_fetch_bullet(name, targets):
            say(FETCHING, err=True)
        with progress(f"native code of {name}") as report:
            fmu_binaries.build_binaries(name, targets, report)
    return chosen
