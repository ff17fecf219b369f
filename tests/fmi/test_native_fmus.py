"""The .fmu files without Python: contents, description, start values, ships of one instance, sources."""

from __future__ import annotations

import logging
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from xml.etree import ElementTree

import fmpy
import pytest
from fmpy.validation import validate_fmu
from fmu_manipulation_toolbox.checker import get_checkers
from fmu_manipulation_toolbox.operations import FMU

from shipcollision_fmu.compliance.report import validate
from shipcollision_fmu.errors import HostError, InputError
from shipcollision_fmu.fmi.builder import native_fmus as builder
from shipcollision_fmu.fmi.builder.native_fmus import (
    NATIVE_FMUS,
    build_native_fmus,
    native_fmu_bytes,
    native_fmu_file,
    native_instance_fmu,
)
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE
from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from shipcollision_fmu.ship.loading.library import list_ship_names
from shipcollision_fmu.toolchain import libraries
from shipcollision_fmu.toolchain.bullet_sources import DEFINES
from shipcollision_fmu.toolchain.compilers import find_compiler
from shipcollision_fmu.toolchain.fmu_binaries import Binary, choose_platforms
from shipcollision_fmu.toolchain.objects import FLAGS, run
from shipcollision_fmu.toolchain.platforms import find_own_target
from tests.conftest import NATIVE_CACHE
from tests.ship_files import ship_toml

BINARIES = [Binary("linux64", ".so", b"ELF"), Binary("darwin64", ".dylib", b"MACH")]
"""In place of libraries, where none is called."""
FLAVOURS = ("2", "3", "3-scalar")


NAMES = ("ShipManoeuvring", pytest.param("ShipCollision", marks=pytest.mark.slow))


@pytest.fixture(params=NAMES)
def built(request: pytest.FixtureRequest) -> dict[str, Path]:
    """One FMU by flavour."""
    of: dict[str, Path] = request.getfixturevalue(
        "native_fmus" if request.param == "ShipManoeuvring" else "native_collisions"
    )
    return of


@pytest.fixture(autouse=True)
def _few_ships(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch, native_fmus: dict[str, Path]) -> None:
    """After the real FMUs: the mesh of a shipped ship takes seconds to be cut. Bullet's source is there for them."""
    for fixture in {"built", "native_collisions"} & set(request.fixturenames):
        request.getfixturevalue(fixture)
    monkeypatch.setattr(builder, "list_ship_names", lambda: ["buoy", "kvlcc2"])
    monkeypatch.setattr(libraries, "native_cache", lambda: NATIVE_CACHE)


def contents(fmu: bytes | Path, tmp_path: Path) -> dict[str, bytes]:
    """The files of an FMU by name."""
    path = fmu if isinstance(fmu, Path) else tmp_path / "ShipManoeuvring.fmu"
    if isinstance(fmu, bytes):
        path.write_bytes(fmu)
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def test_what_is_in_an_fmu(tmp_path: Path) -> None:
    files = contents(native_fmu_bytes(NATIVE_FMUS["ShipManoeuvring"], BINARIES), tmp_path)
    assert sorted(files) == sorted([
        "binaries/darwin64/ShipManoeuvring.dylib", "binaries/linux64/ShipManoeuvring.so",
        "documentation/index.html", "documentation/licenses/fmi_headers.txt", "documentation/licenses/license.txt",
        "documentation/licenses/shipcollision_fmu.txt", "model.png", "modelDescription.xml", "resources/variables.txt",
        "resources/ships/buoy.ship", "resources/ships/kvlcc2.ship",
    ])  # fmt: skip
    assert files["binaries/linux64/ShipManoeuvring.so"] == b"ELF"
    assert files["resources/ships/kvlcc2.ship"] == prepare_ship("kvlcc2")
    assert b"Python" not in files["modelDescription.xml"]
    assert b"linux64, darwin64" in files["documentation/index.html"]
    licence = files["documentation/licenses/license.txt"].decode()
    assert all(
        name.rpartition("/")[2] in licence for name in files if "licenses/" in name and "license.txt" not in name
    )
    assert files["documentation/licenses/fmi_headers.txt"].startswith(b"Copyright (C)")


