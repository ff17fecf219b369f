"""evaluate(): the parts of native/collision one by one, compiled together with the library."""

from __future__ import annotations

import ctypes
from functools import cache
from pathlib import Path

import numpy as np

from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.toolchain.libraries import build_library, native_cache
from shipcollision_fmu.toolchain.load import EXPORTS
from shipcollision_fmu.toolchain.platforms import find_own_target
from shipcollision_fmu.toolchain.sources import Part, list_library_parts

__all__ = ["evaluate", "load_kernels"]

CACHE = native_cache()
"""Taken before the tests set another cache."""
HERE = Path(__file__).parent


@cache
def load_kernels() -> ctypes.CDLL:
    """The library with the parts of all files kernels_*.cpp."""
    target = find_own_target()
    assert target is not None
    files = tuple(sorted(path.name for path in HERE.glob("kernels_*.cpp")))
    parts = [*list_library_parts(CACHE), Part(HERE, files)]
    return ctypes.CDLL(str(build_library("collision_kernels", parts, target, EXPORTS, cache=CACHE, prefer_system=True)))


def evaluate(file: str, name: str, inputs: object, outs: int) -> Array:
    """The outputs (n, outs) of a kernel of kernels_FILE.cpp for inputs (n, k); what it does not write is nan."""
    rows = np.ascontiguousarray(inputs, dtype=float)
    outputs = np.full((len(rows), outs), np.nan)
    function = load_kernels()[f"shipcollision_evaluate_{file}"]
    function.restype = ctypes.c_bool
    pointer = ctypes.POINTER(ctypes.c_double)
    done = function(
        name.encode(), rows.ctypes.data_as(pointer), ctypes.c_size_t(rows.shape[1]), outputs.ctypes.data_as(pointer),
        ctypes.c_size_t(outs), ctypes.c_size_t(len(rows)),
    )  # fmt: skip
    assert done
    return outputs
