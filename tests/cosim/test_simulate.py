"""Whole runs: same bits with and without FMI, same files twice, a closed balance, failures that write nothing."""

from __future__ import annotations

import csv
import json
import sys
from importlib.resources import files
from math import hypot
from pathlib import Path

import numpy as np
import pytest
from jsonschema import validate

from shipcollision_fmu import load_scenario, load_ship, simulate
from shipcollision_fmu.collision.geometry import adapter
from shipcollision_fmu.cosim import master
from shipcollision_fmu.cosim.run import Run
from shipcollision_fmu.errors import HostError, ScenarioError, StepError
from shipcollision_fmu.ship.degrees_of_freedom import free_inverse
from shipcollision_fmu.ship.frames import rotation
from tests.conftest import Write

BOTH = pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
LINEAR, ANGLES = ("surge", "sway", "heave"), ("roll", "pitch", "yaw")


def ran(path: Path, **options: object) -> Run:
    return simulate(load_scenario(path), **{"in_process": True, **options})  # type: ignore[arg-type]  # passed on


def compared_files(out: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in out.iterdir() if path.name != "timing.json"}


@pytest.mark.one_in(2)
@BOTH
def test_fmus_and_models_in_process_give_the_same_files(scenario_file: Write, tmp_path: Path, algorithm: str) -> None:
    path = scenario_file()
    ran(path, in_process=False, algorithm=algorithm, out=tmp_path / "fmu")
    ran(path, in_process=False, fmi=3, algorithm=algorithm, out=tmp_path / "fmi3")
    run = ran(path, algorithm=algorithm, out=tmp_path / "in_process")
    assert compared_files(tmp_path / "fmu") == compared_files(tmp_path / "in_process")
    assert compared_files(tmp_path / "fmi3") == compared_files(tmp_path / "in_process")
    assert run.summary["collisions"] == 1


def test_a_scenario_may_be_a_path(scenario_file: Write) -> None:
    path = scenario_file()
    runs = [simulate(source, in_process=True) for source in (path, str(path), load_scenario(path))]
    assert [run.summary["scenario"] for run in runs] == ["encounter"] * 3


@pytest.mark.needs("pybullet")
def test_the_published_collision_is_the_same_to_the_bit_through_fmi_2_and_3(tmp_path: Path) -> None:
    """All states, contacts, events and figures of guan2014."""
    for fmi in (2, 3):
        simulate("guan2014", fmi=fmi, out=tmp_path / str(fmi))
    assert compared_files(tmp_path / "2") == compared_files(tmp_path / "3")
    assert len((tmp_path / "3" / "states.csv").read_text().splitlines()) == 122
    assert json.loads((tmp_path / "3" / "timing.json").read_text())["mode"] == "FMU, FMI 3.0"


@pytest.mark.parametrize(
    ("fmi", "in_process", "message"),
    [
        (1, False, "fmi = 1 must be 2 or 3, the version of FMI"),
        (3, True, "fmi = 3 with in_process = True: there is no FMI in process"),
    ],
)
def test_a_version_of_fmi_that_is_none_is_refused(
    scenario_file: Write, fmi: int, in_process: bool, message: str
) -> None:
    with pytest.raises(ScenarioError, match=message):
        ran(scenario_file(), fmi=fmi, in_process=in_process)


def test_running_twice_gives_the_same_files(scenario_file: Write, tmp_path: Path) -> None:
    path = scenario_file()
    for name in ("first", "second"):
        ran(path, in_process=False, out=tmp_path / name)
    first = compared_files(tmp_path / "first")
    assert first == compared_files(tmp_path / "second")
    assert sorted(first) == [
        "bodies.json", "contacts.csv", "events.json", "machinery.csv", "signals.csv", "states.csv", "summary.json",
        "surroundings.csv",
    ]  # fmt: skip
    assert json.loads((tmp_path / "first" / "timing.json").read_text())["mode"] == "FMU"


def test_numbers_in_csv_read_back_as_the_same_doubles(scenario_file: Write, tmp_path: Path) -> None:
    run = ran(scenario_file(), out=tmp_path / "run")
    for name, table in (("states", run.states), ("contacts", run.contacts), ("signals", run.signals)):
        with (tmp_path / "run" / f"{name}.csv").open() as file:
            rows = list(csv.DictReader(file))
        assert len(rows) == len(table) > 0
        assert tuple(rows[0]) == table.dtype.names
        for row, stored in zip(rows, table, strict=True):
            for column, text in row.items():
                value = stored[column].item()
                assert type(value)(text) == value


def test_there_is_a_row_per_communication_point(scenario_file: Write) -> None:
    states = ran(scenario_file()).states
    assert states["time"].tolist() == [round(k * 0.05, 9) for k in range(61)]
    assert states.dtype.names[:4] == ("time", "own.position.north", "own.position.east", "own.position.down")
    assert states.dtype.names[-1] == "target.rate.yaw"
    np.testing.assert_allclose(states["own.position.east"][:5], -64.0 + 4.0 * states["time"][:5], rtol=1e-14)


