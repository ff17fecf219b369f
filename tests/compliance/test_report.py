"""`shipcollision validate`: our FMUs pass, and every check finds what breaks it."""

from __future__ import annotations

import math
import re
import subprocess
import sys
import zipfile
from functools import cache, partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from click.testing import CliRunner

from shipcollision_fmu.cli import main
from shipcollision_fmu.compliance import probes, strict_probes
from shipcollision_fmu.compliance.calls import run_probes
from shipcollision_fmu.compliance.probes import PROBES
from shipcollision_fmu.compliance.report import NAMES, find_problems, validate
from shipcollision_fmu.compliance.rules import RULES
from shipcollision_fmu.compliance.subject import Subject
from shipcollision_fmu.cosim.fmu_files import ready_fmus
from shipcollision_fmu.errors import InputError


@pytest.mark.parametrize(
    ("name", "fmi"),
    [
        ("ShipManoeuvring", 2),
        pytest.param("ShipManoeuvring", 3, marks=pytest.mark.slow),
        pytest.param("ShipCollision", 3, marks=pytest.mark.slow),
        pytest.param("ShipCollision", 2, marks=pytest.mark.slow),
    ],
)
def test_our_fmus_have_no_problem(name: str, fmi: int) -> None:
    """The notes are faults of the wrappers: they do not tell a slave which guid the host gave, refuse most calls with
    the next step only, and null no handle; that of FMI 2.0 decodes %20 alone in the URI of its resources, that of FMI
    3.0 drops start and stop time."""
    both = ["wrong-token", "error-status", "state-handle"]
    notes = {2: [*both, "locations", "folder-name"], 3: ["stop-time", "start-time", *both]}[fmi]
    found = validate(ready_fmus(fmi=fmi)[name])
    assert [one.check for one in found] == notes
    if fmi == 2:
        crash = "folder-name: crashes the host (SIGSEGV): any name of its folder will do, such as a(1) é#%25"
        assert str(found[-1]) == crash


def test_a_problem_is_one_line(tmp_path: Path) -> None:
    found = find_problems(changed(tmp_path, 2, 'unit="m/s"', 'unit="knots"'), calls=False)
    assert any("knots" in line for line in found)
    assert all(line == " ".join(line.split()) for line in found)


def test_what_is_no_fmu_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"nothing.fmu does not exist: build the FMUs with `shipcollision build`"):
        find_problems(tmp_path / "nothing.fmu")
    (tmp_path / "text.fmu").write_text("text")
    with pytest.raises(InputError, match=r"text.fmu is not a zip archive: give the path of a .fmu file"):
        find_problems(tmp_path / "text.fmu")
    with pytest.raises(InputError, match=r"'colour' is not a check: one of fmpy, units, "):
        validate(ready_fmus()["ShipManoeuvring"], ignore=["colour"])


def test_a_description_that_cannot_be_read_is_a_problem(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "broken.fmu", "w") as archive:
        archive.writestr("modelDescription.xml", "<fmiModelDescription")
    assert [one.check for one in validate(tmp_path / "broken.fmu")] == ["fmpy"]


# What FMPy leaves out of the description. ---------------------------------------------------------------------------


@cache
def read_good(fmi: int) -> tuple[tuple[zipfile.ZipInfo, bytes], ...]:
    """The entries of ShipManoeuvring."""
    with zipfile.ZipFile(ready_fmus(fmi=fmi)["ShipManoeuvring"]) as good:
        return tuple((entry, good.read(entry)) for entry in good.infolist())


def changed(folder: Path, fmi: int, *replaced: str) -> Path:
    """ShipManoeuvring with some of its description's text replaced by regular expressions: old, new, old, new ..."""
    path = folder / "changed.fmu"
    with zipfile.ZipFile(path, "w") as bad:
        for entry, data in read_good(fmi):
            if entry.filename == "modelDescription.xml":
                text = data.decode()
                for old, new in zip(replaced[::2], replaced[1::2], strict=True):
                    text, times = re.subn(old, new, text)
                    assert times, f"{old} is not in the description"
                data = text.encode()
            bad.writestr(entry, data)
    return path


