"""The native library of the user's cache, as in tests/batch."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from shipcollision_fmu.toolchain import libraries

CACHE = libraries.native_cache()
"""Taken before the tests set another cache."""


@pytest.fixture(autouse=True, scope="module")
def _kept_library() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(libraries, "native_cache", lambda: CACHE)
        yield
