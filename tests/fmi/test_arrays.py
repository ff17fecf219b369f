"""The table of variables as FMI 3.0 has it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from shipcollision_fmu.fmi.arrays import Layout, gather_arrays
from shipcollision_fmu.fmi.names import ANGLES, AXES, FORCE, HULL, LINEAR, MOMENT, named
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from shipcollision_fmu.fmi.variables import FORCE_UNITS, IMPULSE_UNITS, Array, real, vector, wrench

TABLES = (COLLISION.table(("own", "target", "third")), MANOEUVRING.table(()))


@pytest.mark.parametrize("table", TABLES)
def test_every_scalar_is_in_one_place(table: tuple[object, ...]) -> None:
    scalars = sorted(scalar for array in gather_arrays(table) for scalar in array.references)  # type: ignore[arg-type]  # the table of an interface
    assert scalars == list(range(len(table)))


@pytest.mark.parametrize("table", TABLES)
def test_names_are_unique_and_differ_from_no_scalar_in_meaning(table: tuple[object, ...]) -> None:
    names = [array.name for array in gather_arrays(table)]  # type: ignore[arg-type]  # the table of an interface
    assert len(set(names)) == len(names)


def test_vectors_and_blocks_become_arrays() -> None:
    table = TABLES[0]  # of three ships: twelve contact points
    found = {array.name: array for array in gather_arrays(table)}
    assert found["own.position"].shape == (3,)
    assert [table[k].name for k in found["own.position"].references] == [
        "own.position.north", "own.position.east", "own.position.down",
    ]  # fmt: skip
    assert found["contact.gap"].shape == (12,)
    assert found["contact.normal"].shape == (12, 3)
    rows = [table[k].name for k in found["contact.normal"].references]
    assert rows[:4] == [f"contact[{k}].normal.{c}" for k, c in ((1, "north"), (1, "east"), (1, "down"), (2, "north"))]
    assert found["contact.normal"].description == "Unit normal from ship_a to ship_b in n: north, east, down"
    assert found["contact.ship_a"].shape == (12,)
    assert found["clearance"].shape == ()
    assert found["impact.position"].shape == (3,)
    assert not [name for name in found if "[" in name]


def test_halves_of_a_wrench_are_told_apart() -> None:
    lines = wrench("output", HULL, FORCE_UNITS, "o", "", "CO") + wrench(
        "output", named("dent", (*LINEAR, *ANGLES)), IMPULSE_UNITS, "o", "", "CO"
    )
    lines += wrench("input", (*FORCE, *MOMENT), FORCE_UNITS, "i", "", "CO")
    assert [(array.name, array.line.unit) for array in gather_arrays(lines)] == [
        ("hull.force", "N"), ("hull.moment", "N.m"), ("dent.linear", "N.s"), ("dent.angular", "N.m.s"),
        ("force", "N"), ("moment", "N.m"),
    ]  # fmt: skip


def test_a_layout_finds_a_scalar() -> None:
    layout = Layout(TABLES[1])
    assert layout.place("position.north") == (1, 0)
    assert layout.place("attitude.yaw") == (2, 2)
    assert layout.place("nothing") is None
    assert layout.array(2).name == "attitude"


def test_what_does_not_belong_together_is_refused() -> None:
    xyz = vector("input", named("a", AXES), "m", "p", "")
    with pytest.raises(ValueError, match=r"array a: a\.z is not of the same kind as a\.x"):
        gather_arrays((*xyz[:2], replace(xyz[2], unit="s")))
    with pytest.raises(ValueError, match=r"array a has shape \(3,\) and 2 elements"):
        gather_arrays(xyz[:2])
    twice = real("input", "one", "m", "p", 0, ""), real("input", "b", "m", "p", 0, "", array=Array("one", (1,), ""))
    with pytest.raises(ValueError, match=r"array one has the name of the scalar one"):
        gather_arrays(twice)
