"""FMU instances and models in process: same interface, same bits, errors with their reason, nothing left behind."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing
from pathlib import Path

import pytest

from shipcollision_fmu.cosim.component import Component, InProcessComponent
from shipcollision_fmu.cosim.fmi2_component import Fmi2Component
from shipcollision_fmu.cosim.fmi3_component import Fmi3Component
from shipcollision_fmu.cosim.fmu_instance import UnpackedFmu
from shipcollision_fmu.errors import HostError, StepError
from shipcollision_fmu.fmi.builder.package import build_fmus
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING

POSE = ["position.north", "position.east", "attitude.yaw", "velocity.surge"]
SAILING = {"ship": "kvlcc2", "degrees_of_freedom": 3, "hydrodynamics": True, "initial.velocity.surge": 7.0}

Make = Callable[[str], Component]


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    return build_fmus(tmp_path_factory.mktemp("fmus"))


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where FMUs are unpacked in this test."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(folder))
    return folder


@pytest.fixture(scope="module")
def built_for_fmi3(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    return build_fmus(tmp_path_factory.mktemp("fmus"), fmi=3)


@pytest.fixture(params=["FMU", "FMU of FMI 3.0", "in process"])
def make(
    request: pytest.FixtureRequest, built: dict[str, Path], built_for_fmi3: dict[str, Path], temporary: Path
) -> Iterator[Make]:
    """Makes a component of each kind from 'ShipManoeuvring' or 'ShipCollision'."""
    with ExitStack() as stack:

        def made(model: str) -> Component:
            made_from = {"ShipManoeuvring": MANOEUVRING, "ShipCollision": COLLISION}[model]
            if request.param == "in process":
                return stack.enter_context(closing(InProcessComponent("one", made_from.make_access())))
            if request.param == "FMU of FMI 3.0":
                unpacked = stack.enter_context(closing(UnpackedFmu(built_for_fmi3[model])))
                table = made_from.table(("own", "target"))
                return stack.enter_context(closing(Fmi3Component("one", unpacked, table)))
            fmu = stack.enter_context(closing(UnpackedFmu(built[model])))
            return stack.enter_context(closing(Fmi2Component("one", fmu)))

        yield made


def sailed(component: Component, steps: int) -> list[list[float]]:
    orders, pose = component.reals(["rudder_order", "propeller_order"]), component.reals(POSE)
    orders.values[:] = [0.3, 1.2]
    component.initialise(SAILING, 10.0, [orders])
    rows = []
    for k in range(steps):
        component.step(k * 0.05, 0.05)
        pose.read()
        rows.append(list(pose.values))
    return rows


def test_all_kinds_give_the_same_bits(make: Make) -> None:
    rows = sailed(make("ShipManoeuvring"), 100)
    assert rows == sailed(InProcessComponent("one", MANOEUVRING.make_access()), 100)
    assert rows[-1][2] != 0.0


def test_a_group_that_writes_part_of_a_vector_leaves_the_rest(make: Make) -> None:
    """Of a scalar FMU trivial; in FMI 3.0 the vector is one variable."""
    ship = make("ShipManoeuvring")
    push = ship.reals(["force.sway", "moment.yaw"])
    whole = ship.reals(["force.surge", "force.sway", "force.heave", "moment.yaw", "moment.roll"])
    whole.values[:] = [1.0, 2.0, 3.0, 4.0, 5.0]
    whole.write()
    push.values[:] = [-2.0, -4.0]
    push.write()
    whole.values[:] = [0.0] * 5
    whole.read()
    assert list(whole.values) == [1.0, -2.0, 3.0, -4.0, 5.0]
    ship.initialise(SAILING, 1.0)


def test_two_instances_of_one_fmu_do_not_disturb_each_other(built: dict[str, Path], temporary: Path) -> None:
    with ExitStack() as stack:
        fmu = stack.enter_context(closing(UnpackedFmu(built["ShipManoeuvring"])))
        first, second = (stack.enter_context(closing(Fmi2Component(name, fmu))) for name in ("first", "second"))
        poses = [ship.reals(POSE) for ship in (first, second)]
        first.initialise(SAILING, 1.0)
        second.initialise(SAILING | {"initial.velocity.surge": 1.0}, 1.0)
        first.step(0.0, 0.05)
        for pose in poses:
            pose.read()
    assert poses[0].values[0] == pytest.approx(0.35, rel=1e-3)
    assert list(poses[1].values) == [0.0, 0.0, 0.0, 1.0]


def test_parameters_of_every_type_reach_the_model(make: Make) -> None:
    ship = make("ShipManoeuvring")
    pose = ship.reals(POSE)
    parameters = {"ship": "kvlcc2", "degrees_of_freedom": 3, "hydrodynamics": False, "initial.position.north": 5}
    ship.initialise(parameters, 1.0)
    pose.read()
    assert list(pose.values) == [5.0, 0.0, 0.0, 0.0]


def test_part_of_a_group_can_be_read(make: Make) -> None:
    ship = make("ShipManoeuvring")
    pose = ship.reals(POSE)
    ship.initialise(SAILING | {"initial.position.north": 3.0, "initial.position.east": 4.0}, 1.0)
    pose.values[:] = [9.0, 9.0, 9.0, 9.0]
    pose.read(1)
    assert list(pose.values) == [3.0, 9.0, 9.0, 9.0]


def test_an_enumeration_is_set_by_name_and_read_as_a_number(make: Make) -> None:
    collision = make("ShipCollision")
    response, positions = collision.integers(["response", "contact.count"]), collision.reals(["target.position.north"])
    positions.values[0] = 1000.0
    collision.initialise({"own.ship": "kvlcc2", "target.ship": "kvlcc2", "response": "pgs"}, 1.0, [positions])
    response.read()
    assert list(response.values) == [1, 0]


def test_a_variable_that_is_not_there_is_named(make: Make) -> None:
    ship = make("ShipManoeuvring")
    with pytest.raises(HostError, match=r"one: .*'positoin.north'"):
        ship.reals(["positoin.north"])
    with pytest.raises(HostError, match=r"one: .*'colour'"):
        ship.initialise({"colour": "red"}, 1.0)


def test_an_item_that_is_not_there_is_named(make: Make) -> None:
    with pytest.raises(HostError, match=r"one: response = 'magic' must be one of pgs"):
        make("ShipCollision").initialise({"response": "magic"}, 1.0)


def test_a_failed_initialisation_tells_the_models_reason(make: Make) -> None:
    reason = r"^one: initialisation failed: .*unknown ship 'kvlc2': did you mean kvlcc2"
    with pytest.raises(HostError, match=reason) as said:
        make("ShipManoeuvring").initialise(SAILING | {"ship": "kvlc2"}, 1.0)
    assert "py exception" not in str(said.value)


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_a_refused_step_tells_when_and_why(make: Make, value: float) -> None:
    ship = make("ShipManoeuvring")
    current, pose = ship.reals(["current.north", "current.east"]), ship.reals(POSE)
    ship.initialise(SAILING, 1.0)
    ship.step(0.0, 0.05)
    pose.read()
    before = list(pose.values)
    current.values[0] = value
    current.write()
    with pytest.raises(StepError, match=r"^one: current = \[(nan|inf), 0.0\] at t = 0.05 s must be finite"):
        ship.step(0.05, 0.05)
    pose.read()
    assert list(pose.values) == before
    current.values[0] = 0.0
    current.write()
    ship.step(0.05, 0.05)
    pose.read()
    assert list(pose.values) != before


def test_closing_removes_the_unpacked_fmu_and_its_traces(built: dict[str, Path], temporary: Path) -> None:
    path = list(sys.path)
    with closing(UnpackedFmu(built["ShipManoeuvring"])) as fmu, closing(Fmi2Component("one", fmu)) as ship:
        assert fmu.directory.is_relative_to(temporary)
        ship.initialise(SAILING, 1.0)
        ship.close()
    ship.close()
    assert list(temporary.iterdir()) == []
    assert sys.path == path


@pytest.mark.parametrize("content", [b"", b"not a zip archive"])
def test_a_broken_fmu_is_refused_and_leaves_nothing(tmp_path: Path, temporary: Path, content: bytes) -> None:
    path = tmp_path / "broken.fmu"
    path.write_bytes(content)
    with pytest.raises(HostError, match=r"broken.fmu cannot be read as an FMU: .*build it again with `shipcollision"):
        UnpackedFmu(path)
    assert list(temporary.iterdir()) == []


def test_an_fmu_without_its_library_is_refused(built: dict[str, Path], temporary: Path) -> None:
    with closing(UnpackedFmu(built["ShipManoeuvring"])) as fmu:
        for library in fmu.directory.glob("binaries/*/*"):
            library.unlink()
        with pytest.raises(HostError, match=r"one: ShipManoeuvring.fmu cannot be instantiated: Cannot find shared"):
            Fmi2Component("one", fmu)
