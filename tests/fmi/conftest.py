"""The dummy FMU, built once and unpacked once, and instances of it as a host sees them."""

from __future__ import annotations

import importlib.util
import json
import sys
from collections import defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave, byref, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

from shipcollision_fmu.fmi.builder.package import build_fmus, fmu_bytes
from shipcollision_fmu.fmi.variable_access import VariableAccess

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


class Host:
    """An instance, its variables by name, and what it logged as (status, message).

    refusal: the status of a step that the standard calls an error; Python's wrapper has Discard alone to answer with.
    """

    refusal = 0

    def __init__(self, unpacked: Path, name: str, logging: bool = True) -> None:
        description = read_model_description(str(unpacked))
        self.references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.kinds: dict[str, list[int]] = defaultdict(list)
        for variable in description.modelVariables:
            self.kinds[variable.type].append(variable.valueReference)
        self.messages: list[tuple[int, str]] = []
        self.categories: list[str] = []
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(self._take)
        callbacks.allocateMemory = defaultCallbacks.allocateMemory
        callbacks.freeMemory = defaultCallbacks.freeMemory
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=str(unpacked),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.fmu.instantiate(callbacks=callbacks, loggingOn=logging)
        self.dll: Any = self.fmu.dll
        self.component: Any = self.fmu.component

    def _take(self, env: Any, who: bytes, status: int, category: bytes | None, message: bytes) -> None:
        self.messages.append((status, message.decode()))
        self.categories.append((category or b"").decode())

    def free(self) -> None:
        if self.component is not None:
            self.fmu.freeInstance()
            self.component = None

    def reference(self, *names: str) -> list[int]:
        return [self.references[name] for name in names]

    def reals(self, *names: str) -> list[float]:
        values: list[float] = self.fmu.getReal(self.reference(*names))
        return values

    def place(self) -> list[float]:
        return self.reals("place.x", "place.y", "place.z")

    def begin(self, start: float = 0.0, stop: float | None = None) -> int:
        """Through initialisation; the status of its end."""
        self.fmu.setupExperiment(startTime=start, stopTime=stop)
        self.fmu.enterInitializationMode()
        status: int = self.dll.fmi2ExitInitializationMode(self.component)
        return status

    def step(self, k: int, h: float = 0.1) -> int:
        status: int = self.dll.fmi2DoStep(self.component, k * h, h, 1)
        return status

    def everything(self) -> str:
        """All values, exactly."""
        return json.dumps([
            self.fmu.getReal(self.kinds["Real"]),
            self.fmu.getInteger(self.kinds["Integer"] + self.kinds["Enumeration"]),
            self.fmu.getBoolean(self.kinds["Boolean"]),
            [text.decode() for text in self.fmu.getString(self.kinds["String"])],
        ])  # fmt: skip

    def saved(self) -> bytes:
        """The whole state as bytes."""
        state = self.fmu.getFMUstate()
        try:
            data: bytes = self.fmu.serializeFMUstate(state)
        finally:
            self.fmu.freeFMUstate(state)
        return data

    def restore(self, data: bytes) -> int:
        state = self.fmu.deSerializeFMUstate(data)
        status: int = self.dll.fmi2SetFMUstate(self.component, state)
        self.dll.fmi2FreeFMUstate(self.component, byref(state))
        return status


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
    python, native = (
        (lambda: request.getfixturevalue("unpacked")),
        lambda: request.getfixturevalue("native_dummies")["2"],
    )
    dummy: Path = python() if form == "Python" else native()

    def make(name: str = "instance", *, logging: bool = True, at: Path = dummy) -> Host:
        made.append(Host(at, name, logging))
        made[-1].refusal = DISCARD if form == "Python" else ERROR
        return made[-1]

    yield make
    for instance in made:
        instance.free()
