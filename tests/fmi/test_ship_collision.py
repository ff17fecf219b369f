"""The FMU ShipCollision, with Python inside and without, against the model behind it, driven in process."""

from __future__ import annotations

import math
import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import extract, read_model_description

from shipcollision_fmu.collision.prepared_obstacles import prepare_obstacles
from shipcollision_fmu.fmi.builder import native_fmus as builder
from shipcollision_fmu.fmi.builder.native_fmus import native_instance_fmu
from shipcollision_fmu.fmi.names import APPLIED, ATTITUDE, IMPULSE, POSITION, POST, RATE, STATE, VELOCITY, named
from shipcollision_fmu.fmi.ship_collision import INTERFACE
from shipcollision_fmu.fmi.variable_access import VariableAccess
from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from shipcollision_fmu.ship.frames import rotation
from shipcollision_fmu.toolchain.fmu_binaries import Binary
from tests.fmi.files_of_states import check_changed_file
from tests.fmi.test_limits import LIMITED
from tests.ship_files import ship_toml

OK, DISCARD, ERROR = 0, 2, 3
Make = Callable[..., Any]
FORMS = ["Python", pytest.param("native", marks=pytest.mark.slow)]
H = 0.25
SHIPS = ("own", "target")


@pytest.fixture(scope="module", params=FORMS)
def form(request: pytest.FixtureRequest) -> str:
    name: str = request.param
    return name


