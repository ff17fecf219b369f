"""The FMU ShipManoeuvring: the contract's names, and the model behind them."""

from __future__ import annotations

import gc
import math
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from fmpy import extract, read_model_description

from shipcollision_fmu.errors import ShipCollisionError
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE
from shipcollision_fmu.fmi.variable_access import VariableAccess
from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from tests.fmi.files_of_states import check_changed_file
from tests.ship_files import ship_toml

OK, DISCARD, ERROR, FATAL = 0, 2, 3, 4
Make = Callable[..., Any]

NED, LINEAR, ANGLES = ("north", "east", "down"), ("surge", "sway", "heave"), ("roll", "pitch", "yaw")


def group(name: str, parts: tuple[str, ...], causality: str, unit: str) -> set[tuple[str, str, str, str | None]]:
    return {(f"{name}.{part}", "Real", causality, unit) for part in parts}


CONTRACT = {
    *group("position", NED, "output", "m"),
    *group("attitude", ANGLES, "output", "rad"),
    *group("velocity", LINEAR, "output", "m/s"),
    *group("rate", ANGLES, "output", "rad/s"),
    *group("initial.position", NED, "parameter", "m"),
    *group("initial.attitude", ANGLES, "parameter", "rad"),
    *group("initial.velocity", LINEAR, "parameter", "m/s"),
    *group("initial.rate", ANGLES, "parameter", "rad/s"),
    ("rudder_order", "Real", "input", "rad"),
    ("rudder_angle", "Real", "output", "rad"),
    ("propeller_order", "Real", "input", "rev/s"),
    ("propeller_speed", "Real", "output", "rev/s"),
    *group("current", ("north", "east"), "input", "m/s"),
    ("wind.speed", "Real", "input", "m/s"),
    ("wind.direction", "Real", "input", "rad"),
    *group("impulse", LINEAR, "input", "N.s"),
    *group("impulse", ANGLES, "input", "N.m.s"),
    *group("impulse_applied", LINEAR, "output", "N.s"),
    *group("impulse_applied", ANGLES, "output", "N.m.s"),
    *group("force", LINEAR, "input", "N"),
    *group("moment", ANGLES, "input", "N.m"),
    *(line for origin in ("hull", "propeller", "rudder", "wind") for line in group(origin, LINEAR, "output", "N")),
    *(line for origin in ("hull", "propeller", "rudder", "wind") for line in group(origin, ANGLES, "output", "N.m")),
    ("ship", "String", "parameter", None),
    ("degrees_of_freedom", "Integer", "parameter", None),
    ("hydrodynamics", "Boolean", "parameter", None),
}
EXTENSIONS = {("substep", "Real", "parameter", "s"), ("coasting", "Enumeration", "parameter", None)}


FORMS = ["Python", pytest.param("native", marks=pytest.mark.slow)]
"""The FMU with Python inside, and the one without."""


@pytest.fixture(scope="module", params=FORMS)
def form(request: pytest.FixtureRequest) -> str:
    name: str = request.param
    return name


