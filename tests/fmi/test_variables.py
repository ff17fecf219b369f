"""Tables of variables, and the units in them."""

from __future__ import annotations

from math import pi
from typing import Any

import pytest

from shipcollision_fmu.fmi.names import (
    APPLIED,
    CONTACT_INTEGERS,
    CONTACT_REALS,
    CONTACT_START,
    ENERGY,
    FORCE,
    MOMENT,
    POSITION,
    contact_point,
    named,
)
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from shipcollision_fmu.fmi.units import UNITS
from shipcollision_fmu.fmi.variables import FORCE_UNITS, IMPULSE_UNITS, Variable, enumeration, real, vector, wrench


def test_a_vector_is_its_components_in_order() -> None:
    lines = vector("output", named("own", POSITION), "m", "outputs.ships.0.position", "CO in n")
    assert [line.name for line in lines] == ["own.position.north", "own.position.east", "own.position.down"]
    assert [line.index for line in lines] == [0, 1, 2]
    assert [line.description for line in lines] == ["CO in n: north", "CO in n: east", "CO in n: down"]


def test_a_wrench_has_the_linear_part_first() -> None:
    lines = wrench("input", (*FORCE, *MOMENT), FORCE_UNITS, "inputs.force", "External force", "External moment")
    assert [line.name for line in lines] == [
        "force.surge", "force.sway", "force.heave", "moment.roll", "moment.pitch", "moment.yaw",
    ]  # fmt: skip
    assert [line.unit for line in lines] == ["N"] * 3 + ["N.m"] * 3
    assert [line.index for line in lines] == [0, 1, 2, 3, 4, 5]
    assert [line.unit for line in wrench("input", APPLIED, IMPULSE_UNITS, "x", "", "")] == ["N.s"] * 3 + ["N.m.s"] * 3


@pytest.mark.parametrize(
    ("kind", "causality", "variability"),
    [
        ("Real", "parameter", "fixed"),
        ("String", "parameter", "fixed"),
        ("Real", "output", "continuous"),
        ("Real", "input", "continuous"),
        ("Integer", "output", "discrete"),
        ("Boolean", "input", "discrete"),
        ("String", "output", "discrete"),
    ],
)
def test_variability_follows(kind: Any, causality: Any, variability: str) -> None:
    line = Variable("a", kind, causality, "x", None, "", "m" if kind == "Real" else None)
    assert line.variability == variability


@pytest.mark.parametrize(
    ("make", "reason"),
    [
        (lambda: real("input", "a", "knots", "x", 0, ""), "variable a: unit 'knots' is not one of 1, J, N"),
        (lambda: Variable("a", "Real", "input", "x", 0, ""), "variable a: a Real with unit None"),
        (lambda: Variable("a", "Integer", "input", "x", 0, "", "m"), "variable a: a Integer with unit 'm'"),
        (lambda: enumeration("input", "a", (), "x", ""), "variable a: a Enumeration with items ()"),
    ],
)
def test_a_line_that_cannot_be_is_refused(make: Any, reason: str) -> None:
    with pytest.raises(ValueError, match="variable a") as refused:
        make()
    assert reason in str(refused.value)


def test_units_agree_with_each_other() -> None:
    """J = N m, N = kg m/s2, and so on: exponents add up."""

    def exponents(name: str) -> tuple[int, int, int]:
        unit = UNITS[name]
        return unit.kg, unit.m, unit.s

    def product(*names: str) -> tuple[int, ...]:
        return tuple(map(sum, zip(*map(exponents, names), strict=True)))

    assert exponents("N") == (1, 1, -2)
    assert product("N", "m") == exponents("N.m") == exponents("J")
    assert product("N", "s") == exponents("N.s") == product("kg", "m/s")
    assert product("N.m", "s") == exponents("N.m.s") == product("N.s", "m")
    assert product("m/s", "s") == exponents("m")
    assert exponents("1") == (0, 0, 0)


def test_each_unit_has_a_quantity_of_its_own_and_a_usual_size() -> None:
    quantities = [unit.quantity for unit in UNITS.values()]
    assert len(set(quantities)) == len(quantities)
    assert all(unit.nominal > 0.0 for unit in UNITS.values())


def test_what_only_jumps_is_discrete_and_what_may_grow_is_not() -> None:
    """Linear interpolation of a collision's start or place between two points in time would invent a collision."""
    table = {line.name: line for line in COLLISION.table(("own", "target"))}
    jumping = {name for name, line in table.items() if line.kind == "Real" and line.variability == "discrete"}
    expected = {f"{contact_point(k)}.{name}" for k in range(1, 9) for name in (*CONTACT_REALS, *CONTACT_START)}
    assert jumping == expected | {"solver.residual", "impact.time", "impact.closing_speed", "impact.angle"} | {
        f"impact.{axis}" for axis in ("north", "east", "down")
    }
    for name in ("own.impulse.surge", "own.force.surge", "energy.dissipated", "clearance", "fender.stored"):
        assert table[name].variability == "continuous"


def test_moments_are_described_as_moments() -> None:
    for table in (COLLISION.table(("own", "target")), MANOEUVRING.table(())):
        for line in table:
            if line.unit in ("N.m", "N.m.s"):
                assert "oment" in line.description, line.name
            if line.unit in ("N", "N.s"):
                assert "oment" not in line.description, line.name


def test_display_units() -> None:
    def shown(name: str, value: float) -> float:
        unit = UNITS[name].display
        assert unit is not None
        return unit.factor * value

    assert shown("rad", pi) == pytest.approx(180.0, rel=1e-15)
    assert shown("rad/s", pi) == pytest.approx(180.0, rel=1e-15)
    assert shown("rev/s", 1.5) == 90.0
    assert shown("m/s", 1852.0) == pytest.approx(3600.0, rel=1e-15)  # 1 kn is 1852 m/h, BIPM SI Brochure, table 8
    for name, mega in {"N": "MN", "N.m": "MN.m", "N.s": "MN.s", "N.m.s": "MN.m.s", "J": "MJ"}.items():
        assert shown(name, 3e6) == pytest.approx(3.0, rel=1e-15)
        unit = UNITS[name].display
        assert unit is not None
        assert unit.name == mega
    assert UNITS["rev/s"].factor == 2.0 * pi


def test_the_names_of_contacts_are_those_of_the_table() -> None:
    """Recorders read these groups, each up to the contact points in use, in the order of their names."""
    table = COLLISION.table(("own", "target"))
    for kind, names in (("Real", CONTACT_REALS + CONTACT_START), ("Integer", CONTACT_INTEGERS)):
        found = [line.name for line in table if line.kind == kind and line.name.startswith("contact[2].")]
        assert sorted(found) == sorted(named(contact_point(2), names))
    assert set(ENERGY) <= {line.name for line in table}