@pytest.fixture(scope="module")
def folder(form: str, request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    if form == "native":
        return Path(extract(request.getfixturevalue("native_collisions")["2"], tmp_path_factory.mktemp("native")))
    python: Path = request.getfixturevalue("real_unpacked")["ShipCollision", 2]
    return python


@pytest.fixture
def collision(host: Make, folder: Path) -> Make:
    """Makes instances of the FMU."""
    return lambda name="collision": host(name, at=folder)


class Twice:
    """The FMU and the model, given the same values and stepped alike; both must give the same."""

    def __init__(self, fmu: Any, form: str) -> None:
        self.fmu, self.access = fmu, INTERFACE.make_access()
        self.tolerance = 0.0 if form == "Python" else 1e-8
        self.said: list[str] = []  # by the model
        table = self.access.table
        self.outputs = {
            kind: [k for k, line in enumerate(table) if line.kind == kind and line.causality == "output"]
            for kind in ("Real", "Integer", "Boolean", "String")
        }
        self.units = np.array([str(table[k].unit) for k in self.outputs["Real"]])

    def set_reals(self, names: Sequence[str], values: Any) -> None:
        numbers = [float(x) for x in values]
        self.fmu.fmu.setReal(self.fmu.reference(*names), numbers)
        self.access.set_real(self.access.references(names), numbers)

    def apply_impulses(self, ship: str) -> None:
        """Give each its own impulse back, which the model compares with what it has issued."""
        issued, applied = named(ship, IMPULSE), named(ship, APPLIED)
        self.fmu.fmu.setReal(self.fmu.reference(*applied), self.fmu.reals(*issued))
        self.access.set_real(self.access.references(applied), self.access.get_real(self.access.references(issued)))

    def set_strings(self, **values: str) -> None:
        names = [name.replace("__", ".") for name in values]
        self.fmu.fmu.setString(self.fmu.reference(*names), list(values.values()))
        self.access.set_string(self.access.references(names), list(values.values()))

    def begin(self) -> None:
        assert self.fmu.begin() == OK
        self.access.initialise()
        self.compare()

    def step(self, k: int) -> None:
        assert self.fmu.step(k, H) == OK
        self.access.do_step(k * H, H)
        self.said += [*self.access.events, *filter(None, [self.access.warning])]
        self.compare()

    def integer(self, name: str) -> int:
        (value,) = self.access.get_integer(self.access.references([name]))
        return value

    def post(self, ship: str) -> list[float]:
        return self.access.get_real(self.access.references(named(f"{ship}.{POST}", STATE)))

    def compare(self) -> None:
        """Reals in the scale of the largest of their unit, all others exactly; and what was logged."""
        fmu, access = self.fmu.fmu, self.access
        expected = np.array(access.get_real(self.outputs["Real"]))
        off = np.abs(np.array(fmu.getReal(self.outputs["Real"])) - expected)
        for unit in set(self.units):
            of_unit = self.units == unit
            assert off[of_unit].max() <= self.tolerance * max(1.0, np.abs(expected[of_unit]).max()), unit
        sweeps = access.references(["solver.sweeps"])  # the least change of a contact changes their number
        counted = [k for k in self.outputs["Integer"] if k not in sweeps]
        assert fmu.getInteger(counted) == access.get_integer(counted)
        assert list(map(bool, fmu.getBoolean(self.outputs["Boolean"]))) == access.get_boolean(self.outputs["Boolean"])
        assert [text.decode() for text in fmu.getString(self.outputs["String"])] == access.get_string(
            self.outputs["String"]
        )
        assert [line for _, line in self.fmu.messages] == self.said


def strike(both: Twice, *, frame: str = "b", steps: int = 40) -> None:
    """own, heeled and heading nearly east, strikes the side of target; the ships follow what the model gives back."""
    both.set_strings(own__ship="guan2014_own", target__ship="guan2014_own")
    both.set_strings(own__velocity_frame=frame, own__force_frame=frame)
    attitude = (0.05, -0.02, math.pi / 2 - 0.3)
    states = {
        "own": [0.0, -165.0, 0.0, *attitude, 5.0, 0.5, 0.0, 0.001, 0.002, 0.01],
        "target": [0.0] * 12,
    }
    for k in range(-1, steps):
        for ship, state in states.items():
            turn = rotation(state[3:6]) if frame == "n" and ship == "own" else np.eye(3)
            turned = [*state[:6], *(turn @ state[6:9]), *(turn @ state[9:])]
            both.set_reals(named(ship, (*POSITION, *ATTITUDE, *VELOCITY, *RATE)), turned)
            if k > 0:
                both.apply_impulses(ship)
        if k < 0:
            both.begin()
            continue
        both.step(k)
        states = {ship: both.post(ship) for ship in SHIPS}
    assert both.integer("impact.count") == 1


def test_the_variables_are_those_of_the_fmu_with_python(
    native_fmus: dict[str, Path], real_fmus: dict[tuple[str, int], Path], request: pytest.FixtureRequest, form: str
) -> None:
    if form == "Python":
        return
    for flavour, fmi in (("2", 2), ("3", 3)):
        native = read_model_description(str(request.getfixturevalue("native_collisions")[flavour])).modelVariables
        python = read_model_description(str(real_fmus["ShipCollision", fmi])).modelVariables
        assert [(v.name, v.valueReference, v.type, v.causality, v.unit, v.start) for v in native] == [
            (v.name, v.valueReference, v.type, v.causality, v.unit, v.start) for v in python
        ]


@pytest.mark.parametrize("frame", ["b", "n"])
def test_a_collision_is_the_models_to_the_events_in_the_log(collision: Make, form: str, frame: str) -> None:
    fmu = collision()
    both = Twice(fmu, form)
    strike(both, frame=frame)
    assert len(both.said) == 1
    assert "own" in both.said[0]
    assert fmu.categories == ["logEvents"]


def test_a_wrong_wiring_is_said_and_counted(collision: Make, form: str) -> None:
    """Speed in knots."""
    both = Twice(collision(), form)
    for name in SHIPS:
        both.set_reals([f"{name}.position.east"], [4000.0 * (name == "own")])
    for k in range(-1, 60):
        for name in SHIPS:
            both.set_reals([f"{name}.position.north", f"{name}.velocity.surge"], [5.0 * H * k, 5.0 / 0.5144])
        if k < 0:
            both.begin()
        else:
            both.step(k)
    assert both.integer("diagnosis.count") == 2
    assert both.integer("diagnosis.code") > 0
    assert "knots" in both.said[0]


def pass_the_origin(fmu: Any) -> None:
    """own passes the origin, where target would be if anything of it were set; from k = 0 on."""
    for k in range(40):
        fmu.fmu.setReal(fmu.reference(*named("own", STATE)), [-400.0 + 2.5 * k, *[0.0] * 5, 5.0, *[0.0] * 5])
        assert fmu.step(k, 0.5) == OK


def count_impacts(fmu: Any) -> int:
    count: int = fmu.fmu.getInteger(fmu.reference("impact.count"))[0]
    return count


def begin_alone(fmu: Any) -> None:
    fmu.fmu.setReal(fmu.reference(*named("own", STATE)), [-400.0, *[0.0] * 5, 5.0, *[0.0] * 5])
    assert fmu.begin() == OK


def test_a_ship_of_which_nothing_was_set_is_absent(collision: Make) -> None:
    fmu = collision()
    begin_alone(fmu)
    pass_the_origin(fmu)
    assert count_impacts(fmu) == 0
    assert len(fmu.messages) == 1
    assert fmu.messages[0][1].startswith("no state of 'target' was ever set")


def test_a_ship_that_is_set_to_the_origin_is_there_until_reset(collision: Make) -> None:
    fmu = collision()
    fmu.fmu.setReal(fmu.reference("target.rate.yaw"), [0.0])
    begin_alone(fmu)
    pass_the_origin(fmu)
    assert count_impacts(fmu) == 1
    fmu.fmu.reset()
    begin_alone(fmu)
    pass_the_origin(fmu)
    assert count_impacts(fmu) == 0


def test_what_was_set_is_part_of_the_state(collision: Make) -> None:
    fmu = collision()
    begin_alone(fmu)
    before = fmu.saved()
    fmu.fmu.setReal(fmu.reference("target.velocity.surge"), [0.0])
    after = fmu.saved()
    for state, impacts in ((before, 0), (after, 1), (before, 0)):
        assert fmu.restore(state) == OK
        pass_the_origin(fmu)
        assert count_impacts(fmu) == impacts


def test_what_is_received_without_a_pose_or_twist_does_not_make_a_ship(collision: Make) -> None:
    fmu = collision()
    fmu.fmu.setReal(fmu.reference("target.impulse_applied.surge"), [0.0])
    begin_alone(fmu)
    pass_the_origin(fmu)
    assert count_impacts(fmu) == 0


WALL = '[wall]\nkind = "quay"\nshape = "box"\nlength = 50.0\nbreadth = 9.0\nposition = [0.0, {east}]\n'


@pytest.mark.parametrize("name", ["own.ship", "target.ship", "obstacles"])
def test_a_state_is_refused_when_a_file_of_it_has_changed(
    collision: Make, form: str, name: str, tmp_path: Path
) -> None:
    """The parameter names the same file; heights of decks differ, or the place of a wall, and nothing else."""
    is_ship = name != "obstacles"
    kind = "toml" if form == "Python" else "ship" if is_ship else "obstacles"
    path, any_toml = tmp_path / f"changed.{kind}", tmp_path / "any.toml"
    contents = []
    for depth, east in ((8.0, 500.0), (8.5, 510.0)):
        any_toml.write_text(ship_toml(hull={"depth": depth}) if is_ship else WALL.format(east=east))
        prepared = prepare_ship(any_toml) if is_ship else prepare_obstacles(str(any_toml))
        contents.append(any_toml.read_bytes() if form == "Python" else prepared)

    def begin(fmu: Any) -> None:
        fmu.fmu.setString(fmu.reference(name), [str(path)])
        begin_alone(fmu)

    line = f"ShipCollision: the file that {name} = '{path}' names is not that of the saved state: give the file of then"
    check_changed_file(collision, begin, path, (contents[0], contents[1]), line)


REFUSED = [
    ("own.velocity_frame", "ned", "own.velocity_frame = 'ned' must be 'b' (body) or 'n' (north, east, down)"),
    ("target.force_frame", "N", "target.force_frame = 'N' must be 'b' (body) or 'n' (north, east, down)"),
    ("own.ship", "", "own.ship: ship = '' is no ship"),
]


@pytest.mark.parametrize(("name", "value", "line"), REFUSED)
def test_a_parameter_that_is_refused_can_be_corrected(
    collision: Make, form: str, name: str, value: str, line: str
) -> None:
    fmu = collision()
    before = [text.decode() for text in fmu.fmu.getString(fmu.reference(name))]
    fmu.fmu.setString(fmu.reference(name), [value])
    assert fmu.begin() != OK
    assert line in fmu.messages[-1][1]
    if form == "native":  # Python's wrapper answers fatal
        fmu.fmu.setString(fmu.reference(name), before)
        assert fmu.dll.fmi2ExitInitializationMode(fmu.component) == OK


NEEDS_PYTHON = "needs Python: take response 'pgs', or the FMU that runs Python"
TOML = (
    "obstacles: a native FMU reads no TOML; write prepared obstacles with `shipcollision prepare OBSTACLES.toml` and "
    "give the path of that file, which ends in .obstacles"
)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "name", "value", "line"),
    [
        ("Integer", "response", 2, f"response = 'closed_form' {NEEDS_PYTHON}"),
        ("Integer", "response", 3, f"response = 'bullet' {NEEDS_PYTHON}"),
        ("String", "obstacles", "[quay]\nposition = [0.0, 0.0]\n", TOML),
        ("String", "obstacles", "harbour.toml", TOML),
        ("String", "own.ship", "tug.toml", "own.ship: ship file tug.toml: a native FMU reads no TOML"),
    ],
)
@pytest.mark.parametrize("form", ["native"], indirect=True)
def test_what_needs_python_is_refused_in_one_line(
    collision: Make, kind: str, name: str, value: object, line: str
) -> None:
    fmu = collision()
    getattr(fmu.fmu, f"set{kind}")(fmu.reference(name), [value])
    assert fmu.begin() == ERROR
    assert len(fmu.messages) == 1
    assert fmu.messages[0][1].startswith(f"ShipCollision cannot be initialised: {line}")
    assert "\n" not in fmu.messages[0][1]


