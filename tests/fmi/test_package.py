"""The .fmu files: contents, same bytes, which sources run, what is stale."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu

import shipcollision_fmu
from shipcollision_fmu.errors import HostError, InputError
from shipcollision_fmu.fmi import build_record
from shipcollision_fmu.fmi.builder import package
from shipcollision_fmu.fmi.builder.package import FMUS, are_fmus_current, build_fmus
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(shipcollision_fmu.__file__).parent.parent


@pytest.fixture(scope="module")
def built(real_fmus: dict[tuple[str, int], Path]) -> dict[str, Path]:
    """Both FMUs for FMI 2.0."""
    return {name: path for (name, fmi), path in real_fmus.items() if fmi == 2}


@pytest.fixture(scope="module")
def built_for_fmi3(real_fmus: dict[tuple[str, int], Path]) -> dict[str, Path]:
    """Those for FMI 3.0, in the same folder."""
    return {name: path for (name, fmi), path in real_fmus.items() if fmi == 3}


def in_a_process(code: str, *arguments: object, **environment: str) -> str:
    """Run code in a Python of its own, with the package importable only where the code makes it so."""
    clean = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    done = subprocess.run(
        [sys.executable, "-W", "error", "-X", "faulthandler", "-c", code, *map(str, arguments)],
        env=clean | environment,
        cwd="/",
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_both_fmus_are_valid(built: dict[str, Path]) -> None:
    assert sorted(built) == ["ShipCollision", "ShipManoeuvring"]
    for name, path in built.items():
        assert path.name == f"{name}.fmu"
        assert validate_fmu(str(path)) == []


def test_fmi3_files_lie_beside_the_others_and_are_valid(
    built: dict[str, Path], built_for_fmi3: dict[str, Path]
) -> None:
    assert sorted(built_for_fmi3) == ["ShipCollision", "ShipManoeuvring"]
    for name, path in built_for_fmi3.items():
        assert path == built[name].parent / f"{name}.fmi3.fmu"
        assert validate_fmu(str(path)) == []
        assert read_model_description(str(path)).fmiVersion == "3.0"
    assert are_fmus_current(built["ShipCollision"].parent)
    assert are_fmus_current(built["ShipCollision"].parent, fmi=3)


def test_what_is_in_an_fmi3_fmu(built_for_fmi3: dict[str, Path]) -> None:
    for name, path in built_for_fmi3.items():
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
            module = archive.read("resources/slavemodule.txt").decode()
            page = archive.read("documentation/index.html").decode()
        assert re.fullmatch(rf"{name}_[0-9a-f]{{12}}", module)
        for wanted in (
            f"binaries/x86_64-linux/{name}.so",
            "terminalsAndIcons/terminalsAndIcons.xml",
            "terminalsAndIcons/icon.png",
            "terminalsAndIcons/icon.svg",
            "documentation/externalDependencies.txt",  # FMI 3.0, section 2.5.1: where needsExecutionTool is true
            "documentation/licenses/license.txt",
            "documentation/licenses/pythonfmu3.txt",
            f"resources/{module}.py",
            "resources/pythonfmu3/fmi3slave.py",
            "resources/shipcollision_fmu/fmi/slave_fmi3.py",
        ):
            assert wanted in names
        assert not [n for n in names if n.startswith("resources/pythonfmu/") or "linux64" in n]
        assert "Float64[3]" in page
        assert "fmi3GetFloat32" in page


def test_the_entry_to_the_licences_names_every_other(built: dict[str, Path], built_for_fmi3: dict[str, Path]) -> None:
    for path in (*built.values(), *built_for_fmi3.values()):
        with zipfile.ZipFile(path) as archive:
            texts = {n.rpartition("/")[2] for n in archive.namelist() if n.startswith("documentation/licenses/")}
            entry = archive.read("documentation/licenses/license.txt").decode()
            needs = archive.read("documentation/externalDependencies.txt").decode()
            requirements = archive.read("resources/requirements.txt").decode().split("\n")
        assert all(text in entry for text in texts - {"license.txt"})
        assert len(texts) == 3
        assert all(line in needs for line in requirements)
        assert ("pybullet" in needs) == ("ShipCollision" in path.name)


@pytest.mark.slow
def test_the_scalar_flavour_has_the_names_of_fmi2(built: dict[str, Path], tmp_path: Path) -> None:
    """For hosts that do not pass arrays: no Dimension anywhere, the value references of FMI 2.0 plus 1, time 0."""
    made = build_fmus(tmp_path, fmi=3, scalar=True)
    for name, path in made.items():
        assert path.name == f"{name}.fmi3-scalar.fmu"
        assert validate_fmu(str(path)) == []
        scalar, plain = (read_model_description(str(one)).modelVariables for one in (path, built[name]))
        assert [(v.name, v.valueReference) for v in scalar] == [
            ("time", 0), *((v.name, v.valueReference + 1) for v in plain)
        ]  # fmt: skip
        with zipfile.ZipFile(path) as archive:
            assert b"<Dimension" not in archive.read("modelDescription.xml")
    with pytest.raises(InputError, match=r"scalar = True is for FMI 3.0 alone, since FMI 2.0 has no arrays"):
        build_fmus(tmp_path, scalar=True)


def test_another_version_of_fmi_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"fmi = 1 is not a version that FMUs can be built for: give one of 2, 3"):
        build_fmus(tmp_path, fmi=1)


def test_without_pythonfmu3_it_says_how_to_get_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(package, "find_spec", lambda name: None)
    install = f"run `{sys.executable} -m pip install 'shipcollision-fmu[fmi3]'` (in a clone: '.[fmi3]')"
    with pytest.raises(HostError, match=rf"^pythonfmu3, .*: {re.escape(install)}$"):
        build_fmus(tmp_path, fmi=3)
    assert list(tmp_path.iterdir()) == []


def test_what_is_in_an_fmu(built: dict[str, Path]) -> None:
    for name, path in built.items():
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
            assert names == sorted(names)
            assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
            module = archive.read("resources/slavemodule.txt").decode()
            assert re.fullmatch(rf"{name}_[0-9a-f]{{12}}", module)  # of its own: the wrapper imports it by name
        for wanted in (
            "modelDescription.xml",
            f"binaries/linux64/{name}.so",
            "documentation/index.html",
            "documentation/externalDependencies.txt",
            "documentation/licenses/license.txt",
            "documentation/licenses/shipcollision_fmu.txt",
            "documentation/licenses/pythonfmu.txt",
            f"resources/{module}.py",
            "resources/build.json",
            "resources/requirements.txt",
            "resources/pythonfmu/fmi2slave.py",
            "resources/shipcollision_fmu/fmi/slave.py",
            "resources/models/ships/kvlcc2.toml",
        ):
            assert wanted in names
        assert "model.png" in names
        assert (f"binaries/win64/{name}.dll" in names) == (name == "ShipManoeuvring")  # pybullet is for Linux alone
        assert not [n for n in names if re.search(r"__pycache__|\.pyc$|/scenarios/|/fmu_src/", n)]
        carried = {n.split("/")[2] for n in names if n.startswith("resources/shipcollision_fmu/")}
        assert carried == {
            "__init__.py",
            "collision",
            "errors.py",
            "files.py",
            "fmi",
            "manoeuvring",
            "ship",
            "toolchain",
        }


def test_requirements_are_those_of_the_project_and_each_fmus_own() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["dependencies"]

    def plain(lines: object) -> set[str]:
        return {re.sub(r"[\s'\"]", "", line) for line in lines}  # type: ignore[attr-defined]  # lines of any source

    # The package, and the FMU that needs pybullet, take it where it has wheels.
    wheels = "; python_version < '3.12' and sys_platform == 'linux' and platform_machine == 'x86_64'"
    assert f"pybullet>=3.2.5{wheels}" in project
    everywhere = plain(line.replace(wheels, "; python_version < '3.12'") for line in project)
    assert plain(COLLISION.requirements) <= everywhere
    left_out = {re.split(r"[<>=;]", line)[0] for line in everywhere - plain(COLLISION.requirements)}
    assert left_out == {"click", "fmpy", "pythonfmu", "rich"}  # of the master and the command line, and packed
    assert set(COLLISION.requirements) - set(MANOEUVRING.requirements) == {"pybullet>=3.2.5; python_version < '3.12'"}


BUILD = """
import os, sys, time
sys.path.insert(0, sys.argv[1])
os.umask(int(sys.argv[3], 8))
from shipcollision_fmu import build_fmus
before = list(sys.path)
build_fmus(sys.argv[2])
build_fmus(sys.argv[2], fmi=3)
assert sys.path == before
assert not {"ShipCollision", "ShipManoeuvring", "pythonfmu.builder.nothing"} & set(sys.modules)
"""


@pytest.mark.slow
def test_same_inputs_same_bytes(built: dict[str, Path], built_for_fmi3: dict[str, Path], tmp_path: Path) -> None:
    """Whatever the hash seed, the umask, the time zone, the folder and the process."""
    in_a_process(BUILD, ROOT, tmp_path / "a", "077", PYTHONHASHSEED="1", TZ="Asia/Tokyo")
    in_a_process(BUILD, ROOT, tmp_path / "b" / "c", "000", PYTHONHASHSEED="2", TZ="America/Lima")
    for path in (*built.values(), *built_for_fmi3.values()):
        here = path.read_bytes()
        assert (tmp_path / "a" / path.name).read_bytes() == here
        assert (tmp_path / "b" / "c" / path.name).read_bytes() == here


def test_same_bytes_from_files_found_in_another_order(
    built: dict[str, Path], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    for search in ("glob", "rglob"):
        walk = getattr(Path, search)
        monkeypatch.setattr(
            Path, search, lambda self, pattern, walk=walk, **how: reversed(list(walk(self, pattern, **how)))
        )
    for name, path in build_fmus(tmp_path).items():
        assert path.read_bytes() == built[name].read_bytes()


@pytest.mark.slow
def test_other_ships_make_another_fmu(built: dict[str, Path], tmp_path: Path) -> None:
    three = build_fmus(tmp_path, ships=("own", "target", "third"))
    assert validate_fmu(str(three["ShipCollision"])) == []
    with zipfile.ZipFile(three["ShipCollision"]) as archive:
        assert b'name="third.post.position.north"' in archive.read("modelDescription.xml")
        record = build_record.BuildRecord.from_json(archive.read("resources/build.json"))
    assert record.ships == ("own", "target", "third")
    with zipfile.ZipFile(built["ShipCollision"]) as archive:
        assert build_record.BuildRecord.from_json(archive.read("resources/build.json")).guid != record.guid
    assert are_fmus_current(tmp_path, ships=("own", "target", "third"))
    assert not are_fmus_current(tmp_path)


# Stale or current. --------------------------------------------------------------------------------------------------


def test_current_until_the_sources_change(built: dict[str, Path], monkeypatch: pytest.MonkeyPatch) -> None:
    folder = next(iter(built.values())).parent
    assert are_fmus_current(folder)
    monkeypatch.setattr(build_record, "digest_contents", lambda package: "0" * 64)
    assert not are_fmus_current(folder)


def test_missing_or_broken_files_are_stale(built: dict[str, Path], tmp_path: Path) -> None:
    assert not are_fmus_current(tmp_path / "nowhere")
    for path in built.values():
        shutil.copy(path, tmp_path)
    assert are_fmus_current(tmp_path)
    for name in FMUS:
        whole = (tmp_path / f"{name}.fmu").read_bytes()
        (tmp_path / f"{name}.fmu").write_bytes(whole[: len(whole) // 2])
        assert not are_fmus_current(tmp_path)
        (tmp_path / f"{name}.fmu").write_bytes(whole)
    shutil.copy(tmp_path / "ShipCollision.fmu", tmp_path / "ShipManoeuvring.fmu")
    assert not are_fmus_current(tmp_path)


def test_the_digest_sees_every_file_and_its_name(tmp_path: Path) -> None:
    def tree(name: str, files: dict[str, str]) -> str:
        package_directory = tmp_path / name / "shipcollision_fmu"
        package_directory.mkdir(parents=True)
        for path, text in files.items():
            (tmp_path / name / path).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / name / path).write_text(text)
        return build_record.digest_contents(package_directory)

    plain = {"shipcollision_fmu/ship/a.py": "1", "models/ships/x.toml": "2"}
    digest = tree("plain", plain)
    assert tree("other text", {**plain, "shipcollision_fmu/ship/a.py": "3"}) != digest
    assert tree("other ship", {**plain, "models/ships/x.toml": "3"}) != digest
    assert tree("other name", {"shipcollision_fmu/ship/b.py": "1", "models/ships/x.toml": "2"}) != digest
    # As installed: ship data inside the package. And what no FMU carries does not count.
    assert (
        tree("installed", {"shipcollision_fmu/ship/a.py": "1", "shipcollision_fmu/models/ships/x.toml": "2"}) == digest
    )
    unseen = ("shipcollision_fmu/m.py", "shipcollision_fmu/new_room/m.py", "shipcollision_fmu/fmi/builder/m.py",
              "shipcollision_fmu/manoeuvring/trials/m.py", "shipcollision_fmu/ship/README.md",
              "shipcollision_fmu/ship/__pycache__/a.pyc",
              "models/scenarios/s.toml", "shipcollision_fmu/fmu_src/S.py")  # fmt: skip
    assert tree("more", {**plain, **dict.fromkeys(unseen, "4")}) == digest


# Failures. ----------------------------------------------------------------------------------------------------------


def test_an_unwritable_folder_is_refused_in_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("not a folder")
    with pytest.raises(HostError, match=r"cannot write to .*/file: File exists; give another folder"):
        build_fmus(tmp_path / "file")
    with pytest.raises(HostError, match=r"/file/below: (Not a directory|File exists); give another folder with --out"):
        build_fmus(tmp_path / "file" / "below")


def test_a_disk_that_fills_up_leaves_the_old_files(
    built: dict[str, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in FMUS:
        (tmp_path / f"{name}.fmu").write_text("old")
    write = Path.write_bytes

    def full(self: Path, data: bytes) -> int:
        if "ShipManoeuvring" in self.name:
            write(self, data[:100])
            raise OSError(28, "No space left on device")
        return write(self, data)

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(HostError, match="No space left on device"):
        build_fmus(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["ShipCollision.fmu", "ShipManoeuvring.fmu"]
    assert {path.read_text() for path in tmp_path.iterdir()} == {"old"}


def test_an_incomplete_installation_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(package, "slave_directory", lambda: tmp_path)
    with pytest.raises(HostError, match=r"ShipCollision\.py is missing: the installation .* is not complete"):
        build_fmus(tmp_path)


# Which sources run. -------------------------------------------------------------------------------------------------

INSTANTIATE = """
import sys, shutil
from pathlib import Path
from fmpy import read_model_description
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