@pytest.fixture(scope="module")
def folder(form: str, request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    if form == "native":
        return Path(extract(request.getfixturevalue("native_fmus")["2"], tmp_path_factory.mktemp("native")))
    python: Path = request.getfixturevalue("real_unpacked")["ShipManoeuvring", 2]
    return python


@pytest.fixture
def ship(host: Make, folder: Path) -> Make:
    """Makes instances of the FMU."""
    return lambda name="ship": host(name, at=folder)


def sailing(instance: Any) -> Any:
    """A KVLCC2 at seven metres per second with its helm over, initialised."""
    fmu, reference = instance.fmu, instance.reference
    fmu.setBoolean(reference("hydrodynamics"), [True])
    fmu.setInteger(reference("degrees_of_freedom"), [3])
    fmu.setReal(reference("initial.velocity.surge", "initial.attitude.yaw", "initial.position.north"), [7.0, 0.1, 5.0])
    fmu.setReal(reference("rudder_order", "propeller_order"), [0.5, 1.7])
    assert instance.begin() == OK
    return instance


def test_names_are_the_contracts(folder: Path) -> None:
    seen = read_model_description(str(folder)).modelVariables
    assert {(v.name, v.type, v.causality, v.unit) for v in seen} == CONTRACT | EXTENSIONS
    assert len(seen) == len(CONTRACT | EXTENSIONS)


def test_every_variable_is_a_cell_of_its_own() -> None:
    """Writing one value changes that value and no other, and the table forgets no number that the model gives."""
    access = INTERFACE.make_access()
    reals = [k for k, line in enumerate(access.table) if line.kind == "Real"]
    places = {(line.path, line.index) for line in access.table}
    assert len(places) == len(access.table)
    model: Any = access.model
    for part in ("parameters", "inputs", "outputs"):
        for name, values in vars(getattr(model, part)).items():
            for index in range(len(values)) if isinstance(values, list) else (None,):
                assert (f"{part}.{name}", index) in places
    settable = [k for k in reals if access.table[k].causality != "output"]
    numbers = [random.Random(3).random() for _ in settable]
    access.set_real(settable, numbers)
    assert access.get_real(settable) == numbers


def test_the_start_is_what_was_asked_for(ship: Make) -> None:
    a = ship()
    asked = {line[0]: 0.01 * k for k, line in enumerate(sorted(CONTRACT), 1) if line[0].startswith("initial.")}
    a.fmu.setReal(a.reference(*asked), list(asked.values()))
    a.fmu.setupExperiment()
    a.fmu.enterInitializationMode()
    assert a.reals(*(name.removeprefix("initial.") for name in asked)) == list(asked.values())


def test_what_the_outputs_depend_on_at_the_start(folder: Path) -> None:
    """Changing a parameter or an input that is not declared leaves the output as it is, to the bit."""
    description = read_model_description(str(folder))
    declared = {
        u.variable.name: {v.name for v in u.dependencies}
        for u in description.initialUnknowns
        if u.dependencies is not None
    }
    assert len(declared) == 20
    base: dict[str, Any] = {"hydrodynamics": True, "degrees_of_freedom": 3, "propeller_order": 1.0}
    base |= {"initial.velocity.surge": 4.0}

    def start(values: dict[str, Any]) -> list[float]:
        access = INTERFACE.make_access()
        for name, value in values.items():
            (reference,) = access.references([name])
            setters: dict[type, Any] = {bool: access.set_boolean, int: access.set_integer, str: access.set_string}
            setters.get(type(value), access.set_real)([reference], [value])
        return access.get_real(access.references(list(declared)))

    expected, changes = start(base), 0
    for line in INTERFACE.table(()):
        if line.causality == "output":
            continue
        other = {"hydrodynamics": False, "degrees_of_freedom": 3, "ship": "kvlcc2_l7"}.get(line.name, 0.125)
        try:
            now = start({**base, line.name: other})
        except ShipCollisionError:  # out of the plane: this model of hydrodynamics does not take it
            continue
        for name, before, after in zip(declared, expected, now, strict=True):
            if before != after:
                assert line.name in declared[name], (line.name, name)
                changes += 1
    assert changes >= 6


def test_the_fmu_and_a_run_in_process_give_the_same_numbers(ship: Make, form: str) -> None:
    """The Python FMU to the bit. The elementary functions of native code are its own: its numbers agree to 1e-11."""
    a, access = sailing(ship()), INTERFACE.make_access()
    access.set_boolean(access.references(["hydrodynamics"]), [True])
    access.set_integer(access.references(["degrees_of_freedom"]), [3])
    access.set_real(
        access.references(["initial.velocity.surge", "initial.attitude.yaw", "initial.position.north"]), [7.0, 0.1, 5.0]
    )
    access.set_real(access.references(["rudder_order", "propeller_order"]), [0.5, 1.7])
    access.initialise()
    reals = a.kinds["Real"]
    impulse = access.references(["impulse.sway", "impulse.yaw"])
    for k in range(40):
        if k == 20:
            a.fmu.setReal(impulse, [1e8, -1e9])
            access.set_real(impulse, [1e8, -1e9])
        assert a.step(k, 0.05) == OK
        access.do_step(k * 0.05, 0.05)
        found, expected = a.fmu.getReal(reals), access.get_real(reals)
        assert found == (expected if form == "Python" else pytest.approx(expected, rel=1e-11, abs=1e-11))
    assert a.reals("impulse_applied.sway", "impulse_applied.yaw") == [1e8, -1e9]


def test_state_repeats_to_the_bit(ship: Make) -> None:
    a, b = sailing(ship("a")), ship("b")
    for k in range(10):
        a.step(k)
    a.fmu.setReal(a.reference("impulse.surge", "impulse.roll"), [-3e8 / 7.0, 1e7 / 3.0])
    data, before = a.saved(), a.everything()
    first = [(a.step(k), a.everything()) for k in range(10, 20)]
    assert a.restore(data) == b.restore(data) == OK
    assert a.everything() == b.everything() == before
    for k, expected in zip(range(10, 20), first, strict=True):
        assert (a.step(k), a.everything()) == expected
        assert (b.step(k), b.everything()) == expected
    assert first[-1][0] == OK
    assert a.saved() == b.saved()


def test_a_state_goes_into_an_instance_with_other_parameters_and_bad_inputs(ship: Make) -> None:
    """Restoring makes the model read the saved parameters; what the inputs hold just then must not matter."""
    a, b = sailing(ship("a")), ship("b")
    a.step(0)
    b.begin()
    b.fmu.setReal(b.reference("current.north"), [math.nan])
    assert b.restore(a.saved()) == OK
    assert b.messages == []
    assert (a.step(1), b.step(1)) == (OK, OK)
    assert b.everything() == a.everything()


def test_a_state_goes_into_an_instance_whose_parameters_were_set_since(ship: Make) -> None:
    """The model read the same parameters as the state's, and then the host set others without letting it read them."""
    a, b = ship("a"), ship("b")
    a.begin()
    a.step(0)
    b.fmu.setupExperiment()
    b.fmu.enterInitializationMode()
    b.reals("position.north")  # an output: the model reads its parameters
    b.fmu.setString(b.reference("ship"), ["no such ship"])
    assert b.restore(a.saved()) == OK
    assert b.messages == []
    assert (a.step(1), b.step(1)) == (OK, OK)
    assert b.everything() == a.everything()


def test_a_state_is_refused_when_the_file_of_its_ship_has_changed(ship: Make, form: str, tmp_path: Path) -> None:
    """The parameter names the same file; masses differ, and nothing else."""
    path = tmp_path / ("own.toml" if form == "Python" else "own.ship")
    texts = [ship_toml(particulars={"mass": mass}) for mass in (8.2e6, 8.3e6)]
    contents = [text.encode() if form == "Python" else prepare(tmp_path, text) for text in texts]

    def begin(instance: Any) -> None:
        instance.fmu.setString(instance.reference("ship"), [str(path)])
        assert instance.begin() == OK

    line = f"ShipManoeuvring: the file that ship = '{path}' names is not that of the saved state: give the file of then"
    check_changed_file(ship, begin, path, (contents[0], contents[1]), line)


def prepare(folder: Path, text: str) -> bytes:
    """The prepared file of a ship file."""
    path = folder / "any.toml"
    path.write_text(text)
    return prepare_ship(path)


def test_an_unknown_ship_fails_initialisation(ship: Make, form: str) -> None:
    """Error is right; Python's wrapper has Fatal alone to answer with."""
    a = ship()
    a.fmu.setString(a.reference("ship"), ["no such ship"])
    refused = FATAL if form == "Python" else ERROR
    assert a.begin() == refused
    ((status, message),) = a.messages
    assert status == refused
    assert "ShipManoeuvring cannot be initialised: " in message
    assert "no such ship" in message
    a.fmu.reset()
    sailing(a)


@pytest.mark.parametrize("name", ["rudder_order", "current.east", "wind.speed", "impulse.yaw", "moment.pitch"])
@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_input_that_is_not_finite(ship: Make, name: str, bad: float) -> None:
    a, b = sailing(ship("a")), sailing(ship("b"))
    good = a.reals(name)
    before = a.everything()
    a.fmu.setReal(a.reference(name), [bad])
    assert a.step(0) == DISCARD
    assert len(a.messages) == 1
    a.fmu.setReal(a.reference(name), good)
    assert a.everything() == before
    assert (a.step(0), b.step(0)) == (OK, OK)
    assert a.everything() == b.everything()


@pytest.mark.slow
def test_instances_may_come_and_go(ship: Make) -> None:
    """pythonfmu 0.7 gives the slave module's dictionary back once too often at each instantiation."""
    for k in range(30):
        a = ship(f"ship {k}")
        assert a.begin() == OK
        assert a.step(0) == OK
        a.free()
        gc.collect()


def test_access_is_to_the_table_of_the_interface() -> None:
    access = INTERFACE.make_access()
    assert isinstance(access, VariableAccess)
    assert access.name == "ShipManoeuvring"
    assert access.table == INTERFACE.table(("own", "target"))
