"""The native library, compiled once for all tests. What is compiled stays in the user's cache: the next run is fast."""

from __future__ import annotations

import ctypes

import pytest

from shipcollision_fmu.toolchain.libraries import native_cache
from shipcollision_fmu.toolchain.load import load_library

CACHE = native_cache()
"""Taken before the tests set another cache. What is in it depends on the sources alone."""


@pytest.fixture(scope="session")
def native_library() -> ctypes.CDLL:
    """All of native/ but the functions of FMI."""
    return load_library(CACHE)
