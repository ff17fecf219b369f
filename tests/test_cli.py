"""The command line: results on stdout, one line on stderr for a mistake, exit status 0, 1 or 2, nothing half-done."""

from __future__ import annotations

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from shipcollision_fmu import __version__
from shipcollision_fmu.cli import main
from shipcollision_fmu.cosim import fmu_files
from shipcollision_fmu.errors import HostError
from shipcollision_fmu.fmi.builder import native_fmus
from shipcollision_fmu.toolchain import bullet_sources, fmu_binaries, libraries
from shipcollision_fmu.toolchain.fmu_binaries import Binary
from tests.conftest import ENCOUNTER, NATIVE_CACHE
from tests.ship_files import ship_toml

BARGE = ship_toml()

SCENARIO = ENCOUNTER.replace("duration = 3.0", "duration = 1.5").replace("-64.0", "-62.0").replace("speed = 1.0\n", "")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working folder with a scenario in it; FMUs are those of the session, see tests/conftest.py."""
    here = tmp_path / "here"
    here.mkdir()
    (here / "barge.toml").write_text(BARGE, encoding="utf-8")
    (here / "encounter.toml").write_text(SCENARIO, encoding="utf-8")
    monkeypatch.chdir(here)
    return here


def called(*arguments: str) -> Result:
    return CliRunner().invoke(main, list(arguments))


def fresh(*arguments: str, cwd: Path, prelude: str = "") -> subprocess.CompletedProcess[str]:
    """The command in an interpreter of its own, after some lines of Python. Of this process's path it has the package
    alone: FMUs of other tests have put their own folders there."""
    code = f"{prelude}\nfrom shipcollision_fmu.cli import main\nmain()"
    environment = os.environ | {"PYTHONPATH": str(fmu_files._PACKAGE.parent)}
    return subprocess.run(
        [sys.executable, "-c", code, *arguments], cwd=cwd, env=environment, capture_output=True, text=True, timeout=1200
    )  # fmt: skip


def test_help_is_everywhere() -> None:
    assert called().output == called("--help").output
    for command in ("run", "build", "ships", "scenarios", "validate", "trial", "encounter", "import"):
        assert command in called("--help").output
        result = called(command, "--help")
        assert result.exit_code == 0
        assert result.output.startswith(f"Usage: main {command}")
    assert __version__ in called("--version").output


@pytest.mark.parametrize("how", [[], ["--in-process"], ["--algorithm", "jacobi"], ["--step", "0.1"]])
def test_run_stores_and_shows_what_happened(folder: Path, how: list[str]) -> None:
    result = called("run", "encounter.toml", *how)
    assert result.exit_code == 0, result.stderr
    assert "own - target" in result.stdout
    assert "MJ dissipated in contact" in result.stdout
    assert "stored in runs/encounter" in result.stdout
    assert "[m/s]" in result.stdout
    assert {path.name for path in (folder / "runs" / "encounter").iterdir()} == {
        "states.csv", "contacts.csv", "signals.csv", "events.json", "bodies.json", "summary.json", "timing.json",
        "machinery.csv", "surroundings.csv", "replay.html",
    }  # fmt: skip
    assert "open runs/encounter/replay.html in a browser" in result.stdout.splitlines()[-1]


def test_run_writes_no_page_when_told_so_and_the_same_page_twice(folder: Path) -> None:
    page = folder / "runs" / "encounter" / "replay.html"
    assert called("run", "encounter.toml", "--in-process", "--no-page").exit_code == 0
    assert not page.exists()
    pages = []
    for _ in range(2):
        assert called("run", "encounter.toml", "--in-process").exit_code == 0
        pages.append(page.read_bytes())
    assert pages[0] == pages[1]


def test_a_page_that_cannot_be_made_does_not_undo_the_run(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def failing(name: str) -> str:
        raise HostError("the page's bundle is missing")

    monkeypatch.setattr("shipcollision_fmu.show.page._read_bundle", failing)
    result = called("run", "encounter.toml", "--in-process")
    assert result.exit_code == 0
    assert result.stderr.strip().endswith("no page: the page's bundle is missing")
    assert (folder / "runs" / "encounter" / "states.csv").exists()
    assert not (folder / "runs" / "encounter" / "replay.html").exists()


def test_run_replaces_no_file_of_other_origin_unless_told_so(folder: Path) -> None:
    """Measured data called states.csv, a picture, a summary of another program: kept. Both remedies work."""
    run = ("run", "encounter.toml", "--in-process", "--out", "data")
    for name, text in (("states.csv", "mine"), ("still.png", "mine"), ("summary.json", '{"versions": 3}')):
        Path("data").mkdir(exist_ok=True)
        Path("data", name).write_text(text, encoding="utf-8")
        refused = called(*run)
        assert (refused.exit_code, refused.stdout) == (1, ""), name
        assert "error: data holds " in refused.stderr
        assert "of other origin (no run of this program has its summary.json there): give another" in refused.stderr
        assert name in refused.stderr
        assert refused.stderr.count("\n") == 1
    assert sorted(p.name for p in Path("data").iterdir()) == ["states.csv", "still.png", "summary.json"]
    assert Path("data", "states.csv").read_text(encoding="utf-8") == "mine"
    assert called(*run[:-1], "elsewhere").exit_code == 0
    assert called(*run, "--overwrite").exit_code == 0
    assert Path("data", "states.csv").read_text(encoding="utf-8").startswith("time,own.")
    assert not Path("data", "still.png").exists()  # of an earlier run, as far as anybody knows
    assert called(*run).exit_code == 0  # a run replaces an earlier one
    Path("notes").mkdir()
    Path("notes", "read.me").write_text("mine", encoding="utf-8")
    assert called(*run[:-1], "notes").exit_code == 0
    assert Path("notes", "read.me").exists()


def test_run_compares_with_what_was_published(folder: Path) -> None:
    reference = """
        [reference]
        source = "A paper, Table 2"
        time = 1.0
        [reference.ships.own]
        printed = {x = -58.0, y = 7.0, v_x = 4.0}
        corrected = {y = 5.0}
        tolerance = {horizontal = 0.1, vertical = 0.1, quaternion = 0.005, velocity = 1e-9, rate = 0.003}
    """
    with Path("encounter.toml").open("a", encoding="utf-8") as file:
        file.write(reference)
    result = called("run", "encounter.toml", "--in-process")
    assert result.exit_code == 0, result.stderr
    assert "encounter: A paper, Table 2, at 1 s" in result.stdout
    rows = [line.split() for line in result.stdout.splitlines()]
    (y,) = (row for row in rows if row[:2] == ["y", "m"])
    assert y[2:4] == ["7.0000", "*5.0000"]
    assert y[-1] == "yes"
    (v_x,) = (row for row in rows if row[:2] == ["v_x", "m/s"])
    assert max(map(len, result.stdout.splitlines())) <= 80
    assert v_x[-1] == "NO"  # the ships touch at 0.5 s
    assert "of 3 numbers within tolerance" in result.stdout


def test_a_published_collision_is_the_default() -> None:
    result = called("run", "--help")
    assert "guan2014" in result.output
    (argument,) = (p for p in main.commands["run"].params if p.name == "scenario")
    assert argument.default == "guan2014"


def test_build_names_the_ships_and_takes_arrays_apart(folder: Path) -> None:
    built = called("build", "--out", "fmus", "--fmi", "3", "--scalar", "--ships", "tug")
    assert built.exit_code == 0, built.output
    assert built.stdout.split() == ["fmus/ShipCollision.fmi3-scalar.fmu", "fmus/ShipManoeuvring.fmi3-scalar.fmu"]
    with zipfile.ZipFile(folder / "fmus" / "ShipCollision.fmi3-scalar.fmu") as archive:
        description = archive.read("modelDescription.xml")
    assert b'name="tug.position.north"' in description
    assert b'name="own.' not in description


def test_build_without_python(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    library = Binary("win64", ".dll", b"MZ")
    monkeypatch.setattr(fmu_binaries, "build_binaries", lambda name, platforms, report: {2: [library]})
    monkeypatch.setattr(native_fmus, "build_binaries", lambda name, platforms, report: {2: [library]})
    monkeypatch.setattr(native_fmus, "list_ship_names", lambda: ["buoy"])
    monkeypatch.setattr(libraries, "native_cache", lambda: NATIVE_CACHE)
    bullet_sources.find_bullet_sources(NATIVE_CACHE)  # else that it is fetched would be said
    built = called("build", "--native", "--platforms", "win64", "--out", "fmus", "--sources")
    both = "fmus/ShipCollision.native.fmu\nfmus/ShipManoeuvring.native.fmu\n"
    assert (built.exit_code, built.stdout, built.stderr) == (0, both, "")
    for name, own in (("ShipManoeuvring", "manoeuvring/model.cpp"), ("ShipCollision", "collision/model.cpp")):
        with zipfile.ZipFile(folder / "fmus" / f"{name}.native.fmu") as archive:
            names = archive.namelist()
        assert {f"binaries/win64/{name}.dll", "sources/fmi/fmi2.cpp", f"sources/{own}"} <= set(names)


def test_a_build_without_the_source_of_bullet_is_one_line(
    folder: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def fail(place: Path) -> None:
        raise OSError("no network")

    monkeypatch.setattr(libraries, "native_cache", lambda: tmp_path / "cache")
    monkeypatch.setattr(fmu_binaries, "find_compiler", lambda target: None)
    monkeypatch.setattr(bullet_sources, "_fetch_by_pip", fail)
    for command in (["build", "--native", "--out", "fmus"], ["run", "guan2014_added_mass", "--native", "--out", "run"]):
        result = called(*command)
        note, error = result.stderr.splitlines()
        assert (result.exit_code, result.stdout) == (1, "")
        assert note.startswith("note: pip fetches Bullet's source, 80 MB, once")
        assert error.startswith("error: Bullet's source cannot be fetched: pip downloads it as the source distribution")
        assert "(no network)" in error
    assert not (folder / "fmus").exists()
    assert not (folder / "run").exists()


def test_without_a_compiler_nothing_is_fetched(folder: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def fail(*given: object) -> None:
        raise HostError("no compiler")

    monkeypatch.setattr(libraries, "native_cache", lambda: tmp_path / "cache")
    monkeypatch.setattr(fmu_binaries, "find_compiler", fail)
    result = called("build", "--native")
    assert (result.exit_code, result.stderr) == (1, "error: no compiler\n")
    assert not (tmp_path / "cache").exists()


def test_ships_and_scenarios_are_listed() -> None:
    ships, scenarios = called("ships"), called("scenarios")
    assert (ships.exit_code, scenarios.exit_code) == (0, 0)
    assert "kvlcc2" in ships.stdout
    assert "L_pp" in ships.stdout
    assert "[m]" in ships.stdout
    assert "kvlcc2_crossing" in scenarios.stdout


def test_a_ship_shows_its_figures() -> None:
    shown = called("ships", "guan2014_target_manoeuvring")
    assert shown.exit_code == 0, shown.output
    for figure in ("GM_T", "roll period", "service speed", "rated power", "bollard pull", "crash stop, track reach"):
        assert figure in shown.stdout, figure
    assert max(map(len, shown.stdout.partition("Estimated:")[0].splitlines())) <= 60
    (yaw,) = (line.split() for line in shown.stdout.splitlines() if "yaw I_zz" in line)
    assert yaw[-3:] == [f"{42.08e6 * (0.25 * 250.0) ** 2:.4g}", "kg", "m2"]  # about CG: m k_zz^2
    assert sum("added mass, " in line or "added inertia about CO, " in line for line in shown.stdout.splitlines()) == 6
    assert "  [engine] rate = " in shown.stdout  # an estimate is told as one
    coasting = called("ships", "guan2014_own")
    assert coasting.exit_code == 0
    assert "note: it coasts" in coasting.stdout
    unknown = called("ships", "kvlc2")
    assert (unknown.exit_code, unknown.stderr.count("did you mean kvlcc2?")) == (2, 1)


def test_build_and_validate(folder: Path) -> None:
    built = called("build", "--out", "fmus")
    assert built.exit_code == 0, built.stderr
    assert built.stdout.split() == ["fmus/ShipCollision.fmu", "fmus/ShipManoeuvring.fmu"]
    path = built.stdout.split()[1]
    result = called("validate", path, "--no-calls")
    assert (result.exit_code, result.stdout) == (0, f"{path}: no problem found\n")


def test_validate_fails_on_a_problem(folder: Path) -> None:
    import zipfile

    with zipfile.ZipFile("spoilt.fmu", "w") as archive:
        archive.writestr("modelDescription.xml", "<fmiModelDescription/>")
    result = called("validate", "spoilt.fmu")
    assert result.exit_code == 1
    assert result.stdout.startswith("spoilt.fmu: ")
    assert result.stderr.startswith("error: spoilt.fmu has ")


def edited(old: str, new: str) -> None:
    for name in ("encounter.toml", "barge.toml"):
        path = Path(name)
        path.write_text(path.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")


@pytest.mark.parametrize(
    ("old", "new", "arguments", "status", "line"),
    [
        ("speed", "sped", [], 2, "encounter.toml: [ships.own] sped is not a known key: did you mean speed?"),
        ("./barge.toml", "kvlc2", [], 2, "unknown ship 'kvlc2': did you mean kvlcc2?"),
        ("8200000.0", "-82e5", [], 2, "[ships.own] barge.toml: [particulars] mass = -8200000.0"),
        ("8200000.0", "82e6", [], 2, "rho"),
        ("step = 0.05", "step = 0.0", [], 2, "encounter.toml: [scenario] step = 0.0 must be greater than 0"),
        ("", "", ["--step", "0"], 2, "encounter.toml with another step: [scenario] step = 0.0 must be greater than 0"),
        ("", "", ["--step", "nan"], 2, "encounter.toml with another step: [scenario] step = nan must be a finite"),
        ("", "", ["--step", "0.4"], 2, "duration = 1.5 s is 3.75 steps of 0.4 s, must be a whole number: take"),
        ("", "", ["--step", "x"], 2, "Invalid value for '--step': 'x' is not a number: give one such as 0.5"),
        ("4.0", "nan", [], 2, "encounter.toml: [ships.own] speed = nan must be a finite number"),
        ("", "", ["--algorithm", "gauss"], 2, "Invalid value for '--algorithm': 'gauss': did you mean gauss-seidel?"),
        ("", "", ["--dry"], 2, "there is no option --dry: known: --out, --algorithm, --"),
        ("", "", ["--stp", "1"], 2, "there is no option --stp: did you mean --step? (see `main run --help`)"),
        ("", "", ["--out", "barge.toml"], 1, "cannot write to barge.toml: barge.toml is not a folder; give another"),
        ("", "", ["--out", "/proc/x"], 1, "cannot write to /proc/x: "),
    ],
)  # fmt: skip
def test_a_mistake_is_one_line_and_writes_nothing(
    folder: Path, old: str, new: str, arguments: list[str], status: int, line: str
) -> None:
    edited(old, new)
    before = sorted(folder.rglob("*"))
    result = called("run", "encounter.toml", *arguments)
    assert result.exit_code == status
    assert result.stdout == ""
    assert result.stderr.startswith("error: ")
    assert result.stderr.count("\n") == 1
    assert line in result.stderr
    assert sorted(folder.rglob("*")) == before


@pytest.mark.parametrize(
    ("arguments", "status", "line"),
    [
        (["rnu"], 2, "unknown command 'rnu': did you mean run? (see `main --help`)"),
        (
            ["run", "kvlcc2_crosing"],
            2,
            "unknown scenario 'kvlcc2_crosing': did you mean kvlcc2_crossing? Else give the path of a TOML",
        ),
        (["run", "absent.toml"], 2, "scenario file absent.toml does not exist: give the path of a TOML file or one of"),
        (["run", "one", "two"], 2, "Got unexpected extra argument"),
        (["validate"], 2, "Missing argument 'FMU'"),
        (["build", "--scalar"], 2, "--scalar is for FMI 3.0: FMI 2.0 has no arrays; add --fmi 3 or leave it out"),
        (["build", "--ships", "own,contact"], 2, "ships: 'contact' is no name for a ship"),
        (["build", "--ships", "own,own"], 2, "ships: 'own' is there twice"),
        (["build", "--native", "--ships", "own,own"], 2, "ships: 'own' is there twice: give each ship a name of its"),
        (["build", "--platforms", "win64"], 2, "--platforms is for native code: add --native or leave it out (see"),
        (["package", "guan2014", "--osp", "--platforms", "win64"], 2, "--platforms is for native code: add --native"),
        (["package", "guan2014", "--osp", "--native"], 2, "guan2014_added_mass and kvlcc2_crossing do, or leave --nat"),
        (["run", "guan2014", "--native"], 2, "[collision] response = 'bullet' needs Python, and native code has 'pgs'"),
        (["run", "--native"], 2, "as the scenarios guan2014_added_mass and kvlcc2_crossing do, or leave --native out"),
        (["run", "--native", "--in-process"], 2, "--in-process runs without FMI: leave out --native (see"),
        (["build", "--sources"], 2, "--sources is for native code: add --native or leave it out (see"),
        (["build", "--native", "--platforms", "amiga"], 2, "platform 'amiga' is unknown: give some of linux64, win64,"),
        (["build", "--native", "--out", "barge.toml"], 1, "cannot write to barge.toml: "),
        (["package", "guan2014", "--osp", "--inputs"], 2, "--inputs is for --ssp: an OSP system has all variables"),
        (["validate", "absent.fmu"], 2, "absent.fmu does not exist: build the FMUs with `shipcollision build`"),
        (["validate", "other.fmu", "--ignore", "unit"], 2, "--ignore 'unit' is not a check: did you mean units? (see"),
        (["run", "barge.toml"], 2, "barge.toml is a ship, not a scenario: give a scenario, whose [ships.NAME] ship"),
        (["ships", "encounter.toml"], 2, "encounter.toml is a scenario, not a ship: name one of the ship files in it"),
        (["run", "--out"], 2, "Option '--out' requires an argument (see `main run --help`)"),
        (["run", "--fmi", "4"], 2, "Invalid value for '--fmi': '4' must be one of 2, 3 (see"),
        (
            ["package", "guan2014", "--ssp", "--replace", "own=x.fmu"],
            2,
            "--replace: x.fmu does not exist: give a .fmu file",
        ),
        (["trial", "kvlcc2"], 2, "Missing argument 'MANOEUVRE'. Choose from: turning-circle, zigzag, crash-stop (see"),
        (["encounter", "imazuu"], 2, "unknown encounter 'imazuu': did you mean imazu? (see"),
        (["validate", "barge.toml"], 2, "barge.toml is not a zip archive: give the path of a .fmu file"),
        (
            ["validate", "other.fmu"],
            2,
            "other.fmu is no FMU: it has no modelDescription.xml; give the path of a .fmu file",
        ),
        (
            ["show", "run", "--still", "abc"],
            2,
            "Invalid value for '--still': 'abc' is not a number: give one such as 0.5",
        ),
        (["build", "--out", "barge.toml"], 1, "cannot write to barge.toml: "),
    ],
)
def test_bad_usage_is_one_line(folder: Path, arguments: list[str], status: int, line: str) -> None:
    with zipfile.ZipFile("other.fmu", "w") as archive:
        archive.writestr("readme.txt", "no FMU")
    result = called(*arguments)
    assert result.exit_code == status
    assert result.stdout == ""
    assert result.stderr.startswith("error: ")
    assert result.stderr.count("\n") == 1
    assert line in result.stderr


def test_a_nan_in_mid_run_is_one_line_and_writes_nothing(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from shipcollision_fmu.cosim import master

    advance = master.ALGORITHMS["gauss-seidel"]

    def broken(system: object, t: float, h: float) -> None:
        system.states[1].outputs.values[0] = float("nan")  # type: ignore[attr-defined]  # a system of any master
        advance(system, t, h)  # type: ignore[arg-type]  # a system of any master

    monkeypatch.setitem(master.ALGORITHMS, "gauss-seidel", broken)
    result = called("run", "encounter.toml")
    assert result.exit_code == 1
    assert result.stderr.startswith("error: collision: target.position = [nan, 0.0, 0.0] at t = 0.0 s is not finite")
    assert result.stderr.count("\n") == 1
    assert not (folder / "runs").exists()


def test_an_interrupted_run_writes_nothing(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from shipcollision_fmu.cosim import master

    def interrupted(system: object, t: float, h: float) -> None:
        raise KeyboardInterrupt

    monkeypatch.setitem(master.ALGORITHMS, "gauss-seidel", interrupted)
    result = called("run", "encounter.toml", "--in-process")
    assert result.exit_code == 130
    assert result.stderr.lstrip() == "error: interrupted; nothing is written\n"
    assert not (folder / "runs").exists()


SIGNALLED = """
import os, signal
from pathlib import Path
from shipcollision_fmu.cosim import fmu_files, master
fmu_files.fmu_directory = lambda ships=(): Path({fmus!r})
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell that starts the tests may have it ignored
advance = master.ALGORITHMS["gauss-seidel"]
def struck(system, t, h):
    if t > 0.2:
        os.kill(os.getpid(), signal.{signal})
    advance(system, t, h)
