"""Native FMUs of the test models, made once, and instances of them as a host sees them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from shipcollision_fmu.toolchain.libraries import native_cache
from tests.fmi.conftest import Host
from tests.fmi.Dummy import INTERFACE

from .native_fmus import build_test_library, write_fmu

CACHE = native_cache()
"""Taken before the tests set another cache."""


@pytest.fixture(scope="session")
def test_library() -> Path:
    """The library of the test models."""
    return build_test_library(CACHE)


@pytest.fixture(scope="session")
def native_dummies(test_library: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Unpacked FMUs of the dummy, by flavour: "2", "3", and "3-scalar"."""
    home = tmp_path_factory.mktemp("native")
    return {
        "2": write_fmu(home / "2", test_library, INTERFACE),
        "3": write_fmu(home / "3", test_library, INTERFACE, 3),
        "3-scalar": write_fmu(home / "3-scalar", test_library, INTERFACE, 3, scalar=True),
    }


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
