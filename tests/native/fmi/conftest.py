"""Instances of the native dummy as a host sees them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.fmi.conftest import Host


@pytest.fixture
def host(native_dummies: dict[str, Path]) -> Iterator[Callable[..., Host]]:
    """Makes instances of the dummy for FMI 2.0, and frees them."""
    made: list[Host] = []

    def make(name: str = "instance", *, logging: bool = True) -> Host:
        made.append(Host(native_dummies["2"], name, logging))
        return made[-1]

    yield make
    for instance in made:
        instance.free()
