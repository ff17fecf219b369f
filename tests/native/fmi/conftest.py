"""Instances of the native dummy: the hosts of tests/fmi, of this form alone."""

from __future__ import annotations

import pytest

from tests.fmi.conftest import host, host3

__all__ = ["form", "host", "host3"]


@pytest.fixture
def form() -> str:
    """The dummy without Python inside."""
    return "native"