messages = []
keep = fmi2CallbackLoggerTYPE(lambda env, who, status, category, message: messages.append(message.decode()))
callbacks = fmi2CallbackFunctions(keep, defaultCallbacks.allocateMemory, defaultCallbacks.freeMemory)

def instance(folder):
    description = read_model_description(folder)
    slave = FMU2Slave(guid=description.guid, unzipDirectory=folder, instanceName="one",
                      modelIdentifier=description.coSimulation.modelIdentifier)
    slave.instantiate(callbacks=callbacks, loggingOn=True)
    return slave

def run(folder):
    slave = instance(folder)
    slave.setupExperiment(); slave.enterInitializationMode(); slave.exitInitializationMode()
    slave.doStep(0.0, 0.1)
    slave.terminate(); slave.freeInstance()
"""


def unpacked(fmu: Path, folder: Path) -> Path:
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
    return folder


@pytest.mark.slow
def test_a_host_without_the_package_runs_what_the_fmu_carries(built: dict[str, Path], tmp_path: Path) -> None:
    """Both FMUs in one host. The host unpacks again after it has deleted the folder from which the modules came."""
    folders = [
        unpacked(built[name], tmp_path / f"{name} {k}")  # with a space: the wrapper decodes that one
        for k in (1, 2)
        for name in ("ShipManoeuvring", "ShipCollision")
    ]
    code = (
        INSTANTIATE
        + """
