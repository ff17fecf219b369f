"""A ship model of somebody else in a package: found by its names, refused with the remedy, wired by force."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner
from fmpy.ssp.ssd import read_ssd

from shipcollision_fmu.cli import main
from shipcollision_fmu.errors import ScenarioError
from shipcollision_fmu.packaging.foreign_ship import read_foreign_ship
from shipcollision_fmu.packaging.system_structure import build_system_structure
from shipcollision_fmu.scenario.scenario import load_scenario

Write = Callable[..., Path]
OURS = {
    "output": ("position.north", "position.east", "attitude.yaw", "velocity.surge", "velocity.sway", "rate.yaw"),
    "input": ("force.surge", "force.sway", "moment.yaw"),
}
WIRING = """
position = ["x", "y", ""]
attitude = ["", "", "psi"]
velocity = ["vx", "vy", ""]
rate = ["", "", "r"]
force = ["X", "Y", ""]
moment = ["", "", "N"]
velocity_frame = "n"
force_frame = "n"
[start]
psi = 1.5
"""
DESCRIPTION = (
    '<fmiModelDescription fmiVersion="2.0" modelName="Vessel"><CoSimulation modelIdentifier="Vessel"/>'
    "<ModelVariables>{}</ModelVariables></fmiModelDescription>"
)
THEIRS = {"output": ("x", "y", "psi", "vx", "vy", "r"), "input": ("X", "Y", "N")}
START_VALUE = 'start="0.0"'
SETTABLE = {"input": ("X", "Y", "N", "Z"), "parameter": ("U0",)}  # Z has a start value


def vessel(folder: Path, names: dict[str, tuple[str, ...]] = OURS, wiring: str = "", unit: str = "") -> Path:
    """An FMU of FMI 2.0 as far as a package reads it."""
    variables = "".join(
        f'<ScalarVariable name="{name}" valueReference="{k}" causality="{causality}"><Real {unit} '
        f"{START_VALUE if causality == 'parameter' or name == 'Z' else ''}/></ScalarVariable>"
        for causality, all_names in names.items()
        for k, name in enumerate(all_names)
    )
    folder.mkdir(exist_ok=True)
    with zipfile.ZipFile(folder / "vessel.fmu", "w") as archive:
        archive.writestr("modelDescription.xml", DESCRIPTION.format(variables))
    if wiring:
        (folder / "vessel.toml").write_text(wiring)
    return folder / "vessel.fmu"


def test_a_vessel_with_our_names_needs_no_wiring(scenario_file: Write, tmp_path: Path) -> None:
    scenario = load_scenario(scenario_file())
    system = build_system_structure(scenario, foreign={"own": read_foreign_ship(vessel(tmp_path / "v"))})
    assert [one.name for one in system.instances] == ["own", "target", "collision"]
    to_own = {c.input: c.output for c in system.connections if c.target == "own"}
    assert to_own == {name: f"own.{name}" for name in OURS["input"]}
    assert {c.output for c in system.connections if c.source == "own"} == set(OURS["output"])
    collision = system.instances[-1].start
    assert collision["own.feedback"] == "force"
    assert "target.feedback" not in collision
    assert any("own is vessel.fmu, coupled by force" in line for line in system.left_out)


def test_a_vessel_that_speaks_n_is_turned_by_the_collision(scenario_file: Write, tmp_path: Path) -> None:
    foreign = read_foreign_ship(vessel(tmp_path / "v", THEIRS, WIRING))
    system = build_system_structure(load_scenario(scenario_file()), foreign={"own": foreign})
    wires = {(c.source, c.output, c.target, c.input) for c in system.connections if "own" in (c.source, c.target)}
    assert wires == {
        ("own", "x", "collision", "own.position.north"), ("own", "y", "collision", "own.position.east"),
        ("own", "psi", "collision", "own.attitude.yaw"), ("own", "r", "collision", "own.rate.yaw"),
        ("own", "vx", "collision", "own.velocity.surge"), ("own", "vy", "collision", "own.velocity.sway"),
        ("collision", "own.force.surge", "own", "X"), ("collision", "own.force.sway", "own", "Y"),
        ("collision", "own.moment.yaw", "own", "N"),
    }  # fmt: skip
    assert system.instances[0].start == {"psi": 1.5}
    collision = system.instances[-1].start
    assert (collision["own.velocity_frame"], collision["own.force_frame"]) == ("n", "n")


@pytest.mark.parametrize("form", ["--ssp", "--osp"])
def test_both_forms_hold_it(scenario_file: Write, tmp_path: Path, form: str) -> None:
    fmu, out = vessel(tmp_path / "v", THEIRS, WIRING), tmp_path / ("it.ssp" if form == "--ssp" else "osp")
    done = CliRunner().invoke(
        main, ["package", str(scenario_file()), form, "--out", str(out), "--replace", f"own={fmu}"]
    )
    assert done.exit_code == 0, done.output
    if form == "--ssp":
        system = read_ssd(str(out)).system
        assert [one.name for one in system.elements] == ["own", "target", "collision"]
        with zipfile.ZipFile(out) as archive:
            assert archive.read("resources/own.fmu") == fmu.read_bytes()
            assert b'name="psi"' in archive.read("resources/own.ssv")
    else:
        assert (out / "own.fmu").read_bytes() == fmu.read_bytes()
        text = (out / "OspSystemStructure.xml").read_text()
        assert '<Variable simulator="own" name="psi" />' in text
        assert '<VariableGroup simulator="own"' not in text
        assert '<VariableGroup simulator="target"' in text
        assert not (out / "vessel_OspModelDescription.xml").exists()


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (('"psi"]', '"heading"]'), "has no real output 'heading' for attitude.yaw: name it in vessel.toml"),
        (('"psi"]', '"heading"]'), "beside the FMU; it has x, y, psi, vx, vy, r$"),  # outputs alone
        (('["X", "Y", ""]', '["F", "Y", ""]'), "beside the FMU; it has X, Y, N, Z$"),  # inputs alone
        (('["vx", "vy", ""]', '["", "", ""]'), 'vessel.toml has "" for velocity.surge, which is required: vessel.fmu '
            "must have position.north, position.east, attitude.yaw, velocity.surge, velocity.sway, rate.yaw, "
            'force.surge, force.sway, moment.yaw; only the others may be ""$'),
        (("psi = 1.5", 'psi = "270"'), "[start] psi = '270' must be a number"),
        (("psi = 1.5", "psi = true"), "[start] psi = True must be a number"),
        (("psi = 1.5", 'velocity_frame = "n"'), "[start] velocity_frame: velocity_frame is no start value: it "
            "belongs above the line [start] of vessel.toml$"),
        (('force = ["X"', 'force = ["x"'), "has no real input 'x' for force.surge"),
        (('["X", "Y", ""]', '["X", "Y"]'), "force = ['X', 'Y'] must be three names, \"\" for what the model does"),
        (('force_frame = "n"', 'force_frame = "ned"'), "force_frame = 'ned' must be \"b\" or \"n\""),
        (("velocity_frame", "frame"), "vessel.toml: unknown key frame: known are position, attitude"),
        (("psi = 1.5", "mass = 1.5"), "[start] mass: vessel.fmu has no such variable; it has Z, U0$"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused(tmp_path: Path, change: tuple[str, str], reason: str) -> None:
    with pytest.raises(ScenarioError) as refused:
        read_foreign_ship(vessel(tmp_path / "v", THEIRS | SETTABLE, WIRING.replace(*change)))
    assert reason in f"{refused.value}$"


def test_other_mistakes_are_one_line(scenario_file: Write, tmp_path: Path) -> None:
    with pytest.raises(ScenarioError, match=r"x of vessel.fmu is in deg, position.north in m: convert it in the model"):
        read_foreign_ship(vessel(tmp_path / "v", THEIRS, WIRING, 'unit="deg"'))
    (tmp_path / "no.fmu").write_text("text")
    with pytest.raises(ScenarioError, match=r"no.fmu is no FMU that can be read"):
        read_foreign_ship(tmp_path / "no.fmu")
    scenario = load_scenario(scenario_file())
    with pytest.raises(ScenarioError, match=r"--replace tug: encounter has no such ship: it has own, target"):
        build_system_structure(scenario, foreign={"tug": read_foreign_ship(vessel(tmp_path / "w"))})
    done = CliRunner().invoke(main, ["package", "guan2014", "--ssp", "--replace", "own"])
    assert done.exit_code == 2
    assert "say which ship and by which file" in done.output


START = (
    "The scenario starts own at north 5 m, east -64 m, yaw 1.5708 rad, surge 4 m/s: give these in [start] of "
    "vessel.toml, by the parameter names of vessel.fmu"
)


@pytest.mark.one_in(2)
@pytest.mark.parametrize("wiring", [WIRING, WIRING.replace("psi = 1.5", "")])
def test_the_scenarios_start_is_said_unless_the_vessel_is_given_one(
    scenario_file: Write, tmp_path: Path, wiring: str
) -> None:
    fmu = vessel(tmp_path / "v", THEIRS, wiring)
    package = ["package", str(scenario_file()), "--osp", "--out", str(tmp_path / "osp"), "--replace", f"own={fmu}"]
    done = CliRunner().invoke(main, package)
    assert done.exit_code == 0, done.output
    assert (
        done.stderr.count("The scenario starts own at ") == done.stderr.count(START) == (0 if wiring == WIRING else 1)
    )


@pytest.mark.parametrize("form", ["--ssp", "--osp"])
def test_a_package_replaces_no_file_of_other_origin_unless_told_so(
    scenario_file: Write, tmp_path: Path, empty_fmus: None, form: str
) -> None:
    """Another system's description, or an FMU beside none: kept. Both remedies work, and a package replaces its own."""
    scenario = str(scenario_file())
    for name in ("it.ssp",) if form == "--ssp" else ("own.fmu", "OspSystemStructure.xml"):
        place = tmp_path / name if form == "--ssp" else tmp_path / "osp"
        mine = place if form == "--ssp" else place / name
        place.parent.mkdir(exist_ok=True)
        mine.parent.mkdir(exist_ok=True)
        mine.write_text("mine")
        package = ["package", scenario, form, "--out", str(place)]
        refused = CliRunner().invoke(main, package)
        assert (refused.exit_code, mine.read_text()) == (1, "mine")
        assert f"holds {name}" in refused.stderr
        assert "of other origin" in refused.stderr
        assert f"give another {'file' if form == '--ssp' else 'folder'} with --out, or replace" in refused.stderr
        assert CliRunner().invoke(main, [*package[:-1], str(tmp_path / f"other-{name}.ssp")]).exit_code == 0
    assert CliRunner().invoke(main, [*package, "--overwrite"]).exit_code == 0
    assert CliRunner().invoke(main, package).exit_code == 0
