"""FMUs share one interpreter and its modules: what does not fit together is refused, and no FMU runs another's code.

Each case in a process of its own, as a host that has not imported the package unless the case says so.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import shipcollision_fmu

ROOT = Path(shipcollision_fmu.__file__).parent.parent

SLOW = pytest.mark.slow

HOST = """
import ctypes, shutil, sys
sys.path.insert(0, sys.argv[1])
from pathlib import Path
from fuzz import Fmu, Wrong
folders = list(map(Path, sys.argv[2:]))

def run(folder, ship=b"kvlcc2"):
    fmu = Fmu(folder)
    try:
        one = fmu.instantiate(True)
    except Wrong as refusal:
        return str(refusal)
    kind = "Real" if fmu.fmi == 2 else "Float64"
    first = fmu.kinds[kind][0] if fmu.fmi == 2 else fmu.kinds[kind][1]
    fmu.enter(one, 0.0, 1.0)
    assert fmu.call("ExitInitializationMode")(one) == 0, fmu.said
    assert fmu.step(one, 0.0, 0.05) == 0, fmu.said
    status, values = fmu.get(kind, one, [first], fmu.sizes[first])
    fmu.free(one)
    return values[0]

def loaded():
    import shipcollision_fmu
    return Path(shipcollision_fmu.__file__)
"""


def host(code: str, *folders: Path) -> str:
    """What a host prints that runs this code."""
    clean = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    done = subprocess.run(
        [sys.executable, "-X", "faulthandler", "-c", HOST + code, Path(__file__).parent, *folders],
        env=clean, cwd="/", capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout


def unpack(fmu: Path, folder: Path) -> Path:
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
    return folder


@pytest.fixture(scope="module")
def other(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Another version of the package, one constant and the number changed, with its FMUs beside it."""
    home = tmp_path_factory.mktemp("other")
    for part in ("shipcollision_fmu", "models", "fmu_src"):
        shutil.copytree(ROOT / part, home / part, ignore=shutil.ignore_patterns("__pycache__"))
    package = home / "shipcollision_fmu"
    edit(package / "__init__.py", f'__version__ = "{shipcollision_fmu.__version__}"', '__version__ = "9.9.9"')
    edit(package / "fmi" / "interface.py", "step_size: float = 0.05", "step_size: float = 0.07")
    code = "import sys; sys.path.insert(0, sys.argv[1]); from shipcollision_fmu import build_fmus\n"
    code += "[build_fmus(sys.argv[1] + '/build', fmi=fmi) for fmi in (2, 3)]"
    subprocess.run([sys.executable, "-c", code, home], check=True, timeout=600, cwd="/")
    return home


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("first", "second"), [(2, 2), (3, 3), pytest.param(2, 3, marks=SLOW), pytest.param(3, 2, marks=SLOW)]
)
def test_fmus_of_two_versions_refuse_to_share_a_process(
    real_unpacked: dict[tuple[str, int], Path], other: Path, tmp_path: Path, first: int, second: int
) -> None:
    """Whichever comes second says which version it is, which one runs, and from where; the first goes on working."""
    ours = real_unpacked["ShipManoeuvring", first]
    theirs = unpack(other / "build" / f"ShipManoeuvring{'.fmi3' if second == 3 else ''}.fmu", tmp_path / "theirs")
    said = host("before = run(folders[0]); print(run(folders[1])); assert run(folders[0]) == before", ours, theirs)
    version = shipcollision_fmu.__version__
    assert "ShipManoeuvring.fmu was built from shipcollision_fmu 9.9.9 (" in said
    assert f"but this process has imported {version} (" in said
    assert f"from {ours}/resources/shipcollision_fmu; build the FMU again from that package, or keep" in said


@pytest.mark.slow
@pytest.mark.parametrize("fmi", [2, 3])
def test_an_fmu_beside_an_installed_package_of_another_version_is_refused(
    real_unpacked: dict[tuple[str, int], Path], other: Path, fmi: int
) -> None:
    code = f"sys.path.insert(0, {str(other)!r}); import shipcollision_fmu; print(run(folders[0]))"
    said = host(code, real_unpacked["ShipCollision", fmi])
    assert f"ShipCollision.fmu was built from shipcollision_fmu {shipcollision_fmu.__version__} (" in said
    assert "but this process has imported 9.9.9 (" in said
    assert f"from {other}/shipcollision_fmu; " in said


