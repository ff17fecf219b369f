"""The native library of the user's cache, as in tests/batch: studies of the guide use it."""

from __future__ import annotations

import pytest


@pytest.fixture(autouse=True, scope="module")
def _kept_library(kept_library: None) -> None:
    """In every module."""
