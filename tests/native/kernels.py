"""evaluate(): the parts of the native ship model one by one, compiled together with the library."""

from __future__ import annotations

import ctypes
from functools import cache
from pathlib import Path

import numpy as np

from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.toolchain.libraries import build_library, native_cache
from shipcollision_fmu.toolchain.load import EXPORTS
from shipcollision_fmu.toolchain.platforms import find_own_target
from shipcollision_fmu.toolchain.sources import Part, find_native

__all__ = ["evaluate", "find_ship_model", "load_kernels"]

CACHE = native_cache()
"""Taken before the tests set another cache."""
HERE = Path(__file__).parent
FOLDERS = ("numbers/", "ship/", "manoeuvring/", "f", "memory", "python_ship", "wide_path")
"""Of native/, what the ship model needs: without collision/ it compiles without Bullet's source."""


def find_ship_model() -> Part:
    """The sources of the ship model."""
    native = find_native()
    files = [file for folder in FOLDERS for file in native.glob(f"{folder}*.cpp")]
    return Part(native, tuple(sorted(file.relative_to(native).as_posix() for file in files)))


@cache
def load_kernels() -> ctypes.CDLL:
    """The library with the parts of tests/native/kernels.cpp."""
    target = find_own_target()
    assert target is not None
    parts = [find_ship_model(), Part(HERE, ("kernels.cpp",))]
    return ctypes.CDLL(str(build_library("kernels", parts, target, EXPORTS, cache=CACHE, prefer_system=True)))


def evaluate(name: str, ship: bytes, inputs: Array, outs: int) -> Array:
    """The outputs (n, outs) of a kernel for inputs (n, k) and a prepared ship; b"" for a kernel that needs none."""
    inputs = np.ascontiguousarray(inputs, dtype=float)
    outputs = np.full((len(inputs), outs), np.nan)
    pointer = ctypes.POINTER(ctypes.c_double)
    done = load_kernels().shipcollision_evaluate(
        name.encode(), ship, ctypes.c_size_t(len(ship)), inputs.ctypes.data_as(pointer),
        ctypes.c_size_t(inputs.shape[1]), outputs.ctypes.data_as(pointer), ctypes.c_size_t(outs),
        ctypes.c_size_t(len(inputs)),
    )  # fmt: skip
    assert done & 1
    return outputs