def test_a_package_of_before_fmi3_is_named_as_the_reason(
    real_unpacked: dict[tuple[str, int], Path], other: Path, tmp_path: Path
) -> None:
    shutil.copytree(other / "shipcollision_fmu", tmp_path / "old" / "shipcollision_fmu")
    (tmp_path / "old" / "shipcollision_fmu" / "fmi" / "slave_fmi3.py").unlink()
    code = f"sys.path.insert(0, {str(tmp_path / 'old')!r}); import shipcollision_fmu; print(run(folders[0]))"
    said = host(code, real_unpacked["ShipCollision", 3])
    assert "shipcollision_fmu cannot be imported as this FMU needs it: No module named" in said


@pytest.mark.parametrize("fmi", [2, 3])
def test_a_package_that_the_host_does_not_have_is_named(real_unpacked: dict[tuple[str, int], Path], fmi: int) -> None:
    code = "sys.modules['pydantic'] = None; print(run(folders[0]))"
    said = host(code, real_unpacked["ShipCollision", fmi])
    assert "cannot be instantiated" in said
    assert "import of pydantic halted" in said


@pytest.mark.slow
def test_both_versions_of_fmi_and_both_fmus_share_a_process(real_unpacked: dict[tuple[str, int], Path]) -> None:
    folders = [real_unpacked[name, fmi] for name in ("ShipManoeuvring", "ShipCollision") for fmi in (2, 3)]
    said = host("print([run(folder) for folder in folders + folders[::-1]])", *folders)
    assert "refuse" not in said
    assert said.count(",") == 7


@pytest.mark.slow
@pytest.mark.parametrize("fmi", [2, 3])
def test_the_first_folder_may_be_deleted(real_fmus: dict[tuple[str, int], Path], tmp_path: Path, fmi: int) -> None:
    """A host unpacks an FMU for every run. Modules that are imported late, and ship files, come from a folder that is
    there."""
    folders = [unpack(real_fmus[name, fmi], tmp_path / f"{name} {k}")
               for k in range(2) for name in ("ShipManoeuvring", "ShipCollision")]  # fmt: skip
    code = """
for folder in folders:
    print(run(folder))
    shutil.rmtree(folder)
    assert folder != folders[-1] or not loaded().exists()
"""
    said = host(code, *folders).split()
    assert len(said) == 4
    assert said[0] == said[2]


MESH_FILES = (
    "mesh", "mesh_file", "mesh_checks", "file_frame", "mending", "one_solid", "convex_parts", "child_process",
    "hull_cache",
)  # fmt: skip
PROGRAMS = ("coacd_process", "manifold_process", "self_crossing")
LATER = {
    "ship/kinetic_energy.py": "for summaries and pages; the room ship travels whole",
    "ship/ship_state.py": "for helms and tracks; the room ship travels whole",
    **dict.fromkeys(
        ("manoeuvring/prepared_ship.py", "collision/prepared_obstacles.py", "ship/prepared_lines.py"),
        "for `shipcollision prepare`; the files of the room travel all",
    ),
    **{f"ship/hull/{name}.py": "imported with the first ship whose hull is a mesh file" for name in MESH_FILES},
    **{f"ship/hull/{name}.py": "runs in a process of its own" for name in PROGRAMS},
}
"""Files that an FMU carries although its first step does not import them, and why."""


def test_an_fmu_carries_what_its_slaves_import_and_nothing_else(real_unpacked: dict[tuple[str, int], Path]) -> None:
    """Both FMUs, in both versions of FMI, run in one process. What they import is compared with what they carry."""
    folders = [real_unpacked[name, fmi] for name in ("ShipManoeuvring", "ShipCollision") for fmi in (2, 3)]
    code = """
assert all(isinstance(run(folder), float) for folder in folders)
package = loaded().parent
files = {Path(module.__file__) for name, module in sys.modules.items() if name.split(".")[0] == package.name}
print(*sorted(file.relative_to(package).as_posix() for file in files))
"""
    imported = set(host(code, *folders).split())
    for folder in folders:
        package = folder / "resources" / "shipcollision_fmu"
        carried = {path.relative_to(package).as_posix() for path in package.rglob("*")
                   if path.is_file() and path.suffix != ".pyc"}  # fmt: skip
        assert carried == imported | set(LATER)
        assert not imported & set(LATER)