def repacked(folder: Path, fmi: int, files: dict[str, bytes | None]) -> Path:
    """ShipManoeuvring with files replaced, added, or left out where there is None."""
    path = folder / "repacked.fmu"
    with zipfile.ZipFile(path, "w") as bad:
        packed = {entry.filename: data for entry, data in read_good(fmi)}
        for name, data in {**packed, **files}.items():
            if data is not None:
                bad.writestr(name, data)
    return path


def renamed(folder: Path) -> Path:
    """Its library under another name, and one file with another date."""
    path = folder / "renamed.fmu"
    with zipfile.ZipFile(ready_fmus()["ShipManoeuvring"]) as good, zipfile.ZipFile(path, "w") as bad:
        for entry in good.infolist():
            name = entry.filename.replace("64/ShipManoeuvring", "64/Ship")
            moved = zipfile.ZipInfo(name, (2001, 2, 3, 4, 5, 6) if name != entry.filename else entry.date_time)
            bad.writestr(moved, good.read(entry))
    return path


ITEMS = '<Item name="a" value="1"/><Item name="b" value="1"/>'
TYPES = f'<SimpleType name="T"><Enumeration>{ITEMS}</Enumeration></SimpleType>'
BROKEN = {
    "units": [(2, ('unit="m/s" ', ""), "without a unit: velocity.surge, velocity.sway, velocity.heave"),
              (3, ('unit="m/s"', ""), "without a unit: velocity, current, wind.speed, initial.velocity")],
    "exponents": [(2, (r'<BaseUnit kg="1" m="1" s="-2" />', ""), "units without exponents of the SI base units: N;"),
                  (2, (r'<BaseUnit m="1" />', "<BaseUnit />"), "units whose BaseUnit is empty: m;")],
    "start": [(2, ('start="false"', ""), "hydrodynamics has no start value"),
              (2, ('max="6" start="6"', 'max="6" start="7"'), "7 of degrees_of_freedom is outside its limits 3 to 6"),
              (2, ('start="6"', 'start="six"'), "the start value 'six' of degrees_of_freedom is no Integer"),
              (3, ('start="0.0 0.0 0.0"', 'start="0.0 x 0.0"'), "the start value 'x' of impulse.linear is no Float64")],
    "limits": [(2, ('min="3" max="6"', 'min="7" max="6"'), "min = 7 of degrees_of_freedom is above its max = 6")],
    "initial": [(2, ('causality="input"', 'causality="input" initial="exact"'), "rudder_order is input and must not"),
                (3, ('causality="independent"', 'causality="independent" initial="exact"'), "time is independent and")],
    "dependencies": [(2, ('(<Unknown index="1") dependencies=""', r"\1"),
                      "outputs without dependencies, which then depend on every input: position.north;"),
                     (3, ('(<Output valueReference="1") dependencies=""', r"\1"), "every input: position;")],
    "knowns": [(3, ('<Output valueReference="1" dependencies=""', '<Output valueReference="1" dependencies="29"'),
                "output position depends on substep, which is a parameter")],
    "enumerations": [(2, ("<LogCategories>", f"<TypeDefinitions>{TYPES}</TypeDefinitions><LogCategories>"),
                      "two items of type T have the same value")],
    "nominals": [(2, (' nominal="100.0"', ""), "without a nominal value: position.north, position.east, position.down"),
                 (3, (' nominal="100.0"', ""), "without a nominal value: position, initial.position")],
    "experiment": [(2, ('stopTime="60.0" tolerance="1e-06" ', ""), "DefaultExperiment has no stopTime, tolerance"),
                   (3, ('<DefaultExperiment [^>]*>', ""), "DefaultExperiment has no stopTime, tolerance, stepSize")],
    "authorship": [(2, ('author="[^"]*" copyright="[^"]*" ', ""), "the description does not say author, copyright")],
    "token": [(2, ('guid="[^"]*"', 'guid=" "'), "guid (instantiationToken) is empty")],
    "content": [(2, ('start="0.05"', 'start="0.06"'), "the file was changed after it was built"),
                (3, ('instantiationToken="....', 'instantiationToken="0123'), "but resources/build.json has")],
    "reproducible": [(2, ('guid="', 'generationDateAndTime="2026-01-01T00:00:00Z" guid="'),
                      "generationDateAndTime makes every build another file")],
}  # fmt: skip