@pytest.mark.parametrize(("fmi", "scalar"), [(2, False), (3, False), (3, True)])
def test_the_description_and_the_table_have_one_token(tmp_path: Path, fmi: int, scalar: bool) -> None:
    interface, flavour = NATIVE_FMUS["ShipManoeuvring"], {"fmi": fmi, "scalar": scalar}
    files = contents(native_fmu_bytes(interface, BINARIES, **flavour), tmp_path)
    root = ElementTree.fromstring(files["modelDescription.xml"])
    token = root.get("guid" if fmi == 2 else "instantiationToken")
    assert token is not None
    assert f'token "{token}"\n' in files["resources/variables.txt"].decode()
    other = contents(native_fmu_bytes(interface, BINARIES, **flavour, start={"substep": 0.01}), tmp_path)
    assert f'token "{token}"\n' not in other["resources/variables.txt"].decode()
    assert native_fmu_bytes(interface, BINARIES, **flavour) == native_fmu_bytes(interface, BINARIES, **flavour)


@pytest.mark.parametrize("fmi", [2, 3])
def test_what_the_description_promises(tmp_path: Path, fmi: int) -> None:
    files = contents(native_fmu_bytes(NATIVE_FMUS["ShipManoeuvring"], BINARIES, fmi=fmi), tmp_path)
    root = ElementTree.fromstring(files["modelDescription.xml"])
    able = root.find("CoSimulation")
    assert able is not None
    assert able.get("needsExecutionTool") == "false"
    assert able.get("canBeInstantiatedOnlyOncePerProcess") == "false"
    state = "state" if fmi == 2 else "State"
    assert able.get(f"canGetAndSetFMU{state}") == able.get(f"canSerializeFMU{state}") == "true"
    said = next(one.get("description") for one in root.iter() if one.get("name") == "ship")
    assert said == "Name of a ship in the FMU's resources, or path of a prepared ship"


def test_every_shipped_ship_is_there(built: dict[str, Path]) -> None:
    files = contents(built["2"], built["2"].parent)
    assert {f"resources/ships/{name}.ship" for name in list_ship_names()} <= set(files)


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_fmpy_has_no_finding(built: dict[str, Path], flavour: str) -> None:
    assert validate_fmu(str(built[flavour])) == []


@pytest.mark.slow
@pytest.mark.parametrize("flavour", FLAVOURS)
def test_our_validator_has_no_finding(built: dict[str, Path], flavour: str) -> None:
    assert [str(one) for one in validate(built[flavour])] == []


@pytest.fixture
def findings_of_the_container_tool(caplog: pytest.LogCaptureFixture) -> Callable[[Path], list[str]]:
    """What `fmutool -check` of fmu-manipulation-toolbox says about an FMU."""

    def check(fmu: Path) -> list[str]:
        caplog.clear()
        with caplog.at_level(logging.INFO, "fmu_manipulation_toolbox"):
            opened = FMU(str(fmu))
            for checker in get_checkers():
                opened.apply_operation(checker())
        assert len(caplog.messages) >= 2  # both checkers speak
        return [record.getMessage() for record in caplog.records if record.levelno >= logging.WARNING]

    return check


@pytest.mark.slow
@pytest.mark.parametrize("flavour", FLAVOURS)
def test_the_container_tools_own_check_has_no_finding(
    built: dict[str, Path], flavour: str, findings_of_the_container_tool: Callable[[Path], list[str]]
) -> None:
    assert findings_of_the_container_tool(built[flavour]) == []


@pytest.mark.slow
def test_the_container_tools_own_check_sees_a_fault(
    native_fmus: dict[str, Path], findings_of_the_container_tool: Callable[[Path], list[str]], tmp_path: Path
) -> None:
    files = contents(native_fmus["2"], tmp_path)
    files["modelDescription.xml"] = files["modelDescription.xml"].replace(b'name="substep"', b'name="ship"')
    with zipfile.ZipFile(tmp_path / "damaged.fmu", "w") as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    assert "ship" in "".join(findings_of_the_container_tool(tmp_path / "damaged.fmu"))


def simulate(fmu: Path, **start: Any) -> Any:
    """Last row of two seconds."""
    return fmpy.simulate_fmu(str(fmu), stop_time=2.0, step_size=0.5, start_values=start, validate=False)[-1]