def test_an_fmu_that_was_edited_is_refused(real_fmus: dict[tuple[str, int], Path], tmp_path: Path) -> None:
    folder = unpack(real_fmus["ShipManoeuvring", 2], tmp_path / "edited")
    edit(folder / "resources" / "shipcollision_fmu" / "manoeuvring" / "model.py", "STEEPEST = 1.4", "STEEPEST = 1.3")
    said = host("print(run(folders[0]))", folder)
    assert "ShipManoeuvring.fmu was built from shipcollision_fmu" in said
    assert "build the FMU again" in said


# FMUs of somebody else. ---------------------------------------------------------------------------------------------

FOREIGN = """
from {wrapper} import {base}, {prefix}Causality, {real}
import helper
import models


class {name}({base}):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.answer = helper.answer() + models.MORE
        self.register_variable({real}("answer", causality={prefix}Causality.output))

    def do_step(self, t, h):
        return {ok}
"""


def foreign(folder: Path, name: str, fmi: int, answer: float) -> Path:
    """An FMU by pythonfmu's own builder, whose modules have names that ours have too, or that others may have."""
    (folder / "parts").mkdir(parents=True)
    (folder / "helper.py").write_text(f"def answer():\n    return {answer}\n")
    (folder / "models.py").write_text("MORE = 0.5\n")
    words = (
        {"wrapper": "pythonfmu", "base": "Fmi2Slave", "prefix": "Fmi2", "real": "Real", "ok": "True"} if fmi == 2 else
        {"wrapper": "pythonfmu3", "base": "Fmi3Slave", "prefix": "Fmi3", "real": "Float64", "ok": "True"}
    )  # fmt: skip
    (folder / f"{name}.py").write_text(FOREIGN.format(name=name, **words))
    build = [sys.executable, "-m", words["wrapper"], "build", "-f", f"{name}.py", "helper.py", "models.py"]
    subprocess.run(build, check=True, cwd=folder, capture_output=True, timeout=600)
    return unpack(folder / f"{name}.fmu", folder / "unpacked")


@pytest.mark.parametrize(
    ("fmi", "order"),
    [
        (2, "foreign first"),
        pytest.param(3, "foreign first", marks=SLOW),
        pytest.param(2, "ours first", marks=SLOW),
        pytest.param(3, "ours first", marks=SLOW),
    ],
)
def test_a_foreign_fmu_with_modules_of_the_same_names(
    real_unpacked: dict[tuple[str, int], Path], tmp_path: Path, fmi: int, order: str
) -> None:
    """Its slave is called ShipManoeuvring as ours is, and it has a module `models` as we have a folder."""
    theirs, ours = foreign(tmp_path / "f", "ShipManoeuvring", fmi, 42.0), real_unpacked["ShipManoeuvring", fmi]
    folders = [theirs, ours] if order == "foreign first" else [ours, theirs]
    code = """
first, second = run_foreign(folders[0]), run_foreign(folders[1])
print(first, second, run_foreign(folders[0]))
"""
    runner = """
import numpy  # a plain FMU of pythonfmu aborts at the end of a host that has not: see fmi/wrapper_library.py

def run_foreign(folder):
    if "answer" not in (folder / "modelDescription.xml").read_text():
        return run(folder)
    fmu = Fmu(folder)
    one = fmu.instantiate(True)
    kind = "Real" if fmu.fmi == 2 else "Float64"
    status, values = fmu.get(kind, one, fmu.kinds[kind][-1:], 1)
    fmu.free(one)
    return values[0]
"""
    said = host(runner + code, *folders).split()
    assert said == (["42.5", "0.0", "42.5"] if order == "foreign first" else ["0.0", "42.5", "0.0"])


@pytest.mark.parametrize("fmi", [2, 3])
def test_a_foreign_fmu_with_another_version_of_the_wrapper_is_told(
    real_unpacked: dict[tuple[str, int], Path], tmp_path: Path, fmi: int
) -> None:
    """It is imported first, and our slave would run on its base class."""
    theirs = foreign(tmp_path / "f", "Theirs", fmi, 1.0)
    wrapper = "pythonfmu" if fmi == 2 else "pythonfmu3"
    version = theirs / "resources" / wrapper / "_version.py"
    version.write_text('__version__ = "0.1.2"\n')
    code = "import numpy; Fmu(folders[0]).instantiate(True); print(run(folders[1]))"
    said = host(code, theirs, real_unpacked["ShipManoeuvring", fmi])
    assert f"ShipManoeuvring.fmu was built with {wrapper} 0." in said
    assert f"but this process has imported {wrapper} 0.1.2, perhaps from another FMU: install the same version" in said