@pytest.mark.parametrize(
    ("rule", "fmi", "replaced", "line"), [(rule, *case) for rule, cases in BROKEN.items() for case in cases]
)
def test_a_rule_finds_what_breaks_it(tmp_path: Path, rule: str, fmi: int, replaced: tuple[str, str], line: str) -> None:
    subject = Subject(changed(tmp_path, fmi, *replaced))
    (check,) = (one.check for one in RULES if one.name == rule)
    assert any(line in found for found in check(subject)), list(check(subject))


def test_rules_about_the_archive(tmp_path: Path) -> None:
    found = {one.check: one.line for one in validate(renamed(tmp_path), calls=False)}
    assert found["library"] == "the libraries are called Ship, the model identifier is ShipManoeuvring"
    assert "the files in the archive have different dates" in found["reproducible"]
    assert "the file was changed after it was built" in found["content"]


REPACKED = {
    "documents": [
        (3, {"documentation/externalDependencies.txt": None}, "needsExecutionTool is true: documentation/externalD"),
        (2, {"documentation/licenses/license.txt": None}, "there are licences, but documentation/licenses/license.txt"),
    ],
    "icon": [
        (2, {"model.png": None}, "there is no icon: add model.png"),
        (3, {"terminalsAndIcons/icon.png": None}, "there is no icon: add terminalsAndIcons/icon.png"),
    ],
    "platforms": [
        (2, {"binaries/win64/ShipManoeuvring.dll": b"\x7fELF"}, "binaries/win64/ShipManoeuvring.dll is no library of"),
        (2, {"binaries/linux64/ShipManoeuvring.so": b"MZ"}, "binaries/linux64/ShipManoeuvring.so is no library of"),
        (2, {"resources/requirements.txt": b"numpy\npybullet>=3.2.5\n"},
         "binaries/win64/ShipManoeuvring.dll cannot work: pybullet of resources/requirements.txt exists for Linux"),
    ],
}  # fmt: skip


@pytest.mark.parametrize(
    ("rule", "fmi", "files", "line"), [(rule, *case) for rule, cases in REPACKED.items() for case in cases]
)
def test_a_rule_finds_a_file_that_is_missing_or_wrong(
    tmp_path: Path, rule: str, fmi: int, files: dict[str, bytes | None], line: str
) -> None:
    (check,) = (one.check for one in RULES if one.name == rule)
    assert list(check(Subject(ready_fmus(fmi=fmi)["ShipManoeuvring"]))) == []
    found = list(check(Subject(repacked(tmp_path, fmi, files))))
    assert len(found) == 1
    assert line in found[0]


def test_every_rule_has_a_case() -> None:
    assert {*BROKEN, *REPACKED, "library"} == {rule.name for rule in RULES}
    assert len(set(NAMES)) == len(NAMES)


# What calls show. ---------------------------------------------------------------------------------------------------

CARELESS = """
import itertools
from pythonfmu import Fmi2Causality, Fmi2Initial, Fmi2Slave, Fmi2Variability, Real

count = itertools.count()


class Careless(Fmi2Slave):
    '''Takes everything, and remembers what it should not.'''

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.number = next(count)
        self.x, self.gain, self.hidden = 0.0, 1.0, 0.0
        self.register_variable(Real("x", causality=Fmi2Causality.output, initial=Fmi2Initial.calculated))
        self.register_variable(Real("gain", causality=Fmi2Causality.parameter, variability=Fmi2Variability.fixed))

    def get_real(self, vrs):
        return [self.x if min(vrs) >= 0 else 0.5 for _ in vrs]

    def do_step(self, t, h):
        self.hidden += 1.0
        self.x = self.hidden + 100.0 * self.number
        return self.number not in (1, 18)  # 18: the second of the two that should run side by side
"""
FAILING = """
from pythonfmu import Fmi2Slave


class Failing(Fmi2Slave):
    '''Cannot be initialised; ends the process when it is stepped.'''

    def exit_initialization_mode(self):
        raise RuntimeError("no")

    def do_step(self, t, h):
        import os
        os.abort()
"""