def test_events_fit_their_schema_and_the_run(scenario_file: Write, tmp_path: Path) -> None:
    run = ran(scenario_file(), out=tmp_path / "run")
    stored = json.loads((tmp_path / "run" / "events.json").read_text())
    validate(stored, json.loads(files("shipcollision_fmu.results").joinpath("events.schema.json").read_text()))
    (collision,) = stored["collisions"]
    assert (collision["ship_a"], collision["ship_b"]) == ("own", "target")
    assert collision["start"] == pytest.approx(1.0, abs=0.05)  # 4 m of water at 4 m/s
    assert collision["closing_speed"] == pytest.approx(4.0, rel=1e-6)
    assert collision["angle"] == pytest.approx(np.pi / 2)
    north, east, _ = collision["first_point"]["n"]
    assert east == pytest.approx(-10.0, abs=0.2)  # target's port side
    assert -6.0 < north < 16.0  # own's stem, 20 m wide
    assert collision["first_point"]["b_a"][0] == pytest.approx(50.0, abs=0.2)
    assert collision["first_point"]["b_b"][1] == pytest.approx(-10.0, abs=0.2)
    for scratch in stored["scratches"]:
        assert scratch["collision"] == 1
        assert len(scratch["time"]) == len(scratch["b_a"]) == len(scratch["b_b"])
        assert scratch["time"][0] == scratch["start"] <= scratch["end"] == scratch["time"][-1]
    assert collision["end"] == max(scratch["end"] for scratch in stored["scratches"]) == run.contacts["time"][-1]


@BOTH
def test_everything_issued_has_been_applied(scenario_file: Write, algorithm: str) -> None:
    """After the last contact; the restitution makes them part."""
    run = ran(scenario_file(("friction = 0.3", "friction = 0.3\nrestitution = 0.5")), algorithm=algorithm)
    assert run.contacts["time"][-1] < run.states["time"][-2]
    for name in ("own", "target"):
        ledger = run.summary["ledger"][name]
        assert hypot(*ledger["issued"][:3]) > 1e6
        assert ledger["pending"] == [0.0] * 6


def test_a_collision_takes_as_much_momentum_from_one_ship_as_it_gives_the_other(scenario_file: Write) -> None:
    """Coasting without added mass: momentum is the same before and after, energy falls by what contact dissipated."""
    added_mass = "m_x = 0.05\nm_y = 0.85\nm_z = 1.0\nj_x = 0.2\nj_y = 1.0\nj_z = 0.21"
    none = (added_mass, "M_A = [" + "[0, 0, 0, 0, 0, 0]," * 6 + "]")
    run = ran(scenario_file(barge=none))
    before, after = (np.array(run.summary["momentum"][when]["linear"]) for when in ("before", "after"))
    np.testing.assert_allclose(after, before, rtol=0, atol=1e-11 * np.linalg.norm(before))
    energy = run.summary["energy"]
    assert energy["dissipated"] == pytest.approx(energy["normal"] + energy["tangential"], rel=1e-12)
    assert energy["before"]["total"] - energy["after"]["total"] == pytest.approx(energy["dissipated"], rel=1e-6)
    assert run.events["collisions"][0]["energy"] == pytest.approx(energy["dissipated"], rel=1e-9)
    assert energy["dissipated"] > 1e6


def test_delta_v_is_what_the_ships_velocities_show(scenario_file: Write) -> None:
    """A coasting ship's velocity changes by impulses only; CO, which is not CG, turns a little besides."""
    run = ran(scenario_file())
    (collision,) = run.events["collisions"]
    for name in ("own", "target"):
        R = [rotation([run.states[f"{name}.attitude.{angle}"][k] for angle in ANGLES]) for k in (0, -1)]
        v = [np.array([run.states[f"{name}.velocity.{c}"][k] for c in LINEAR]) for k in (0, -1)]
        np.testing.assert_allclose(collision["delta_v"][name], R[1] @ v[1] - R[0] @ v[0], atol=0.03)


def test_delta_v_of_a_single_impulse_is_the_inverse_inertia_times_it(scenario_file: Write) -> None:
    run = ran(scenario_file(("friction = 0.3", "friction = 0.0\nrestitution = 1.0")))
    (collision,) = run.events["collisions"]
    ship = load_ship(load_scenario(scenario_file()).ship_file("own"))
    issued = np.array(run.summary["ledger"]["own"]["issued"])
    R_nb = rotation([0.0, 0.0, np.pi / 2])
    expected = R_nb @ (free_inverse(ship.M, 6) @ issued)[:3]
    np.testing.assert_allclose(collision["delta_v"]["own"], expected, atol=1e-9 + 0.01 * np.linalg.norm(expected))


