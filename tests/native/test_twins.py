"""native/ship, manoeuvring and collision mirror the Python rooms: file by file, and constant by constant."""

from __future__ import annotations

import re
from importlib import import_module
from pathlib import Path
from types import ModuleType

import pytest

from shipcollision_fmu.encounters import encounter, request, targeting
from shipcollision_fmu.manoeuvring import prepared_ship
from shipcollision_fmu.study.definition import variables
from shipcollision_fmu.study.rows import python_impacts
from shipcollision_fmu.toolchain.sources import find_native

NATIVE = find_native()
ELSEWHERE = {
    "ship/prepared_ship": "manoeuvring/prepared_ship",  # Python writes what it has computed, C++ reads it
    "ship/tables": "ship/tables/manoeuvring",
    "batch/plan_contact": "encounters/plan_contact",
}
"""Twins that are not at the same place."""
FILES = sorted(
    path.relative_to(NATIVE).as_posix()
    for room in ("ship", "manoeuvring", "collision")
    for path in (NATIVE / room).rglob("*.?pp")
) + ["batch/plan_contact.cpp"]
_CONSTANT = re.compile(r"^constexpr (?:double|int) ([A-Z][A-Z_]*) = ([-+.e\d]+);", re.MULTILINE)
CONSTANTS = [
    (file, name, float(value))
    for file in FILES
    for name, value in _CONSTANT.findall((NATIVE / file).read_text("utf-8"))
]


_MADE = re.compile(r"= new ([A-Z]\w*)|return new ([A-Z]\w*)")
_HEAP = re.compile(r"(?:struct|class) (?:\w+::)?(\w+)(?: final)? : (?:public )?(\w+) \{|(?:struct|class) (\w+) \{"
                   r"(?:(?!\n\};).)*?operator new\(size_t size\) noexcept", re.DOTALL)  # fmt: skip
BULLET = {"QuickHull"}
"""Classes of Bullet, which does not look whether it has got memory: the detector asks for enough of it before."""


def test_new_answers_null_without_memory() -> None:
    """A `new` that does not say noexcept constructs at null where there is no memory, before anyone can look."""
    texts = {path: path.read_text("utf-8") for path in NATIVE.rglob("*.?pp")}
    safe, bases = {"OnHeap"}, {}
    for text in texts.values():
        for name, base, own in _HEAP.findall(text):
            bases[name] = base
            safe |= {own} - {""}
    while more := {name for name, base in bases.items() if base in safe} - safe:
        safe |= more
    made = {name or other for text in texts.values() for name, other in _MADE.findall(text)}
    assert len(made) > 10
    assert made - safe - BULLET == set()


def find_twin(file: str) -> str:
    stem = file.rpartition(".")[0]
    return ELSEWHERE.get(stem, stem)


@pytest.mark.parametrize("file", FILES)
def test_each_file_has_a_twin(file: str) -> None:
    package = Path(import_module("shipcollision_fmu").__file__ or "").parent
    assert (package / f"{find_twin(file)}.py").is_file()


def test_there_are_constants() -> None:
    assert {"ABSURD_SPEED", "FINEST", "RHO_AIR", "ROUNDING"} <= {name for _, name, _ in CONSTANTS}


@pytest.mark.parametrize(("file", "name", "value"), CONSTANTS)
def test_each_constant_is_that_of_the_twin(file: str, name: str, value: float) -> None:
    """Those of tables have another name in Python and show in every comparison."""
    module = import_module(f"shipcollision_fmu.{find_twin(file).replace('/', '.')}")
    twin = {key.removeprefix("_"): number for key, number in vars(module).items()}
    if name in twin:
        assert twin[name] == pytest.approx(value, rel=1e-15, abs=0.0)  # some are tangents
    else:
        assert name in {"ROLL", "PITCH", "BREAKING_THRESHOLD"} or name.startswith(("SERIES", "TORQUE"))


@pytest.mark.parametrize(
    ("name", "module"),
    [
        ("SLOWEST_CLOSING", encounter), ("GRAZING", encounter), ("FASTEST", request), ("OVERLAP", targeting),
        ("INSTANT", python_impacts), ("DEEPER", python_impacts), ("DEEPEST", python_impacts),
        ("ATTEMPTS", python_impacts), ("FASTEST_TURN", variables),
    ],
)  # fmt: skip
def test_an_impact_is_refused_and_placed_as_an_encounter(name: str, module: ModuleType) -> None:
    constants = dict(_CONSTANT.findall((NATIVE / "batch/impact.cpp").read_text("utf-8")))
    assert float(constants[name]) == vars(module)[name]


@pytest.mark.parametrize(
    ("file", "table", "names"),
    [
        ("tables", "ManoeuvringTable", prepared_ship.MANOEUVRING),
        ("tables", "PropellerTable", prepared_ship.PROPELLER), ("tables", "RudderTable", prepared_ship.RUDDER),
        ("tables", "EngineTable", prepared_ship.ENGINE), ("windage", "Windage", prepared_ship.WINDAGE),
        ("seakeeping", "Seakeeping", prepared_ship.SEAKEEPING),
    ],
)  # fmt: skip
def test_tables_have_the_order_of_the_prepared_file(file: str, table: str, names: tuple[str, ...]) -> None:
    text = (NATIVE / "ship" / f"{file}.hpp").read_text("utf-8")
    found = re.search(rf"struct {table} {{\s+double ([^;]+);", text)
    assert found is not None
    assert tuple(re.split(r",\s+", found.group(1))) == names