master.ALGORITHMS["gauss-seidel"] = struck
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "status", "line"),
    [("SIGINT", 130, "interrupted; nothing is written"), ("SIGTERM", 143, "ended by a signal; nothing is written")],
)
def test_a_signal_leaves_no_unpacked_fmu_behind(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, status: int, line: str
) -> None:
    (tmp_path / "unpacked").mkdir()
    monkeypatch.setenv("TMPDIR", str(tmp_path / "unpacked"))
    prelude = SIGNALLED.format(fmus=str(fmu_files.ready_fmus()["ShipCollision"].parent), signal=name)
    done = fresh("run", "encounter.toml", cwd=folder, prelude=prelude)
    assert (done.returncode, done.stderr.lstrip()) == (status, f"error: {line}\n")
    assert list((tmp_path / "unpacked").iterdir()) == []
    assert not (folder / "runs").exists()


WITHOUT_PYBULLET = "import sys; sys.modules['pybullet'] = None"
"""Python treats a module that is None in sys.modules as one that is not installed."""
NOTHING_COMPILES = """
from shipcollision_fmu.toolchain import compilers, load
compilers._find_zig = compilers._find_system = load.find_installed_library = lambda: None
"""


def test_without_pybullet_both_fmus_are_built(folder: Path) -> None:
    result = fresh("build", "--out", "fmus", cwd=folder, prelude=WITHOUT_PYBULLET)
    assert (result.returncode, result.stderr) == (0, "")
    assert result.stdout.split() == ["fmus/ShipCollision.fmu", "fmus/ShipManoeuvring.fmu"]


