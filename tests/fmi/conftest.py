"""The dummy FMU, built once and unpacked once, and instances of it as a host sees them."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType

import pytest
from fmpy import extract

from shipcollision_fmu.fmi.builder.package import build_fmus, fmu_bytes
from shipcollision_fmu.fmi.variable_access import VariableAccess

from .hosts import Host, Host3

DISCARD, ERROR = 2, 3
DUMMY = Path(__file__).with_name("Dummy.py")


@pytest.fixture(scope="session")
def dummy() -> ModuleType:
    """The slave module of the dummy, under a name that the FMU's wrapper will not find."""
    spec = importlib.util.spec_from_file_location("dummy_of_the_tests", DUMMY)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def access(dummy: ModuleType) -> VariableAccess:
    """A fresh dummy model, in process."""
    made: VariableAccess = dummy.INTERFACE.make_access()
    return made


@pytest.fixture(scope="session")
def dummy_fmu(dummy: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("fmu") / "Dummy.fmu"
    path.write_bytes(fmu_bytes(dummy.INTERFACE, DUMMY.read_bytes()))
    return path


@pytest.fixture(scope="session")
def unpacked3(dummy: ModuleType, tmp_path_factory: pytest.TempPathFactory, _tidy_path: None) -> Path:
    """The dummy for FMI 3.0: the same text with the other base."""
    return _unpacked_for_fmi3(dummy, tmp_path_factory.mktemp("fmu3"), scalar=False)


@pytest.fixture(scope="session")
def unpacked_scalar(dummy: ModuleType, tmp_path_factory: pytest.TempPathFactory, _tidy_path: None) -> Path:
    """The same without arrays."""
    return _unpacked_for_fmi3(dummy, tmp_path_factory.mktemp("fmu3-scalar"), scalar=True)


def _unpacked_for_fmi3(dummy: ModuleType, folder: Path, *, scalar: bool) -> Path:
    text = DUMMY.read_text(encoding="utf-8")
    text = text.replace("fmi.slave import ModelSlave", "fmi.slave_fmi3 import Fmi3Slave, ModelSlave3")
    text = text.replace("class Dummy(ModelSlave)", "class Dummy(ModelSlave3, Fmi3Slave)")
    path = folder / "Dummy.fmi3.fmu"
    path.write_bytes(fmu_bytes(dummy.INTERFACE, text.encode(), fmi=3, scalar=scalar))
    return Path(extract(path, folder / "unpacked"))


@pytest.fixture(scope="session")
def _tidy_path() -> Iterator[None]:
    """The wrapper leaves the resources of every FMU on sys.path."""
    before = list(sys.path)
    yield
    sys.path[:] = before


@pytest.fixture(scope="session")
def unpacked(dummy_fmu: Path, tmp_path_factory: pytest.TempPathFactory, _tidy_path: None) -> Path:
    return Path(extract(dummy_fmu, tmp_path_factory.mktemp("unpacked")))


@pytest.fixture(scope="session")
def real_fmus(tmp_path_factory: pytest.TempPathFactory) -> dict[tuple[str, int], Path]:
    """Files of both FMUs, by name and version of FMI."""
    folder = tmp_path_factory.mktemp("real") / "new" / "folder"
    return {(name, fmi): path for fmi in (2, 3) for name, path in build_fmus(folder, fmi=fmi).items()}


@pytest.fixture(scope="session")
def real_unpacked(
    real_fmus: dict[tuple[str, int], Path], tmp_path_factory: pytest.TempPathFactory, _tidy_path: None
) -> dict[tuple[str, int], Path]:
    """Both FMUs unpacked, by name and version of FMI."""
    return {
        which: Path(extract(path, tmp_path_factory.mktemp(f"{which[0]}{which[1]}")))
        for which, path in real_fmus.items()
    }


OF_PYTHON = pytest.mark.parametrize("form", ["Python"], indirect=True)
"""Marks what the wrapper of Python alone does, or does in its own way; tests/native/fmi has native code's."""


@pytest.fixture(params=["Python", "native"])
def form(request: pytest.FixtureRequest) -> str:
    """The dummy with Python inside, and its twin without: what holds for both is tested of both."""
    name: str = request.param
    return name


@pytest.fixture
def host(form: str, request: pytest.FixtureRequest) -> Iterator[Callable[..., Host]]:
    """Makes instances of the dummy FMU, and frees them."""
    made: list[Host] = []
    fixture = request.getfixturevalue
    dummy: Path = fixture("unpacked") if form == "Python" else fixture("native_dummies")["2"]

    def make(name: str = "instance", *, logging: bool = True, at: Path = dummy) -> Host:
        made.append(Host(at, name, logging))
        made[-1].refusal = DISCARD if form == "Python" else ERROR
        return made[-1]

    yield make
    for instance in made:
        instance.free()


@pytest.fixture
def host3(form: str, request: pytest.FixtureRequest) -> Iterator[Callable[..., Host3]]:
    """Makes instances of the dummy FMU for FMI 3.0, with arrays or without, and frees them."""
    made: list[Host3] = []
    fixture = request.getfixturevalue

    def make(name: str = "instance", flavour: str = "3") -> Host3:
        python = {"3": "unpacked3", "3-scalar": "unpacked_scalar"}
        folder: Path = fixture(python[flavour]) if form == "Python" else fixture("native_dummies")[flavour]
        made.append(Host3(folder, name))
        return made[-1]

    yield make
    for instance in made:
        instance.free()