@pytest.fixture(scope="module")
def badly_made(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """FMUs by pythonfmu's own builder."""
    folder = tmp_path_factory.mktemp("bad")
    for name, text in (("Careless", CARELESS), ("Failing", FAILING)):
        (folder / f"{name}.py").write_text(text)
        build = ["build", "-f", f"{name}.py", "--handle-state", "--serialize-state"]
        subprocess.run([sys.executable, "-m", "pythonfmu", *build], cwd=folder, check=True, capture_output=True)
    return [folder / "Careless.fmu", folder / "Failing.fmu"]


def test_every_probe_finds_what_breaks_it(badly_made: list[Path]) -> None:
    careless, failing = ([(probe.name, line) for probe, line in run_probes(fmu)] for fmu in badly_made)
    names = {probe.name for probe in PROBES}
    # start-time is found in our own FMUs for FMI 3.0, state-after-end below.
    assert {name for name, _ in careless + failing} == names - {"start-time", "state-after-end"}
    assert ("step-size", "a step of -0.01 s is not refused") in careless
    assert ("stop-time", "a step that ends after the stop time is not refused") in careless
    assert (
        "wrong-reference",
        "one unknown value reference spoils the other values of the call, which is not refused",
    ) in (careless)
    assert ("set-output", "setting output x is not refused") in careless
    assert ("reset", "after reset the outputs of the first step differ from the first time") in careless
    assert ("runs", "initialisation with the start values answers status 4") in failing
    assert ("step-first", "crashes the host (SIGABRT): no step before initialisation") in failing


class Strict:
    """An instance that follows the state machine of FMI 2.0 (section 4.2.4) to the letter: a call that is not allowed
    answers fmi2Error, and after that everything but reset and free does."""

    fmi = 2

    def __init__(
        self, folder: Path, token: str | None = None, *, by_standard: bool = False, location: str | None = None
    ) -> None:
        if token is not None:
            raise ValueError("another guid")
        capabilities = SimpleNamespace(canBeInstantiatedOnlyOncePerProcess=False, canGetAndSetFMUstate=False)
        variable = partial(SimpleNamespace, type="Real", dimensions=[])
        self.description = SimpleNamespace(coSimulation=capabilities, modelVariables=[
            variable(name="x", valueReference=0, causality="output", variability="continuous"),
            variable(name="k", valueReference=1, causality="parameter", variability="fixed"),
        ])  # fmt: skip
        self.fmu = SimpleNamespace(freeInstance=lambda: None)
        self.mode, self.stop, self.now = "instantiated", math.inf, 0.0

    def call(self, name: str, *arguments: Any) -> int:
        """A call by name."""
        if name == "Reset":
            self.mode = "instantiated"
            return 0
        before, after = {
            "EnterInitializationMode": ("instantiated", "initialising"),
            "ExitInitializationMode": ("initialising", "running"),
            "Terminate": ("running", "terminated"),
        }[name]
        return self._answer(self.mode == before, after)

    def _answer(self, allowed: bool, after: str) -> int:
        self.mode = after if allowed else "error"
        return 0 if allowed else 3

    def enter(self, start: float = 0.0, stop: float | None = None) -> int:
        """Set up the experiment and enter."""
        self.now, self.stop = start, math.inf if stop is None else stop
        return self.call("EnterInitializationMode")

    def begin(self, start: float = 0.0, stop: float | None = None) -> int:
        """Through initialisation."""
        return self.enter(start, stop) or self.call("ExitInitializationMode")

    def step(self, t: float, h: float) -> int:
        """A step."""
        allowed = self.mode == "running" and h > 0.0 and t + h <= self.stop * (1.0 + 1e-9)
        self.now = t + h
        return self._answer(allowed, "running")

    def step_size(self) -> float:
        """Proposed."""
        return 0.1

    def set(self, variable: Any, value: float) -> int:
        """Neither an output nor a parameter may be set on the way."""
        return self._answer(self.mode == "instantiated" and variable.causality == "parameter", self.mode)

    def read(self, references: list[int]) -> tuple[int, list[float]]:
        """Values."""
        return self._answer(max(references) < 2, self.mode), [self.now for _ in references]

    def read_outputs(self) -> list[str]:
        """All outputs."""
        return [self.now.hex()]

    find_variable = probes.Instance.find_variable


def test_an_fmu_that_follows_the_state_machine_is_not_blamed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """After an error FMI allows no step: a probe that asks for one has itself to blame."""
    monkeypatch.setattr(probes, "Instance", Strict)
    monkeypatch.setattr(strict_probes, "Instance", Strict)
    (tmp_path / "modelDescription.xml").write_text("")
    assert [(probe.name, line) for probe in PROBES for line in probe.run(tmp_path)] == []


class Forgetful(Strict):
    """An instance whose states have nothing in them, and whose handles stay as they are."""

    def __init__(self, folder: Path, **options: Any) -> None:
        super().__init__(folder, **options)
        self.description.coSimulation.canGetAndSetFMUstate = True

    def call(self, name: str, *arguments: Any) -> int:
        """A call by name."""
        if name == "GetFMUstate":
            arguments[0]._obj.value = 1
        return 0 if "FMUstate" in name else super().call(name, *arguments)


def test_states_that_restore_nothing_are_found(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(strict_probes, "Instance", Forgetful)
    assert list(strict_probes.probe_state_handle(tmp_path)) == [
        "a handle that was used for another state has not that state",
        "a handle is not a null pointer after its state was freed",
    ]
    assert list(strict_probes.probe_state_after_end(tmp_path)) == [
        "after terminate a state does not bring it back", "after reset a state does not bring it back",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("name", "fmi", "needs_tool", "is_binding"),
    [("folder-name", 2, True, False), ("folder-name", 2, False, True), ("stop-time", 3, True, False),
     ("stop-time", 3, False, True), ("runs", 3, True, True)],
)  # fmt: skip
def test_what_a_wrapper_cannot_give_binds_an_fmu_without_one(
    name: str, fmi: int, needs_tool: bool, is_binding: bool
) -> None:
    (probe,) = (probe for probe in PROBES if probe.name == name)
    assert probe.is_binding(fmi, needs_tool) == is_binding


@pytest.mark.slow
@pytest.mark.parametrize("flavour", ["2", "3", "3-scalar"])
def test_our_native_fmus_have_neither_problem_nor_note(native_fmus: dict[str, Path], flavour: str) -> None:
    assert [str(one) for one in validate(native_fmus[flavour])] == []


@pytest.mark.slow
def test_breaches_of_a_native_fmu_are_problems(tmp_path: Path) -> None:
    """A Python FMU that says it needs no tool."""
    fmu = changed(tmp_path, 2, 'needsExecutionTool="true"', 'needsExecutionTool="false"')
    found = {one.check for one in validate(fmu, ignore=["content", "documents"]) if one.binding}
    assert found == {"wrong-token", "error-status", "state-handle", "locations", "folder-name"}


def test_the_command_tells_problems_and_notes(badly_made: list[Path]) -> None:
    fmu = str(badly_made[0])
    done = CliRunner().invoke(main, ["validate", fmu, "--no-calls", "--ignore", "reproducible"])
    assert done.exit_code == 1
    assert f"{fmu}: note: units: without a unit: x, gain; give each a unit" in done.output
    assert "reproducible" not in done.output
    assert "step-first" not in done.output
    assert CliRunner().invoke(main, ["validate", fmu, "--ignore", "colour"]).exit_code == 2