first = True
for folder in sys.argv[1:]:
    run(folder)
    import shipcollision_fmu
    if first:
        assert Path(shipcollision_fmu.__file__).is_relative_to(folder), shipcollision_fmu.__file__
        first = False
    shutil.rmtree(folder)
assert not messages, messages
"""
    )
    in_a_process(code, *folders)


def test_an_fmu_refuses_to_run_on_another_build(built: dict[str, Path], tmp_path: Path) -> None:
    other = tmp_path / "other"
    left_out = shutil.ignore_patterns("__pycache__")
    shutil.copytree(ROOT / "shipcollision_fmu", other / "shipcollision_fmu", ignore=left_out)
    with (other / "shipcollision_fmu" / "errors.py").open("a") as file:
        file.write("# changed\n")
    folder = unpacked(built["ShipManoeuvring"], tmp_path / "fmu")
    code = (
        INSTANTIATE
        + """
sys.path.insert(0, sys.argv[2])
import shipcollision_fmu
try:
    instance(sys.argv[1])
except Exception as error:
    print(error)
print(len(messages), messages[0])
"""
    )
    said = in_a_process(code, folder, other)
    assert said.startswith("Failed to instantiate model\n1 Fatal py exception encountered: ")
    assert f"ShipManoeuvring.fmu was built from shipcollision_fmu {shipcollision_fmu.__version__} (" in said
    assert f"from {other}/shipcollision_fmu; build the FMU again" in said


def test_resources_without_a_record_are_refused(tmp_path: Path) -> None:
    with pytest.raises(HostError, match=r"has no record of what the FMU was built from \(FileNotFoundError"):
        build_record.confirm_build(str(tmp_path), "pythonfmu 0.7.0")
