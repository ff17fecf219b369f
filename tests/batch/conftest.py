"""The native library of the user's cache: what is compiled stays there, and the next run is fast."""

from __future__ import annotations

import pytest


@pytest.fixture(autouse=True, scope="module")
def _kept_library(kept_library: None) -> None:
    """In every module."""
