"""Names of ships: one rule for the model, the FMUs and the scenario."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from shipcollision_fmu import InputError, ShipCollision, build_fmus
from shipcollision_fmu.collision.ship_names import RESERVED, check_ship_names
from shipcollision_fmu.fmi.ship_collision import table


@pytest.mark.parametrize("source", ["", "ferry.toml", "kvlc2"])
def test_a_refused_ship_is_named(source: str, tmp_path: Path) -> None:
    model = ShipCollision(("own", "target"))
    model.directory = tmp_path
    model.parameters.ships[1].ship = source
    with pytest.raises(InputError, match=r"^target\.ship: .*ship ") as refused:
        model.initialise()
    assert ("looked for in" in str(refused.value)) == (source == "ferry.toml")
    assert (str(tmp_path) in str(refused.value)) == (source == "ferry.toml")


@pytest.mark.parametrize(
    ("ships", "line"),
    [
        (("a b", "c"), "ships: 'a b' is no name for a ship"),
        (("own", "2nd"), "ships: '2nd' is no name for a ship"),
        (("own", "fähre"), "ships: 'fähre' is no name for a ship"),
        (("own", 3), "ships: 3 is no name for a ship"),
        (("friction", "contact"), "ships: 'friction' is no name for a ship"),
        (("own", "own"), "ships: 'own' is there twice: give each ship a name of its own"),
        ((), r"ships = \(\) must be a tuple of one or more names, such as \('own', 'target'\)"),
        ("own", r"ships = 'own' must be a tuple of one or more names"),
    ],
)
def test_bad_names_are_refused_by_the_model_and_by_the_builder(ships: Any, line: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=f"^{line}"):
        ShipCollision(ships)
    with pytest.raises(InputError, match=f"^{line}"):
        build_fmus(tmp_path / "out", ships=ships)
    assert list(tmp_path.iterdir()) == []


def test_one_ship_is_enough() -> None:
    assert check_ship_names(["a"]) == ("a",)
    assert ShipCollision(["a"]).names == ("a",)


def test_every_group_of_the_fmus_own_variables_is_reserved() -> None:
    groups = {variable.name.split(".")[0].split("[")[0] for variable in table(("own", "target"))}
    assert groups - {"own", "target"} <= RESERVED