def test_a_run_needs_no_python_and_gives_the_python_models_numbers(native_fmus: dict[str, Path]) -> None:
    start = {"initial.velocity.surge": 5.0, "rudder_order": 0.2, "propeller_order": 1.5, "hydrodynamics": True}
    access = INTERFACE.make_access((), start)
    access.model.initialise()
    for k in range(4):
        access.model.step(0.5 * k, 0.5)
    north, east, _ = access.model.outputs.position
    found = simulate(native_fmus["2"], **start)
    assert (found["position.north"], found["position.east"]) == pytest.approx((north, east), rel=1e-11, abs=1e-11)


def for_this_machine(native_fmus: dict[str, Path], monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the builder take the library that is built already."""
    with zipfile.ZipFile(native_fmus["2"]) as archive:
        name = next(name for name in archive.namelist() if name.startswith("binaries/"))
        folder, suffix = name.split("/")[1], Path(name).suffix
        library = Binary(folder, suffix, archive.read(name))
    monkeypatch.setattr(builder, "build_binaries", lambda name, platforms: {2: [library], 3: [library]})


def test_the_fmu_of_an_instance_starts_from_its_values_with_its_own_ship(
    native_fmus: dict[str, Path], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    for_this_machine(native_fmus, monkeypatch)
    (tmp_path / "tug.toml").write_text(ship_toml(), encoding="utf-8")
    tug = prepare_ship(str(tmp_path / "tug.toml"))
    start = {"ship": "ships/tug.ship", "initial.position.north": 7.0, "initial.velocity.surge": 2.0}
    fmu = tmp_path / "tug.fmu"
    fmu.write_bytes(native_instance_fmu(INTERFACE, ("tug",), start, {"ships/tug.ship": tug}))
    files = contents(fmu, tmp_path)
    assert files["resources/ships/tug.ship"] == tug
    found = simulate(fmu)
    assert found["position.north"] == pytest.approx(11.0, abs=1e-3)
    description = fmpy.read_model_description(str(fmu))
    assert {one.name: one.start for one in description.modelVariables}["ship"] == "ships/tug.ship"


def test_another_model_has_no_native_form() -> None:
    other = replace(COLLISION, name="Dummy")
    with pytest.raises(InputError, match="Dummy has no native form: our models ShipCollision and ShipManoeuvring have"):
        native_instance_fmu(other, ("own",), {})


def test_what_is_in_the_fmu_of_the_collision(tmp_path: Path) -> None:
    interface, ships = NATIVE_FMUS["ShipCollision"], ("tug", "barge")
    files = contents(native_fmu_bytes(interface, BINARIES, ships, sources=True), tmp_path)
    assert {"binaries/linux64/ShipCollision.so", "resources/ships/kvlcc2.ship", "sources/collision/model.cpp",
            "sources/fmi/ship_collision.cpp", "sources/LICENSE.txt"} <= set(files)  # fmt: skip
    assert not any("python" in name or "manoeuvring/model.cpp" in name for name in files)
    assert b'ships "tug" "barge"\n' in files["resources/variables.txt"]
    root = ElementTree.fromstring(files["modelDescription.xml"])
    said = {one.get("name"): one.get("description") for one in root.iter()}
    assert said["tug.ship"] == "Ship of tug: a name in the FMU's resources, or path of a prepared ship"
    assert "TOML" not in str(said["obstacles"])
    assert b"Bullet 3.26" in files["documentation/licenses/license.txt"]
    assert b"zlib license" in files["documentation/licenses/bullet.txt"]
    assert DEFINES[0].encode() in files["sources/README.txt"]


@pytest.mark.parametrize("name", ["ShipManoeuvring", "ShipCollision"])
@pytest.mark.parametrize("fmi", [2, 3])
def test_sources_travel_and_are_listed(tmp_path: Path, name: str, fmi: int) -> None:
    files = contents(native_fmu_bytes(NATIVE_FMUS[name], BINARIES, fmi=fmi, sources=True), tmp_path)
    listing = files["modelDescription.xml" if fmi == 2 else "sources/buildDescription.xml"]
    listed = [one.get("name") for one in ElementTree.fromstring(listing).iter("File" if fmi == 2 else "SourceFile")]
    there = sorted(name.removeprefix("sources/") for name in files if name.endswith(".cpp"))
    assert sorted(map(str, listed)) == there
    own, other = ("collision", "manoeuvring") if name == "ShipCollision" else ("manoeuvring", "collision")
    assert {"fmi/fmi2.cpp", "fmi/fmi3.cpp", f"{own}/model.cpp"} <= set(there)
    assert not any("python" in name or name.startswith(other) for name in there)
    assert {"sources/fmi2Functions.h", "sources/fmi3Functions.h", "sources/README.txt"} <= set(files)


OF_SOURCES: dict[str, tuple[str, tuple[str, ...], dict[str, Any]]] = {
    "ShipManoeuvring": (
        "native_fmus", (),
        {"initial.velocity.surge": 5.0, "rudder_order": 0.2, "propeller_order": 1.5, "hydrodynamics": True},
    ),
    "ShipCollision": (
        "native_collisions", tuple(f"-D{name}" for name in DEFINES),
        {"own.position.north": -194.0, "own.velocity.surge": 5.0, "target.attitude.yaw": 1.0},
    ),
}  # fmt: skip
"""Fixture, flags and start values of a run by FMU: the collision's ships touch."""


@pytest.mark.parametrize(
    "name",
    [pytest.param("ShipManoeuvring", marks=pytest.mark.slow), pytest.param("ShipCollision", marks=pytest.mark.soak)],
)
def test_what_is_compiled_from_the_sources_gives_the_same_bits(
    name: str, request: pytest.FixtureRequest, tmp_path: Path
) -> None:
    fixture, flags, start = OF_SOURCES[name]
    with zipfile.ZipFile(request.getfixturevalue(fixture)["2"]) as archive:
        library = next(name for name in archive.namelist() if name.startswith("binaries/"))
        binary = Binary(library.split("/")[1], Path(library).suffix, archive.read(library))
    fmu = tmp_path / "with_sources.fmu"
    fmu.write_bytes(native_fmu_bytes(NATIVE_FMUS[name], [binary], sources=True))
    expected = simulate(fmu, **start)
    assert name == "ShipManoeuvring" or expected["impact.count"] == 1
    folder = Path(fmpy.extract(str(fmu), str(tmp_path / "unpacked")))
    target = find_own_target()
    assert target is not None
    compiler = find_compiler(target, prefer_system=True)
    files = [path.relative_to(folder / "sources").as_posix() for path in (folder / "sources").rglob("*.cpp")]
    (folder / library).unlink()
    command = [*compiler.link, "-shared", "-fPIC", *FLAGS, *flags, "-I.", "-o", str(folder / library), *files]
    run(command, compiler, "cannot compile the sources", folder / "sources")
    assert simulate(folder, **start).tolist() == expected.tolist()


def test_names_of_files() -> None:
    assert native_fmu_file("X") == "X.native.fmu"
    assert native_fmu_file("X", 3) == "X.native.fmi3.fmu"
    assert native_fmu_file("X", 3, scalar=True) == "X.native.fmi3-scalar.fmu"


def test_mistakes_are_told_before_anything_is_compiled(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="'amiga' is unknown: give some of linux64, win64, darwin64, aarch64-linux"):
        build_native_fmus(tmp_path, platforms=["linux64", "amiga"])
    with pytest.raises(InputError, match="an FMU needs a platform: give some of linux64"):
        build_native_fmus(tmp_path, platforms=[])
    with pytest.raises(InputError, match="fmi = 1 is not a version that FMUs can be built for"):
        build_native_fmus(tmp_path, fmi=1)
    assert list(tmp_path.iterdir()) == []


def test_a_platform_that_is_named_twice_is_built_once() -> None:
    assert [one.name for one in choose_platforms(["win64", "linux64", "win64"])] == ["win64", "linux64"]


def test_nothing_is_written_when_nothing_compiles(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*arguments: object) -> SimpleNamespace:
        raise HostError("no compiler")

    monkeypatch.setattr(builder, "build_binaries", refuse)
    with pytest.raises(HostError, match="no compiler"):
        build_native_fmus(tmp_path / "out")
    assert list(tmp_path.iterdir()) == []