def test_without_a_collision_there_are_no_events(scenario_file: Write) -> None:
    run = ran(scenario_file(("speed = 4.0", "speed = -4.0")))
    assert run.events == {"collisions": [], "scratches": []}
    assert len(run.contacts) == 0
    assert run.summary["energy"]["dissipated"] == 0.0
    assert run.summary["least_clearance"] == pytest.approx(4.0, abs=0.1)
    assert run.summary["nearest"] == ["own", "target"]


def test_more_than_two_ships_and_other_names(scenario_file: Write, tmp_path: Path) -> None:
    """The third lies behind the target and is not touched in this time."""
    third = '\n[ships.moored]\nship = "./barge.toml"\nposition = [0.0, 200.0]\nheading_deg = 0.0\n'
    path = scenario_file(("[ships.own]", "[ships.striking]"), added=third)
    with_fmus = ran(path, in_process=False)
    assert list(with_fmus.summary["ledger"]) == ["striking", "target", "moored"]
    assert with_fmus.events["collisions"][0]["ship_a"] == "striking"
    assert with_fmus.summary["ledger"]["moored"]["issued"] == [0.0] * 6
    np.testing.assert_array_equal(with_fmus.states, ran(path).states)


def test_ships_that_take_the_mean_force_answer_too(scenario_file: Write) -> None:
    """feedback "force" and "none": the ledger stays unused, the target is pushed or is not."""
    pushed = ran(scenario_file(("friction = 0.3", 'feedback = "force"')))
    assert abs(pushed.states["target.velocity.sway"][-1]) > 0.5
    assert pushed.summary["ledger"]["target"]["applied"] == [0.0] * 6
    ignored = ran(scenario_file(("friction = 0.3", 'feedback = "none"')))
    assert ignored.states["target.velocity.sway"][-1] == 0.0
    assert ignored.summary["collisions"] == 1


def test_orders_reach_the_helm(scenario_file: Write) -> None:
    """Two runs that differ in one order part after it and not before."""
    barge = 'ship = "./barge.toml"\nposition = [5.0, -64.0]'
    sailing = (barge, 'ship = "kvlcc2"\nhydrodynamics = true\nposition = [5.0, -900.0]')
    runs = [
        ran(scenario_file(sailing, ("speed = 4.0", f"speed = 4.0\norders = [{{time = 1.0, rudder_deg = {angle}}}]")))
        for angle in (0.0, 35.0)
    ]
    yaw = [run.states["own.attitude.yaw"] for run in runs]
    assert yaw[0][:21].tolist() == yaw[1][:21].tolist()
    assert yaw[1][-1] > yaw[0][-1]


def test_progress_is_called_after_every_step(scenario_file: Write) -> None:
    calls: list[tuple[int, int]] = []
    ran(scenario_file(), progress=lambda done, total: calls.append((done, total)))
    assert calls == [(k, 60) for k in range(1, 61)]


def test_the_step_can_be_changed(scenario_file: Write) -> None:
    run = ran(scenario_file(), step=0.1)
    assert len(run.states) == 31
    assert run.summary["step"] == 0.1
    with pytest.raises(ScenarioError, match=r"with another step: \[scenario\] duration"):
        ran(scenario_file(), step=0.07)


def test_an_unwritable_folder_is_refused_before_anything_runs(scenario_file: Write, tmp_path: Path) -> None:
    calls: list[int] = []
    (tmp_path / "file").write_text("mine")
    with pytest.raises(HostError, match=r"cannot write to .*/file/run: .*; give another folder with --out"):
        ran(scenario_file(), out=tmp_path / "file" / "run", progress=lambda done, total: calls.append(done))
    assert calls == []


@pytest.mark.parametrize("in_process", [True, False])
def test_a_run_that_fails_writes_nothing_and_leaves_nothing(
    scenario_file: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, in_process: bool
) -> None:
    """A NaN that appears in a ship's state in mid-run, on the wire to the collision model."""
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(temporary))
    advance = master.ALGORITHMS["gauss-seidel"]

    def broken(system: object, t: float, h: float) -> None:
        if t > 0.5:
            system.states[0].outputs.values[0] = float("nan")  # type: ignore[attr-defined]  # a system of any master
        advance(system, t, h)  # type: ignore[arg-type]  # a system of any master

    monkeypatch.setitem(master.ALGORITHMS, "gauss-seidel", broken)
    with pytest.raises(StepError, match=r"collision: own.position = \[nan, .*\] at t = 0.55.* s is not finite"):
        ran(scenario_file(), in_process=in_process, out=tmp_path / "out")
    assert not (tmp_path / "out").exists()
    assert list(temporary.iterdir()) == []


def test_without_pybullet_and_library_it_says_how_to_get_one(
    scenario_file: Write, monkeypatch: pytest.MonkeyPatch
) -> None:
    def missing() -> None:
        raise HostError("there is no C++ compiler for native code: install g++")

    monkeypatch.setitem(sys.modules, "pybullet", None)
    monkeypatch.setattr(adapter, "open_library", missing)
    with pytest.raises(HostError, match=r"^contacts cannot be detected: pybullet, .* 3.10 and 3.11 .*: install g\+\+$"):
        ran(scenario_file())