def test_without_pybullet_and_library_a_run_is_refused_in_one_line(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nor is there a library that another test has compiled: the cache is empty."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    result = fresh("run", "encounter.toml", cwd=folder, prelude=f"{WITHOUT_PYBULLET}\n{NOTHING_COMPILES}")
    assert result.returncode == 1
    assert result.stdout == ""
    assert result.stderr.startswith(
        "error: contacts cannot be detected: pybullet, with wheels for CPython 3.10 and 3.11"
    )
    assert "there is no C++ compiler for native code: run `" in result.stderr
    assert result.stderr.count("\n") == 1
    assert sorted(path.name for path in folder.iterdir()) == ["barge.toml", "encounter.toml"]


def test_a_real_process_ends_as_it_should(folder: Path) -> None:
    done = fresh("run", "encounter.toml", "--in-process", "--out", "out", cwd=folder)
    assert done.returncode == 0
    assert "stored in out" in done.stdout
    assert "\x1b" not in done.stdout + done.stderr  # no colours in a pipe
    refused = fresh("run", "absent.toml", cwd=folder)
    assert (refused.returncode, refused.stdout) == (2, "")
    assert refused.stderr.startswith("error: scenario file absent.toml does not exist")
    assert refused.stderr.count("\n") == 1


def test_the_package_is_the_command_too(folder: Path) -> None:
    environment = os.environ | {"PYTHONPATH": str(fmu_files._PACKAGE.parent)}
    command = [sys.executable, "-m", "shipcollision_fmu", "--version"]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    assert __version__ in done.stdout


def test_a_trial_prints_its_figures_beside_the_limits(folder: Path) -> None:
    result = called("trial", "kvlcc2", "turning-circle", "--rudder-deg", "35", "--port", "--out", "turn.csv")
    assert result.exit_code == 0, result.stderr
    rows = {line.split("  ")[0].strip(): line.split() for line in result.stdout.splitlines() if line.strip()}
    assert rows["advance"][-3:] == ["L", "4.5", "kept"]
    assert rows["tactical diameter"][-3:] == ["L", "5", "kept"]
    assert "35 deg to port" in result.stdout
    assert "stored in turn.csv" in result.stdout
    assert Path("turn.csv").read_text(encoding="utf-8").startswith("time,x,y,heading,surge,sway,yaw_rate,rudder_angle,")
    assert max(map(len, result.stdout.splitlines())) <= 110
    for manoeuvre, figure in (("zigzag", "first overshoot"), ("crash-stop", "track reach")):
        assert figure in called("trial", "kvlcc2_l7", manoeuvre).stdout


def test_an_encounter_is_a_file_that_runs_and_collides(folder: Path) -> None:
    made = called(
        "encounter", "t-bone", "--at", "0.2", "--side", "port", "--time", "5", "--after", "1", "--out", "t.toml"
    )
    assert (made.exit_code, made.stdout) == (0, "stored in t.toml: run it with `shipcollision run t.toml`\n"), (
        made.stderr
    )
    result = called("run", "t.toml", "--in-process")
    assert result.exit_code == 0, result.stderr
    assert "own - target" in result.stdout
    printed = called("encounter", "t-bone", "--at", "0.2", "--side", "port", "--time", "5", "--after", "1")
    assert printed.stdout == Path("t.toml").read_text(encoding="utf-8")


def test_an_imazu_case_is_a_file(folder: Path) -> None:
    assert called("encounter", "imazu", "--case", "13", "--hydrodynamics", "--out", "i.toml").exit_code == 0
    assert Path("i.toml").read_text(encoding="utf-8").count("[ships.target_") == 3


SITUATION = """{"version": "0.2.0", "ownShip": {"static": {"id": 1, "dimensions": {"length": 100, "width": 16}},
"initial": {"position": {"lat": 58.0, "lon": 10.0}, "sog": 10, "cog": 0}, "waypoints": []},
"targetShips": [{"static": {"id": 2, "dimensions": {"length": 80, "width": 14}},
"waypoints": [{"position": {"lat": 58.01, "lon": 10.0}}, 
{"position": {"lat": 58.0, "lon": 10.0}, "leg": {"sog": 8}}]}]}"""


def test_a_traffic_situation_becomes_a_scenario_with_its_ships(folder: Path) -> None:
    Path("s.json").write_text(SITUATION, encoding="utf-8")
    made = called("import", "s.json", "--out", "in/s.toml", "--duration", "115", "--step", "0.5")
    assert made.exit_code == 0, made.stderr
    assert made.stdout.split() == ["in/s-own.toml", "in/s-target.toml", "in/s.toml"]
    result = called("run", "in/s.toml", "--in-process")
    assert result.exit_code == 0, result.stderr
    assert "own - target" in result.stdout  # head-on, 1.1 km apart, 18 kn: 110 s


@pytest.mark.parametrize("name", ["s.json", "S.XML"])
def test_a_run_of_a_traffic_file_is_sent_to_import(folder: Path, name: str) -> None:
    Path(name).write_text(SITUATION, encoding="utf-8")
    refused = called("run", name)
    assert refused.exit_code != 0
    assert refused.stderr.strip().endswith(
        f"{name} is no scenario file: make one with `shipcollision import {name} --out FILE.toml`"
    )
    if name == "s.json":
        assert called("import", name, "--out", "FILE.toml", "--duration", "2").exit_code == 0
        assert called("run", "FILE.toml", "--in-process", "--no-page").exit_code == 0


def test_import_replaces_no_other_ship_file_unless_told_so(folder: Path) -> None:
    Path("s.json").write_text(SITUATION, encoding="utf-8")
    Path("s-own.toml").write_text(BARGE, encoding="utf-8")
    made = ("import", "s.json", "--out", "s.toml", "--duration", "115", "--step", "0.5")
    refused = called(*made)
    assert (refused.exit_code, refused.stdout) == (1, "")
    assert refused.stderr == (
        "error: s-own.toml exists and would be replaced by another text: name the scenario differently with --out, or "
        "replace it with --overwrite\n"
    )
    assert Path("s-own.toml").read_text(encoding="utf-8") == BARGE
    assert not Path("s.toml").exists()
    assert called("import", "s.json", "--out", "t.toml", *made[4:]).exit_code == 0
    assert called(*made, "--overwrite").exit_code == 0
    assert Path("s-own.toml").read_text(encoding="utf-8") != BARGE
    assert called(*made).exit_code == 0  # the same text again


@pytest.mark.parametrize(
    ("arguments", "status", "line"),
    [
        (["trial", "kvlc2", "zigzag"], 2, "unknown ship 'kvlc2': did you mean kvlcc2?"),
        (["trial", "kvlcc2", "zigzagg"], 2, "Invalid value for 'MANOEUVRE': 'zigzagg': did you mean zigzag? (see"),
        (["trial", "kvlcc2", "turning-circle", "--rudder-deg", "-35"], 2, "rudder_deg = -35 must be greater"),
        (["trial", "kvlcc2", "turning-circle", "--speed", "155"], 2, "speed = 155 m/s must be above 0 and at most"),
        (["trial", "guan2014_own", "crash-stop"], 2, "so it can only coast: take one that is listed as manoeuvring"),
        (["trial", "kvlcc2", "zigzag", "--out", "barge.toml/x.csv"], 1, "cannot write to barge.toml: barge"),
        (["trial", "kvlcc2", "zigzag", "--out", "sub"], 1, "cannot write to sub: it is a folder"),
        (["trial", "kvlcc2", "crash-stop", "--rudder-deg", "9"], 2, "--rudder-deg goes with a turning-circle or a"),
        (["trial", "kvlcc2", "turning-circle", "--heading-deg", "9"], 2, "--heading-deg goes with a zigzag only"),
        (["encounter", "tbone", "--out", "x.toml"], 2, "unknown encounter 'tbone': did you mean t-bone?"),
        (["encounter", "glancing", "--angle-deg", "0", "--out", "x.toml"], 2, "KVLCC2 does not meet KVLCC2 at s = 0.1"),
        (["encounter", "t-bone", "--own", "kvlc2", "--out", "x.toml"], 2, "unknown ship 'kvlc2': did you mean kvlcc2?"),
        (["encounter", "t-bone", "--own-speed", "nan", "--out", "x.toml"], 2, "own_speed = nan must be 0 to 50: give"),
        (["encounter", "t-bone", "--case", "3"], 2, "--case goes with TYPE imazu only"),
        (["encounter", "imazu", "--out", "x.toml"], 2, "which of Imazu's cases? give --case 1 to 22"),
        (["encounter", "imazu", "--case", "0", "--out", "x.toml"], 2, "Imazu case 0 does not exist: take 1 to"),
        (["encounter", "imazu", "--case", "1", "--at", "0.1"], 2, "Imazu's cases have no at: take own, target"),
        (["encounter", "imazu", "--case", "one"], 2, "'--case': 'one' is not a whole number: give one such as 3"),
        (["encounter", "t-bone", "--out", "x.txt"], 2, "'--out': x.txt does not end in .toml: call it x.toml"),
        (["import", "bad.json", "--out", "x"], 2, "'--out': x does not end in .toml: call it x.toml"),
        (["encounter", "head-on", "--angle-deg", "90"], 2, "angle_deg = 90 must be 135 to 180 for this type: take"),
        (["encounter", "t-bone", "--angle-deg", "0"], 2, "close at 0.00 m/s, at least 0.15 m/s is needed"),
        (["import", "absent.json", "--out", "x.toml"], 2, "absent.json cannot be read: No such file or directory"),
        (["import", "barge.toml", "--out", "x.toml"], 2, "column 2 (char 1); give JSON of trafficgen or"),
        (["import", "bad.json", "--out", "x.toml"], 2, "[ownShip.initial] sog = 1000 must be less than or equal to 60"),
        (["import", "bad.json"], 2, "Missing option '--out'"),
    ],
)  # fmt: skip
def test_a_mistake_with_trial_encounter_and_import_is_one_line_and_writes_nothing(
    folder: Path, arguments: list[str], status: int, line: str
) -> None:
    Path("sub").mkdir()
    Path("bad.json").write_text(SITUATION.replace('"sog": 10', '"sog": 1000'), encoding="utf-8")
    before = sorted(folder.rglob("*"))
    result = called(*arguments)
    assert result.exit_code == status, result.stdout
    assert result.stdout == ""
    assert result.stderr.startswith("error: ")
    assert result.stderr.count("\n") == 1
    assert line in result.stderr
    assert sorted(folder.rglob("*")) == before


@pytest.mark.slow
def test_a_package_is_a_file_or_a_folder(folder: Path) -> None:
    done = called("package", "encounter.toml", "--ssp")
    assert (done.exit_code, done.stdout) == (0, "encounter.ssp\n")
    assert "note: The host chooses the algorithm; the scenario's own is gauss-seidel." in done.stderr
    done = called("package", "encounter.toml", "--osp", "--out", "osp")
    assert (done.exit_code, done.stdout) == (0, "osp\n")
    assert {path.name for path in (folder / "osp").iterdir()} == {
        "OspSystemStructure.xml", "ShipCollision_OspModelDescription.xml", "ShipManoeuvring_OspModelDescription.xml",
        "collision.fmu", "own.fmu", "target.fmu",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["encounter.toml"], "error: choose one form: --ssp or --osp (see "),
        (["encounter.toml", "--ssp", "--out", "x"], "error: --out x: hosts recognise the file by its suffix; call it"),
        (["encountr", "--ssp"], "error: unknown scenario 'encountr'"),
        (["kvlcc2_crossing", "--ssp"], "error: kvlcc2_crossing cannot be packaged whole: [ships.own] gives orders at"),
        (["encounter.toml", "--osp", "--out", "barge.toml"], "error: cannot write to barge.toml: it is a file"),
    ],
)
def test_a_mistake_with_package_is_one_line_and_writes_nothing(folder: Path, arguments: list[str], line: str) -> None:
    before = sorted(folder.iterdir())
    done = called("package", *arguments)
    assert done.exit_code != 0
    assert done.stderr.startswith(line)
    assert done.stderr.count("\n") == 1
    assert sorted(folder.iterdir()) == before