@pytest.mark.slow
@pytest.mark.parametrize("form", ["native"], indirect=True)
def test_native_code_keeps_the_limits_of_the_description(collision: Make) -> None:
    """Just outside is refused."""
    fmu = collision()
    for made_from, line, limit, outward in LIMITED:
        if made_from is not INTERFACE:
            continue
        far = int(limit) + (1 if outward > 0 else -1) if line.kind == "Integer" else math.nextafter(limit, outward)
        set_value = fmu.fmu.setInteger if line.kind == "Integer" else fmu.fmu.setReal
        set_value(fmu.reference(line.name), [far])
        assert fmu.begin() == ERROR, line.name
        assert line.name.rpartition(".")[2] in fmu.messages[-1][1]
        fmu.fmu.reset()


@pytest.mark.slow
@pytest.mark.parametrize("form", ["native"], indirect=True)
def test_a_start_value_of_an_instance_makes_a_ship(
    host: Make, folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (place,) = (folder / "binaries").rglob("ShipCollision.*")
    library = Binary(place.parent.name, place.suffix, place.read_bytes())
    monkeypatch.setattr(builder, "build_binaries", lambda name, platforms: {2: [library]})
    monkeypatch.setattr(builder, "list_ship_names", lambda: ["kvlcc2"])
    monkeypatch.setattr(builder, "read_bullet_licence", lambda: "zlib")
    for start, impacts in (({"target.position.north": 0.0}, 1), ({"friction": 0.2}, 0)):
        fmu = tmp_path / f"{impacts}.fmu"
        fmu.write_bytes(native_instance_fmu(INTERFACE, SHIPS, start))
        one = host("one", at=Path(extract(fmu, tmp_path / str(impacts))))
        for _ in range(2):  # also after a reset
            begin_alone(one)
            pass_the_origin(one)
            assert count_impacts(one) == impacts
            one.fmu.reset()


@pytest.mark.slow
def test_ships_of_any_number_have_their_names(
    tmp_path: Path, native_collisions: dict[str, Path], monkeypatch: pytest.MonkeyPatch, host: Make
) -> None:
    with zipfile.ZipFile(native_collisions["2"]) as archive:
        name = next(name for name in archive.namelist() if name.startswith("binaries/"))
        library = Binary(name.split("/")[1], Path(name).suffix, archive.read(name))
    monkeypatch.setattr(builder, "list_ship_names", lambda: ["kvlcc2"])
    monkeypatch.setattr(builder, "read_bullet_licence", lambda: "zlib")
    ships = tuple(f"s{i}" for i in range(12))
    fmu = tmp_path / "many.fmu"
    fmu.write_bytes(builder.native_fmu_bytes(builder.NATIVE_FMUS["ShipCollision"], [library], ships))
    one = host("many", at=Path(extract(fmu, tmp_path / "many")))
    for i, ship in enumerate(ships):
        one.fmu.setReal(one.reference(f"{ship}.position.east"), [100.0 * i])
    assert one.begin() == OK
    assert one.step(0) == OK
    assert one.reals("s11.post.position.east") == [1100.0]
    access: VariableAccess = INTERFACE.make_access(ships)
    for i, ship in enumerate(ships):
        access.set_real(access.references([f"{ship}.position.east"]), [100.0 * i])
    access.initialise()
    access.do_step(0.0, 0.1)
    assert one.reals("clearance") == pytest.approx(access.get_real(access.references(["clearance"])), rel=1e-12)


@pytest.mark.parametrize("form", FORMS, indirect=True)
def test_a_ship_file_that_has_changed_is_read_after_a_reset(collision: Make, form: str, tmp_path: Path) -> None:
    suffix, write = (".ship", prepare_ship) if form == "native" else (".toml", str.encode)
    toml, place = tmp_path / "barge.toml", tmp_path / f"file{suffix}"
    fmu = collision()
    found = []
    for length in (100.0, 110.0):
        toml.write_text(ship_toml().replace("L_pp = 100.0", f"L_pp = {length}"), encoding="utf-8")
        place.write_bytes(write(str(toml) if form == "native" else toml.read_text(encoding="utf-8")))
        fmu.fmu.setString(fmu.reference("own.ship", "target.ship"), [str(place)] * 2)
        fmu.fmu.setReal(fmu.reference("own.position.north", "target.position.north"), [0.0, 150.0])
        assert fmu.begin() == OK
        found += fmu.reals("clearance")
        fmu.fmu.reset()
    assert found[1] - found[0] == pytest.approx(-10.0, abs=0.1)
